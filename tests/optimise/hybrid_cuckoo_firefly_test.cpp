// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/hybrid_cuckoo_firefly.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "optimise/functions.h"
#include "optimise/swarms.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

OptimiserOptions hybrid(const FireflyMove& move) {
  return {.method = Method::hybrid_cuckoo_firefly,
          .hybrid_cuckoo_firefly = {.generations = 101, .move = move}};
}

TEST(HybridCuckooFirefly, EndsWhereOthersDo) {
  test::expect_as_listed(test::sphere10(), hybrid({}), {1.993e-7, 31853});
  test::expect_as_listed(test::sphere10(), hybrid(yang_attraction), {1.475e-7, 31304});
  test::expect_as_listed(test::rosenbrock5(), hybrid({}), {0.9199, 31876});
  test::expect_as_listed(test::rosenbrock5(), hybrid(yang_attraction), {0.07358, 30492});
}

TEST(HybridCuckooFirefly, SweepsTheWorstNestsWhenAsked) {
  const Problem problem = test::sphere(3);
  const HybridCuckooFireflyOptions options = {.population = 10, .swept = 0.25};
  const auto optimiser = make_optimiser(problem.variables, options, {});
  EXPECT_EQ(optimiser->largest_generation(), 10u + 3 * 2);
  for (std::uint32_t generation = 1; generation < 30; ++generation) {
    test::play(problem, *optimiser, generation, [](auto&&...) {});
    int round = 0;
    std::vector<double> before(10), after(10), violation(10);
    // Members as the flights left them: seen in the round of the first move.
    test::play(problem, *optimiser, generation + 1, [&](const PopulationView&, auto, auto) {
      if (++round == 11) problem.evaluate(optimiser->members(), before, violation);
    });
    ASSERT_GT(round, 10);
    problem.evaluate(optimiser->members(), after, violation);
    std::vector<double> sorted = before;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < 10; ++i) EXPECT_TRUE(before[i] >= sorted[7] || after[i] == before[i]) << i;
  }
}

TEST(HybridCuckooFirefly, ConstraintsComeFirst) {
  const SeedStatistics crescent = test::swarms(test::g06(), hybrid(yang_attraction)).statistics;
  EXPECT_EQ(crescent.feasible, 20);
  EXPECT_LT(crescent.median, -6900);  // best known -6961.8
}

TEST(HybridCuckooFirefly, SaysWhichOptionIsOutOfRange) {
  const Problem problem = test::sphere(2);
  const auto with = [&](const HybridCuckooFireflyOptions& o) {
    return message([&] { make_optimiser(problem.variables, o, {}); });
  };
  EXPECT_THAT(with({.population = 1}),
              HasSubstr("hybrid_cuckoo_firefly: population must be at least 2, got 1"));
  EXPECT_THAT(with({.swept = 0}), HasSubstr("hybrid_cuckoo_firefly: swept must be more than 0, got 0"));
  EXPECT_THAT(with({.flight = {.exponent = 0.1}}), HasSubstr("levy_exponent must be at least 0.3, got 0.1"));
}

TEST(HybridCuckooFirefly, SeveralObjectivesRankNestsByTheMeanRelativeToTheBest) {
  // The nest with the costs of the best so far, (1, 1000), is not among the two worst, although plain means
  // would have it last: the two others are swept, and one moves towards the other.
  const Problem problem = test::schaffer(1);
  const auto optimiser =
      make_optimiser(problem.variables, HybridCuckooFireflyOptions{.population = 3, .swept = 0.5}, {}, 2);
  optimiser->start_from(std::vector<double>{0}, std::vector<double>{1, 1000});
  optimiser->ask();
  optimiser->tell(std::vector<double>{10, 10, 1, 1000, 11, 11}, std::vector<double>(3));
  for (std::uint32_t generation = 1; generation < 10; ++generation) {
    int rounds = 0;
    for (; optimiser->generation() == generation; ++rounds) {
      optimiser->ask();
      optimiser->tell(std::vector<double>(2, rounds < 3 ? 1e9 : 11), std::vector<double>(1));
    }
    EXPECT_EQ(rounds, 4);  // three flights that come to nothing, and the move
  }
}

}  // namespace
}  // namespace linkwright::optimise
