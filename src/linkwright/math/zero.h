// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/math/function_ref.h"

namespace linkwright::math {

/// A zero of a continuous function between a and b, where its values have different signs (or are zero), to
/// the last digit of x: inverse quadratic interpolation where it is safe, else halving (Chandrupatla 1997).
/// Of several zeros it finds one. Values that are not finite count as having the sign of f(a).
///
/// Throws ContractError when f(a) and f(b) have the same sign.
double zero_between(FunctionRef<double(double)> f, double a, double b);

/// A bracket of a place where a condition changes: it holds at `inside` and does not at `outside`.
struct Boundary {
  double inside, outside;
};

struct BisectionStop {
  double relative = 0;  ///< width of the bracket over its larger end
  int halvings = 2100;  ///< at most: a double has no more
};

/// Halves a bracket, whose ends are taken as they are, until it is narrow enough or no number lies between.
Boundary bisect(FunctionRef<bool(double)> holds, double inside, double outside, const BisectionStop& stop);

}  // namespace linkwright::math
