// SPDX-License-Identifier: BSD-3-Clause
#include <complex>

#include "linkwright/math/angles.h"
#include "linkwright/math/vector2.h"

namespace linkwright::math {

std::complex<double> transform(const Pose& pose, std::complex<double> point) {
  return std::complex(pose.x, pose.y) + std::polar(1.0, pose.angle) * point;
}

Pose compose(const Pose& outer, const Pose& inner) {
  const std::complex<double> origin = transform(outer, {inner.x, inner.y});
  return {origin.real(), origin.imag(), wrap_angle(outer.angle + inner.angle)};
}

Pose inverse(const Pose& pose) {
  const std::complex<double> origin = -std::polar(1.0, -pose.angle) * std::complex(pose.x, pose.y);
  return {origin.real(), origin.imag(), wrap_angle(-pose.angle)};
}

Pose difference(const Pose& to, const Pose& from) {
  // Not through the inverse: the difference of near poses far from the origin keeps its digits.
  const std::complex<double> way(to.x - from.x, to.y - from.y);
  const std::complex<double> seen = std::polar(1.0, -from.angle) * way;
  return {seen.real(), seen.imag(), angle_difference(to.angle, from.angle)};
}

}  // namespace linkwright::math
