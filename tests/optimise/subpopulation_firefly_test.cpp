// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/subpopulation_firefly.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "optimise/functions.h"
#include "optimise/swarms.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

OptimiserOptions parts(const FireflyMove& move) {
  return {.method = Method::subpopulation_firefly,
          .subpopulation_firefly = {.generations = 101, .move = move}};
}

TEST(SubpopulationFirefly, EndsWhereOthersDo) {
  test::expect_as_listed(test::sphere10(), parts({}), {1.913e-7, 54160});
  test::expect_as_listed(test::sphere10(), parts(yang_attraction), {1.457e-7, 52334});
  test::expect_as_listed(test::rosenbrock5(), parts({}), {0.7786, 51722});
  test::expect_as_listed(test::rosenbrock5(), parts(yang_attraction), {0.04422, 50736});
}

TEST(SubpopulationFirefly, FliesUntilFeasibleButNotForEver) {
  // Everything violates: all fireflies make all their flights, five rounds of eight, then moves.
  const Problem never = test::make_problem(2, 0, 1, [](std::span<const double> x) {
    return test::Value{HUGE_VAL, 1 + x[0]};
  });
  const SubpopulationFireflyOptions options = {.population = 8, .flights = 5};
  const auto stuck = make_optimiser(never.variables, options, {});
  std::vector<std::size_t> sizes;
  test::play(never, *stuck, 2, [&](const PopulationView& x, auto, auto) { sizes.push_back(x.size); });
  ASSERT_GT(sizes.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(sizes[k], 8u);
  for (std::size_t k = 6; k < sizes.size(); ++k) EXPECT_EQ(sizes[k], 1u);

  // Feasible everywhere: one flight each.
  const Problem always = test::sphere(2);
  const auto free = make_optimiser(always.variables, options, {});
  sizes.clear();
  test::play(always, *free, 2, [&](const PopulationView& x, auto, auto) { sizes.push_back(x.size); });
  EXPECT_EQ(sizes[1], 8u);
  EXPECT_EQ(sizes[2], 1u);

  // In between: a next round has those whose last flight violated, as many.
  const Problem half = test::make_problem(2, 0, 1, [](std::span<const double> x) {
    return x[0] < 0.5 ? test::Value{x[1]} : test::Value{HUGE_VAL, x[0]};
  });
  const auto some = make_optimiser(half.variables, options, {});
  test::play(half, *some, 1, [](auto&&...) {});
  std::size_t expected = 8;
  int round = 0;
  test::play(half, *some, 2, [&](const PopulationView& x, auto, auto violation) {
    if (++round > 5 || expected == 0) return;
    EXPECT_EQ(x.size, expected);
    expected = 0;
    for (const double v : violation) expected += v > 0;
  });
  EXPECT_GT(round, 2);
}

TEST(SubpopulationFirefly, PartsAreSweptByThemselvesAndExchangeTheirBest) {
  // Two fireflies are two parts of one: no moves, flights only.
  const Problem problem = test::sphere(2);
  const auto pair = make_optimiser(problem.variables, SubpopulationFireflyOptions{.population = 2}, {});
  test::play(problem, *pair, 30, [](const PopulationView& x, auto, auto) { EXPECT_EQ(x.size, 2u); });
  // Three are one and two: a single move, in every generation.
  const auto three = make_optimiser(problem.variables, SubpopulationFireflyOptions{.population = 3}, {});
  int moves = 0;
  test::play(problem, *three, 31, [&](const PopulationView& x, auto, auto) { moves += x.size == 1; });
  EXPECT_GE(moves, 30);
  EXPECT_LE(moves, 60);  // a firefly that a move made brighter may be moved towards at once
}

TEST(SubpopulationFirefly, ConstraintsComeFirst) {
  const SeedStatistics crescent = test::swarms(test::g06(), parts(yang_attraction)).statistics;
  EXPECT_EQ(crescent.feasible, 20);
  EXPECT_LT(crescent.median, -6900);  // best known -6961.8
}

TEST(SubpopulationFirefly, SaysWhichOptionIsOutOfRange) {
  const Problem problem = test::sphere(2);
  const auto with = [&](const SubpopulationFireflyOptions& o) {
    return message([&] { make_optimiser(problem.variables, o, {}); });
  };
  EXPECT_THAT(with({.population = 1}),
              HasSubstr("subpopulation_firefly: population must be at least 2, got 1"));
  EXPECT_THAT(with({.flights = 0}), HasSubstr("subpopulation_firefly: flights must be at least 1, got 0"));
}

TEST(SubpopulationFirefly, SeveralObjectivesRankByTheMeanRelativeToTheBest) {
  // One member has the costs of the best so far, (1, 1000), and ranks first although the plain means of the
  // others are less: (10, 10) and the one dominated by it, (11, 11). A part of two and a part of one exchange
  // their best, so these two come together in two splits of three, and the worse moves towards the better.
  // No other pair has a move, and with plain means they would never come together.
  const Problem problem = test::schaffer(1);
  const auto optimiser =
      make_optimiser(problem.variables, SubpopulationFireflyOptions{.population = 3}, {}, 2);
  optimiser->start_from(std::vector<double>{0}, std::vector<double>{1, 1000});
  optimiser->ask();
  optimiser->tell(std::vector<double>{10, 10, 1, 1000, 11, 11}, std::vector<double>(3));
  int moves = 0;
  while (optimiser->generation() < 61) {
    const bool moved = optimiser->ask().size == 1;  // or else three flights, which come to nothing
    moves += moved;
    optimiser->tell(std::vector<double>(moved ? 2 : 6, moved ? 11 : 1e9), std::vector<double>(moved ? 1 : 3));
  }
  EXPECT_NEAR(moves, 40, 15);  // four standard deviations of 60 splits
}

}  // namespace
}  // namespace linkwright::optimise
