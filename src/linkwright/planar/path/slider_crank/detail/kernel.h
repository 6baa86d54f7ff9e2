// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "linkwright/math/scalar.h"
#include "linkwright/math/vector2.h"

// Formulas of the slider-crank in the frame of its guide, written once for `double`, dual numbers and SIMD
// batches: the x axis runs along the guide, the crank pivot O is the origin, and the guide line lies at
// `offset` along y.
namespace linkwright::planar {

/// The rod A-B of a slider-crank for one place of the crank pin.
template <class T>
struct RodClosure {
  T sine;      ///< sine of the rod's angle from the guide: the pressure angle has its magnitude
  T radicand;  ///< 1 - sine^2: negative = no assembly, zero = rod square to the guide, where the modes meet
};

/// Boskovic 2018, Eq. (4.9), without the arcsine. `across` = L2 sin(theta2 - delta): y of the crank pin.
/// The offset is that of the program, the H of the source with the opposite sign.
template <class T>
LINKWRIGHT_KERNEL RodClosure<T> close_rod(const T& across, const T& offset, const T& inverse_rod) {
  const T sine = (offset - across) * inverse_rod;
  return {sine, (T(1.0) - sine) * (T(1.0) + sine)};
}

/// Unit vector along A->B. `side` = +1 slider ahead of the crank pin along the guide direction, -1 behind it.
/// Where the rod does not reach the guide the root counts as zero and the vector is longer than 1: finite,
/// and to be flagged by the caller.
template <class T>
LINKWRIGHT_KERNEL math::Vector2<T> rod_direction(const RodClosure<T>& closure, const T& side) {
  using std::sqrt;
  return {side * sqrt(math::Scalar<T>::positive_part(closure.radicand)), closure.sine};
}

/// The travel of the slider from the pin-in-line position away from the crank pivot to the one towards it,
/// over a full turn of the crank: 4 L2 L3 / (s1 + s2) with s1,2 = sqrt((L2 +- L3)^2 - offset^2), which loses
/// no digits of a short crank.
template <class T>
LINKWRIGHT_KERNEL T slider_stroke(const T& crank, const T& rod, const T& offset) {
  using S = math::Scalar<T>;
  using std::sqrt;
  const T sum = rod + crank, difference = rod - crank;
  const T outer = sqrt(S::positive_part((sum - offset) * (sum + offset)));
  const T inner = sqrt(S::positive_part((difference - offset) * (difference + offset)));
  return T(4.0) * crank * rod / (outer + inner);
}

}  // namespace linkwright::planar
