// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/self_adaptive_differential_evolution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/optimise/statistics.h"
#include "optimise/functions.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

const OptimiserOptions jde = {.method = Method::self_adaptive_differential_evolution};

int successes(const Problem& problem, int generations, double threshold) {
  MinimiseOptions options;
  options.stop.generations = generations;
  options.stop.target_cost = threshold;
  RunContext context;
  return minimise_seeds(problem, jde, options, {1, 20}, threshold, context).statistics.successes;
}

TEST(SelfAdaptiveDifferentialEvolution, FindsTheKnownOptima) {
  // Budgets are about twice what the slowest of the twenty seeds needs.
  EXPECT_EQ(successes(test::sphere(10), 400, 1e-10), 20);
  EXPECT_EQ(successes(test::rosenbrock(5), 1500, 1e-8), 20);
  EXPECT_EQ(successes(test::ackley(10), 700, 1e-8), 20);
  EXPECT_EQ(successes(test::rastrigin(10), 1000, 1e-8), 20);
  EXPECT_EQ(successes(test::g06(), 500, -6961.8138), 20);
}

TEST(SelfAdaptiveDifferentialEvolution, WithoutAdaptationItIsDifferentialEvolutionWithLaterWords) {
  // Same first generation and the same choice of members; only the words that decide about crossing differ,
  // and they do not matter when every variable is crossed.
  const Problem problem = test::rastrigin(4);
  SelfAdaptiveDifferentialEvolutionOptions options = {.population = 20};
  options.scale_start = 0.6;
  options.scale_rate = options.crossover_rate = 0;
  options.crossover_start = 1;
  const auto a = make_optimiser(problem.variables, options, {.seed = 4});
  const auto b = make_optimiser(problem.variables,
                                DifferentialEvolutionOptions{.population = 20, .scale = 0.6, .crossover = 1},
                                {.seed = 4});
  std::vector<double> cost(20), violation(20);
  for (int generation = 0; generation < 20; ++generation) {
    const PopulationView x = a->ask(), y = b->ask();
    for (std::size_t i = 0; i < 20; ++i)
      for (std::size_t j = 0; j < 4; ++j) ASSERT_EQ(x(j, i), y(j, i)) << generation;
    problem.evaluate(x, cost, violation);
    a->tell(cost, violation);
    b->tell(cost, violation);
  }
}

TEST(SelfAdaptiveDifferentialEvolution, SaysWhichOptionIsOutOfRange) {
  const Problem problem = test::sphere(2);
  const auto with = [&](const SelfAdaptiveDifferentialEvolutionOptions& o) {
    return message([&] { make_optimiser(problem.variables, o, {}); });
  };
  EXPECT_THAT(with({.population = 3}),
              HasSubstr("self_adaptive_differential_evolution: population must be at least 4, got 3"));
  EXPECT_THAT(with({.scale_rate = -0.1}), HasSubstr("scale_rate must be at least 0, got -0.1"));
  EXPECT_THAT(with({.crossover_rate = 2}), HasSubstr("crossover_rate must be at most 1, got 2"));
}

}  // namespace
}  // namespace linkwright::optimise
