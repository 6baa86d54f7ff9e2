// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/angles.h"

#include <cmath>

#include "linkwright/core/numbers.h"

namespace linkwright::math {

double wrap_angle(double angle) {
  if (angle > -pi && angle <= pi) return angle;
  // Both results are exact (Sterbenz), so they equal the slower remainder.
  if (angle > pi && angle <= 3 * pi) return angle - 2 * pi;
  if (angle <= -pi && angle > -3 * pi) return angle + 2 * pi;
  const double wrapped = std::remainder(angle, 2 * pi);
  return wrapped <= -pi ? pi : wrapped;
}

double into_range(double angle, double lower, double upper) {
  const double turned = angle - 2 * pi * std::floor((angle - lower) / (2 * pi));
  return turned <= upper ? turned : angle;
}

double angle_difference(double to, double from) { return wrap_angle(to - from); }

void unwrap_angles(std::span<double> angles) {
  double previous = 0, turns = 0;
  bool first = true;
  for (double& angle : angles) {
    if (std::isnan(angle)) continue;
    const double raw = angle;
    // Whole turns are counted, not summed up in the angle, so that no rounding gathers over a long sequence.
    if (!first) turns -= std::round((raw - previous - angle_difference(raw, previous)) / (2 * pi));
    angle = raw + turns * (2 * pi);
    previous = raw;
    first = false;
  }
}

}  // namespace linkwright::math
