// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/minimum.h"

#include <algorithm>
#include <cmath>

namespace linkwright::math {

Minimum minimum_about(FunctionRef<double(double)> f, double a, double b, double c, const MinimumStop& stop) {
  constexpr double golden = 0.38196601125010515;  // (3 - sqrt(5)) / 2
  Minimum out{b, f(b)};
  for (int k = 0; k < stop.sections; ++k) {
    const double width = std::max(stop.absolute, stop.relative * std::max(std::abs(a), std::abs(c)));
    if (!(std::abs(c - a) > width)) break;
    const bool right = std::abs(c - out.at) > std::abs(out.at - a);
    const double x = right ? out.at + golden * (c - out.at) : out.at - golden * (out.at - a);
    const double value = f(x);
    if (value < out.value) {
      (right ? a : c) = out.at;
      out = {x, value};
    } else {
      (right ? c : a) = x;
    }
  }
  return out;
}

}  // namespace linkwright::math
