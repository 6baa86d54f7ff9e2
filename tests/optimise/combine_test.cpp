// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/combine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/optimise/minimise.h"
#include "linkwright/optimise/priorities.h"
#include "optimise/functions.h"
#include "support/allocations.h"
#include "support/memory_checkpoint.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Costs x0 and x1, no costs where x0 > 8.
Problem plain() {
  return test::make_problem(2, 0, 10, 2, [](std::span<const double> x, std::span<double> costs) {
    costs[0] = costs[1] = HUGE_VAL;
    if (x[0] > 8) return 3.0;
    costs[0] = x[0];
    costs[1] = x[1];
    return 0.0;
  });
}

struct Answer {
  double cost, violation;
};

Answer at(const Problem& problem, double x0, double x1) {
  EXPECT_EQ(problem.objectives, 1u);
  Population one(2, 1);
  one.set(0, std::vector<double>{x0, x1});
  Answer a;
  problem.evaluate(one.view(), {&a.cost, 1}, {&a.violation, 1});
  return a;
}

TEST(Combine, WeighsAndAdds) {
  EXPECT_EQ(at(weighted_sum(plain()), 2, 5).cost, 3.5);  // halves: the mean
  EXPECT_EQ(at(weighted_sum(plain(), std::vector<double>{1, 2}), 2, 5).cost, 12);
  EXPECT_EQ(at(weighted_sum(plain(), std::vector<double>{0, 2}), 2, 5).cost, 10);
  EXPECT_EQ(weighted_sum(plain()).variables.size(), 2u);
}

TEST(Combine, TakesTheLargest) {
  EXPECT_EQ(at(largest(plain()), 2, 5).cost, 5);
  EXPECT_EQ(at(largest(plain()), 7, 5).cost, 7);
}

TEST(Combine, WhatDoesNotExistStaysInfiniteAndItsViolationAsItIs) {
  const double caps[] = {1, 1};
  for (const Problem& problem :
       {weighted_sum(plain(), std::vector<double>{0, 1}, caps), largest(plain(), caps)}) {
    EXPECT_EQ(at(problem, 9, 0).cost, HUGE_VAL);  // no NaN from 0 times infinity
    EXPECT_EQ(at(problem, 9, 0).violation, 3);
  }
}

TEST(Combine, CapsAddWhatExceedsThem) {
  const double caps[] = {HUGE_VAL, 4};
  const Problem problem = weighted_sum(plain(), {}, caps);
  EXPECT_EQ(at(problem, 7, 4).violation, 0);
  EXPECT_EQ(at(problem, 7, 4.5).violation, 0.5);
  EXPECT_EQ(at(problem, 7, 4.5).cost, 5.75);
  const double both[] = {2, 4};
  EXPECT_EQ(at(largest(plain(), both), 3, 6).violation, 3);
  const std::vector<Violation> reasons = largest(plain(), both).explain(std::vector<double>{3, 4});
  ASSERT_EQ(reasons.size(), 1u);
  EXPECT_EQ(reasons[0].reason, "objective_1_at_most");
  EXPECT_EQ(reasons[0].amount, 1);
  EXPECT_FALSE(largest(plain()).explain);  // the same as the parts
}

TEST(Combine, ACombinationCanBeCombinedAgain) {
  Problem both = plain();
  both.evaluate = [sum = weighted_sum(plain()), most = largest(plain())](
                      const PopulationView& x, std::span<double> cost, std::span<double> violation) {
    std::vector<double> a(x.size), b(x.size);
    sum.evaluate(x, a, violation);
    most.evaluate(x, b, violation);
    for (std::size_t i = 0; i < x.size; ++i) {
      cost[2 * i] = a[i];
      cost[2 * i + 1] = b[i];
    }
  };
  EXPECT_EQ(at(weighted_sum(both), 2, 5).cost, (3.5 + 5) / 2);
}

TEST(Combine, EvaluatesWithoutAllocationAfterTheFirstTime) {
  Problem problem = plain();
  problem.evaluate = [](const PopulationView& x, std::span<double> cost, std::span<double> violation) {
    for (std::size_t i = 0; i < x.size; ++i) {
      cost[2 * i] = cost[2 * i + 1] = x(0, i);
      violation[i] = 0;
    }
  };
  const Problem sum = weighted_sum(problem);
  const Population x(2, 40);
  std::vector<double> cost(40), violation(40);
  sum.evaluate(x.view(), cost, violation);
  const auto before = linkwright::test::allocations();
  for (int k = 0; k < 10; ++k) sum.evaluate(x.view(), cost, violation);
  EXPECT_EQ(linkwright::test::allocations(), before);
}

TEST(Combine, AnyMethodMinimisesAndReportsAllObjectives) {
  const Problem problem = test::schaffer(3);
  MinimiseOptions options = {.front = 30};
  options.stop.generations = 200;
  for (const EnumName<Method>& entry : names(Method{})) {
    RunContext context;
    const Report mean = minimise(weighted_sum(problem), {.method = entry.value}, options, {}, context);
    ASSERT_EQ(mean.costs.size(), 2u) << entry.name;
    EXPECT_EQ(mean.cost, 0.5 * mean.costs[0] + 0.5 * mean.costs[1]);
    EXPECT_NEAR(mean.cost, 1, 1e-3) << entry.name;  // in the middle, where both are 1
    EXPECT_EQ(mean.log.back().best_cost, mean.cost);
    const Report most = minimise(largest(problem), {.method = entry.value}, options, {}, context);
    EXPECT_EQ(most.cost, std::max(most.costs[0], most.costs[1]));
    EXPECT_NEAR(most.cost, 1, 1e-2) << entry.name;
    // On the way it left a front, the best of the mean on it.
    ASSERT_GT(mean.front.size(), 2u);
    EXPECT_LE(mean.front.size(), 30u);
    const auto costs_of_best = [&](const ParetoPoint& p) { return p.costs == mean.costs; };
    EXPECT_LE(std::count_if(mean.front.begin(), mean.front.end(), costs_of_best), 1);
    for (const ParetoPoint& a : mean.front)
      for (const ParetoPoint& b : mean.front) EXPECT_FALSE(dominates(a.costs, b.costs));
  }
  // A cap on the first objective: sqrt(f1) + sqrt(f2) = 2 on the front.
  RunContext context;
  const double caps[] = {0.25, HUGE_VAL};
  options.stop.generations = 2000;
  const Report capped = minimise(weighted_sum(problem, {}, caps), {}, options, {}, context);
  EXPECT_EQ(capped.violation, 0);
  EXPECT_NEAR(capped.costs[0], 0.25, 1e-4);
  EXPECT_NEAR(capped.costs[1], 2.25, 1e-3);
  for (const ParetoPoint& p : capped.front) EXPECT_LE(p.costs[0], 0.25);
}

TEST(Combine, GoesOnFromACheckpointWithTheSameBits) {
  const Problem problem = by_priority(test::binh_korn(), {.tolerances = {40, 30}});
  MinimiseOptions options = {.incumbent = {{-1, 9}, {70, 50}}, .front = 12, .checkpoint = "here"};
  options.stop.generations = 40;
  RunContext plain;
  const Report whole = minimise(problem, OptimiserOptions{}, options, {}, plain);
  for (const int last : {1, 7, 39}) {
    linkwright::test::MemoryCheckpoint checkpoint;
    RunContext first, second;
    first.set_checkpoint(&checkpoint);
    second.set_checkpoint(&checkpoint);
    int generations = 0;
    first.set_progress([&](const Progress&) {
      if (++generations == last) first.cancel();
    });
    minimise(problem, OptimiserOptions{}, options, {}, first);
    const Report resumed = minimise(problem, OptimiserOptions{}, options, {}, second);
    EXPECT_EQ(resumed.x, whole.x);
    EXPECT_EQ(resumed.costs, whole.costs);
    EXPECT_EQ(resumed.cost, whole.cost);
    ASSERT_EQ(resumed.front.size(), whole.front.size());
    for (std::size_t i = 0; i < whole.front.size(); ++i) {
      EXPECT_EQ(resumed.front[i].x, whole.front[i].x);
      EXPECT_EQ(resumed.front[i].costs, whole.front[i].costs);
    }
  }
  EXPECT_EQ(whole.cost, priority_cost(priority_key(whole.costs, {.tolerances = {40, 30}})));

  // A front in the checkpoint must be one, of designs in the bounds [0, 5] x [0, 3].
  linkwright::test::MemoryCheckpoint checkpoint;
  RunContext context;
  context.set_checkpoint(&checkpoint);
  minimise(problem, OptimiserOptions{}, options, {}, context);
  const auto refusal = [&](const std::vector<double>& front) -> std::string {
    checkpoint.entries["here/state"]["front"] = pack_numbers(front);
    try {
      minimise(problem, OptimiserOptions{}, options, {}, context);
    } catch (const CheckpointError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(refusal({1, 1, 8, 32, 2, 2, 32, 18}), "none");
  for (const std::vector<double>& front : {std::vector<double>{1, 1, 8},
                                           {1, 1, 8, 32, 2, 2, 32, 40},
                                           {1, NAN, 8, 32},
                                           {-1, 1, 8, 32},
                                           {1, 4, 8, 32}})
    EXPECT_EQ(refusal(front), "here: is not a state of this method and problem");
}

TEST(Combine, StartsFromTheObjectivesOfTheIncumbent) {
  MinimiseOptions options = {.incumbent = {{-7, 2, 2}, {0.4, 0.2}}};
  options.stop.generations = 20;
  RunContext context;
  const Report kept = minimise(largest(test::schaffer(3)), {}, options, {}, context);
  EXPECT_EQ(kept.cost, 0.4);
  EXPECT_THAT(kept.costs, ElementsAre(0.4, 0.2));
  options.incumbent.costs = {0.4};
  EXPECT_THAT(message([&] { minimise(largest(test::schaffer(3)), {}, options, {}, context); }),
              HasSubstr("an incumbent of 1 costs for 2 objectives"));
}

TEST(Combine, SaysWhatIsWrong) {
  const auto weights = [](const std::vector<double>& w) {
    return message([&] { weighted_sum(plain(), w); });
  };
  EXPECT_THAT(weights({1, 2, 3}), HasSubstr("3 weights for 2 objectives"));
  EXPECT_THAT(weights({1, -2}), HasSubstr("weight 1 must be at least 0, got -2"));
  EXPECT_THAT(weights({0, 0}), HasSubstr("all weights are 0"));
  EXPECT_THAT(message([] { largest(plain(), std::vector<double>{1}); }),
              HasSubstr("1 caps for 2 objectives"));
  EXPECT_THAT(message([] {
                largest(plain(), std::vector<double>{1, NAN});
              }),
              HasSubstr("combine: cap 1: nan"));
}

}  // namespace
}  // namespace linkwright::optimise
