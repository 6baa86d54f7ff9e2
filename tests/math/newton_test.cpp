#include "linkwright/math/newton.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/differences.h"
#include "support/allocations.h"
#include "support/message.h"

namespace linkwright::math {
namespace {

using ::testing::HasSubstr;

/// Closure of a four-bar with links 4, 2, 5, 4.5 at a crank angle, for the coupler and rocker angles x.
struct FourBarLoop {
  double crank_angle = 1.0;
  static constexpr double ground = 4, crank = 2, coupler = 5, rocker = 4.5;
  bool operator()(std::span<const double> x, std::span<double> r, std::span<double> j) const {
    const std::complex<double> loop =
        std::polar(crank, crank_angle) + std::polar(coupler, x[0]) - ground - std::polar(rocker, x[1]);
    r[0] = loop.real();
    r[1] = loop.imag();
    if (!j.empty()) {
      j[0] = -coupler * std::sin(x[0]);
      j[1] = coupler * std::cos(x[0]);
      j[2] = rocker * std::sin(x[1]);
      j[3] = -rocker * std::cos(x[1]);
    }
    return true;
  }
};

/// The two closed forms: B where the circles about A and B0 meet, to the left (+1) or right of A -> B0.
std::array<double, 2> closed_form(const FourBarLoop& l, double side) {
  const std::complex<double> a = std::polar(l.crank, l.crank_angle), d = l.ground - a;
  const double distance = std::abs(d);
  const double cosine =
      (l.coupler * l.coupler + distance * distance - l.rocker * l.rocker) / (2 * l.coupler * distance);
  const double coupler_angle = std::arg(d) + side * std::acos(cosine);
  return {coupler_angle, std::arg(a + std::polar(l.coupler, coupler_angle) - l.ground)};
}

TEST(Newton, ClosesAFourBarFromRoughGuesses) {
  NewtonWorkspace workspace;
  for (const double crank_angle : {0.3, 1.0, 2.5, 4.0, 6.0})
    for (const double side : {1.0, -1.0}) {
      const FourBarLoop loop{crank_angle};
      const auto expected = closed_form(loop, side);
      for (const double off : {-0.4, 0.4}) {
        std::array<double, 2> x = {expected[0] + off, expected[1] + 0.5 * off};
        const auto report = solve_newton(loop, x, {}, workspace);
        EXPECT_EQ(report.status, Status::done);
        EXPECT_LE(report.residual, 1e-12);
        // det J = L3 L4 sin(mu) with sin(mu) > 0.3 here: a residual of 1e-12 is 1e-12 of the angles.
        EXPECT_NEAR(x[0], expected[0], 1e-12);
        EXPECT_NEAR(x[1], expected[1], 1e-12);
        EXPECT_LE(report.iterations, 6);
        EXPECT_LT(report.condition, 30);
      }
    }
}

TEST(Newton, LoopHasTheRightJacobian) {
  const std::array<double, 2> x = {0.7, 2.0};
  EXPECT_TRUE(check_jacobian(FourBarLoop{}, 2, x).passed);
}

TEST(Newton, ConvergesQuadratically) {
  const FourBarLoop loop{1.0};
  std::vector<double> sizes;
  const auto recording = [&](std::span<const double> x, std::span<double> r, std::span<double> j) {
    loop(x, r, j);
    sizes.push_back(std::hypot(r[0], r[1]));
    return true;
  };
  const auto expected = closed_form(loop, 1);
  std::array<double, 2> x = {expected[0] + 0.3, expected[1] - 0.2};
  NewtonWorkspace workspace;
  const auto report = solve_newton(recording, x, {}, workspace);
  ASSERT_EQ(report.status, Status::done);
  ASSERT_EQ(report.evaluations, static_cast<int>(sizes.size()));
  ASSERT_EQ(report.evaluations, report.iterations + 1) << "no step was halved";
  // |F_next| <= |F''| |J^-1|^2 / 2 |F|^2. The second derivative is at most L3 + L4 = 9.5 and |J^-1| about
  // 1 / (4.5 sin(mu)) with mu = 0.73 rad.
  const double factor = 9.5 / 2 / std::pow(4.5 * std::sin(0.7), 2);
  int compared = 0;
  for (std::size_t k = 0; k + 1 < sizes.size(); ++k) {
    if (sizes[k] < 1e-7) break;  // the next one is rounding
    EXPECT_LE(sizes[k + 1], factor * sizes[k] * sizes[k]) << "step " << k;
    ++compared;
  }
  EXPECT_GE(compared, 3);
}

bool arctangent(std::span<const double> x, std::span<double> r, std::span<double> j) {
  r[0] = std::atan(x[0]);
  if (!j.empty()) j[0] = 1 / (1 + x[0] * x[0]);
  return true;
}

TEST(Newton, DampsStepsThatOvershoot) {
  // Whole steps diverge from |x| > 1.39.
  NewtonWorkspace workspace;
  for (const double start : {1.5, -10.0, 1e6}) {
    std::array<double, 1> x = {start};
    const auto report = solve_newton(arctangent, x, {}, workspace);
    EXPECT_EQ(report.status, Status::done) << start;
    EXPECT_NEAR(x[0], 0, 1e-12);
    EXPECT_GT(report.evaluations, report.iterations + 1);
  }
  std::array<double, 1> x = {10};
  EXPECT_EQ(solve_newton(arctangent, x, {.max_halvings = 0}, workspace).status, Status::not_converged);
  EXPECT_EQ(x[0], 10);
}

TEST(Newton, ReportsASingularJacobian) {
  // Two equations that say the same: rank 1 everywhere, no root.
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    r[0] = x[0] + 3 * x[1] - 1;
    r[1] = 0.1 * x[0] + 0.3 * x[1] - 1;
    if (!j.empty()) j[0] = 1, j[1] = 0.1, j[2] = 3, j[3] = 0.3;
    return true;
  };
  std::array<double, 2> x = {5, 7};
  NewtonWorkspace workspace;
  const auto report = solve_newton(f, x, {}, workspace);
  EXPECT_EQ(report.status, Status::singular);
  EXPECT_GT(report.condition, 1e15);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(x, (std::array<double, 2>{5, 7}));

  // Exactly: links of the loop in line.
  x = {0, 0};
  const auto straight = solve_newton(FourBarLoop{}, x, {}, workspace);
  EXPECT_EQ(straight.status, Status::singular);
  EXPECT_EQ(straight.condition, infinity);
}

TEST(Newton, ConditionTellsADoubleRoot) {
  // x^2 beside y - 1: halves x in each step, so x and the condition, 1 / (2 x), end at the root of the
  // tolerance.
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    r[0] = x[0] * x[0];
    r[1] = x[1] - 1;
    if (!j.empty()) j[0] = 2 * x[0], j[1] = 0, j[2] = 0, j[3] = 1;
    return true;
  };
  std::array<double, 2> x = {0.25, 0};
  NewtonWorkspace workspace;
  const auto report = solve_newton(f, x, {}, workspace);
  EXPECT_EQ(report.status, Status::done);
  EXPECT_NEAR(report.condition * 2 * x[0], 1, 1e-12);
  EXPECT_GT(report.condition, 5e5);
  EXPECT_EQ(report.iterations, 18);  // (0.25 / 2^18)^2 < 1e-12
}

TEST(Newton, ConditionIsThatOfTheOneNorm) {
  // The inverse of [2 1; 1 3] / 5 is [3 -1; -1 2]: norms 4 / 5 and 4.
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    r[0] = (2 * x[0] + x[1]) / 5;
    r[1] = (x[0] + 3 * x[1]) / 5;
    if (!j.empty()) j[0] = 0.4, j[1] = 0.2, j[2] = 0.2, j[3] = 0.6;
    return true;
  };
  std::array<double, 2> x = {1, 1};
  NewtonWorkspace workspace;
  EXPECT_NEAR(solve_newton(f, x, {}, workspace).condition, 3.2, 1e-14);
}

TEST(Newton, StopsWhereNoStepLowersTheResidual) {
  // x^2 + 1 has no root; its norm is least at 0, where the Jacobian vanishes.
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    r[0] = x[0] * x[0] + 1;
    if (!j.empty()) j[0] = 2 * x[0];
    return true;
  };
  std::array<double, 1> x = {3};
  NewtonWorkspace workspace;
  const auto report = solve_newton(f, x, {.max_iterations = 1000}, workspace);
  EXPECT_TRUE(report.status == Status::not_converged || report.status == Status::singular);
  EXPECT_LT(std::abs(x[0]), 1e-3);
  x = {3};
  const auto early = solve_newton(f, x, {.max_iterations = 1}, workspace);
  EXPECT_EQ(early.status, Status::not_converged);
  EXPECT_EQ(early.iterations, 1);
}

TEST(Newton, EitherToleranceEnds) {
  NewtonWorkspace workspace;
  const auto expected = closed_form(FourBarLoop{}, 1);
  const std::array<double, 2> start = {expected[0] + 0.3, expected[1] - 0.2};
  auto x = start;
  const auto coarse =
      solve_newton(FourBarLoop{}, x, {.residual_tolerance = 1e-2, .step_tolerance = 0}, workspace);
  EXPECT_EQ(coarse.status, Status::done);
  EXPECT_LE(coarse.residual, 1e-2);
  EXPECT_GT(coarse.residual, 1e-12);
  // The step is judged before it is taken: the x returned is better by its square.
  x = start;
  const auto by_step =
      solve_newton(FourBarLoop{}, x, {.residual_tolerance = 0, .step_tolerance = 1e-3}, workspace);
  EXPECT_EQ(by_step.status, Status::done);
  EXPECT_LE(by_step.step, 1e-3);
  EXPECT_NEAR(x[0], expected[0], 1e-5);
  // Nothing smaller than rounding is asked for in vain.
  x = start;
  const auto fine =
      solve_newton(FourBarLoop{}, x, {.residual_tolerance = 0, .step_tolerance = 1e-14}, workspace);
  EXPECT_EQ(fine.status, Status::done);
  EXPECT_NEAR(x[0], expected[0], 1e-14);
}

TEST(Newton, ShortensStepsThatCannotBeEvaluated) {
  const auto f = [](std::span<const double> x, std::span<double> r, std::span<double> j) {
    r[0] = std::log(x[0]) - 1;  // NaN below 0
    if (!j.empty()) j[0] = 1 / x[0];
    return x[0] < 1000;
  };
  std::array<double, 1> x = {20};
  NewtonWorkspace workspace;
  EXPECT_EQ(solve_newton(f, x, {}, workspace).status, Status::done);
  EXPECT_NEAR(x[0], std::exp(1.0), 3e-12);

  for (const double start : {-1.0, 2000.0}) {
    x = {start};
    const auto impossible = solve_newton(f, x, {}, workspace);
    EXPECT_EQ(impossible.status, Status::infeasible);
    EXPECT_EQ(impossible.evaluations, 1);
    EXPECT_EQ(x[0], start);
  }
}

/// The discrete boundary value problem of More, Garbow and Hillstrom 1981, No. 28, for any n.
bool boundary_value(std::span<const double> x, std::span<double> r, std::span<double> j) {
  const std::size_t n = x.size();
  const double h = 1.0 / static_cast<double>(n + 1);
  std::fill(j.begin(), j.end(), 0);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i + 1) * h, u = x[i] + t + 1;
    r[i] = 2 * x[i] - (i > 0 ? x[i - 1] : 0) - (i + 1 < n ? x[i + 1] : 0) + h * h * u * u * u / 2;
    if (j.empty()) continue;
    j[i * n + i] = 2 + 1.5 * h * h * u * u;
    if (i > 0) j[(i - 1) * n + i] = -1;
    if (i + 1 < n) j[(i + 1) * n + i] = -1;
  }
  return true;
}

TEST(Newton, AllocatesNothingAfterTheFirstCall) {
  for (const std::size_t n : {2u, 10u, 40u}) {
    NewtonWorkspace workspace;
    std::vector<double> x(n);
    const auto start = [&] {
      for (std::size_t i = 0; i < n; ++i) {
        const double t = static_cast<double>(i + 1) / static_cast<double>(n + 1);
        x[i] = t * (t - 1);
      }
    };
    start();
    solve_newton(boundary_value, x, {}, workspace);
    start();
    const auto before = test::allocations();
    const auto report = solve_newton(boundary_value, x, {}, workspace);
    EXPECT_EQ(test::allocations(), before) << n;
    EXPECT_EQ(report.status, Status::done) << n;
    EXPECT_LE(report.iterations, 4) << n;
  }
}

TEST(Newton, WorkspaceHoldsWhatBelongsToTheSolution) {
  NewtonWorkspace first;
  std::array<double, 2> x = {1, 2}, r{};
  std::array<double, 4> j{};
  solve_newton(FourBarLoop{}, x, {.max_iterations = 2}, first);
  FourBarLoop{}(x, r, j);
  EXPECT_THAT(first.residuals(), ::testing::ElementsAreArray(r));
  EXPECT_THAT(first.jacobian(), ::testing::ElementsAreArray(j));
  // Moved away and used again, with another size.
  NewtonWorkspace second = std::move(first);
  EXPECT_THAT(second.residuals(), ::testing::ElementsAreArray(r));
  std::array<double, 1> y = {1};
  EXPECT_EQ(solve_newton(arctangent, y, {}, first).status, Status::done);
}

TEST(Newton, SaysWhatIsWrongWithACall) {
  NewtonWorkspace workspace;
  std::array<double, 1> x = {1};
  const auto call = [&](std::span<double> at, const NewtonOptions& options) {
    return test::message([&] { solve_newton(arctangent, at, options, workspace); });
  };
  EXPECT_THAT(call({}, {}), HasSubstr("no unknowns"));
  EXPECT_THAT(call(x, {.residual_tolerance = -1}), HasSubstr("tolerances -1 and 1e-12"));
  EXPECT_THAT(call(x, {.max_iterations = -1}), HasSubstr("-1 iterations, 30 halvings"));
}

}  // namespace
}  // namespace linkwright::math
