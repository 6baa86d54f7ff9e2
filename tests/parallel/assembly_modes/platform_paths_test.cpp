// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/assembly_modes/platform_paths.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "parallel/platforms.h"

namespace linkwright::parallel {
namespace {

bool contains(const std::vector<PlatformPoint>& points, const PlatformPoint& x) {
  return std::any_of(points.begin(), points.end(),
                     [&](const PlatformPoint& p) { return distance(p, x) < 1e-10; });
}

TEST(PlatformPaths, MonodromyFindsFortyDifferentSolutions) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const SolvedPlatform solved = monodromy(seed);
    ASSERT_EQ(solved.solutions.size(), 40u) << "seed " << seed;
    PlatformValues at;
    for (std::size_t i = 0; i < 40; ++i) {
      const PlatformPoint& x = solved.solutions[i];
      evaluate(solved.legs, x, x, at);
      for (const Complex& value : at.value) EXPECT_LT(std::abs(value), 1e-13);
      for (std::size_t j = 0; j < i; ++j) EXPECT_GT(distance(x, solved.solutions[j]), 1e-3);
    }
    // Far from the end of the search: loops would have gone on had there been a 41st, to no effect.
    EXPECT_LT(solved.paths, 1000);
  }
}

TEST(PlatformPaths, LeadFromOneSolvedPlatformToTheOther) {
  // Two searches that know nothing of each other.
  const SolvedPlatform one = monodromy(1), other = monodromy(2);
  std::vector<PlatformPoint> ends;
  for (const PlatformPoint& x : one.solutions) {
    const PlatformPath path = follow(one.legs, other.legs, x);
    ASSERT_EQ(path.end, PathEnd::regular);
    EXPECT_EQ(path.at, 1);
    EXPECT_TRUE(contains(other.solutions, path.point));
    EXPECT_FALSE(contains(ends, path.point));
    ends.push_back(path.point);
    const PlatformPath back = follow(other.legs, one.legs, path.point);
    EXPECT_LT(distance(back.point, x), 1e-10);
  }
}

TEST(PlatformPaths, StopShortOfASingularPlatform) {
  // A level platform with equal joints and rods can move: not a simple solution.
  PlatformLegs end = placed_platform(1).legs;
  end.platform = end.base;
  end.square = {};
  end.square.re[0] = 1;
  const SolvedPlatform start = monodromy(1);
  int regular = 0;
  for (const PlatformPoint& x : start.solutions) {
    const PlatformPath path = follow(start.legs, end, x);
    if (path.end == PathEnd::regular) ++regular;
    if (path.end == PathEnd::singular) {
      EXPECT_GT(path.at, 1 - 1e-6);
      EXPECT_LT(path.at, 1);
    }
  }
  EXPECT_LT(regular, 40);
}

TEST(PlatformPaths, AreLostFromAPointThatIsNoSolution) {
  const SolvedPlatform start = monodromy(1);
  PlatformPoint x = start.solutions[0];
  x[2] += 0.5;
  const PlatformPath path = follow(start.legs, complex_platform(1), x);
  EXPECT_EQ(path.end, PathEnd::lost);
  EXPECT_EQ(path.at, 0);
}

TEST(PlatformPaths, KnowWhatIsNearlyAtInfinity) {
  PlatformPoint x = placed_platform(1).point;
  EXPECT_FALSE(nearly_infinite(x));
  EXPECT_TRUE(nearly_infinite(scaled(x, {0, 50})));
}

}  // namespace
}  // namespace linkwright::parallel
