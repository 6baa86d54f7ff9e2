// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/particle_swarm.h"

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

SeedStatistics run(const Problem& problem, const ParticleSwarmOptions& swarm, double threshold) {
  const OptimiserOptions method = {.method = Method::particle_swarm, .particle_swarm = swarm};
  RunContext context;
  return minimise_seeds(problem, method, {}, {1, 20}, threshold, context).statistics;
}

TEST(ParticleSwarm, FindsTheKnownOptima) {
  for (const SwarmBounds bounds : {SwarmBounds::clip, SwarmBounds::reflect}) {
    const ParticleSwarmOptions swarm = {.bounds = bounds};
    EXPECT_EQ(run(test::sphere(10), swarm, 1e-10).successes, 20);
    EXPECT_EQ(run(test::ackley(5), swarm, 1e-8).successes, 20);
    EXPECT_EQ(run(test::rosenbrock(2), swarm, 1e-6).successes, 20);
    // A thin crescent of feasible points: every swarm finds it, most come near its tip.
    EXPECT_GE(run(test::g06(), swarm, -6950).successes, 14);
    // Many separate minima hold some swarms.
    EXPECT_GE(run(test::rastrigin(5), swarm, 1e-8).successes, 12);
  }
}

/// The published step written again, one particle at a time, from the costs alone.
TEST(ParticleSwarm, MovesAsPublished) {
  const Problem problem = test::rastrigin(3);
  const ParticleSwarmOptions options = {
      .population = 6, .generations = 11, .inertia_start = 0.8, .inertia_end = 0.3};
  const auto optimiser = make_optimiser(problem.variables, options, {.seed = 5});
  // Range 9.12, limit 0.2 of it.
  const double limit = 0.2 * 9.12;
  std::vector<double> cost(6), violation(6), own_cost(6, HUGE_VAL);
  std::vector<std::array<double, 3>> last(6), own(6), velocity(6);
  std::array<double, 3> best{};
  double best_cost = HUGE_VAL;
  int free_moves = 0;
  for (int i = 0; i < 11; ++i) {
    const PopulationView x = optimiser->ask();
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t j = 0; j < 3; ++j) {
        const double moved = x(j, k) - last[k][j];
        if (i > 0) {
          EXPECT_LE(std::abs(moved), limit * (1 + 1e-12));
        }
        const bool at_bound = x(j, k) == -4 || x(j, k) == 5.12;
        if (i > 1 && !at_bound && std::abs(moved) < limit * (1 - 1e-12)) {
          // v = rho v + 2 r1 (own - x) + 2 r2 (best - x) for some r1, r2 in [0, 1).
          const double kept = (0.8 - 0.5 * i / 10) * velocity[k][j];
          const double to_own = 2 * (own[k][j] - last[k][j]), to_best = 2 * (best[j] - last[k][j]);
          EXPECT_GE(moved, kept + std::min(to_own, 0.0) + std::min(to_best, 0.0) - 1e-12);
          EXPECT_LE(moved, kept + std::max(to_own, 0.0) + std::max(to_best, 0.0) + 1e-12);
          // The best particle of all is drawn nowhere: its inertia alone moves it.
          if (own_cost[k] == best_cost && last[k] == best) {
            EXPECT_NEAR(moved, kept, 1e-12);
            ++free_moves;
          }
        }
        velocity[k][j] = at_bound && i > 0 ? 0 : moved;
        last[k][j] = x(j, k);
      }
    problem.evaluate(x, cost, violation);
    for (std::size_t k = 0; k < 6; ++k) {
      if (cost[k] < own_cost[k]) {
        own_cost[k] = cost[k];
        own[k] = last[k];
      }
      if (cost[k] < best_cost) {
        best_cost = cost[k];
        best = last[k];
      }
    }
    optimiser->tell(cost, violation);
  }
  EXPECT_GE(free_moves, 3);
}

TEST(ParticleSwarm, ClippedParticlesStopAndReflectedOnesTurnBack) {
  // The cost falls towards both upper bounds, so that the swarm runs into the corner.
  const std::vector<Variable> variables = {{"x", 0, 1}, {"y", 0, 1}};
  for (const SwarmBounds bounds : {SwarmBounds::clip, SwarmBounds::reflect}) {
    const auto optimiser = make_optimiser(variables, ParticleSwarmOptions{.bounds = bounds}, {});
    std::vector<double> cost(40), violation(40);
    int at_bound = 0;
    for (int generation = 0; generation < 30; ++generation) {
      const PopulationView x = optimiser->ask();
      for (std::size_t i = 0; i < 40; ++i) {
        at_bound += x(0, i) == 1;
        cost[i] = -x(0, i) - x(1, i);
      }
      optimiser->tell(cost, violation);
    }
    if (bounds == SwarmBounds::clip)
      EXPECT_GT(at_bound, 100);
    else
      EXPECT_EQ(at_bound, 0);
    EXPECT_LT(optimiser->best_cost(), -1.99);
  }
}

TEST(ParticleSwarm, StopsWhenTheSwarmIsSmall) {
  const Problem problem = test::sphere(3);
  const OptimiserOptions method = {.method = Method::particle_swarm};
  MinimiseOptions options;
  options.stop.diameter = 1e-3;
  RunContext context;
  const auto optimiser = make_optimiser(problem.variables, method, {});
  const Report report = minimise(problem, *optimiser, 500, "swarm", options, context);
  EXPECT_EQ(report.stop_reason, "no two members more than 0.001 apart");
  EXPECT_LT(report.generations, 500);
  double diameter = 0;
  const PopulationView x = optimiser->members();
  for (std::size_t a = 0; a < 40; ++a)
    for (std::size_t b = 0; b < a; ++b)
      diameter = std::max(diameter, std::hypot(x(0, a) - x(0, b), x(1, a) - x(1, b), x(2, a) - x(2, b)));
  EXPECT_LE(diameter, 1e-3);
  // Not before: the run that ends one generation earlier is wider.
  const auto earlier = make_optimiser(problem.variables, method, {});
  const Report before = minimise(problem, *earlier, report.generations - 1, "swarm", options, context);
  EXPECT_EQ(before.stop_reason, std::to_string(report.generations - 1) + " generations");
}

TEST(ParticleSwarm, SaysWhichOptionIsOutOfRange) {
  const Problem problem = test::sphere(2);
  const auto with = [&](const ParticleSwarmOptions& o) {
    return message([&] { make_optimiser(problem.variables, o, {}); });
  };
  EXPECT_THAT(with({.population = 0}), HasSubstr("particle_swarm: population must be at least 1, got 0"));
  EXPECT_THAT(with({.own_attraction = -1}),
              HasSubstr("particle_swarm: own_attraction must be at least 0, got -1"));
  EXPECT_THAT(with({.inertia_end = 2.5}),
              HasSubstr("particle_swarm: inertia_end must be at most 2, got 2.5"));
  EXPECT_THAT(with({.velocity_limit = 0}),
              HasSubstr("particle_swarm: velocity_limit must be more than 0, got 0"));
}

}  // namespace
}  // namespace linkwright::optimise
