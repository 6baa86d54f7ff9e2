// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "linkwright/math/scalar.h"

namespace linkwright::math {

/// Sine and cosine of x in radians, |x| <= 1e5, absolute error below 3e-16 times (1 + |x| / 1e3);
/// branch-free, so that the same source serves `double` and SIMD batches with the same bits. Argument
/// reduction by multiples of pi/2 in three parts (Cody and Waite 1980), then minimax polynomials on [-pi/4,
/// pi/4] (coefficients published with Cephes, Moshier 1984).
template <class T>
LINKWRIGHT_KERNEL void sincos(const T& x, T& sine, T& cosine) {
  using S = Scalar<T>;
  const T shift(
      0x1.8p52);  // adding it leaves no room for fraction bits: the nearest whole number, for |x| < 2^51
  const T quarter = (x * T(0.63661977236758134308) + shift) - shift;
  T r = S::multiply_add(quarter, T(-1.57079632673412561417e+00), x);
  r = S::multiply_add(quarter, T(-6.07710050630396597660e-11), r);
  r = S::multiply_add(quarter, T(-2.02226624879595063154e-21), r);
  const T z = r * r;
  T s = S::multiply_add(z, T(1.58969099521155010221e-10), T(-2.50507602534068634195e-08));
  s = S::multiply_add(z, s, T(2.75573137070700676789e-06));
  s = S::multiply_add(z, s, T(-1.98412698298579493134e-04));
  s = S::multiply_add(z, s, T(8.33333333332248946124e-03));
  s = S::multiply_add(z, s, T(-1.66666666666666324348e-01));
  s = S::multiply_add(z * r, s, r);
  T c = S::multiply_add(z, T(-1.13596475577881948265e-11), T(2.08757232129817482790e-09));
  c = S::multiply_add(z, c, T(-2.75573143513906633035e-07));
  c = S::multiply_add(z, c, T(2.48015872894767294178e-05));
  c = S::multiply_add(z, c, T(-1.38888888888741095749e-03));
  c = S::multiply_add(z, c, T(4.16666666666666019037e-02));
  c = S::multiply_add(z * z, c, S::multiply_add(z, T(-0.5), T(1.0)));
  // Quadrant q = quarter mod 4 without integers: quarter = 4 whole + q, q in {-2, -1, 0, 1, 2}.
  const T q = quarter - T(4.0) * ((quarter * T(0.25) + shift) - shift);
  const auto odd = (q * q) == T(1.0);
  const T swapped_s = S::choose(odd, c, s);
  const T swapped_c = S::choose(odd, s, c);
  // sin: q = 0: s, 1: c, +-2: -s, -1: -c;  cos: q = 0: c, 1: -s, +-2: -c, -1: s.
  sine = S::choose((q == T(1.0)) | (q == T(0.0)), swapped_s, -swapped_s);
  cosine = S::choose((q == T(0.0)) | (q == T(-1.0)), swapped_c, -swapped_c);
}

/// The same for any x: beyond its range by the functions of the library.
inline void sincos_of_any(double x, double& sine, double& cosine) {
  if (std::abs(x) <= 1e5) {
    sincos(x, sine, cosine);
  } else {
    sine = std::sin(x);
    cosine = std::cos(x);
  }
}

}  // namespace linkwright::math
