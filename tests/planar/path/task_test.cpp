// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/task.h"

#include <gmock/gmock.h>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

PathTask square() {
  PathTask p;
  p.x = {0, 3, 3, 0};
  p.y = {0, 0, 4, 4};
  return p;
}

std::string refusal(const PathTask& task) {
  try {
    require_valid_task(task);
  } catch (const ContractError& error) {
    return error.what();
  }
  return "none";
}

TEST(PathTask, AnglesFollowFromTheTiming) {
  PathTask p = square();
  EXPECT_TRUE(p.free_timing());
  EXPECT_EQ(point_angle(p, 2), 0);
  p.timing = Timing::equal_steps;
  p.step = 0.25;
  EXPECT_EQ(point_angle(p, 3), 0.75);
  p.timing = Timing::increments;
  p.angles = {0, 0.1, 0.4, 0.9};
  EXPECT_EQ(point_angle(p, 2), 0.4);
  EXPECT_TRUE(p.searches(1));
  EXPECT_FALSE(p.searches(-1));
}

TEST(PathTask, RefusesWhatTheTimingCannotMean) {
  PathTask p = square();
  EXPECT_EQ(refusal(p), "none");
  p.min_step = 0;
  EXPECT_THAT(refusal(p), HasSubstr("the least step is 0"));
  p = square();
  p.timing = Timing::equal_steps;
  EXPECT_THAT(refusal(p), HasSubstr("the step must not be zero"));
  p.timing = Timing::given;
  p.angles = {0, 1, 2};
  EXPECT_THAT(refusal(p), HasSubstr("3 angles for 4 points"));
  p.angles = {0, 1, nan, 3};
  EXPECT_THAT(refusal(p), HasSubstr("angle 3 is nan"));
}

TEST(PathTask, RangesFollowFromTheBoxOfThePath) {
  const PathTask p = square();  // its diagonal is 5 m
  const PathRanges ranges = derive_ranges(p.x, p.y);
  EXPECT_EQ(ranges.link, (Range{0.005, 250}));
  EXPECT_EQ(ranges.place, (Range{-250, 250}));
  EXPECT_EQ(ranges.pivot_x, (Range{-248.5, 251.5}));
  EXPECT_EQ(ranges.pivot_y, (Range{-248, 252}));
  EXPECT_EQ(ranges.turn, (Range{0, 2 * pi}));
}

TEST(TracedPath, IsBetterByTheFeasibilityRules) {
  TracedPath<int> near, far, outside;
  near.error = 1;
  far.error = 2;
  outside.violations = {{"bounds", 0.25}, {"order", 0.5}};
  EXPECT_EQ(total_violation(outside), 0.75);
  EXPECT_TRUE(better_design(near, far));
  EXPECT_FALSE(better_design(far, near));
  EXPECT_TRUE(better_design(far, outside));
}

}  // namespace
}  // namespace linkwright::planar
