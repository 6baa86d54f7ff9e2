// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/minimise_smooth.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/looks.h"
#include "linkwright/core/numbers.h"
#include "optimise/smooth_cases.h"
#include "support/memory_checkpoint.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using test::smooth_problem;
using ::testing::HasSubstr;
using Numbers = std::span<const double>;
using Out = std::span<double>;

// Central differences leave 1e-10, squared by the minimum; stop criteria 1e-10 of the cost.
constexpr double close = 1e-7;

const ActiveLimit* find(const SmoothReport& report, LimitKind kind, std::size_t index) {
  for (const ActiveLimit& limit : report.active)
    if (limit.kind == kind && limit.index == index) return &limit;
  return nullptr;
}

TEST(MinimiseSmooth, FindsTheMeanUnderAConstraint) {
  // The mean is the square of the distance to (1/2, 1), and more; nearest on a + b = 1 is (1/4, 3/4).
  RunContext context;
  const SmoothReport r = minimise_smooth(test::two_points(), {.candidates = 64, .starts = 8}, {}, context);
  EXPECT_EQ(r.status, Status::done);
  EXPECT_EQ(r.stop_reason, "8 searches");
  EXPECT_NEAR(r.x[0], 0.25, 1e-5);
  EXPECT_NEAR(r.x[1], 0.75, 1e-5);
  EXPECT_NEAR(r.cost, 1.375, close);
  EXPECT_EQ(r.reached_best, 8);
  EXPECT_EQ(r.ends.size(), 8u);
  EXPECT_NEAR(r.constraints[0], 0, 1e-9);
  // Moving the line by 1 in a + b changes the cost by 1/2 at first.
  const ActiveLimit* line = find(r, LimitKind::constraint, 0);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->price, 0.5, 1e-5);
  EXPECT_EQ(r.active.size(), 1u);
  EXPECT_LT(r.stationarity, 1e-5);
}

// Candidates are counted as far as they were evaluated, and the best of them is the start.
TEST(MinimiseSmooth, AnInterruptionAmongTheFirstCandidatesKeepsThose) {
  RunContext context;
  const SmoothOptions options{.candidates = 10000, .starts = 8};
  const LooksAllowed looks(99);
  const SmoothReport r = minimise_smooth(interruptible(test::two_points(), context), options, {}, context);
  EXPECT_EQ(r.status, Status::cancelled);
  // A hundred candidates, and what a search takes at its start.
  EXPECT_GE(r.evaluations, 100);
  EXPECT_LE(r.evaluations, 110);
  // The mean of a hundred random designs of [-3, 3]^2 is far above that of their best.
  EXPECT_LT(r.cost, 2);
  EXPECT_GE(r.cost, 1.375 - 0.5);
}

TEST(MinimiseSmooth, FindsTheLargest) {
  // Equal on 4 b - 2 a = 3, and within a + b <= 1 nearest to both on the segment of the centres: at t of it,
  // sqrt(5) t = sqrt(5) (1 - t), which is (1/2, 1), not allowed; on the line (1/6, 5/6), 25/18.
  RunContext context;
  const SmoothReport r = minimise_smooth(
      test::two_points(), {.goal = SmoothGoal::largest, .candidates = 64, .starts = 8}, {}, context);
  EXPECT_NEAR(r.cost, 25.0 / 18, close);
  EXPECT_NEAR(r.x[0], 1.0 / 6, 1e-6);
  EXPECT_NEAR(r.objectives[0], r.objectives[1], close);
  // Their shares l and 1 - l, and the price p of the line, take the gradients to zero.
  const ActiveLimit *first = find(r, LimitKind::objective, 0), *second = find(r, LimitKind::objective, 1),
                    *line = find(r, LimitKind::constraint, 0);
  ASSERT_TRUE(first && second && line);
  EXPECT_NEAR(first->price + second->price, 1, 1e-9);
  const double a = r.x[0], b = r.x[1], l = first->price;
  EXPECT_NEAR(l * 2 * (a - 1) + (1 - l) * 2 * a + line->price, 0, 1e-6);
  EXPECT_NEAR(l * 2 * b + (1 - l) * 2 * (b - 2) + line->price, 0, 1e-6);
}

TEST(MinimiseSmooth, KeepsCapsAndTellsTheirPrice) {
  // Without the line: least mean with the first objective at most 1/4.
  SmoothProblem p = test::two_points();
  SmoothOptions o{.candidates = 64, .starts = 8, .caps = {0.25, infinity}};
  p = smooth_problem({{"a", -3, 3}, {"b", -3, 3}}, 2, 0, [](Numbers x, Out out) {
    out[0] = (x[0] - 1) * (x[0] - 1) + x[1] * x[1];
    out[1] = x[0] * x[0] + (x[1] - 2) * (x[1] - 2);
  });
  RunContext context;
  const SmoothReport r = minimise_smooth(p, o, {}, context);
  // On the segment of the centres at a distance of 1/2 from the first.
  const double rest = std::sqrt(5.0) - 0.5;
  EXPECT_NEAR(r.cost, (0.25 + rest * rest) / 2, close);
  const ActiveLimit* cap = find(r, LimitKind::cap, 0);
  ASSERT_TRUE(cap);
  // d/dc of (c + (sqrt 5 - sqrt c)^2) / 2, negative.
  const double price = (std::sqrt(5.0) / 0.5 - 2) / 2;
  EXPECT_NEAR(cap->price, price, 1e-5);
  EXPECT_NEAR(cap->price_per_cent, price * 0.25 / 100, 1e-7);
}

TEST(MinimiseSmooth, TellsThePriceOfBounds) {
  const SmoothProblem p =
      smooth_problem({{"a", 0.5, 2}, {"b", 0, 3}, {"c", 4, 4}}, 1, 0,
                     [](Numbers x, Out out) { out[0] = x[0] * x[0] + (x[1] - 4) * (x[1] - 4) + x[2]; });
  RunContext context;
  const SmoothReport r = minimise_smooth(p, {.candidates = 16, .starts = 4}, {}, context);
  EXPECT_EQ(r.x, (std::vector<double>{0.5, 3, 4}));
  const ActiveLimit *low = find(r, LimitKind::lower_bound, 0), *high = find(r, LimitKind::upper_bound, 1);
  ASSERT_TRUE(low && high);
  EXPECT_NEAR(low->price, 1, 1e-8);
  EXPECT_NEAR(low->price_per_cent, 0.005, 1e-9);
  EXPECT_NEAR(high->price, 2, 1e-8);
  EXPECT_NEAR(high->price_per_cent, 0.06, 1e-9);
  EXPECT_EQ(r.active.size(), 2u);
  EXPECT_EQ(r.active[0].kind, LimitKind::upper_bound);  // the dearer one first
}

// Rastrigin's function of two variables: 121 minima in the box, the best 1.
SmoothProblem bumpy() {
  return smooth_problem({{"a", -5, 5.5}, {"b", -5, 5.5}}, 1, 0, [](Numbers x, Out out) {
    out[0] = 21;
    for (const double v : x) out[0] += v * v - 10 * std::cos(2 * M_PI * v);
  });
}

TEST(MinimiseSmooth, BeginsFromTheBestOfMany) {
  RunContext context;
  const SmoothReport r = minimise_smooth(bumpy(), {.confirmations = 2}, {.seed = 3}, context);
  EXPECT_NEAR(r.cost, 1, 1e-8);
  EXPECT_LT(r.ends.size(), 96u);
  EXPECT_EQ(r.stop_reason, fmt::format("{} of {} searches found the best", r.reached_best, r.ends.size()));
}

TEST(MinimiseSmooth, GivesTheSameBitsForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    RunContext context;
    context.set_threads(threads);
    return minimise_smooth(bumpy(), {.candidates = 1000, .starts = 20, .confirmations = 0}, {.seed = 8},
                           context);
  };
  const SmoothReport one = run(1), three = run(3);
  EXPECT_EQ(one.x, three.x);
  EXPECT_EQ(one.evaluations, three.evaluations);
  ASSERT_EQ(one.ends.size(), three.ends.size());
  for (std::size_t k = 0; k < one.ends.size(); ++k) EXPECT_EQ(one.ends[k].x, three.ends[k].x);
}

TEST(MinimiseSmooth, GoesOnFromItsCheckpoint) {
  const SmoothOptions o{.candidates = 500, .starts = 24, .confirmations = 0, .checkpoint = "seed 1"};
  RunContext plain;
  const SmoothReport whole = minimise_smooth(bumpy(), o, {}, plain);

  test::MemoryCheckpoint kept;
  RunContext first;
  first.set_checkpoint(&kept);
  kept.kept = [&](std::string_view) { first.cancel(); };
  const SmoothReport cut = minimise_smooth(bumpy(), o, {}, first);
  EXPECT_EQ(cut.status, Status::cancelled);
  EXPECT_EQ(cut.stop_reason, "cancelled");
  EXPECT_EQ(cut.ends.size(), 8u);

  kept.kept = {};
  RunContext second;
  second.set_checkpoint(&kept);
  const SmoothReport rest = minimise_smooth(bumpy(), o, {}, second);
  EXPECT_EQ(rest.status, Status::done);
  EXPECT_EQ(rest.x, whole.x);
  EXPECT_EQ(rest.cost, whole.cost);
  EXPECT_EQ(rest.evaluations, whole.evaluations);
  EXPECT_EQ(rest.reached_best, whole.reached_best);

  kept.entries["seed 1/ends"] = pack_numbers(std::vector<double>{1, 2, 3});
  EXPECT_THROW(minimise_smooth(bumpy(), o, {}, second), CheckpointError);
}

TEST(MinimiseSmooth, EvaluatesNoMoreThanAPartOfItsCandidatesWhenItIsToStop) {
  SmoothProblem problem = test::two_points();
  const auto plain = problem.evaluate;
  std::int64_t evaluated = 0;
  problem.evaluate = [&](const PopulationView& x, std::span<double> values) {
    evaluated += static_cast<std::int64_t>(x.size);
    plain(x, values);
  };
  RunContext context;
  context.cancel();
  const SmoothReport cut = minimise_smooth(problem, {.candidates = 1000000}, {}, context);
  EXPECT_EQ(cut.status, Status::cancelled);
  EXPECT_EQ(cut.x.size(), 2u);
  EXPECT_LT(cut.cost, HUGE_VAL);
  EXPECT_LT(evaluated, 2000);
  EXPECT_LE(cut.evaluations, evaluated);
}

TEST(MinimiseSmooth, SaysWhenNothingIsFeasible) {
  const SmoothProblem p =
      smooth_problem({{"a", 0, 1}}, 1, 1, [](Numbers x, Out out) { out[0] = x[0], out[1] = 2 - x[0]; });
  RunContext context;
  const SmoothReport r = minimise_smooth(p, {.candidates = 8, .starts = 2}, {}, context);
  EXPECT_EQ(r.status, Status::infeasible);
  EXPECT_NEAR(r.violation, 1, 1e-6);
  EXPECT_EQ(r.reached_best, 0);
}

TEST(MinimiseSmooth, SearchesFromOneStart) {
  RunContext context;
  const std::vector<double> start = {-2, 2}, outside = {2.9, -1};
  const SmoothReport r = minimise_smooth_from(test::two_points(), {}, start, context);
  EXPECT_NEAR(r.cost, 1.375, close);
  EXPECT_EQ(r.ends.size(), 1u);
  // It does not exist there, and nothing leads away.
  EXPECT_EQ(minimise_smooth_from(test::two_points(), {}, outside, context).status, Status::infeasible);
}

TEST(MinimiseSmooth, RejectsWhatItCannotUse) {
  const auto error = [](SmoothProblem p, const SmoothOptions& o) {
    RunContext context;
    return test::message([&] { minimise_smooth(p, o, {}, context); });
  };
  const SmoothProblem good = test::two_points();
  EXPECT_THAT(error(good, {.candidates = 0}),
              HasSubstr("minimise_smooth: candidates must be at least 1, got 0"));
  EXPECT_THAT(error(good, {.weights = {1}}), HasSubstr("1 weights for 2 objectives"));
  EXPECT_THAT(error(good, {.weights = {1, -1}}), HasSubstr("weight 1 must be at least 0, got -1"));
  EXPECT_THAT(error(good, {.weights = {0, 0}}), HasSubstr("all 2 weights are 0"));
  EXPECT_THAT(error(good, {.caps = {1}}), HasSubstr("1 caps for 2 objectives"));
  EXPECT_THAT(error(good, {.caps = {1, std::nan("")}}), HasSubstr("cap 1 is not a number"));
  EXPECT_THAT(error(good, {.local = {.method = LocalMethod::cobyla}}), HasSubstr("needs slsqp, got cobyla"));
  SmoothProblem bad = good;
  bad.variables[1].upper = -4;
  EXPECT_THAT(error(bad, {}), HasSubstr("bounds of b: -3 to -4"));
  bad = good;
  bad.variables = {{"a", 1, 1}, {"b", 2, 2}};
  EXPECT_THAT(error(bad, {}), HasSubstr("no variable of 2 is free"));
}

}  // namespace
}  // namespace linkwright::optimise
