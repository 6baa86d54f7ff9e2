// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/scene.h"

namespace linkwright::report::test {

using study::Scene;

/// A parallel crank of 30 mm with a coupler of 100 mm, which passes between its fixed pivots.
inline Scene parallel_crank() {
  Scene scene;
  scene.name = "crank";
  for (int i = 0; i < 36; ++i) scene.input.push_back(i * pi / 18);
  const auto moving = [&](const char* name, double x) {
    Scene::Point out{name, {}, {}};
    for (const double angle : scene.input) {
      out.x.push_back(x + 0.03 * std::cos(angle));
      out.y.push_back(0.03 * std::sin(angle));
    }
    return out;
  };
  scene.points = {{"O", {0}, {0}}, moving("A", 0), moving("B", 0.1), {"Q", {0.1}, {0}}};
  scene.bodies = {{"crank", {0, 1}}, {"coupler", {1, 2}}, {"rocker", {3, 2}}};
  scene.joints = {{"O", 0, Scene::JointStyle::ground_pivot},
                  {"A", 1},
                  {"B", 2},
                  {"Q", 3, Scene::JointStyle::ground_pivot}};
  return scene;
}

inline const study::PartSizes sizes{.width = 0.012, .thickness = 0.004, .pin_diameter = 0.005};

}  // namespace linkwright::report::test
