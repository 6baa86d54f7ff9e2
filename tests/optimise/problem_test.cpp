// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/problem.h"

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "linkwright/core/numbers.h"

namespace linkwright::optimise {
namespace {

TEST(Better, PrefersFeasibleToInfeasibleWhateverTheCost) {
  EXPECT_TRUE(better(1e9, 0, 1, 1e-12));
  EXPECT_FALSE(better(1, 1e-12, 1e9, 0));
}

TEST(Better, ComparesFeasibleOnesByCost) {
  EXPECT_TRUE(better(1, 0, 2, 0));
  EXPECT_FALSE(better(2, 0, 1, 0));
}

TEST(Better, ComparesInfeasibleOnesByViolationThenCost) {
  EXPECT_TRUE(better(5, 0.1, 1, 0.2));
  EXPECT_TRUE(better(1, 0.1, 5, 0.1));
  EXPECT_TRUE(better(infinity, 0.1, infinity, 0.2));
}

TEST(Better, IsStrict) {
  EXPECT_FALSE(better(1, 0, 1, 0));
  EXPECT_FALSE(better(infinity, 0.1, infinity, 0.1));
}

bool better_by_all(const std::vector<double>& a, double violation_a, const std::vector<double>& b,
                   double violation_b) {
  return better(std::span(a), violation_a, std::span(b), violation_b);
}

TEST(BetterByAllObjectives, FeasibleOnesHaveToBeLessInEveryObjective) {
  EXPECT_TRUE(better_by_all({1, 2, 3}, 0, {2, 3, 4}, 0));
  EXPECT_FALSE(better_by_all({1, 2, 4}, 0, {2, 3, 4}, 0));  // the last is equal
  EXPECT_FALSE(better_by_all({2, 2, 3}, 0, {2, 3, 4}, 0));  // the first is
  // Neither of the two: the last objective alone does not decide, as it does in the published listing.
  EXPECT_FALSE(better_by_all({9, 1}, 0, {1, 2}, 0));
  EXPECT_FALSE(better_by_all({1, 2}, 0, {9, 1}, 0));
}

TEST(BetterByAllObjectives, OthersAreComparedByViolationOnly) {
  EXPECT_TRUE(better_by_all({9, 9}, 0, {1, 1}, 1e-12));
  EXPECT_FALSE(better_by_all({1, 1}, 1e-12, {9, 9}, 0));
  EXPECT_TRUE(better_by_all({9, 9}, 0.1, {1, 1}, 0.2));
  EXPECT_FALSE(better_by_all({1, 1}, 0.1, {9, 9}, 0.1));
}

TEST(BetterByAllObjectives, OneObjectiveIsAsEver) {
  for (const double cost : {1.0, 2.0, infinity})
    for (const double other : {1.0, 2.0, infinity})
      for (const double violation : {0.0, 0.1, 0.2})
        for (const double other_violation : {0.0, 0.1, 0.2})
          EXPECT_EQ(better_by_all({cost}, violation, {other}, other_violation),
                    better(cost, violation, other, other_violation));
}

}  // namespace
}  // namespace linkwright::optimise
