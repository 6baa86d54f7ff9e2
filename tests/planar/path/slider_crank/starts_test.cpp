// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/starts.h"

#include <gmock/gmock.h>

#include <cmath>

#include "planar/slider_crank_path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

SliderPathProblem free_points(bool closed, bool turning) {
  SliderPathProblem p = printed_eighteen_slider_points();
  p.timing = Timing::free;
  p.closed = closed;
  p.crank_rotates_fully = turning;
  return p;
}

TEST(SliderPathMatcher, StartsAreInOrderAndLieNearThePath) {
  for (const bool closed : {true, false})
    for (const bool turning : {true, false})
      for (const SliderSide side : {SliderSide::forward, SliderSide::backward})
        for (const double sense : {1.0, -1.0}) {
          if (closed && !turning) continue;
          const SliderPathProblem p = free_points(closed, turning);
          SliderPathMatcher matcher(p, side, sense);
          for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            RandomStream stream({.seed = seed});
            const auto start = matcher.best_of(48, stream);
            ASSERT_TRUE(start);
            const SliderPathDesign d = measure(p, start->linkage, sense, start->angles);
            ASSERT_TRUE(std::isfinite(d.error));
            for (const auto& violation : d.violations) {
              EXPECT_NE(violation.reason, "order");
              EXPECT_NE(violation.reason, "crank_rotates_fully");
            }
            // The mismatch is that of the curve between its samples, a 96th of its length apart.
            EXPECT_NEAR(d.error, start->mismatch, 0.1 * start->mismatch + 0.1);
            EXPECT_LT(d.error, 1.5);  // the points about their mean have 1.9
          }
        }
}

TEST(SliderPathMatcher, TheSameStreamGivesTheSameStart) {
  const SliderPathProblem p = free_points(true, true);
  SliderPathMatcher matcher(p, SliderSide::forward, 1), again(p, SliderSide::forward, 1);
  RandomStream a({.seed = 7}), b({.seed = 7});
  matcher.best_of(5, a);
  RandomStream c({.seed = 7});
  const auto first = matcher.best_of(20, b), second = again.best_of(20, c);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->angles, second->angles);
  EXPECT_EQ(first->linkage.parameters.rod, second->linkage.parameters.rod);
}

}  // namespace
}  // namespace linkwright::planar
