// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/multistart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/message.h"

namespace linkwright::optimise {
namespace {

/// Half the square of cos(3 x) + x / 4: many local minima, those of cost 0 where cos(3 x) = -x / 4.
bool waves(std::span<const double> x, std::span<double> r, std::span<double> j) {
  r[0] = std::cos(3 * x[0]) + x[0] / 4;
  if (!j.empty()) j[0] = -3 * std::sin(3 * x[0]) + 0.25;
  return true;
}

bool uniform_start(std::size_t, RandomStream& random, std::span<double> x) {
  x[0] = random.uniform(-20, 20);
  return true;
}

TEST(Multistart, FindsTheGlobalMinimumAmongLocalOnes) {
  RunContext context;
  const auto report =
      multistart_least_squares(waves, 1, 1, {}, {}, uniform_start, {.starts = 60}, {}, context);
  EXPECT_EQ(report.status, Status::done);
  ASSERT_EQ(report.ends.size(), 60u);
  EXPECT_LT(report.ends[report.best].report.cost, 1e-13);
  int worse = 0;
  std::int64_t evaluations = 0;
  for (const MultistartEnd& end : report.ends) {
    worse += end.report.cost > 1e-3;
    evaluations += end.report.evaluations;
    EXPECT_GE(end.report.cost, report.ends[report.best].report.cost);
  }
  EXPECT_GT(worse, 5);
  EXPECT_EQ(evaluations, report.evaluations);
  EXPECT_GE(report.reached_best, 1);
}

TEST(Multistart, AStartIsTheSameWhereverItIsMade) {
  RunContext context;
  const auto all =
      multistart_least_squares(waves, 1, 1, {}, {}, uniform_start, {.starts = 20}, {.seed = 3}, context);
  const auto only_seven = multistart_least_squares(
      waves, 1, 1, {}, {},
      [](std::size_t start, RandomStream& random, std::span<double> x) {
        return uniform_start(start, random, x) && start == 7;
      },
      {.starts = 20}, {.seed = 3}, context);
  ASSERT_EQ(only_seven.ends.size(), 1u);
  EXPECT_EQ(only_seven.ends[0].start, 7u);
  EXPECT_EQ(only_seven.ends[0].x, all.ends[7].x);
  const auto other =
      multistart_least_squares(waves, 1, 1, {}, {}, uniform_start, {.starts = 20}, {.seed = 4}, context);
  EXPECT_NE(other.ends[7].x, all.ends[7].x);
}

TEST(Multistart, EndsAtTargetBudgetOrInterruption) {
  RunContext context;
  const auto target = multistart_least_squares(waves, 1, 1, {}, {}, uniform_start,
                                               {.starts = 1000, .target_cost = 1e-12}, {}, context);
  EXPECT_LE(target.ends.back().report.cost, 1e-12);
  EXPECT_EQ(target.best, target.ends.size() - 1);
  EXPECT_LT(target.ends.size(), 100u);
  const auto budget = multistart_least_squares(waves, 1, 1, {}, {}, uniform_start,
                                               {.starts = 1000, .evaluations = 50}, {}, context);
  EXPECT_GE(budget.evaluations, 50);
  EXPECT_LT(budget.evaluations - budget.ends.back().report.evaluations, 50);
  RunContext cancelled;
  cancelled.cancel();
  const auto stopped = multistart_least_squares(waves, 1, 1, {}, {}, uniform_start, {}, {}, cancelled);
  EXPECT_EQ(stopped.status, Status::cancelled);
  EXPECT_EQ(stopped.ends.size(), 1u);
}

TEST(Multistart, CutsALocalSearchShort) {
  RunContext context;
  int calls = 0;
  double least = INFINITY;
  const auto watched = [&](std::span<const double> x, std::span<double> r, std::span<double> j) {
    if (++calls == 3) context.cancel();
    waves(x, r, j);
    least = std::min(least, r[0] * r[0] / 2);
    return true;
  };
  const auto report =
      multistart_least_squares(watched, 1, 1, {}, {}, uniform_start, {.starts = 60}, {}, context);
  EXPECT_EQ(report.status, Status::cancelled);
  ASSERT_EQ(report.ends.size(), 1u);
  EXPECT_LE(calls, 4);  // and once more at the place it had come to
  EXPECT_EQ(report.evaluations, calls);
  EXPECT_EQ(report.ends[0].report.status, Status::not_converged);
  EXPECT_EQ(report.ends[0].report.cost, least);
  double r = 0;
  waves(report.ends[0].x, {&r, 1}, {});
  EXPECT_EQ(r * r / 2, least);
}

TEST(Multistart, TellsWhenNoStartCanBeEvaluated) {
  RunContext context;
  const auto report = multistart_least_squares([](auto...) { return false; }, 1, 1, {}, {}, uniform_start,
                                               {.starts = 3}, {}, context);
  EXPECT_EQ(report.status, Status::infeasible);
  EXPECT_EQ(report.reached_best, 0);
  EXPECT_EQ(report.ends.size(), 3u);
  EXPECT_THAT(linkwright::test::message([&] {
                multistart_least_squares(waves, 1, 1, {}, {}, uniform_start, {.starts = 0}, {}, context);
              }),
              ::testing::HasSubstr("starts must be at least 1, got 0"));
}

TEST(Multistart, BoundsHold) {
  RunContext context;
  const std::array<double, 1> lower = {2}, upper = {2.5};
  const auto report =
      multistart_least_squares(waves, 1, 1, lower, upper, uniform_start, {.starts = 5}, {}, context);
  for (const MultistartEnd& end : report.ends) EXPECT_TRUE(end.x[0] >= 2 && end.x[0] <= 2.5);
}

}  // namespace
}  // namespace linkwright::optimise
