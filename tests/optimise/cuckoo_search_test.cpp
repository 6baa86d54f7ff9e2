// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/cuckoo_search.h"

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

const OptimiserOptions cuckoos = {.method = Method::cuckoo_search, .cuckoo_search = {.generations = 101}};

TEST(CuckooSearch, EndsWhereOthersDo) {
  test::expect_as_listed(test::sphere10(), cuckoos, {0.006968, 4884});
  test::expect_as_listed(test::rosenbrock5(), cuckoos, {3.985, 4431});
}

TEST(CuckooSearch, FlightsComeOneByOneAndDiscoveriesTogether) {
  const Problem problem = test::sphere(8);
  const auto optimiser = make_optimiser(problem.variables, CuckooSearchOptions{.population = 7}, {});
  test::play(problem, *optimiser, 1, [](auto&&...) {});
  std::vector<std::size_t> sizes;
  int abandoned = 0, discoveries = 0;
  test::play(problem, *optimiser, 201, [&](const PopulationView& x, auto, auto) {
    sizes.push_back(x.size);
    if (sizes.size() % 8 != 0) {
      EXPECT_EQ(x.size, 1u);
      return;
    }
    // Components that are not abandoned are those of a nest.
    for (std::size_t c = 0; c < x.size; ++c, ++discoveries) {
      int most = -1;
      for (std::size_t i = 0; i < 7; ++i) {
        int same = 0;
        for (std::size_t j = 0; j < 8; ++j) same += x(j, c) == optimiser->members()(j, i);
        most = std::max(most, same);
      }
      abandoned += 8 - most;
    }
  });
  ASSERT_EQ(sizes.size(), 200u * 8);  // P(no discovery in a generation) = 0.75^56
  // A nest is found out with probability 1 - 0.75^8 = 0.8999, in 8 * 0.25 / 0.8999 components then; one time
  // in seven p(i) = q(i), and nothing changes. Five standard deviations of 1400 draws: 56, and 0.2.
  EXPECT_NEAR(discoveries, 0.8999 * 7 * 200, 56);
  EXPECT_NEAR(static_cast<double>(abandoned) / discoveries, 2 / 0.8999 * 6 / 7, 0.2);
}

TEST(CuckooSearch, NestsOnlyBecomeBetter) {
  const Problem problem = test::rastrigin(4);
  for (const LevyForm form : {LevyForm::plain, LevyForm::best_difference}) {
    const auto optimiser = make_optimiser(
        problem.variables, CuckooSearchOptions{.population = 12, .flight = {.form = form}}, {});
    std::vector<double> before(12, HUGE_VAL), cost(12), violation(12);
    for (std::uint32_t generation = 1; generation < 60; ++generation) {
      test::play(problem, *optimiser, generation, [](auto&&...) {});
      problem.evaluate(optimiser->members(), cost, violation);
      for (std::size_t i = 0; i < 12; ++i) EXPECT_LE(cost[i], before[i]);
      before = cost;
    }
  }
}

TEST(CuckooSearch, FlightsOfTheOtherFormLeaveTheBestWhereItIs) {
  // Its distance from itself is 0; members other than the best move.
  const Problem problem = test::sphere(2);
  const auto optimiser =
      make_optimiser(problem.variables,
                     CuckooSearchOptions{.population = 5, .flight = {.form = LevyForm::best_difference}}, {});
  test::play(problem, *optimiser, 1, [](auto&&...) {});
  int flights = 0, still = 0;
  test::play(problem, *optimiser, 2, [&](const PopulationView& x, auto, auto) {
    if (flights++ < 5) still += x(0, 0) == optimiser->best()[0] && x(1, 0) == optimiser->best()[1];
  });
  EXPECT_GE(still, 1);
  EXPECT_LE(still, 3);
}

TEST(CuckooSearch, ConstraintsComeFirst) {
  const SeedStatistics crescent = test::swarms(test::g06(), cuckoos).statistics;
  EXPECT_GE(crescent.feasible, 18);
  EXPECT_LT(crescent.median, -6500);  // best known -6961.8
}

TEST(CuckooSearch, SaysWhichOptionIsOutOfRange) {
  const Problem problem = test::sphere(2);
  const auto with = [&](const CuckooSearchOptions& o) {
    return message([&] { make_optimiser(problem.variables, o, {}); });
  };
  EXPECT_THAT(with({.population = 1}), HasSubstr("cuckoo_search: population must be at least 2, got 1"));
  EXPECT_THAT(with({.discovery = 1.5}), HasSubstr("cuckoo_search: discovery must be at most 1, got 1.5"));
  EXPECT_THAT(with({.flight = {.exponent = 2}}),
              HasSubstr("cuckoo_search: levy_exponent must be at most 1.99, got 2"));
  EXPECT_THAT(with({.flight = {.step = 0}}),
              HasSubstr("cuckoo_search: levy_step must be more than 0, got 0"));
}

}  // namespace
}  // namespace linkwright::optimise
