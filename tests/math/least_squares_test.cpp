// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/least_squares.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "support/allocations.h"

namespace linkwright::math {
namespace {

/// Rosenbrock as two residuals; minimum 0 at (1, 1).
bool rosenbrock(std::span<const double> x, std::span<double> r, std::span<double> j) {
  r[0] = 10 * (x[1] - x[0] * x[0]);
  r[1] = 1 - x[0];
  if (!j.empty()) {
    j[0] = -20 * x[0];
    j[1] = -1;
    j[2] = 10;
    j[3] = 0;
  }
  return true;
}

/// Misra1a of the NIST statistical reference datasets: y = b1 (1 - exp(-b2 x)), lower difficulty, observed
/// data.
constexpr std::array<double, 14> misra_x = {77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                                            378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};
constexpr std::array<double, 14> misra_y = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                                            44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};
bool misra1a(std::span<const double> b, std::span<double> r, std::span<double> j) {
  for (std::size_t i = 0; i < 14; ++i) {
    const double e = std::exp(-b[1] * misra_x[i]);
    r[i] = b[0] * (1 - e) - misra_y[i];
    if (!j.empty()) {
      j[i] = 1 - e;
      j[14 + i] = b[0] * misra_x[i] * e;
    }
  }
  return true;
}

const LeastSquaresOptions tight = {
    .max_iterations = 500, .decrease_tolerance = 0, .gradient_tolerance = 1e-14};

TEST(LeastSquares, RosenbrockFromTheClassicStart) {
  for (const Damping damping : {Damping::identity, Damping::diagonal}) {
    std::array<double, 2> x = {-1.2, 1};
    LeastSquaresWorkspace workspace;
    LeastSquaresOptions options = tight;
    options.damping = damping;
    const auto report = minimise_least_squares(rosenbrock, 2, x, options, workspace);
    EXPECT_EQ(report.status, Status::done) << name_of(report.end);
    // The gradient is J'(x - solution) with J'J of smallest eigenvalue 0.2: 1e-14 / 0.2, and some rounding.
    EXPECT_NEAR(x[0], 1, 1e-12);
    EXPECT_NEAR(x[1], 1, 1e-12);
    EXPECT_LT(report.iterations, 60);
  }
}

TEST(LeastSquares, Misra1aFromBothNistStarts) {
  // Certified: b1 = 2.3894212918E+02, b2 = 5.5015643181E-04, residual sum of squares 1.2455138894E-01 (11
  // digits).
  for (const std::array<double, 2> start : {std::array{500.0, 1e-4}, std::array{250.0, 5e-4}}) {
    std::array<double, 2> x = start;
    LeastSquaresWorkspace workspace;
    LeastSquaresOptions options = tight;
    options.lambda_max = 1e20;
    options.gradient_tolerance = 0;
    const auto report = minimise_least_squares(misra1a, 14, x, options, workspace);
    EXPECT_NEAR(2 * report.cost, 1.2455138894e-01, 1e-11);
    // Half the certified digits: at the minimum the cost is flat to the square of the parameter error.
    EXPECT_NEAR(x[0] / 2.3894212918e+02, 1, 1e-7);
    EXPECT_NEAR(x[1] / 5.5015643181e-04, 1, 1e-7);
  }
}

TEST(LeastSquares, GeodesicAccelerationFollowsACurvedValley) {
  // Residuals 1000 (y - x^2) and x - 1: the valley y = x^2 is a thousand times as steep across as along.
  int evaluations[2] = {};
  const auto narrow = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    r[0] = 1e3 * (x[1] - x[0] * x[0]);
    r[1] = x[0] - 1;
    if (!j.empty()) {
      j[0] = -2e3 * x[0];
      j[1] = 1;
      j[2] = 1e3;
      j[3] = 0;
    }
    return true;
  };
  for (const bool accelerated : {false, true}) {
    std::array<double, 2> x = {-1.2, 1.44};
    LeastSquaresWorkspace workspace;
    LeastSquaresOptions options = tight;
    options.damping = Damping::identity;
    options.max_iterations = 5000;
    options.geodesic_acceleration = accelerated;
    const auto report = minimise_least_squares(narrow, 2, x, options, workspace);
    EXPECT_EQ(report.status, Status::done) << name_of(report.end);
    EXPECT_NEAR(x[0], 1, 1e-10);
    EXPECT_NEAR(x[1], 1, 1e-10);
    evaluations[accelerated] = report.evaluations;
  }
  EXPECT_LT(evaluations[true], evaluations[false] / 2);
}

TEST(LeastSquares, GeodesicAccelerationStaysInTheBox) {
  std::array<double, 2> x = {-0.5, 0.2};
  LeastSquaresWorkspace workspace;
  LeastSquaresOptions options = tight;
  options.geodesic_acceleration = true;
  const auto report = minimise_least_squares(rosenbrock, 2, x, std::array{-2.0, -2.0}, std::array{0.5, 2.0},
                                             options, workspace);
  EXPECT_EQ(report.status, Status::done) << name_of(report.end);
  EXPECT_EQ(x[0], 0.5);
  EXPECT_NEAR(x[1], 0.25, 1e-9);  // below it the cost, 0.125, does not change any more
}

TEST(LeastSquares, FewerResidualsThanVariables) {
  // A sphere and a plane: one curve of solutions; any point of it will do.
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    r[0] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 4;
    r[1] = x[0] + x[1] + x[2] - 1;
    if (!j.empty())
      for (std::size_t k = 0; k < 3; ++k) {
        j[2 * k] = 2 * x[k];
        j[2 * k + 1] = 1;
      }
    return true;
  };
  std::array<double, 3> x = {3, -1, 0.5};
  LeastSquaresWorkspace workspace;
  LeastSquaresOptions options = tight;
  options.cost_tolerance = 1e-28;
  const auto report = minimise_least_squares(f, 2, x, options, workspace);
  EXPECT_EQ(report.end, LeastSquaresEnd::cost) << name_of(report.end);
  EXPECT_LE(report.cost, 1e-28);
}

TEST(LeastSquares, BoundsHoldAndAreLeftAgain) {
  // min (x - 3)^2 + (y + x)^2 on 0 <= x <= 2, -1 <= y <= 5: both bounds active at (2, -1).
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    EXPECT_GE(x[0], 0);
    EXPECT_LE(x[0], 2);
    EXPECT_GE(x[1], -1);
    EXPECT_LE(x[1], 5);
    r[0] = x[0] - 3;
    r[1] = x[1] + x[0];
    if (!j.empty()) {
      j[0] = 1;
      j[1] = 1;
      j[2] = 0;
      j[3] = 1;
    }
    return true;
  };
  const std::array<double, 2> lower = {0, -1}, upper = {2, 5};
  LeastSquaresWorkspace workspace;
  for (const std::array<double, 2> start :
       {std::array{0.0, 5.0}, std::array{-7.0, 9.0}, std::array{2.0, 5.0}}) {
    std::array<double, 2> x = start;
    const auto report = minimise_least_squares(f, 2, x, lower, upper, tight, workspace);
    EXPECT_EQ(report.end, LeastSquaresEnd::gradient) << name_of(report.end);
    // On the edge y = -1: (x - 3)^2 + (x - 1)^2 is least at x = 2, where the bound of x is just reached.
    EXPECT_NEAR(x[0], 2, 1e-12);
    EXPECT_EQ(x[1], -1);
    EXPECT_NEAR(report.cost, 1, 1e-12);
  }
}

TEST(LeastSquares, RosenbrockInABoxEndsOnTheEdge) {
  // On x <= 0.5 the minimum is at (0.5, 0.25).
  std::array<double, 2> x = {-1.2, 1};
  const std::array<double, 2> lower = {-2, -infinity}, upper = {0.5, infinity};
  LeastSquaresWorkspace workspace;
  const auto report = minimise_least_squares(rosenbrock, 2, x, lower, upper, tight, workspace);
  EXPECT_EQ(x[0], 0.5);
  // The cost 1/8 + 50 d^2 cannot distinguish d from 0 below sqrt(eps / 8 / 50) = 5e-10.
  EXPECT_NEAR(x[1], 0.25, 5e-10);
  EXPECT_NEAR(report.cost, 0.125, 1e-14);
}

TEST(LeastSquares, StepsShrinkWhereNothingCanBeEvaluated) {
  // ln(x) = 1 from a start whose full step leaves the domain.
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    if (x[0] <= 0) return false;
    r[0] = std::log(x[0]) - 1;
    if (!j.empty()) j[0] = 1 / x[0];
    return true;
  };
  std::array<double, 1> x = {20};
  LeastSquaresWorkspace workspace;
  const auto report = minimise_least_squares(f, 1, x, tight, workspace);
  EXPECT_EQ(report.status, Status::done);
  EXPECT_NEAR(x[0], std::exp(1.0), 1e-12);

  x = {-1};
  const auto impossible = minimise_least_squares(f, 1, x, tight, workspace);
  EXPECT_EQ(impossible.status, Status::infeasible);
  EXPECT_EQ(impossible.end, LeastSquaresEnd::start);
  EXPECT_EQ(x[0], -1);
}

TEST(LeastSquares, NanCountsAsNotEvaluable) {
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    r[0] = std::sqrt(x[0]) - 1;  // NaN below 0
    if (!j.empty()) j[0] = 0.5 / std::sqrt(x[0]);
    return true;
  };
  std::array<double, 1> x = {30};
  LeastSquaresWorkspace workspace;
  EXPECT_EQ(minimise_least_squares(f, 1, x, tight, workspace).status, Status::done);
  EXPECT_NEAR(x[0], 1, 1e-12);
}

TEST(LeastSquares, StepClipBoundsEachStep) {
  double last = -100, longest = 0;
  const auto f = [&](std::span<const double> x, std::span<double> r, std::span<double> j) {
    longest = std::max(longest, std::abs(x[0] - last));
    last = x[0];
    r[0] = x[0];
    if (!j.empty()) j[0] = 1;
    return true;
  };
  std::array<double, 1> x = {-100};
  LeastSquaresOptions options = tight;
  options.step_clip = 2;
  LeastSquaresWorkspace workspace;
  minimise_least_squares(f, 1, x, options, workspace);
  EXPECT_NEAR(x[0], 0, 1e-13);
  EXPECT_LE(longest, 2 + 1e-13);
}

TEST(LeastSquares, SeparateJacobianTakesTheSamePath) {
  LeastSquaresWorkspace workspace;
  std::array<double, 2> x = {-1.2, 1}, y = x;
  LeastSquaresOptions options = tight;
  const auto together = minimise_least_squares(rosenbrock, 2, x, options, workspace);
  options.jacobian_at_trials = false;
  const auto apart = minimise_least_squares(rosenbrock, 2, y, options, workspace);
  EXPECT_EQ(x, y);
  EXPECT_EQ(together.iterations, apart.iterations);
  EXPECT_GT(apart.evaluations, together.evaluations);
}

TEST(LeastSquares, ReportsWhyItEnded) {
  LeastSquaresWorkspace workspace;
  std::array<double, 2> x = {-1.2, 1};
  const auto early = minimise_least_squares(rosenbrock, 2, x, {.max_iterations = 3}, workspace);
  EXPECT_EQ(early.status, Status::not_converged);
  EXPECT_EQ(name_of(early.end), "iterations");
  EXPECT_EQ(early.evaluations, 4);
  // The workspace holds what belongs to the returned x.
  std::array<double, 2> r{};
  rosenbrock(x, r, {});
  EXPECT_EQ(workspace.residuals()[0], r[0]);
  EXPECT_EQ(workspace.residuals()[1], r[1]);
  EXPECT_EQ(workspace.jacobian()[0], -20 * x[0]);
}

TEST(LeastSquares, AllocatesNothingAfterTheFirstCall) {
  LeastSquaresWorkspace workspace;
  std::array<double, 2> x = {500, 1e-4};
  minimise_least_squares(misra1a, 14, x, tight, workspace);
  x = {250, 5e-4};
  const auto before = test::allocations();
  minimise_least_squares(misra1a, 14, x, tight, workspace);
  EXPECT_EQ(test::allocations(), before);
}

TEST(LeastSquares, SaysWhatIsWrongWithACall) {
  LeastSquaresWorkspace workspace;
  std::array<double, 2> x = {0, 0};
  const std::array<double, 1> one = {0};
  const std::array<double, 2> low = {0, 1}, high = {1, 0};
  const auto message = [&](auto&& call) {
    try {
      call();
    } catch (const ContractError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(message([&] { minimise_least_squares(rosenbrock, 2, x, one, high, {}, workspace); }),
              ::testing::HasSubstr("1 lower and 2 upper bounds for 2 variables"));
  EXPECT_THAT(message([&] { minimise_least_squares(rosenbrock, 2, x, low, high, {}, workspace); }),
              ::testing::HasSubstr("bounds of variable 1: 1 > 0"));
  EXPECT_THAT(message([&] { minimise_least_squares(rosenbrock, 0, x, {}, workspace); }),
              ::testing::HasSubstr("needs residuals and variables, got 0 and 2"));
  EXPECT_THAT(message([&] { minimise_least_squares(rosenbrock, 2, x, {.lambda0 = 0}, workspace); }),
              ::testing::HasSubstr("minimise_least_squares: lambda0 0, factors 0.2 and 4"));
}

}  // namespace
}  // namespace linkwright::math
