// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/parallel/assembly_modes/platform_equations.h"

namespace linkwright::parallel {

/// The proof about the solutions of a platform near a point, rounding included: exactly one is within
/// `radius` of it, both scaled so that the greatest of the eight numbers, the chart, is 1.
struct PlatformProof {
  bool unique = false;
  bool finite = false;   ///< n is not 0: it is a place of the platform
  bool real = false;     ///< the solution is real (the platform and the point must be)
  bool complex = false;  ///< it is not
  double radius = 0;     ///< greatest difference of each number
};

/// The theorem of Newton and Kantorovich in the form of Krawczyk's operator T(y) = y - A F(y), A about the
/// inverse of the Jacobian J at x. F is quadratic: with beta >= |A F(x)|, delta >= |1 - A J(x)| and kappa >=
/// |A F''|, T takes the ball of radius r into itself and contracts it if beta + delta r + kappa r^2 / 2 <= r
/// and delta + kappa r < 1. Errors of rounding are bounded by 64 units in the last place times the same
/// expressions of magnitudes, more than twice what the longest chain of operations can collect. A ball about
/// a real point is its own conjugate, and so is its only solution. It is proved for the numbers in `legs` as
/// they are.
PlatformProof prove(const PlatformLegs& legs, const PlatformPoint& x);

/// Proofs `a` of x and `b` of y are of different solutions.
bool apart(const PlatformPoint& x, const PlatformProof& a, const PlatformPoint& y, const PlatformProof& b);

}  // namespace linkwright::parallel
