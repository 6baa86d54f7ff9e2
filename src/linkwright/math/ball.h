// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include "linkwright/math/complex.h"
#include "linkwright/math/double_double.h"

namespace linkwright::math {

/// Bound on the error of one operation with such numbers: twice what rounding does, relative to its result.
template <class T>
inline constexpr double rounding_bound = 0;
template <>
inline constexpr double rounding_bound<double> = 0x1p-52;
template <>
inline constexpr double rounding_bound<DoubleDouble> = 0x1p-100;

/// All complex numbers within `radius` of `middle`. Sums and products hold every sum and product of what is
/// in their parts, rounding included: what holds for the ball holds for the exact numbers. T: any with a
/// rounding_bound.
template <class T>
struct Ball {
  Complex<T> middle;
  double radius = 0;

  Ball() = default;
  explicit Ball(const Complex<T>& at, double within = 0) : middle(at), radius(within) {}

  /// A bound of |z| for every z of the ball.
  double size() const { return up(magnitude(middle) + radius); }

  friend Ball operator+(const Ball& a, const Ball& b) {
    const Complex<T> sum = a.middle + b.middle;
    return Ball(sum, up(a.radius + b.radius + rounding * magnitude(sum)));
  }
  friend Ball operator-(const Ball& a) { return Ball(-a.middle, a.radius); }
  friend Ball operator-(const Ball& a, const Ball& b) { return a + -b; }
  friend Ball operator*(const Ball& a, const Ball& b) {
    const double x = magnitude(a.middle), y = magnitude(b.middle);
    return Ball(a.middle * b.middle,
                up(x * b.radius + y * a.radius + a.radius * b.radius + 4 * rounding * (x * y)));
  }

 private:
  static constexpr double rounding = rounding_bound<T>;
  static_assert(rounding > 0);
  /// The few operations of a radius round as well.
  static double up(double bound) { return bound * (1 + 0x1p-48) + 1e-300; }
  static double magnitude(const Complex<T>& z) {
    return std::abs(static_cast<double>(z.re)) + std::abs(static_cast<double>(z.im));
  }
};

}  // namespace linkwright::math
