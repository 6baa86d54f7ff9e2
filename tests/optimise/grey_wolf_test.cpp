// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/grey_wolf.h"

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

SeedsReport run_wolves(const Problem& problem, const GreyWolfOptions& wolves, int seeds, double threshold) {
  OptimiserOptions method = {.method = Method::grey_wolf, .grey_wolf = wolves};
  RunContext context;
  return minimise_seeds(problem, method, {}, {1, seeds}, threshold, context);
}

TEST(GreyWolf, DefaultsAreThePublishedSetting) {
  const auto report = run_wolves(test::sphere(3), {}, 1, 1);
  EXPECT_EQ(report.reports[0].evaluations, 1500);
  EXPECT_EQ(report.reports[0].generations, 50);
}

TEST(GreyWolf, FindsTheKnownOptima) {
  EXPECT_EQ(run_wolves(test::sphere(10), {.generations = 500}, 20, 1e-10).statistics.successes, 20);
  EXPECT_EQ(run_wolves(test::ackley(10), {.generations = 500}, 20, 1e-8).statistics.successes, 20);
  // Towards the origin it goes by itself; (1, 1) is another matter.
  EXPECT_GE(run_wolves(test::rosenbrock(2), {.generations = 500}, 20, 1e-3).statistics.successes, 18);
  // A thin crescent of feasible points: most packs find it, few its tip.
  const SeedStatistics crescent = run_wolves(test::g06(), {.generations = 500}, 20, -6900).statistics;
  EXPECT_GE(crescent.feasible, 15);
  EXPECT_GE(crescent.successes, 3);
}

TEST(GreyWolf, ThePrintedAbsoluteValueCannotReachNegativeCoordinates) {
  // Minimum 0 at (-2, -2).
  const Problem problem = test::make_problem(2, -5, 3, [](std::span<const double> x) {
    return test::Value{std::pow(x[0] + 2, 2) + std::pow(x[1] + 2, 2)};
  });
  EXPECT_LT(run_wolves(problem, {}, 20, 1e-2).statistics.worst, 1e-2);
  const auto printed = run_wolves(problem, {.absolute_value = true}, 20, 1e-2);
  EXPECT_EQ(printed.statistics.successes, 0);
  // After the first, uniform generation every coordinate is 0 or more.
  const auto optimiser = make_optimiser(problem.variables, GreyWolfOptions{.absolute_value = true}, {});
  std::vector<double> cost(30), violation(30);
  for (int generation = 0; generation < 5; ++generation) {
    const PopulationView x = optimiser->ask();
    const double least = *std::min_element(x.row(0), x.row(0) + 30);
    EXPECT_EQ(least >= 0, generation > 0);
    problem.evaluate(x, cost, violation);
    optimiser->tell(cost, violation);
  }
}

TEST(GreyWolf, WithoutReachThePackStandsAtTheMeanOfTheLeaders) {
  // After the schedule a = 0: every wolf goes to (alpha + beta + delta) / 3, the three best positions ever
  // seen.
  const Problem problem = test::rastrigin(2);
  const auto optimiser =
      make_optimiser(problem.variables, GreyWolfOptions{.population = 5, .generations = 1}, {});
  std::vector<std::pair<double, std::array<double, 2>>> seen;
  std::vector<double> cost(5), violation(5);
  for (int generation = 0; generation < 4; ++generation) {
    const PopulationView x = optimiser->ask();
    if (generation >= 2) {
      std::stable_sort(seen.begin(), seen.end(),
                       [](const auto& a, const auto& b) { return a.first < b.first; });
      for (std::size_t j = 0; j < 2; ++j) {
        const double mean = (seen[0].second[j] + seen[1].second[j] + seen[2].second[j]) / 3;
        for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(x(j, i), mean) << generation;
      }
    }
    problem.evaluate(x, cost, violation);
    for (std::size_t i = 0; i < 5; ++i) seen.push_back({cost[i], {x(0, i), x(1, i)}});
    optimiser->tell(cost, violation);
  }
}

TEST(GreyWolf, TheWorseHalfIsPlacedAnewOnlyWhenAsked) {
  const Problem problem = test::rastrigin(4);
  const auto plain = run_wolves(problem, {}, 5, 0),
             reset = run_wolves(problem, {.reset_worst_half = true}, 5, 0);
  EXPECT_NE(plain.reports[0].cost, reset.reports[0].cost);
  EXPECT_LT(reset.statistics.median,
            30);  // it still searches: a uniform sample of 1500 has a median best near 25 to 35
}

TEST(GreyWolf, SaysWhichOptionIsOutOfRange) {
  const Problem problem = test::sphere(2);
  const auto with = [&](const GreyWolfOptions& o) {
    return message([&] { make_optimiser(problem.variables, o, {}); });
  };
  EXPECT_THAT(with({.population = 2}), HasSubstr("grey_wolf: population must be at least 3, got 2"));
  EXPECT_THAT(with({.generations = 0}), HasSubstr("grey_wolf: generations must be at least 1, got 0"));
}

}  // namespace
}  // namespace linkwright::optimise
