// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/zero.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::math {
namespace {

TEST(ZeroBetween, FindsZerosToTheLastDigit) {
  // One unit in the last place of the zero, which is where the sign of the function changes.
  const double eps = std::numeric_limits<double>::epsilon();
  EXPECT_NEAR(zero_between([](double x) { return std::cos(x); }, 1, 2), pi / 2, 2 * eps);
  EXPECT_NEAR(zero_between([](double x) { return x * x * x - 2; }, 5, 0), std::cbrt(2.0), 2 * eps);
  EXPECT_NEAR(zero_between([](double x) { return std::exp(x) - 1e-3; }, -50, 50), std::log(1e-3), 16 * eps);
}

TEST(ZeroBetween, TakesFewStepsOnSmoothFunctionsAndNotManyOnSteepOnes) {
  int calls = 0;
  zero_between([&](double x) { return ++calls, std::cos(x); }, 1, 2);
  EXPECT_LE(calls, 12);
  calls = 0;
  const double x = zero_between([&](double v) { return ++calls, v < 0.3 ? -1.0 : 1e9; }, 0, 1);
  EXPECT_NEAR(x, 0.3, 1e-15);
  EXPECT_LE(calls, 80);
}

TEST(ZeroBetween, TakesAnEndThatIsZero) {
  EXPECT_EQ(zero_between([](double x) { return x - 1; }, 1, 2), 1);
  EXPECT_EQ(zero_between([](double x) { return x - 2; }, 1, 2), 2);
}

TEST(ZeroBetween, WantsAChangeOfSign) {
  EXPECT_THROW(zero_between([](double x) { return x * x + 1; }, -1, 1), ContractError);
}

TEST(Bisect, NarrowsABracketFromEitherSide) {
  const auto below = [](double x) { return x < 0.3; };
  const Boundary b = bisect(below, 0, 1, {.relative = 1e-3});
  EXPECT_LT(b.inside, 0.3);
  EXPECT_GE(b.outside, 0.3);
  EXPECT_LE(b.outside - b.inside, 1e-3 * b.outside);
  const Boundary c = bisect([](double x) { return x > 0.3; }, 1, 0, {.relative = 1e-3});
  EXPECT_GT(c.inside, 0.3);
  EXPECT_LE(c.outside, 0.3);
}

TEST(Bisect, GoesOnToTheLastDigit) {
  const Boundary b = bisect([](double x) { return x * x < 2; }, 0, 1e300, {});
  EXPECT_LT(b.inside * b.inside, 2);
  EXPECT_EQ(b.outside, std::nextafter(b.inside, 2));
  EXPECT_EQ(bisect([](double x) { return x <= 0; }, 0, 1e300, {}).outside,
            std::numeric_limits<double>::denorm_min());
}

TEST(Bisect, HalvesNoMoreThanAsked) {
  int calls = 0;
  const Boundary b = bisect([&](double x) { return ++calls, x < 0.3; }, 0, 1, {.halvings = 3});
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(b.inside, 0.25);
  EXPECT_EQ(b.outside, 0.375);
}

}  // namespace
}  // namespace linkwright::math
