// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/assembly_modes/platform_equations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "parallel/platforms.h"

namespace linkwright::parallel {
namespace {

double largest(const PlatformPoint& x) {
  double out = 0;
  for (const Complex& c : x) out = std::max(out, std::abs(c));
  return out;
}

TEST(PlatformEquations, HoldWhereTheLegsHaveTheirLengths) {
  // The squares come from the pose by vectors alone.
  const PlacedPlatform placed = placed_platform(1);
  PlatformValues at;
  evaluate(placed.legs, placed.point, placed.point, at);
  EXPECT_LT(largest(at.value), 1e-14);  // a few roundings of numbers about 1
  // A leg that is longer by d has the residual -(2 L d + d^2) n.
  PlatformLegs longer = placed.legs;
  longer.square.re[3] += 0.25;
  evaluate(longer, placed.point, placed.point, at);
  EXPECT_NEAR(at.value[3].real(), -0.25 * placed.rotation_square, 1e-14);
  EXPECT_LT(std::abs(at.value[2]), 1e-14);
}

TEST(PlatformEquations, HaveTheJacobianOfTheirDifferences) {
  const PlatformLegs legs = complex_platform(2);
  const PlatformPoint x = complex_point(3);
  PlatformValues at, plus, minus;
  evaluate(legs, x, x, at);
  for (int k = 0; k < 8; ++k)
    for (const Complex by : {Complex{0.5, 0}, Complex{0, 0.5}}) {
      PlatformPoint more = x, less = x;
      more[k] += by;
      less[k] -= by;
      evaluate(legs, more, x, plus);
      evaluate(legs, less, x, minus);
      // Central differences of quadratic functions are exact.
      for (int i = 0; i < 8; ++i) {
        const Complex difference = (plus.value[i] - minus.value[i]) / (2.0 * by);
        EXPECT_LT(std::abs(difference - Complex(at.jacobian.re[k][i], at.jacobian.im[k][i])), 1e-13)
            << k << i;
      }
    }
}

TEST(PlatformEquations, SquaresThroughAPointMakeItASolution) {
  PlatformLegs legs = complex_platform(4);
  const PlatformPoint x = complex_point(5);
  legs.square = squares_through(legs, x);
  PlatformValues at;
  evaluate(legs, x, x, at);
  for (int i = 0; i < 6; ++i) EXPECT_LT(std::abs(at.value[i]), 1e-13);
}

TEST(PlatformEquations, ScaledPlatformsHaveScaledSolutions) {
  const PlacedPlatform placed = placed_platform(6);
  const Complex factor{0.3, -1.2};
  const PlatformPoint x = scaled(placed.point, factor);
  PlatformValues at;
  evaluate(scaled(placed.legs, factor), x, x, at);
  EXPECT_LT(largest(at.value), 1e-14);
}

TEST(PlatformEquations, DistanceIsTheSineOfTheAngle) {
  PlatformPoint x{}, y{};
  x[0] = {0, 2};
  y[0] = 3 * std::cos(1e-9);
  y[5] = 3 * std::sin(1e-9);
  EXPECT_NEAR(distance(x, y), 1e-9, 1e-24);  // relative rounding
  EXPECT_NEAR(distance(x, x), 0, 1e-16);
  y[0] = 0;
  EXPECT_NEAR(distance(x, y), 1, 1e-15);
  EXPECT_EQ(conjugate(x)[0], Complex(0, -2));
}

TEST(EightLu, SolvesAndTellsSingularMatrices) {
  const PlatformLegs legs = complex_platform(7);
  const PlatformPoint x = complex_point(8), y = complex_point(9);
  PlatformValues at;
  evaluate(legs, x, x, at);
  PlatformPoint right{};
  for (int k = 0; k < 8; ++k)
    for (int i = 0; i < 8; ++i) right[i] += Complex(at.jacobian.re[k][i], at.jacobian.im[k][i]) * y[k];
  EightLu lu;
  ASSERT_TRUE(lu.factor(at.jacobian));
  lu.solve(right);
  for (int k = 0; k < 8; ++k) EXPECT_LT(std::abs(right[k] - y[k]), 1e-12);  // condition about 100
  EXPECT_FALSE(lu.factor(Eight{}));
  at.jacobian.re[2][3] = NAN;
  EXPECT_FALSE(lu.factor(at.jacobian));
}

TEST(PlatformSeries, FollowsTheSolutionToItsOrder) {
  PlatformLegs legs = complex_platform(10);
  const PlatformLegs rate = complex_platform(11);
  PlatformPoint x = complex_point(12);
  x = normalised(x);
  legs.square = squares_through(legs, x);
  PlatformValues at;
  EightLu lu;
  evaluate(legs, x, x, at);
  ASSERT_TRUE(lu.factor(at.jacobian));
  PlatformSeries terms;
  expand(legs, rate, x, lu, terms);
  const auto residual = [&](double t) {
    PlatformPoint y = terms[series_order];
    for (int n = series_order - 1; n >= 0; --n)
      for (int k = 0; k < 8; ++k) y[k] = y[k] * t + terms[n][k];
    evaluate(sum(legs, t, rate), y, x, at);
    return largest(at.value);
  };
  // t small enough for the first term left out to rule, large enough to be above rounding: t doubled, 2^9.
  double t = 0.1;
  while (residual(t) > 1e-8) t /= 2;
  EXPECT_NEAR(std::log2(residual(t) / residual(t / 2)), series_order + 1, 0.5);
}

}  // namespace
}  // namespace linkwright::parallel
