// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/differences.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "support/message.h"

namespace linkwright::math {
namespace {

using test::message;
using ::testing::HasSubstr;

// The size of the error by the model; the functions here are smooth over their scales and of a few
// operations.
const double model_error = 7.0 / 6 * std::pow(std::numeric_limits<double>::epsilon(), 2.0 / 3);

TEST(Differences, StepIsTheCubeRootOfEpsilon) {
  EXPECT_NEAR(difference_step(1), 6.0555e-6, 1e-10);
  EXPECT_DOUBLE_EQ(difference_step(1e-3), 1e-3 * difference_step(1));
}

TEST(Differences, GradientMeetsTheErrorModel) {
  const auto f = [](std::span<const double> x) { return std::exp(x[0]) * std::sin(x[1]); };
  const std::array<double, 2> x = {0.5, 1.2};
  std::array<double, 2> gradient{};
  ASSERT_EQ(central_gradient(f, x, gradient), Status::done);
  const double size = std::exp(0.5);
  EXPECT_NEAR(gradient[0], size * std::sin(1.2), 2 * model_error * size);
  EXPECT_NEAR(gradient[1], size * std::cos(1.2), 2 * model_error * size);
}

TEST(Differences, QuadraticsHaveNoTruncation) {
  // Steps a million times longer leave no rounding either; what is left shows that the distance is the real
  // one.
  const auto f = [](std::span<const double> x) { return x[0] * x[0] - 3 * x[0]; };
  const std::array<double, 1> x = {7}, scale = {1e6};
  std::array<double, 1> gradient{};
  ASSERT_EQ(central_gradient(f, x, gradient, scale), Status::done);
  EXPECT_NEAR(gradient[0], 11, 1e-13);
}

// A length in nanometres and a pressure in pascals, both given in SI units.
struct BadlyScaled {
  static constexpr std::array<double, 2> x = {3e-9, 2e7}, scale = {1e-9, 1e7};
  bool operator()(std::span<const double> at, std::span<double> r, std::span<double> j) const {
    const double u = at[0] / scale[0], v = at[1] / scale[1];
    r[0] = std::sin(u) * v;
    r[1] = 1e12 * std::exp(-u) / v;
    r[2] = 1e-12 * u * u * v;
    if (!j.empty()) {
      j[0] = std::cos(u) * v / scale[0];
      j[1] = -1e12 * std::exp(-u) / v / scale[0];
      j[2] = 1e-12 * 2 * u * v / scale[0];
      j[3] = std::sin(u) / scale[1];
      j[4] = -1e12 * std::exp(-u) / (v * v) / scale[1];
      j[5] = 1e-12 * u * u / scale[1];
    }
    return true;
  }
};

TEST(Differences, JacobianOfBadlyScaledVariables) {
  const BadlyScaled f;
  std::array<double, 3> r{};
  std::array<double, 6> exact{}, numeric{};
  f(f.x, r, exact);
  ASSERT_EQ(central_jacobian(f, 3, f.x, numeric, f.scale), Status::done);
  // 10: the functions bend over somewhat less than the scales (v^-2 by 1 / 2, u twice over).
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(numeric[k] / exact[k], 1, 10 * model_error) << "entry " << k;
  // Without the scales the length is moved by 2000 times itself, and exp overflows: that is what they are
  // for.
  EXPECT_EQ(central_jacobian(f, 3, f.x, numeric), Status::infeasible);
  EXPECT_TRUE(std::isnan(numeric[0]));
}

TEST(Differences, StayBetweenBounds) {
  const std::array<double, 4> lower = {1, -2, 0, 5}, upper = {2, 3, 1e-7, 5};
  const auto f = [&](std::span<const double> x, std::span<double> r, std::span<double>) {
    for (std::size_t j = 0; j < 4; ++j)
      if (x[j] < lower[j] || x[j] > upper[j]) ADD_FAILURE() << "variable " << j << " is " << x[j];
    r[0] = std::exp(x[0]) * std::sin(x[1]) + 1e6 * x[2];
    r[1] = x[0] * x[1] * x[1] + x[3];
    return true;
  };
  for (const double a : {1.0, 1 + 1e-7, 1.5, 2 - 1e-7, 2.0})
    for (const double b : {-2.0, 0.3, 3.0})
      for (const double c : {0.0, 5e-8, 1e-7}) {
        const std::array<double, 4> x = {a, b, c, 5};
        std::array<double, 8> jacobian{};
        ASSERT_EQ(bounded_jacobian(f, 2, x, lower, upper, jacobian), Status::done);
        const std::array<double, 8> exact = {
            std::exp(a) * std::sin(b), b * b, std::exp(a) * std::cos(b), 2 * a * b, 1e6, 0, 0, 0};
        for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(jacobian[k], exact[k], k == 4 ? 0.05 : 5e-9) << k;
      }
  const std::array<double, 4> outside = {0.5, 0, 0, 5};
  std::array<double, 8> jacobian{};
  EXPECT_THROW(bounded_jacobian(f, 2, outside, lower, upper, jacobian), ContractError);
}

TEST(Differences, ColumnsThatCannotBeEvaluatedAreNan) {
  // x[1] must not exceed 1, where it stands; x[2] gives NaN below 2, where it stands.
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double>) {
    if (x[1] > 1) return false;
    r[0] = x[0] * x[1] + std::sqrt(x[2] - 2);
    r[1] = x[0] * x[0];
    return true;
  };
  const std::array<double, 3> x = {3, 1, 2};
  std::array<double, 6> jacobian{};
  EXPECT_EQ(central_jacobian(f, 2, x, jacobian), Status::infeasible);
  EXPECT_NEAR(jacobian[0], 1, 1e-9);
  EXPECT_NEAR(jacobian[1], 6, 1e-9);
  for (std::size_t k = 2; k < 6; ++k) EXPECT_TRUE(std::isnan(jacobian[k])) << k;
}

TEST(CheckJacobian, PassesExactDerivatives) {
  const BadlyScaled f;
  const JacobianCheck check = check_jacobian(f, 3, f.x, f.scale);
  EXPECT_EQ(check.status, Status::done);
  EXPECT_TRUE(check.passed) << "row " << check.row << " column " << check.column << ": " << check.analytic
                            << " is " << check.numeric << " by differences, " << check.deviation << " > "
                            << check.tolerance;
  EXPECT_EQ(check.unchecked, 0u);
  EXPECT_LT(check.tolerance, 1e-8);
  EXPECT_GT(check.tolerance, 1e-10);
}

TEST(CheckJacobian, FindsTheWrongEntry) {
  // Each entry in turn, wrong by a millionth of itself.
  for (std::size_t wrong = 0; wrong < 6; ++wrong) {
    const auto f = [&](std::span<const double> x, std::span<double> r, std::span<double> j) {
      BadlyScaled()(x, r, j);
      if (!j.empty()) j[wrong] *= 1 + 1e-6;
      return true;
    };
    std::array<double, 3> r{};
    std::array<double, 6> j{};
    f(BadlyScaled::x, r, j);
    const JacobianCheck check = check_jacobian(f, 3, BadlyScaled::x, BadlyScaled::scale);
    EXPECT_EQ(check.status, Status::done);
    EXPECT_FALSE(check.passed) << "entry " << wrong;
    EXPECT_EQ(check.row, wrong % 3);
    EXPECT_EQ(check.column, wrong / 3);
    EXPECT_EQ(check.analytic, j[wrong]);
    EXPECT_NEAR(check.numeric / j[wrong], 1 - 1e-6, 1e-8);
    EXPECT_GT(check.deviation, check.tolerance);
    EXPECT_LE(check.deviation, 1.01e-6);
  }
}

TEST(CheckJacobian, FindsAnEntryThatShouldBeZero) {
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    r[0] = x[0];
    r[1] = 5;  // depends on nothing
    r[2] = 0;  // and has no size
    if (!j.empty()) j[0] = 1, j[1] = 0, j[2] = 0, j[3] = 0, j[4] = 1e-6, j[5] = 0;
    return true;
  };
  const std::array<double, 2> x = {0, 1};
  const JacobianCheck check = check_jacobian(f, 3, x);
  EXPECT_FALSE(check.passed);
  EXPECT_EQ(check.row, 1u);
  EXPECT_EQ(check.column, 1u);
  EXPECT_EQ(check.numeric, 0);
  EXPECT_DOUBLE_EQ(check.deviation, 1e-6 / 5);

  const auto without_size = [](std::span<const double>, std::span<double> r, std::span<double> j) {
    r[0] = 0;
    if (!j.empty()) j[0] = 0, j[1] = 1e-300;
    return true;
  };
  const JacobianCheck second = check_jacobian(without_size, 1, x);
  EXPECT_FALSE(second.passed);
  EXPECT_EQ(second.column, 1u);
  EXPECT_EQ(second.deviation, infinity);
}

TEST(CheckJacobian, ToleranceFollowsTheScale) {
  // sin(1000 x) bends over 1/1000: with the scale 1 the difference is off by (6e-6 * 1000)^2 / 6 = 6e-6,
  // which the tolerance makes room for; with the true scale it is sharp.
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    r[0] = std::sin(1000 * x[0]);
    if (!j.empty()) j[0] = 1000 * std::cos(1000 * x[0]);
    return true;
  };
  const std::array<double, 1> x = {0.3}, scale = {1e-3};
  const JacobianCheck blunt = check_jacobian(f, 1, x), sharp = check_jacobian(f, 1, x, scale);
  EXPECT_TRUE(blunt.passed);
  EXPECT_GT(blunt.tolerance, 1e-6);
  EXPECT_TRUE(sharp.passed);
  EXPECT_LT(sharp.tolerance, 1e-8);
  // A million waves per scale: no difference to be had, and not passed though the derivative is right.
  const std::array<double, 1> hopeless = {1e4};
  const JacobianCheck rough = check_jacobian(f, 1, x, hopeless);
  EXPECT_FALSE(rough.passed);
  EXPECT_EQ(rough.tolerance, 1e-3);
}

TEST(CheckJacobian, ChecksTheOtherColumnsWhereANeighbourCannotBeEvaluated) {
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    if (x[0] < 0) return false;
    r[0] = x[0] * x[0] + x[1] * x[1];
    if (!j.empty()) j[0] = 2 * x[0], j[1] = 3 * x[1];  // the second is wrong
    return true;
  };
  const std::array<double, 2> edge = {0, 1};
  const JacobianCheck check = check_jacobian(f, 1, edge);
  EXPECT_EQ(check.status, Status::infeasible);
  EXPECT_FALSE(check.passed);
  EXPECT_EQ(check.unchecked, 1u);
  EXPECT_EQ(check.column, 1u);
  EXPECT_NEAR(check.numeric, 2, 1e-9);
  EXPECT_EQ(check.analytic, 3);

  // The nearer pair of neighbours is inside, the farther is not.
  const std::array<double, 2> near = {1.5 * difference_step(1), 1};
  EXPECT_EQ(check_jacobian(f, 1, near).unchecked, 1u);

  const std::array<double, 2> outside = {-1, 1};
  const JacobianCheck none = check_jacobian(f, 1, outside);
  EXPECT_EQ(none.status, Status::infeasible);
  EXPECT_FALSE(none.passed);
  EXPECT_EQ(none.unchecked, 2u);
  EXPECT_TRUE(std::isnan(none.numeric));
}

TEST(CheckJacobian, NeverPassesWithAColumnUnchecked) {
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    if (x[0] < 0) return false;
    r[0] = x[0] + x[1];
    if (!j.empty()) j[0] = j[1] = 1;
    return true;
  };
  const std::array<double, 2> edge = {0, 1};
  const JacobianCheck check = check_jacobian(f, 1, edge);
  EXPECT_LE(check.deviation, check.tolerance);
  EXPECT_FALSE(check.passed);
}

TEST(Differences, SayWhatIsWrongWithACall) {
  const BadlyScaled f;
  std::array<double, 6> jacobian{};
  const std::array<double, 2> zero = {0, 1}, tiny = {1e-9, 1e-12};
  const auto call = [&](std::span<double> out, std::span<const double> scale) {
    return message([&] { central_jacobian(f, 3, f.x, out, scale); });
  };
  EXPECT_THAT(call(std::span(jacobian).first(5), f.scale),
              HasSubstr("5 entries for 3 residuals of 2 variables"));
  EXPECT_THAT(call(jacobian, std::span(f.scale).first(1)), HasSubstr("1 scales for 2 variables"));
  EXPECT_THAT(call(jacobian, zero), HasSubstr("scale 0 of variable 0"));
  EXPECT_THAT(call(jacobian, tiny),
              HasSubstr("scale 1e-12 of variable 1 is lost in the rounding of 20000000"));
  EXPECT_THAT(message([&] { check_jacobian(f, 0, f.x); }),
              HasSubstr("needs residuals and variables, got 0 and 2"));
}

}  // namespace
}  // namespace linkwright::math
