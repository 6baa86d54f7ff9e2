#pragma once

#include "linkwright/math/function_ref.h"

namespace linkwright::math {

/// A zero of a continuous function between a and b, where its values have different signs (or are zero), to
/// the last digit of x: inverse quadratic interpolation where it is safe, else halving (Chandrupatla 1997).
/// Of several zeros it finds one. Values that are not finite count as having the sign of f(a).
///
/// Throws ContractError when f(a) and f(b) have the same sign.
double zero_between(FunctionRef<double(double)> f, double a, double b);

}  // namespace linkwright::math
