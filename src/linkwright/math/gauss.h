// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Integrals by Gauss's rule.
namespace linkwright::math {

/// Integral by the rule of five points, exact for polynomials of degree 9.
/// @tparam F callable with a double that returns a double
/// @param f function
/// @param a lower end of the interval
/// @param b upper end of the interval
/// @returns the integral of f from a to b
template <class F>
double gauss_integral(F&& f, double a, double b) {
  constexpr double x[] = {0, 0.53846931010568309, 0.90617984593866399};
  constexpr double w[] = {0.56888888888888889, 0.47862867049936647, 0.23692688505618909};
  const double middle = (a + b) / 2, half = (b - a) / 2;
  double sum = w[0] * f(middle);
  for (int k = 1; k < 3; ++k) sum += w[k] * (f(middle - half * x[k]) + f(middle + half * x[k]));
  return half * sum;
}

}  // namespace linkwright::math
