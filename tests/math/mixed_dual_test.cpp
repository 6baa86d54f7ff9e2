// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/mixed_dual.h"

#include <gtest/gtest.h>

namespace linkwright::math {
namespace {

using M = MixedDual<1>;
using D1 = Dual<1>;

// The mixed derivative of f(x, y) by x, the first direction, and y, the further one.
TEST(MixedDual, EveryOperationAgreesWithDifferencesOfDualNumbers) {
  const auto check = [](auto f) {
    const double x = 0.7, y = -0.4, h = 1e-5;
    const M both = f(M(D1::variable(x, 0), D1(0.0)), M(D1(y), D1(1.0)));
    const auto at = [&](double dy) {
      return f(M(D1::variable(x, 0), D1(0.0)), M(D1(y + dy), D1(0.0))).value;
    };
    EXPECT_EQ(both.value, at(0));
    EXPECT_EQ(value_of(both), at(0).value);
    EXPECT_NEAR(both.by.value, (at(h).value - at(-h).value) / (2 * h), 1e-8);
    EXPECT_NEAR(both.by.by[0], (at(h).by[0] - at(-h).by[0]) / (2 * h), 1e-8);
  };
  check([](M x, M y) { return x + y; });
  check([](M x, M y) { return x - y; });
  check([](M x, M y) { return x * y; });
  check([](M x, M y) { return x / y; });
  check([](M x, M y) { return -(x * y); });
  check([](M x, M y) { return 2.0 + x * y * y; });
  check([](M x, M y) { return x * y + 2.0; });
  check([](M x, M y) { return 1.0 - x * x * y; });
  check([](M x, M y) { return x * y - 1.0; });
  check([](M x, M y) { return 3.0 * (x * y); });
  check([](M x, M y) { return (x * y) / 3.0; });
  check([](M x, M y) { return 3.0 / (x * x + y * y); });
  check([](M x, M y) { return sqrt(x * x + y * y); });
  check([](M x, M y) { return abs(x * y); });
  check([](M x, M y) { return sin(x * y); });
  check([](M x, M y) { return cos(x * y) * x; });
  check([](M x, M y) { return atan2(x * y, x + y); });
  check([](M x, M y) {
    M sum = x;
    sum += x * y;
    sum -= y * y * x;
    return sum;
  });
  check([](M x, M y) { return norm(x * Vec3{1, 2, 3} + y * Vec3{-1, 0, 1}); });
}

TEST(MixedDual, ComparesTheNumbersAlone) {
  const M two(2), three(D1::variable(3, 0), D1(5.0));
  EXPECT_TRUE(two < three && three > two && two < 2.5 && three > 2.5);
  EXPECT_FALSE(three < two || two > three || three == two);
}

}  // namespace
}  // namespace linkwright::math
