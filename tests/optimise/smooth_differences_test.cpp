// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/smooth_differences.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimise/smooth_cases.h"
#include "support/allocations.h"

namespace linkwright::optimise {
namespace {

// exp(a) sin(c) and a b c over boxes of width 2, 0 and 4.
SmoothProblem curved() {
  return test::smooth_problem({{"a", -1, 1}, {"b", 3, 3}, {"c", 0, 4}}, 1, 1,
                              [](std::span<const double> x, std::span<double> out) {
                                out[0] = std::exp(x[0]) * std::sin(x[2]);
                                out[1] = x[0] * x[1] * x[2];
                              });
}

void expect_derivatives(double u0, double u1) {
  const SmoothProblem p = curved();
  SmoothDifferences at(p);
  const std::vector<double> u = {u0, u1};
  std::vector<double> x(3);
  at.from_unit(u, x);
  const double e = std::exp(x[0]), s = std::sin(x[2]), c = std::cos(x[2]);
  EXPECT_EQ(at.values(u)[0], e * s);
  const auto jacobian = at.jacobian(u);
  ASSERT_EQ(jacobian.size(), 4u);
  // Second order: third derivatives (at most 4^3 e) times 2^-34, and rounding 1e-16 / 2^-17.
  const double tolerance = 64 * 3 * 0x1p-34 + 1e-10;
  EXPECT_NEAR(jacobian[0], 2 * e * s, tolerance);
  EXPECT_NEAR(jacobian[1], 4 * e * c, tolerance);
  EXPECT_NEAR(jacobian[2], 2 * 3 * x[2], tolerance);
  EXPECT_NEAR(jacobian[3], 4 * 3 * x[0], tolerance);
}

TEST(SmoothDifferences, AreOfSecondOrderInsideAndAtBounds) {
  expect_derivatives(0.3, 0.6);
  expect_derivatives(0, 1);
  expect_derivatives(1, 0);
  expect_derivatives(1e-6, 1 - 1e-6);  // nearer than a step
}

TEST(SmoothDifferences, GoToTheOtherSideOfWhatDoesNotExist) {
  const SmoothProblem p = test::two_points();
  SmoothDifferences at(p);
  std::vector<double> u(2);
  const std::vector<double> edge = {2, 0.5};
  at.to_unit(edge, u);
  // One-sided: the second derivative, 2 6^2, times a step.
  EXPECT_NEAR(at.jacobian(u)[0], 6 * 2 * (2 - 1), 72 * 0x1p-17);
  EXPECT_NEAR(at.jacobian(u)[1], 6 * 2 * 0.5, 1e-8);
}

TEST(SmoothDifferences, AskOnceForAPoint) {
  const SmoothProblem p = curved();
  SmoothDifferences at(p);
  const std::vector<double> u = {0.5, 0.5}, v = {0.5, 0.25};
  at.jacobian(u);
  at.values(u);
  at.jacobian(u);
  EXPECT_EQ(at.evaluations(), 1 + 4);
  at.values(v);
  EXPECT_EQ(at.evaluations(), 1 + 4 + 1);
  EXPECT_EQ(at.variables()[1], 2u);
  EXPECT_EQ(at.width(1), 4);
}

TEST(SmoothDifferences, KeepFixedVariablesAndBoundsExactly) {
  const SmoothProblem p = curved();
  const SmoothDifferences at(p);
  std::vector<double> x(3), u(2);
  at.from_unit(std::vector<double>{1, 0}, x);
  EXPECT_EQ(x, (std::vector<double>{1, 3, 0}));
  at.to_unit(std::vector<double>{7, 9, -1}, u);  // from outside: the nearest
  EXPECT_EQ(u, (std::vector<double>{1, 0}));
}

}  // namespace
}  // namespace linkwright::optimise
