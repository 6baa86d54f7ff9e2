// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/family.h"

#include <gtest/gtest.h>

#include "linkwright/core/check.h"
#include "planar/dyad_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

TEST(DyadFamily, OfFivePosesAreTheFourDyads) {
  const DyadFamily all = dyad_family(stored_poses("MO-5-slider-crank"), {}, {});
  EXPECT_EQ(all.solutions, 4);
  EXPECT_EQ(all.dyads.size(), 4u);
  EXPECT_FALSE(all.dependent);
}

TEST(DyadFamily, OfFewerPosesIsASweepOfDyadsThatHoldThem) {
  for (const std::size_t count : {4u, 3u}) {
    std::vector<BodyPose> poses = stored_poses("MO-5-smooth-four-dyads");
    poses.resize(count);
    const DyadFamily few = dyad_family(poses, {}, {.one = 30, .two = 8}),
                     more = dyad_family(poses, {}, {.one = 60, .two = 16});
    EXPECT_FALSE(few.dyads.empty());
    EXPECT_GT(more.dyads.size(), few.dyads.size());
    for (const GuidingDyad& dyad : more.dyads) EXPECT_LT(spread(dyad, poses), 1e-7);
  }
}

TEST(DyadFamily, AGivenPivotTakesTwoNumbers) {
  const std::vector<BodyPose> poses = random_poses(3, 1);
  Prescription given;
  given.fixed = Complex(0.3, 0.2);
  EXPECT_EQ(open_numbers(3, given), 0);
  EXPECT_EQ(open_numbers(3, {}), 2);
  EXPECT_EQ(dyad_family(poses, given, {}).dyads.size(), 1u);
  EXPECT_THROW((void)dyad_family(random_poses(2, 1), {}, {}), ContractError);
  EXPECT_EQ(size_of_motion(std::vector<BodyPose>{{1.0, 0}, {1.0, 1}}), 1);
}

// Two poses with lines for pivots leave numbers open that no pivot without a line can take.
TEST(DyadFamily, IsSweptAlongLinesWhereNoPivotIsFree) {
  const std::vector<BodyPose> poses = random_poses(2, 5);
  const PivotLine fixed{{0.3, 0.2}, {2, 1}}, moving{{0.1, 0}, {0, 3}};
  const auto off = [](const PivotLine& line, Complex z) {
    return std::abs(((z - line.point) * std::conj(line.direction)).imag()) / std::abs(line.direction);
  };
  for (const bool both : {false, true})
    for (const bool of_ground : {false, true}) {
      Prescription given;
      if (both || of_ground) given.fixed_line = fixed;
      if (both || !of_ground) given.moving_line = moving;
      const DyadFamily found = dyad_family(poses, given, {.one = 40, .two = 8});
      EXPECT_GT(found.dyads.size(), 20u);
      for (const GuidingDyad& dyad : found.dyads) {
        EXPECT_LT(spread(dyad, poses), 1e-9);
        EXPECT_LT(given.fixed_line ? off(fixed, dyad.fixed) : 0, 1e-9);
        EXPECT_LT(given.moving_line ? off(moving, dyad.moving) : 0, 1e-9);
      }
    }
}

// A small region is swept as closely as a large one: what is in it is found wherever it lies.
TEST(DyadFamily, OfARegionHasPivotsInItHoweverSmallItIs) {
  for (const int count : {3, 4}) {
    const std::vector<BodyPose> poses = random_poses(count, 7);
    const DyadFamily all = dyad_family(poses, {}, {});
    const GuidingDyad& known = all.dyads[all.dyads.size() / 2];
    ASSERT_EQ(known.type, GuidingDyadType::rr);
    for (const double half : {0.5, 0.05, 1e-3}) {
      const Complex corner(half, half);
      Prescription fixed, moving, both;
      fixed.fixed_region = both.fixed_region = {known.fixed - corner, known.fixed + corner};
      moving.moving_region = both.moving_region = {known.moving - corner, known.moving + corner};
      for (const Prescription& given : {fixed, moving, both}) {
        const DyadFamily found = dyad_family(poses, given, {});
        EXPECT_FALSE(found.dyads.empty()) << count << " poses, half a side " << half;
        for (const GuidingDyad& dyad : found.dyads) {
          EXPECT_TRUE(in_regions(dyad, given));
          EXPECT_LT(spread(dyad, poses), 1e-7);
        }
      }
    }
  }
}

TEST(DyadFamily, CountsWhatRegionsLeaveOut) {
  const std::vector<BodyPose> poses = stored_poses("MO-5-slider-crank");
  Prescription given;
  given.fixed_region = {{-1e6, -1e6}, {1e6, 1e6}};
  const DyadFamily wide = dyad_family(poses, given, {});
  // A slide on the ground has no pivot there.
  EXPECT_EQ(wide.dyads.size() + static_cast<std::size_t>(wide.outside), 4u);
  for (const GuidingDyad& dyad : wide.dyads) EXPECT_NE(dyad.type, GuidingDyadType::pr);
  EXPECT_EQ(wide.outside, 1);
  given.fixed_region = {{1e6, 1e6}, {2e6, 2e6}};
  EXPECT_EQ(dyad_family(poses, given, {}).outside, 4);
}

}  // namespace
}  // namespace linkwright::planar
