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

}  // namespace
}  // namespace linkwright::planar
