// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/robot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

TEST(Robot, CannedRobotsAreSound) {
  for (const Robot& robot : {reference_delta(), reference_hexa(), reference_five_bar(), reference_platform()})
    EXPECT_EQ(problem(robot), std::nullopt);
}

TEST(Robot, LegsOfAHexaStandInPairs) {
  const Robot robot = reference_hexa();
  ASSERT_EQ(robot.legs(), 6);
  for (int pair = 0; pair < 3; ++pair) {
    const Leg &minus = robot.leg[2 * pair], &plus = robot.leg[2 * pair + 1];
    EXPECT_NEAR(norm(plus.base - minus.base), 0.12, 1e-15);
    EXPECT_EQ(plus.ahead, minus.ahead);
    EXPECT_NEAR(norm(plus.platform - minus.platform), 2 * 0.09 * std::sin(std::atan(1.0)), 1e-15);
  }
  // - before +: counter-clockwise seen from above.
  EXPECT_LT(robot.leg[0].base.y, robot.leg[1].base.y);
}

TEST(Robot, TellsWhichLegIsWrongAndWhy) {
  Robot robot = reference_delta();
  robot.leg[1].arm = 0;
  EXPECT_EQ(problem(robot), "leg 2: arm = 0 m");
  robot = reference_delta();
  robot.leg[2].rod = -0.8;
  EXPECT_EQ(problem(robot), "leg 3: rod = -0.8 m");
  robot = reference_delta();
  robot.leg[0].aside = {0, 0.1, -1};
  EXPECT_EQ(problem(robot), "leg 1: the directions of its arm are not unit vectors at a right angle");
  robot = reference_delta();
  robot.leg[0].base.x = NAN;
  EXPECT_EQ(problem(robot), "leg 1: its joints are not finite");
  robot = reference_five_bar();
  robot.leg[1].base.z = 0.1;
  EXPECT_EQ(problem(robot), "leg 2: it leaves the plane z = 0");
}

}  // namespace
}  // namespace linkwright::parallel
