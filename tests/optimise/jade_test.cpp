// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/jade.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linkwright/optimise/statistics.h"
#include "optimise/functions.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

SeedStatistics run_jade(const Problem& problem, const JadeOptions& jade, double threshold, int seeds = 20) {
  const OptimiserOptions method = {.method = Method::jade, .jade = jade};
  MinimiseOptions options;
  options.stop.target_cost = threshold;
  RunContext context;
  return minimise_seeds(problem, method, options, {1, seeds}, threshold, context).statistics;
}

TEST(Jade, FindsTheKnownOptima) {
  // Budgets are about twice what the slowest of the twenty seeds needs.
  for (const bool archive : {true, false}) {
    const auto successes = [&](const Problem& problem, int generations, double threshold) {
      return run_jade(problem, {.generations = generations, .archive = archive}, threshold).successes;
    };
    EXPECT_EQ(successes(test::sphere(10), 300, 1e-10), 20);
    EXPECT_EQ(successes(test::rosenbrock(5), 500, 1e-8), 20);
    if (!archive) continue;  // nothing new in what follows
    EXPECT_EQ(successes(test::ackley(10), 400, 1e-8), 20);
    EXPECT_EQ(successes(test::rastrigin(10), 800, 1e-8), 20);
    EXPECT_EQ(successes(test::g06(), 300, -6961.8138), 20);
  }
}

/// Zhang and Sanderson 2009, Table IV: the sphere of 30 variables in +-100, 1500 generations of 100, ends at
/// 1.3e-54 with and 1.8e-60 without the archive, means of 50 runs.
TEST(Jade, ReachesThePublishedPrecision) {
  const Problem f1 = test::make_problem(30, -100, 100, [](std::span<const double> x) {
    double sum = 0;
    for (const double v : x) sum += v * v;
    return test::Value{sum};
  });
  // Single runs scatter over ten orders of magnitude, and the worst of 50 makes the printed mean.
  const double with = run_jade(f1, {}, 0, 2).worst, without = run_jade(f1, {.archive = false}, 0, 2).worst;
  EXPECT_LT(with, 1e-52);
  EXPECT_GT(with, 1e-70);
  EXPECT_LT(without, 1e-57);
  EXPECT_GT(without, 1e-70);
}

TEST(Jade, MembersNeverGetWorse) {
  const Problem problem = test::rastrigin(3);
  const auto optimiser = make_optimiser(problem.variables, JadeOptions{.population = 15}, {});
  std::vector<double> cost(15), violation(15), last(15, HUGE_VAL), now(15);
  for (int generation = 0; generation < 30; ++generation) {
    problem.evaluate(optimiser->ask(), cost, violation);
    optimiser->tell(cost, violation);
    problem.evaluate(optimiser->members(), now, violation);
    for (std::size_t i = 0; i < 15; ++i) {
      EXPECT_EQ(now[i], std::min(last[i], cost[i]));
      last[i] = now[i];
    }
  }
}

TEST(Jade, OnlyBetterTrialsReplaceTheirTargets) {
  // Members stay those of the first generation if all costs are the same.
  const std::vector<Variable> variables = {{"x", 0, 1}, {"y", 0, 1}};
  const auto optimiser = make_optimiser(variables, JadeOptions{.population = 8}, {});
  const std::vector<double> zero(8, 0.0);
  std::vector<double> first;
  for (int generation = 0; generation < 5; ++generation) {
    const PopulationView x = optimiser->ask();
    if (generation == 0) first.assign(x.row(0), x.row(0) + 8);
    optimiser->tell(zero, zero);
    EXPECT_TRUE(std::equal(first.begin(), first.end(), optimiser->members().row(0))) << generation;
  }
}

TEST(Jade, SaysWhichOptionIsOutOfRange) {
  const Problem problem = test::sphere(2);
  const auto with = [&](const JadeOptions& o) {
    return message([&] { make_optimiser(problem.variables, o, {}); });
  };
  EXPECT_THAT(with({.population = 3}), HasSubstr("jade: population must be at least 4, got 3"));
  EXPECT_THAT(with({.best_share = 0}), HasSubstr("jade: best_share must be more than 0, got 0"));
  EXPECT_THAT(with({.adaptation = 1.5}), HasSubstr("jade: adaptation must be at most 1, got 1.5"));
}

}  // namespace
}  // namespace linkwright::optimise
