// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/priorities.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "linkwright/optimise/minimise.h"
#include "optimise/functions.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

PriorityKey key(const std::vector<double>& costs, const Priorities& priorities = {}) {
  return priority_key(costs, priorities);
}

TEST(Priorities, KeyCountsTheLeadingObjectivesThatAreMet) {
  const PriorityKey first = key({1.5, 0.1, 0.2});
  EXPECT_EQ(first.met, 0u);
  EXPECT_EQ(first.ratio, 1.5);
  const PriorityKey second = key({1, 3, 0.2});  // 1 is met
  EXPECT_EQ(second.met, 1u);
  EXPECT_EQ(second.ratio, 3);
  const PriorityKey all = key({0.3, 0.7, 0.2});
  EXPECT_EQ(all.met, 3u);
  EXPECT_EQ(all.ratio, 0.7);
  // In another order, in parts of the tolerances.
  const PriorityKey other = key({1.5, 0.1, 0.2}, {.tolerances = {1, 1, 0.1}, .order = {1, 2, 0}});
  EXPECT_EQ(other.met, 1u);
  EXPECT_EQ(other.ratio, 2);
}

TEST(Priorities, AViolatedFirstObjectiveIsWorseThanAnyViolatedSecond) {
  // By the ratios alone, 1.5 against 55, it would be the other way about.
  const PriorityKey first = key({1.5, 0}), second = key({0.9, 55});
  EXPECT_TRUE(better(second, first));
  EXPECT_FALSE(better(first, second));
  EXPECT_LT(priority_cost(second), priority_cost(first));
}

TEST(Priorities, OneNumberHasTheOrderOfTheKeys) {
  // All ratios that can stand with a number of objectives met, the extreme ones and those next to a limit.
  constexpr std::size_t n = 4;
  constexpr double most = std::numeric_limits<double>::max();
  std::vector<PriorityKey> keys;
  for (std::size_t met = 0; met < n; ++met)
    for (const double ratio : {std::nextafter(1.0, 2.0), 1.001, 1.5, 2.0, 55.0, 56.0, 1e6, 1.000001e6, 0x1p53,
                               0x1p53 + 2, 1e300, most, HUGE_VAL})
      keys.push_back({met, ratio});
  for (const double ratio : {0.0, 1e-300, 1e-9, 0.3, 0.7, std::nextafter(1.0, 0.0), 1.0})
    keys.push_back({n, ratio});
  for (const PriorityKey& a : keys)
    for (const PriorityKey& b : keys) {
      EXPECT_TRUE(!better(a, b) || priority_cost(a) <= priority_cost(b))
          << a.met << " " << a.ratio << " " << b.met << " " << b.ratio;
      EXPECT_TRUE(a.met == b.met || better(a, b) == (priority_cost(a) < priority_cost(b)));
    }
  EXPECT_LT(priority_cost({3, 1e6}), priority_cost({3, 1.000001e6}));
  // A target cost tells when all are met.
  for (const PriorityKey& a : keys) EXPECT_EQ(a.met == n, priority_cost(a) <= 0.5 - double{n});
}

TEST(Priorities, PopulationMethodsMinimiseByThem) {
  // On the front sqrt(f1) + sqrt(f2) = 2. The first is to be at most 0.01, so that the second is 3.61 at
  // least.
  const Problem problem = test::schaffer(2);
  RunContext context;
  MinimiseOptions options;
  options.stop.generations = 1000;
  const Report first = minimise(by_priority(problem, {.tolerances = {0.01, 0.01}}), {}, options, {}, context);
  EXPECT_LE(first.costs[0], 0.01);
  EXPECT_NEAR(first.costs[1], 3.61, 1e-3);
  const Report second =
      minimise(by_priority(problem, {.tolerances = {0.01, 0.01}, .order = {1, 0}}), {}, options, {}, context);
  EXPECT_NEAR(second.costs[0], 3.61, 1e-3);
  EXPECT_LE(second.costs[1], 0.01);
  // Both within reach: the search ends where they are met, or goes on to the least of the larger ratio.
  const Priorities wide = {.tolerances = {2, 2}};
  options.stop.target_cost = 0.5 - 2;
  const Report met = minimise(by_priority(problem, wide), {}, options, {}, context);
  EXPECT_LE(met.costs[0], 2);
  EXPECT_LE(met.costs[1], 2);
  EXPECT_LT(met.generations, 100);
  options.stop.target_cost = -HUGE_VAL;
  const Report least = minimise(by_priority(problem, wide), {}, options, {}, context);
  EXPECT_NEAR(priority_key(least.costs, wide).ratio, 0.5, 1e-6);
}

TEST(Priorities, SaysWhatIsWrong) {
  const auto with = [](const Priorities& p, const std::vector<double>& costs = {1, 2}) {
    return message([&] { key(costs, p); });
  };
  EXPECT_THAT(with({.tolerances = {1}}), HasSubstr("1 tolerances for 2 objectives"));
  EXPECT_THAT(with({.tolerances = {1, 0}}), HasSubstr("tolerance 1 must be more than 0, got 0"));
  EXPECT_THAT(with({.order = {0}}), HasSubstr("an order of 1 for 2 objectives"));
  EXPECT_THAT(with({.order = {1, 1}}), HasSubstr("objective 0 is missing in the order"));
  EXPECT_THAT(with({}, {1, -0.5}), HasSubstr("cost 1 must be at least 0, got -0.5"));
  EXPECT_THAT(message([] {
                by_priority(test::schaffer(1), {.order = {0, 2}});
              }),
              HasSubstr("objective 1 is missing in the order"));
}

}  // namespace
}  // namespace linkwright::optimise
