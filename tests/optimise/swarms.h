// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include "linkwright/optimise/statistics.h"
#include "optimise/functions.h"

/// The test functions and settings with which fireflies and cuckoos were measured: T = 100 iterations, 20
/// seeds.
namespace linkwright::test {}
namespace linkwright::optimise::test {
using namespace linkwright::test;  // shared by the tests of all modules

inline Problem sphere10() {
  return make_problem(10, 0, 1, [](std::span<const double> u) {
    double sum = 0;
    for (const double v : u) sum += (10 * v - 4) * (10 * v - 4);
    return Value{sum};
  });
}

inline Problem rosenbrock5() {
  Problem problem = rosenbrock(5);
  for (Variable& v : problem.variables) {
    v.lower = -5;
    v.upper = 5;
  }
  return problem;
}

/// Figures over 20 seeds of another program, in another language and with other random numbers: quantile 0.9
/// of the final costs, evaluations of a run. From tests/published/planar-dynamics-balancing.json,
/// "algorithm-statistics".
struct Listed {
  double quantile90 = 0;
  double evaluations = 0;
};

inline SeedsReport swarms(const Problem& problem, const OptimiserOptions& method, int seeds = 20) {
  MinimiseOptions options;
  options.log = options.progress = false;
  RunContext context;
  return minimise_seeds(problem, method, options, {1, seeds}, 0, context);
}

/// The median of so few seeds scatters, and the tails are long: within three times the listed quantile 0.9.
/// Evaluations depend on how many moves there are and come to the same within 4 %.
inline void expect_as_listed(const Problem& problem, const OptimiserOptions& method, const Listed& listed) {
  const SeedStatistics statistics = swarms(problem, method).statistics;
  EXPECT_EQ(statistics.feasible, 20);
  EXPECT_LE(statistics.median, 3 * listed.quantile90);
  EXPECT_NEAR(static_cast<double>(statistics.evaluations) / 20, listed.evaluations,
              0.04 * listed.evaluations);
}

/// Plays the rounds of an optimiser up to and including the generation with the given number; calls
/// each(candidates, costs) after the evaluation of each round.
template <class Each>
void play(const Problem& problem, Optimiser& optimiser, std::uint32_t generations, Each&& each) {
  std::vector<double> cost(optimiser.population() * problem.objectives), violation(optimiser.population());
  while (optimiser.generation() < generations) {
    const PopulationView x = optimiser.ask();
    const std::span<double> costs(cost.data(), x.size * problem.objectives),
        violations(violation.data(), x.size);
    problem.evaluate(x, costs, violations);
    each(x, costs, violations);
    optimiser.tell(costs, violations);
  }
}

}  // namespace linkwright::optimise::test
