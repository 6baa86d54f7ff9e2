// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/cma_es.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "linkwright/optimise/minimise.h"
#include "optimise/functions.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

Report run(const Problem& problem, int generations, std::uint64_t seed = 1, int population = 0,
           int threads = 1) {
  RunContext context;
  context.set_threads(threads);
  OptimiserOptions method = {.method = Method::cma_es};
  method.cma_es.population = population;
  method.cma_es.generations = generations;
  return minimise(problem, method, {}, {.seed = seed}, context);
}

TEST(CmaEs, FindsKnownOptima) {
  // Its convergence is linear, so that these costs are hundreds of decades from those of random designs.
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    EXPECT_LT(run(test::sphere(8), 400, seed).cost, 1e-20);
    EXPECT_LT(run(test::rosenbrock(5), 600, seed, 20).cost, 1e-18);  // its other minimum costs 3.9
  }
}

TEST(CmaEs, FindsAnOptimumOnAConstraint) {
  // x0 + x1 in the circle of radius sqrt(2): -2 at (-1, -1).
  const Problem problem = test::make_problem(2, -3, 4, [](std::span<const double> x) {
    return test::Value{x[0] + x[1], std::max(0.0, x[0] * x[0] + x[1] * x[1] - 2)};
  });
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Report report = run(problem, 300, seed, 12);
    EXPECT_EQ(report.violation, 0);
    // Ranks are blind to how the cost falls along the boundary: steps shrink before the very optimum.
    EXPECT_NEAR(report.cost, -2, 1e-3);
    EXPECT_GE(report.cost, -2 - 1e-12);
  }
}

TEST(CmaEs, KeepsTheBoundsAndEvaluatesWholePopulations) {
  // The optimum is outside, beyond two of the bounds.
  Problem problem = test::sphere(4);
  problem.variables[0] = {"a", 1, 5};
  problem.variables[2] = {"b", -7, -2};
  const auto inner = problem.evaluate;
  int calls = 0;
  problem.evaluate = [&](const PopulationView& x, std::span<double> cost, std::span<double> violation) {
    ++calls;
    EXPECT_EQ(x.size, 14u);
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < x.size; ++i) {
        EXPECT_GE(x(j, i), problem.variables[j].lower);
        EXPECT_LE(x(j, i), problem.variables[j].upper);
      }
    inner(x, cost, violation);
  };
  const Report report = run(problem, 300, 1, 14);
  EXPECT_EQ(calls, 300);
  EXPECT_EQ(report.evaluations, 300 * 14);
  EXPECT_EQ(report.x[0], 1);
  EXPECT_EQ(report.x[2], -2);
  EXPECT_NEAR(report.cost, 5, 1e-12);
}

TEST(CmaEs, TheSeedDecidesAllForAnyNumberOfThreads) {
  const Problem problem = test::rastrigin(3);
  std::set<double> costs;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Report one = run(problem, 30, seed, 600);  // evaluated in parts
    const Report many = run(problem, 30, seed, 600, 5);
    EXPECT_EQ(one.x, many.x);
    EXPECT_EQ(one.cost, many.cost);
    costs.insert(one.cost);
  }
  EXPECT_EQ(costs.size(), 3u);
}

TEST(CmaEs, IsCancelledBetweenGenerations) {
  RunContext context;
  int generations = 0;
  context.set_progress([&](const Progress& progress) {
    EXPECT_EQ(progress.stage, "cma_es");
    if (++generations == 7) context.cancel();
  });
  const Report report = minimise(test::sphere(3), {.method = Method::cma_es}, {}, {}, context);
  EXPECT_EQ(report.status, Status::cancelled);
  EXPECT_EQ(report.generations, 7);
  EXPECT_EQ(report.evaluations, 7 * 7);
  EXPECT_EQ(report.log.size(), 7u);
}

TEST(CmaEs, EndsWhenItsStepsAreNothing) {
  std::vector<Problem> problems(2, test::sphere(3));
  for (Variable& v : problems[1].variables) v.lower = 0;  // the optimum in a corner
  for (const Problem& problem : problems) {
    const Report report = run(problem, 5000, 1, 8);
    EXPECT_EQ(report.generations, 5000);
    EXPECT_LT(report.evaluations, 8 * 3000);
    EXPECT_LT(report.cost, 1e-30);
    EXPECT_EQ(report.log[4998].evaluations, report.evaluations);
    const auto optimiser = make_optimiser(problem.variables, CmaEsOptions{.population = 8}, {});
    std::vector<double> cost(8), violation(8);
    std::size_t asked = 8;
    while (asked > 0) {
      const PopulationView x = optimiser->ask();
      asked = x.size;
      problem.evaluate(x, std::span(cost).first(asked), std::span(violation).first(asked));
      optimiser->tell(std::span(cost).first(asked), std::span(violation).first(asked));
    }
    const auto restored = make_optimiser(problem.variables, CmaEsOptions{.population = 8}, {});
    ASSERT_TRUE(restored->restore(optimiser->state()));
    EXPECT_EQ(restored->ask().size, 0u);
    EXPECT_EQ(restored->best_cost(), report.cost);
  }
}

TEST(CmaEs, GoesOnAtABoundWhereAllCandidatesMayCoincide) {
  // One variable, the start at the bound: half of the steps lead out of the box and are moved back.
  const Problem problem = test::make_problem(
      1, 0, 1, [](std::span<const double> x) { return test::Value{x[0] < 0.9 ? x[0] : x[0] - 2}; });
  int reached = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) reached += run(problem, 100, seed, 5).cost < 0;
  EXPECT_GE(reached, 10);
}

TEST(CmaEs, ThinAndHugeRangesAreSearchedAlike) {
  // The unit box is what it works in.
  std::vector<double> costs;
  for (const double scale : {1e-12, 1.0, 1e12, 8e307}) {
    const Problem problem = test::make_problem(3, -scale, 2 * scale, [scale](std::span<const double> x) {
      double sum = 0;
      for (const double v : x) sum += (v / scale) * (v / scale);
      return test::Value{sum};
    });
    costs.push_back(run(problem, 60).cost);
  }
  for (const double cost : costs) EXPECT_LT(cost, 1e-6);
}

TEST(CmaEs, PopulationFollowsTheNumberOfVariables) {
  const auto population = [](std::size_t n) {
    return make_optimiser(test::sphere(n).variables, CmaEsOptions{}, {})->population();
  };
  EXPECT_EQ(population(1), 5u);
  EXPECT_EQ(population(2), 6u);
  EXPECT_EQ(population(10), 10u);  // Hansen 2016, Table 1: 4 + floor(3 ln 10)
}

TEST(CmaEs, SaysWhichOptionIsOutOfRange) {
  const auto with = [](const CmaEsOptions& options) {
    return message([&] { make_optimiser(test::sphere(2).variables, options, {}); });
  };
  EXPECT_THAT(with({.population = 4}), HasSubstr("cma_es: population must be 0 or at least 5, got 4"));
  EXPECT_THAT(with({.generations = 0}), HasSubstr("cma_es: generations must be at least 1, got 0"));
  EXPECT_THAT(with({.initial_step = 0}), HasSubstr("cma_es: initial_step must be more than 0, got 0"));
}

}  // namespace
}  // namespace linkwright::optimise
