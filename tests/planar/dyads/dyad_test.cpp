// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/dyad.h"

#include <gtest/gtest.h>

#include "planar/dyad_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

TEST(GuidingDyad, GapIsTheDistanceFromCircleOrLine) {
  const BodyPose pose{{1, 2}, pi / 2};
  EXPECT_LT(std::abs(place(pose, {3, 0}) - Complex(1, 5)), 1e-15);
  EXPECT_NEAR(gap({GuidingDyadType::rr, {1, 1}, {3, 0}, 3.5, 0, 0}, pose), 0.5, 1e-15);
  // The moving pivot at y = 5 is 0.5 above the line y = 4.5.
  EXPECT_NEAR(gap({GuidingDyadType::pr, 0, {3, 0}, 0, {0, 1}, 4.5}, pose), 0.5, 1e-15);
  // The pivot (1, 1) is at (-1, 0) for the body.
  EXPECT_NEAR(gap({GuidingDyadType::rp, {1, 1}, 0, 0, {1, 0}, -1.5}, pose), 0.5, 1e-15);
}

TEST(GuidingDyad, IsTheSameSeenFromTheBody) {
  const std::vector<BodyPose> poses = random_poses(5, 4);
  for (const GuidingDyadType type : {GuidingDyadType::rr, GuidingDyadType::pr, GuidingDyadType::rp}) {
    const GuidingDyad dyad{type, {0.3, -0.8}, {1.1, 0.4}, 1.5, {0.6, 0.8}, 0.2};
    for (const BodyPose& pose : poses) {
      EXPECT_NEAR(gap(inverse(dyad), inverse(pose)), gap(dyad, pose), 1e-14);
      const BodyPose again = inverse(inverse(pose));
      EXPECT_LT(std::abs(again.origin - pose.origin), 1e-14);
      EXPECT_EQ(again.angle, pose.angle);
    }
  }
}

TEST(GuidingDyad, SpreadIsTheRootMeanSquare) {
  const GuidingDyad link{GuidingDyadType::rr, 0, 0, 1, 0, 0};
  const std::vector<BodyPose> poses = {{{1.3, 0}, 0}, {{0, 0.6}, 1}};
  EXPECT_NEAR(spread(link, poses), std::sqrt(0.5 * (0.09 + 0.16)), 1e-15);
}

}  // namespace
}  // namespace linkwright::planar
