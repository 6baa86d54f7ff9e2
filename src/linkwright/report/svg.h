// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "linkwright/report/drawing.h"
#include "linkwright/study/scene.h"

namespace linkwright::report {

/// Options for drawing a scene as a picture.
struct SvgOptions {
  std::optional<std::size_t> sample;      ///< pose to draw; none = the first that is assembled
  double width = 900;                     ///< width of the picture (px)
  double max_height = 680;                ///< the scale is chosen so that the picture is not higher (px)
  bool grid = true;                       ///< grid with lengths
  std::optional<LengthUnit> length = {};  ///< unit of the grid; none = mm or m by the size of the scene
  bool traces = true;
  bool targets = true;         ///< target points with whiskers to what is achieved
  bool labels = true;          ///< names of the joints
  int ghosts = 0;              ///< pale poses at equal distances over the samples
  bool forces = true;          ///< arrows of forces and couples, with an arrow that gives their scale
  bool velocities = false;     ///< arrows of velocities, likewise
  bool accelerations = false;  ///< arrows of accelerations, likewise
  double whisker_scale = 1;    ///< errors are drawn this many times larger
};

/// The scene as a complete SVG 1.1 document (UTF-8, no scripts, nothing loaded), drawn to scale. A spatial
/// scene is seen from behind, from the left and from above (see viewpoints), in one scale and up to one and a
/// half times `max_height` high; of a scene with a second input, the samples with that of `sample` are drawn.
/// Points that do not exist at the sample are left out with the bodies and joints that need them; a scene
/// without any finite point gives a picture that says so. Throws ContractError when `sample` is not one of
/// the scene.
std::string svg(const study::Scene& scene, const SvgOptions& options = {});

}  // namespace linkwright::report
