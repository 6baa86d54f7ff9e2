// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/planar/type_synthesis/stroke.h"

namespace linkwright::planar {

/// What stands out in a stroke.
struct StrokeShape {
  double retraced = 0;       ///< share of the stroke that is traced again in the other sense
  int crossings = 0;         ///< places where it crosses itself
  bool straight = false;     ///< on one line
  bool circle = false;       ///< on one circle
  double circle_radius = 0;  ///< of the circle that fits best, in sizes
};

StrokeShape stroke_shape_of(const SampledStroke& stroke);

}  // namespace linkwright::planar
