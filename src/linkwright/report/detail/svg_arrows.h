// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "linkwright/report/arrows.h"
#include "linkwright/study/scene.h"

/// Arrows, couples and their key in SVG; part of svg().
namespace linkwright::report {

class Canvas;

/// A quantity whose arrows are drawn, and how long they are.
struct ShownArrows {
  study::Scene::Quantity quantity;
  ArrowScale scale;
};

void draw_vectors(std::string& out, const Canvas& canvas, const study::Scene& scene, std::size_t sample,
                  const ShownArrows& shown, bool labels);
void draw_moments(std::string& out, const Canvas& canvas, const study::Scene& scene, std::size_t sample,
                  bool labels);
/// Draws the key: the value of an arrow of the length shown, one line a quantity, at the top left.
void draw_key(std::string& out, const Canvas& canvas, const study::Scene& scene,
              const std::vector<ShownArrows>& shown);

}  // namespace linkwright::report
