// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/nlopt_bridge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "linkwright/core/interruption.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;
using Numbers = std::span<const double>;
using Out = std::span<double>;

double rosenbrock(Numbers x, Out gradient) {
  const double a = x[1] - x[0] * x[0], b = 1 - x[0];
  if (!gradient.empty()) {
    gradient[0] = -400 * x[0] * a - 2 * b;
    gradient[1] = 200 * a;
  }
  return 100 * a * a + b * b;
}

/// Problem 71 of Hock and Schittkowski 1981, its equation as the inequality that is active: 17.0140173 at
/// (1, 4.7429994, 3.8211503, 1.3794082).
double hs071(Numbers x, Out gradient) {
  const double sum = x[0] + x[1] + x[2];
  if (!gradient.empty()) {
    gradient[0] = x[3] * (sum + x[0]);
    gradient[1] = x[0] * x[3];
    gradient[2] = x[0] * x[3] + 1;
    gradient[3] = x[0] * sum;
  }
  return x[0] * x[3] * sum + x[2];
}
void hs071_limits(Numbers x, Out g, Out jacobian) {
  g[0] = 25 - x[0] * x[1] * x[2] * x[3];
  g[1] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3] - 40;
  for (std::size_t j = 0; j < 4 && !jacobian.empty(); ++j) {
    jacobian[j] = -x[(j + 1) % 4] * x[(j + 2) % 4] * x[(j + 3) % 4];
    jacobian[4 + j] = 2 * x[j];
  }
}

/// Problem 35 of Hock and Schittkowski 1981: 1/9 at (4/3, 7/9, 4/9).
double hs035(Numbers x, Out gradient) {
  if (!gradient.empty()) {
    gradient[0] = -8 + 4 * x[0] + 2 * x[1] + 2 * x[2];
    gradient[1] = -6 + 4 * x[1] + 2 * x[0];
    gradient[2] = -4 + 2 * x[2] + 2 * x[0];
  }
  return 9 - 8 * x[0] - 6 * x[1] - 4 * x[2] + 2 * x[0] * x[0] + 2 * x[1] * x[1] + x[2] * x[2] +
         2 * x[0] * x[1] + 2 * x[0] * x[2];
}
void hs035_limit(Numbers x, Out g, Out jacobian) {
  g[0] = x[0] + x[1] + 2 * x[2] - 3;
  if (!jacobian.empty()) {
    jacobian[0] = jacobian[1] = 1;
    jacobian[2] = 2;
  }
}

// Tolerances of places are square roots of what the cost can tell apart near a minimum, with room for the
// condition of the valley; those of costs are linear where a constraint is active.
TEST(NloptBridge, FindsTheEndOfTheValley) {
  for (const LocalMethod method : {LocalMethod::slsqp, LocalMethod::bobyqa}) {
    RunContext context;
    std::vector<double> x = {-1.2, 1};
    const LocalReport report = minimise_local(rosenbrock, x, {}, {}, {.method = method}, context);
    EXPECT_EQ(report.status, Status::done) << name_of(method) << " " << name_of(report.end);
    EXPECT_NEAR(x[0], 1, 1e-6) << name_of(method);
    EXPECT_NEAR(x[1], 1, 1e-6) << name_of(method);
    EXPECT_NEAR(report.cost, 0, 1e-12) << name_of(method);
    EXPECT_EQ(report.cost, rosenbrock(x, {}));
    EXPECT_EQ(report.violation, 0);
    EXPECT_LT(report.evaluations, 300);
  }
}

TEST(NloptBridge, ConstrainedProblemsOfHockAndSchittkowski) {
  const std::vector<double> low(4, 1), high(4, 5), zero(3, 0);
  for (const LocalMethod method : {LocalMethod::slsqp, LocalMethod::cobyla}) {
    RunContext context;
    const bool exact = method == LocalMethod::slsqp;
    const LocalOptions options = {.method = method, .max_evaluations = 5000};
    std::vector<double> x = {1, 5, 5, 1};  // violates the second constraint
    const LocalReport a = minimise_local(hs071, 2, hs071_limits, x, low, high, options, context);
    EXPECT_EQ(a.status, Status::done) << name_of(method) << " " << name_of(a.end);
    EXPECT_NEAR(a.cost, 17.0140173, exact ? 1e-7 : 1e-5) << name_of(method);
    const double at[] = {1, 4.7429994, 3.8211503, 1.3794082};
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(x[j], at[j], exact ? 1e-6 : 1e-3) << name_of(method);
    std::vector<double> y = {0.5, 0.5, 0.5};
    const LocalReport b = minimise_local(hs035, 1, hs035_limit, y, zero, {}, options, context);
    EXPECT_EQ(b.status, Status::done) << name_of(method) << " " << name_of(b.end);
    EXPECT_NEAR(b.cost, 1.0 / 9, exact ? 1e-8 : 1e-6) << name_of(method);
    EXPECT_NEAR(y[0], 4.0 / 3, exact ? 1e-6 : 1e-3) << name_of(method);
    EXPECT_NEAR(y[2], 4.0 / 9, exact ? 1e-6 : 1e-3) << name_of(method);
  }
}

TEST(NloptBridge, BoundsHoldAndTheStartIsMovedInside) {
  // The minimum of the valley under x <= 0.5 is at (0.5, 0.25), 0.25.
  const std::vector<double> low = {-2, -2}, high = {0.5, 2};
  for (const LocalMethod method : {LocalMethod::slsqp, LocalMethod::bobyqa}) {
    RunContext context;
    std::vector<double> x = {3, 7};
    bool outside = false;
    const auto watched = [&](Numbers at, Out gradient) {
      for (std::size_t j = 0; j < 2; ++j) outside = outside || at[j] < low[j] || at[j] > high[j];
      return rosenbrock(at, gradient);
    };
    const LocalReport report = minimise_local(watched, x, low, high, {.method = method}, context);
    EXPECT_EQ(report.status, Status::done) << name_of(method);
    EXPECT_FALSE(outside) << name_of(method);
    EXPECT_EQ(x[0], 0.5) << name_of(method);
    EXPECT_NEAR(x[1], 0.25, 1e-6) << name_of(method);
    EXPECT_NEAR(report.cost, 0.25, 1e-9) << name_of(method);
  }
}

TEST(NloptBridge, FixedVariablesStayFixed) {
  const std::vector<double> low = {0.5, -2}, high = {0.5, 2};
  RunContext context;
  std::vector<double> x = {0, 0};
  EXPECT_EQ(minimise_local(rosenbrock, x, low, high, {}, context).status, Status::done);
  EXPECT_EQ(x[0], 0.5);
  EXPECT_NEAR(x[1], 0.25, 1e-6);
  const std::vector<double> both = {0.5, 1};
  EXPECT_EQ(minimise_local(rosenbrock, x, both, both, {}, context).cost, rosenbrock(both, {}));
}

TEST(NloptBridge, SaysThatNoPointMeetsTheConstraints) {
  // x <= -1 and x >= 1: half-way violates least, by 1.
  const auto apart = [](Numbers x, Out g, Out jacobian) {
    g[0] = x[0] + 1;
    g[1] = 1 - x[0];
    if (!jacobian.empty()) {
      jacobian[0] = 1;
      jacobian[1] = -1;
    }
  };
  const auto square = [](Numbers x, Out gradient) {
    if (!gradient.empty()) gradient[0] = 2 * x[0];
    return x[0] * x[0];
  };
  for (const LocalMethod method : {LocalMethod::slsqp, LocalMethod::cobyla}) {
    RunContext context;
    std::vector<double> x = {3};
    const LocalReport report = minimise_local(square, 2, apart, x, {}, {}, {.method = method}, context);
    EXPECT_EQ(report.status, Status::infeasible) << name_of(method);
    EXPECT_GE(report.violation, 1) << name_of(method);
    EXPECT_LE(report.violation, 4) << name_of(method);
    EXPECT_EQ(report.violation, std::max(x[0] + 1, 1 - x[0])) << name_of(method);
  }
}

TEST(NloptBridge, EndsWithTheBestAtTheBudgetAndAtAnInterruption) {
  for (const LocalMethod method : {LocalMethod::slsqp, LocalMethod::cobyla, LocalMethod::bobyqa}) {
    double least = HUGE_VAL;
    int calls = 0;
    RunContext* running = nullptr;
    const auto watched = [&](Numbers x, Out gradient) {
      if (++calls == 7 && running) running->cancel();
      const double f = rosenbrock(x, gradient);
      least = std::min(least, f);
      return f;
    };
    RunContext free;
    std::vector<double> x = {-1.2, 1};
    const LocalReport budget =
        minimise_local(watched, x, {}, {}, {.method = method, .max_evaluations = 9}, free);
    EXPECT_EQ(budget.status, Status::not_converged) << name_of(method);
    EXPECT_EQ(budget.end, LocalEnd::evaluations) << name_of(method);
    EXPECT_EQ(budget.evaluations, 9) << name_of(method);
    EXPECT_EQ(budget.cost, least) << name_of(method);
    EXPECT_EQ(rosenbrock(x, {}), least) << name_of(method);

    least = HUGE_VAL;
    calls = 0;
    RunContext context;
    running = &context;
    x = {-1.2, 1};
    const LocalReport report = minimise_local(watched, x, {}, {}, {.method = method}, context);
    EXPECT_EQ(report.status, Status::cancelled) << name_of(method);
    EXPECT_EQ(report.end, LocalEnd::interrupted) << name_of(method);
    EXPECT_EQ(report.evaluations, 7) << name_of(method);
    EXPECT_EQ(report.cost, least) << name_of(method);
    EXPECT_EQ(rosenbrock(x, {}), least) << name_of(method);

    RunContext late;
    late.set_time_limit(std::chrono::seconds(0));
    const LocalReport first = minimise_local(rosenbrock, x, {}, {}, {.method = method}, late);
    EXPECT_EQ(first.status, Status::deadline) << name_of(method);
    EXPECT_EQ(first.evaluations, 1) << name_of(method);
  }
}

TEST(NloptBridge, AFunctionThatLooksItselfEndsTheSearch) {
  for (const LocalMethod method : {LocalMethod::slsqp, LocalMethod::cobyla, LocalMethod::bobyqa}) {
    RunContext context;
    double least = HUGE_VAL;
    int calls = 0;
    const auto watched = [&](Numbers x, Out gradient) {
      // The time runs out within the seventh call.
      if (++calls == 7) {
        context.cancel();
        throw_if_interrupted(context);
      }
      const double f = rosenbrock(x, gradient);
      least = std::min(least, f);
      return f;
    };
    std::vector<double> x = {-1.2, 1};
    const LocalReport report = minimise_local(watched, x, {}, {}, {.method = method}, context);
    EXPECT_EQ(report.status, Status::cancelled) << name_of(method);
    EXPECT_EQ(report.end, LocalEnd::interrupted) << name_of(method);
    EXPECT_EQ(calls, 7) << name_of(method);
    EXPECT_EQ(report.cost, least) << name_of(method);
    EXPECT_EQ(rosenbrock(x, {}), least) << name_of(method);
  }
}

TEST(NloptBridge, ValuesThatDoNotExistEndTheSearch) {
  const auto broken = [](Numbers x, Out gradient) {
    return x[0] > 0.5 ? std::nan("") : rosenbrock(x, gradient);
  };
  RunContext context;
  std::vector<double> x = {-1.2, 1};
  const LocalReport report = minimise_local(broken, x, {}, {}, {}, context);
  EXPECT_EQ(report.status, Status::not_converged);
  EXPECT_EQ(report.end, LocalEnd::not_finite);
  EXPECT_EQ(report.cost, rosenbrock(x, {}));
  EXPECT_LT(report.cost, 24.2);  // cost of the start
  x = {2, 1};
  EXPECT_EQ(minimise_local(broken, x, {}, {}, {}, context).cost, HUGE_VAL);
  EXPECT_EQ(x[0], 2);
}

TEST(NloptBridge, ExceptionsComeOutOfTheSearch) {
  RunContext context;
  std::vector<double> x = {-1.2, 1};
  EXPECT_THROW(
      minimise_local([](Numbers, Out) -> double { throw std::domain_error("cost"); }, x, {}, {}, {}, context),
      std::domain_error);
  EXPECT_THROW(
      minimise_local(
          rosenbrock, 1, [](Numbers, Out, Out) { throw std::range_error("limit"); }, x, {}, {}, {}, context),
      std::range_error);
}

TEST(NloptBridge, SaysWhatIsWrong) {
  RunContext context;
  const std::vector<double> one = {0}, low = {0, 2}, high = {1, 1};
  const auto with = [&](std::vector<double> x, Numbers lower, Numbers upper, const LocalOptions& options,
                        std::size_t m = 0) {
    return message([&] { minimise_local(rosenbrock, m, hs035_limit, x, lower, upper, options, context); });
  };
  EXPECT_THAT(with({}, {}, {}, {}), HasSubstr("a search needs variables"));
  EXPECT_THAT(with({0, 0}, one, {}, {}), HasSubstr("1 lower and 0 upper bounds for 2 variables"));
  EXPECT_THAT(with({0, 0}, low, high, {}), HasSubstr("bounds of variable 1: 2 to 1"));
  EXPECT_THAT(with({0, std::nan("")}, {}, {}, {}), HasSubstr("start of variable 1: nan"));
  EXPECT_THAT(with({0, 0}, {}, {}, {.method = LocalMethod::bobyqa}, 1),
              HasSubstr("bobyqa takes no constraints, got 1; slsqp and cobyla do"));
  EXPECT_THAT(with({0}, {}, {}, {.method = LocalMethod::bobyqa}),
              HasSubstr("bobyqa needs two free variables, got 1"));
  EXPECT_THAT(with({0, 0}, {}, {}, {.max_evaluations = 0}),
              HasSubstr("minimise_local: max_evaluations must be at least 1, got 0"));
  EXPECT_THAT(with({0, 0}, {}, {}, {.step_tolerance = -1}),
              HasSubstr("minimise_local: step_tolerance must be at least 0, got -1"));
}

}  // namespace
}  // namespace linkwright::optimise
