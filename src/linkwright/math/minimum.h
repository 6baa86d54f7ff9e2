// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/math/function_ref.h"

namespace linkwright::math {

/// The search for a minimum of a function between `low` and `high` (in either order) by golden sections
/// (Kiefer 1953): two places inside divide the bracket, and `narrow` drops what lies beyond the higher of
/// them, 38 % of the bracket for one value. It finds the only minimum, of several one; the place comes down
/// to about the square root of rounding. Where both values are the same, it continues towards `high`. The
/// caller says when it ends.
template <class F>
struct GoldenSection {
  static constexpr double share = 0.6180339887498949;  // (sqrt(5) - 1) / 2

  F f;
  double low, high;  ///< the bracket
  double left = high - share * (high - low), right = low + share * (high - low);
  double at_left = f(left), at_right = f(right);

  void narrow() {
    if (at_left < at_right) {
      high = right;
      right = left, at_right = at_left;
      left = high - share * (high - low), at_left = f(left);
    } else {
      low = left;
      left = right, at_left = at_right;
      right = low + share * (high - low), at_right = f(right);
    }
  }
};
template <class F>
GoldenSection(F, double, double) -> GoldenSection<F>;

struct Minimum {
  double at, value;
};

struct MinimumStop {
  double absolute = 0, relative = 0;  ///< width of the bracket, and over its larger end
  int sections = 100;                 ///< at most
};

/// The lowest place found between a and c (in either order) when b between them is known to be low: golden
/// sections of the larger part. The value never exceeds f(b), whatever the function; one that is not finite
/// counts as higher.
Minimum minimum_about(FunctionRef<double(double)> f, double a, double b, double c, const MinimumStop& stop);

}  // namespace linkwright::math
