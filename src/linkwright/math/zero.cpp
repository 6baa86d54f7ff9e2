// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/zero.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linkwright/core/check.h"

namespace linkwright::math {

double zero_between(FunctionRef<double(double)> f, double a, double b) {
  double fa = f(a), fb = f(b);
  if (fa == 0) return a;
  if (fb == 0) return b;
  LINKWRIGHT_REQUIRE((fa < 0) != (fb < 0), "no change of sign: f({}) = {}, f({}) = {}", a, fa, b, fb);
  const double filler = fa;
  // a: newest point, b: the other side, c: the point before.
  double share = 0.5;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double x = a + share * (b - a);
    if (x == a || x == b) break;
    double fx = f(x);
    if (!std::isfinite(fx)) fx = filler;
    if (fx == 0) return x;
    const bool same_side = (fx < 0) == (fa < 0);
    const double c = same_side ? a : b, fc = same_side ? fa : fb;
    if (!same_side) b = a, fb = fa;
    a = x, fa = fx;
    const double smallest = std::numeric_limits<double>::epsilon() * std::max(std::abs(a), std::abs(b));
    const double least = 0.5 * smallest / std::abs(b - a);
    if (least > 0.5) break;
    const double xi = (a - b) / (c - b), phi = (fa - fb) / (fc - fb);
    share = 0.5;
    if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)
      share = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb);
    share = std::clamp(share, least, 1 - least);
  }
  return std::abs(fa) < std::abs(fb) ? a : b;
}

Boundary bisect(FunctionRef<bool(double)> holds, double inside, double outside, const BisectionStop& stop) {
  for (int k = 0; k < stop.halvings; ++k) {
    if (!(std::abs(outside - inside) > stop.relative * std::max(std::abs(inside), std::abs(outside)))) break;
    const double middle = (inside + outside) / 2;
    if (middle == inside || middle == outside) break;
    (holds(middle) ? inside : outside) = middle;
  }
  return {inside, outside};
}

}  // namespace linkwright::math
