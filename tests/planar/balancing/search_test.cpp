// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/balancing/search.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/checkpoint.h"
#include "linkwright/optimise/pareto.h"

namespace linkwright::planar {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;

// Two loads that pull to two places: of the first the best x is (1, 1), of the second (3, 1), on a table of
// two rows each. The initial design has (0, 0).
BalancingTask task() {
  BalancingTask t;
  t.variables = {{"x", -5, 5}, {"y", -5, 5}};
  t.initial = {0, 0};
  t.objectives = {{.quantity = "a_N", .measure = Measure::rms}, {.quantity = "b_N", .measure = Measure::rms}};
  t.table = [](std::span<const double> x) {
    Table table{.name = "sweep", .columns{}, .status{}};
    table.add("a_N", "a (N)", {x[0] - 1, x[1] - 1});
    table.add("b_N", "b (N)", {x[0] - 3, x[1] - 1});
    table.status = {"done", "done"};
    return table;
  };
  return t;
}

BalancingRun run(const BalancingTask& t, const BalancingOptimiser& o, std::uint64_t seed = 1) {
  const BalancingProblem p = balancing_problem(t);
  RunContext context;
  context.set_threads(1);
  return balance(p, o, {}, seed, "seed", false, context);
}

TEST(BalancingSearch, LargestIsLevelled) {
  const BalancingRun r = run(task(), {.combine = Combine::largest});
  ASSERT_EQ(r.designs.size(), 1u);
  // On the line y = 1 between the places: |x - 1| / sqrt 2 = |x - 3| / sqrt 10.
  const double x = (3 * std::sqrt(2.0) + std::sqrt(10.0)) / (std::sqrt(2.0) + std::sqrt(10.0));
  EXPECT_NEAR(r.designs[0].x[0], x, 1e-6);
  EXPECT_NEAR(r.designs[0].x[1], 1, 1e-6);
  EXPECT_NEAR(r.designs[0].ratios[0], r.designs[0].ratios[1], 1e-6);
  EXPECT_NEAR(r.designs[0].cost, (x - 1) / std::sqrt(2.0), 1e-6);
}

TEST(BalancingSearch, CapsHold) {
  BalancingTask t = task();
  t.objectives[0].at_most = 0.1;
  const BalancingRun r = run(t, {.combine = Combine::mean});
  ASSERT_EQ(r.designs.size(), 1u);
  EXPECT_LE(r.designs[0].ratios[0], 0.1 + 1e-6);
  EXPECT_EQ(r.designs[0].violation, 0);
  t.objectives[1].at_most = 0.1;  // both cannot be
  EXPECT_EQ(run(t, {.combine = Combine::mean}).status, Status::infeasible);
}

TEST(BalancingSearch, AllMeansNoneWorse) {
  BalancingTask t = task();
  t.initial = {1.1, 1.1};  // nearly the best of the first
  const BalancingRun r = run(t, {.combine = Combine::all});
  ASSERT_EQ(r.designs.size(), 1u);
  // The mean would fall further if the second could grow.
  EXPECT_THAT(r.designs[0].ratios, Each(Le(1 + 1e-6)));
  EXPECT_LT(r.designs[0].ratios[0], 0.99);
  EXPECT_NEAR(r.designs[0].ratios[1], 1, 1e-6);
}

TEST(BalancingSearch, FrontGoesFromOnePlaceToTheOther) {
  const BalancingRun r = run(task(), {.combine = Combine::front, .front = 9});
  ASSERT_EQ(r.designs.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i) {
    const BalancedDesign& d = r.designs[i];
    EXPECT_NEAR(d.x[1], 1, 1e-4);  // all lie on the line between the places
    EXPECT_GE(d.x[0], 1 - 1e-4);
    EXPECT_LE(d.x[0], 3 + 1e-4);
    for (const BalancedDesign& o : r.designs) EXPECT_FALSE(optimise::dominates(o.ratios, d.ratios));
    if (i > 0) {
      EXPECT_GT(d.ratios[0], r.designs[i - 1].ratios[0]);
    }
  }
  EXPECT_LT(r.designs.front().x[0], 1.1);
  EXPECT_GT(r.designs.back().x[0], 2.9);
}

TEST(BalancingSearch, InOrderMeetsTheFirstThenImprovesTheSecond) {
  BalancingTask t = task();
  t.objectives[0].target = 0.5;   // within sqrt(2) / 2 of (1, 1)
  t.objectives[1].target = 0.01;  // out of reach then
  const BalancingRun r = run(t, {.combine = Combine::in_order});
  ASSERT_EQ(r.designs.size(), 1u);
  EXPECT_NEAR(r.designs[0].ratios[0], 0.5, 1e-5);
  EXPECT_NEAR(r.designs[0].x[0], 1 + std::sqrt(2.0) / 2, 1e-4);
  // The first cannot be met: nothing else counts.
  t.objectives[0].at_most = std::nullopt;
  t.variables[0].lower = 2.5;
  t.initial = {4, 4};
  t.objectives[0].reference = 1;
  t.objectives[1].reference = 1;
  const BalancingRun far = run(t, {.combine = Combine::in_order});
  EXPECT_NEAR(far.designs[0].x[0], 2.5, 1e-6);
  EXPECT_NEAR(far.designs[0].x[1], 1, 1e-3);
}

TEST(BalancingSearch, PopulationMethodsComeToTheSame) {
  BalancingOptimiser o{.combine = Combine::largest};
  const double best = run(task(), o).designs[0].cost;
  optimise::PopulationMethod<optimise::DifferentialEvolutionOptions, optimise::Constraints::feasibility_rules>
      de;
  de.options.generations = 300;
  o.method = de;
  EXPECT_NEAR(run(task(), o).designs[0].cost, best, 1e-8);
  optimise::PopulationMethod<optimise::CuckooSearchOptions, optimise::Constraints::feasibility_rules> cuckoo;
  o.method = cuckoo;
  o.combine = Combine::all;
  const BalancingRun r = run(task(), o);
  EXPECT_THAT(r.designs[0].ratios, Each(Le(1.0)));  // every step improves all
}

TEST(BalancingSearch, FrontsByPopulationMethodsLieNearTheExactOne) {
  // Points of the front lie on the line between the two places, which are 2 apart; members of these
  // populations near it.
  const auto expect_near_front = [](const BalancingRun& r, double within, std::size_t least) {
    EXPECT_GE(r.designs.size(), least);
    for (const BalancedDesign& d : r.designs) {
      EXPECT_NEAR(d.x[1], 1, within);
      for (const BalancedDesign& o : r.designs) EXPECT_FALSE(optimise::dominates(o.ratios, d.ratios));
    }
  };
  BalancingOptimiser o{.combine = Combine::front, .front = 20};
  o.method = Nsga2Balancing{.options = {.population = 40, .generations = 100}, .front = {}};
  expect_near_front(run(task(), o), 0.2, 20);
  o.method = MoeadBalancing{.options = {.population = 40, .generations = 100}, .front = {}};
  expect_near_front(run(task(), o), 0.2, 20);
  o.method = optimise::PopulationMethod<optimise::DifferentialEvolutionOptions,
                                        optimise::Constraints::feasibility_rules>();
  expect_near_front(run(task(), o), 1, 4);  // points met on its way
}

TEST(BalancingSearch, QuestionsThatAMethodCannotAnswerAreRefused) {
  BalancingOptimiser o;
  EXPECT_FALSE(problem(o, 3));
  o.method = optimise::PopulationMethod<optimise::DifferentialEvolutionOptions,
                                        optimise::Constraints::feasibility_rules>();
  EXPECT_FALSE(problem(o, 3));
  o.combine = Combine::all;
  EXPECT_FALSE(problem(o, 1));
  EXPECT_EQ(problem(o, 3)->message,
            "differential_evolution minimises one objective, combine = \"all\" asks for several");
  o.method = Nsga2Balancing();
  EXPECT_EQ(problem(o, 3)->message, "nsga2 gives fronts of several objectives");
  o.combine = Combine::front;
  EXPECT_FALSE(problem(o, 3));
  o.method = Nsga2Balancing{.options = {.population = 42}, .front = {}};
  EXPECT_EQ(problem(o, 3)->message, "nsga2 has a population of 42");
  o.method = MoeadBalancing{.options = {.population = 20, .neighbours = 20}, .front = {}};
  EXPECT_EQ(problem(o, 3)->message, "moead has 20 neighbours in a population of 20");
}

TEST(BalancingSearch, WhatIsKeptComesBackWithTheSameBits) {
  const BalancingProblem p = balancing_problem(task());
  const BalancingOptimiser o{.combine = Combine::front, .front = 5};
  const BalancingRun r = run(task(), o);
  const BalancingRun back = restored(kept(r), p, o, "seed 1");
  ASSERT_EQ(back.designs.size(), r.designs.size());
  for (std::size_t i = 0; i < r.designs.size(); ++i) {
    EXPECT_EQ(back.designs[i].x, r.designs[i].x);
    EXPECT_EQ(back.designs[i].ratios, r.designs[i].ratios);
    EXPECT_EQ(back.designs[i].cost, r.designs[i].cost);
    EXPECT_EQ(back.designs[i].active, r.designs[i].active);
  }
  EXPECT_EQ(back.evaluations, r.evaluations);
  ASSERT_EQ(back.history.size(), r.history.size());
}

TEST(BalancingSearch, WhatCannotHaveBeenKeptIsRefused) {
  const BalancingProblem p = balancing_problem(task());
  const BalancingOptimiser o;
  const Value good = kept(run(task(), o));
  const auto refused = [&](auto&& change) {
    Value bad = good;
    change(bad);
    try {
      restored(bad, p, o, "seed 1");
    } catch (const CheckpointError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refused([](Value& v) { v["feasible"] = 1; }), HasSubstr("seed 1: is not a balancing run"));
  EXPECT_THAT(refused([](Value& v) { v["designs"].as_array()[0]["x"] = pack_numbers(std::vector{1.0}); }),
              HasSubstr("seed 1: a design is none of this study"));
  EXPECT_THAT(refused([](Value& v) { v["designs"].as_array()[0]["proof"] = 3; }),
              HasSubstr("seed 1: a design lacks its texts"));
  EXPECT_THAT(refused([](Value& v) { v["history"] = pack_numbers(std::vector{1.0}); }),
              HasSubstr("seed 1: has half a step"));
}

TEST(BalancingSearch, SeedsDecide) {
  const BalancingOptimiser o{.combine = Combine::mean};
  EXPECT_EQ(run(task(), o, 3).designs[0].x, run(task(), o, 3).designs[0].x);
}

}  // namespace
}  // namespace linkwright::planar
