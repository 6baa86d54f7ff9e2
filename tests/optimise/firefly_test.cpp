// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/firefly.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "optimise/functions.h"
#include "optimise/swarms.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

OptimiserOptions fireflies(const FireflyMove& move) {
  return {.method = Method::firefly, .firefly = {.generations = 101, .move = move}};
}

TEST(Firefly, EndsWhereOthersDo) {
  test::expect_as_listed(test::sphere10(), fireflies({}), {1.593e-7, 74730});
  test::expect_as_listed(test::sphere10(), fireflies(yang_attraction), {1.088e-7, 71614});
  test::expect_as_listed(test::rosenbrock5(), fireflies({}), {0.3889, 72644});
  test::expect_as_listed(test::rosenbrock5(), fireflies(yang_attraction), {0.02071, 69945});
}

TEST(Firefly, MovesAreThoseOfTheEquationOneAfterTheOther) {
  // Without randomness every move can be followed: Eq. (2.133) in the unit cube, boxes of width 2 and 4.
  Problem problem = test::make_problem(2, -1, 1, [](std::span<const double> x) {
    return test::Value{std::pow(x[0] - 0.3, 2) + std::pow(x[1] - 1, 2)};
  });
  problem.variables[1].upper = 3;
  const FireflyOptions options = {
      .population = 4,
      .move = {.randomness = 0, .absorption = 2, .attraction = 0.7, .attraction_least = 0.1}};
  const auto optimiser = make_optimiser(problem.variables, options, {.seed = 5});
  std::array<std::array<double, 2>, 4> x;
  std::array<double, 4> f;
  test::play(problem, *optimiser, 1, [&](const PopulationView& first, auto cost, auto) {
    for (std::size_t i = 0; i < 4; ++i) {
      x[i] = {first(0, i), first(1, i)};
      f[i] = cost[i];
    }
  });
  std::vector<std::array<double, 2>> asked;
  test::play(problem, *optimiser, 4, [&](const PopulationView& candidates, auto, auto) {
    ASSERT_EQ(candidates.size, 1u);
    asked.push_back({candidates(0, 0), candidates(1, 0)});
  });
  std::size_t moves = 0;
  for (int t = 0; t < 3; ++t)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        if (!(f[j] < f[i])) continue;
        const double square = std::pow((x[j][0] - x[i][0]) / 2, 2) + std::pow((x[j][1] - x[i][1]) / 4, 2);
        const double beta = 0.1 + 0.6 * std::exp(-2 * square);
        for (std::size_t k = 0; k < 2; ++k) x[i][k] += beta * (x[j][k] - x[i][k]);
        f[i] = std::pow(x[i][0] - 0.3, 2) + std::pow(x[i][1] - 1, 2);
        ASSERT_LT(moves, asked.size());
        // Roundings only.
        EXPECT_NEAR(asked[moves][0], x[i][0], 1e-13);
        EXPECT_NEAR(asked[moves][1], x[i][1], 1e-13);
        ++moves;
      }
  EXPECT_EQ(moves, asked.size());
  EXPECT_GE(moves, 6u);
}

TEST(Firefly, RandomnessDecaysOverTheGenerations) {
  // Without attraction a move is alpha_t (rho - 1/2) of the width, here 8.
  const Problem problem = test::sphere(3);
  const FireflyOptions options = {
      .population = 10, .generations = 11, .move = {.randomness = 0.4, .attraction = 0}};
  const auto optimiser = make_optimiser(problem.variables, options, {});
  for (int t = -1; t < 10; ++t) {
    const double alpha = 0.4 * std::pow(1e-4 / 0.9, t / 10.0);
    double longest = 0;
    test::play(problem, *optimiser, optimiser->generation() + 1, [&](const PopulationView& x, auto, auto) {
      if (t < 0) return;
      // The firefly that moved is the one nearest to where it came to.
      double least = HUGE_VAL;
      for (std::size_t i = 0; i < 10; ++i) {
        double most = 0;
        for (std::size_t j = 0; j < 3; ++j)
          most = std::max(most, std::abs(x(j, 0) - optimiser->members()(j, i)));
        least = std::min(least, most);
      }
      longest = std::max(longest, least / 8);
    });
    if (t < 0) continue;
    EXPECT_LE(longest, alpha / 2 * (1 + 1e-12)) << t;
    // One of some 45 moves comes near that; the first generations, in which clipping matters, aside.
    EXPECT_GE(longest, t > 2 ? alpha / 2 * 0.8 : 0) << t;
  }
}

TEST(Firefly, TheBrightestStays) {
  const Problem problem = test::rastrigin(4);
  const auto optimiser = make_optimiser(problem.variables, FireflyOptions{.population = 12}, {});
  for (std::uint32_t generation = 1; generation < 30; ++generation) {
    test::play(problem, *optimiser, generation, [](auto&&...) {});
    double least = HUGE_VAL;
    std::vector<double> cost(12), violation(12);
    problem.evaluate(optimiser->members(), cost, violation);
    for (const double c : cost) least = std::min(least, c);
    EXPECT_EQ(least, optimiser->best_cost());
  }
}

TEST(Firefly, ConstraintsComeFirst) {
  const SeedStatistics crescent = test::swarms(test::g06(), fireflies(yang_attraction)).statistics;
  EXPECT_EQ(crescent.feasible, 20);
  EXPECT_LT(crescent.median, -6900);  // best known -6961.8; worst feasible value above 0
}

TEST(Firefly, SaysWhichOptionIsOutOfRange) {
  const Problem problem = test::sphere(2);
  const auto with = [&](const FireflyOptions& o) {
    return message([&] { make_optimiser(problem.variables, o, {}); });
  };
  EXPECT_THAT(with({.population = 1}), HasSubstr("firefly: population must be at least 2, got 1"));
  EXPECT_THAT(with({.generations = 0}), HasSubstr("firefly: generations must be at least 1, got 0"));
  EXPECT_THAT(with({.move = {.randomness = -1}}),
              HasSubstr("firefly: randomness must be at least 0, got -1"));
  EXPECT_THAT(with({.move = {.attraction = 3}}), HasSubstr("firefly: attraction must be at most 2, got 3"));
}

}  // namespace
}  // namespace linkwright::optimise
