// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/family.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/message.h"

namespace linkwright::parallel {
namespace {

const std::vector<double> delta_values{0.155, 0.35, 0.8, 0.6};
const std::vector<double> hexa_values{0.25, 0.06, 0.09, 0.78, 0.25, 0.55, 0.4};
const std::vector<double> five_bar_values{0.15, 0.25, 0.35, 0.2};

TEST(RobotFamily, RatesOfLegsAreThoseOfDifferences) {
  for (const auto& [family, x] : {std::pair{RobotFamily::delta, delta_values},
                                  {RobotFamily::hexa, hexa_values},
                                  {RobotFamily::five_bar, five_bar_values}}) {
    ASSERT_EQ(dimensions(family).size(), x.size());
    const DesignedRobot at = design(family, x);
    EXPECT_EQ(problem(at.robot), std::nullopt);
    EXPECT_EQ(at.offset, x.back());
    // Sines are the least linear: error h^2/6.
    constexpr double h = 1e-5;
    for (std::size_t j = 0; j < x.size(); ++j) {
      std::vector<double> more = x, less = x;
      more[j] += h;
      less[j] -= h;
      const Robot up = design(family, more).robot, down = design(family, less).robot;
      for (int i = 0; i < at.robot.legs(); ++i) {
        const LegRate& by = at.by[j][i];
        const auto same = [&](const Vec3& rate, const Vec3& a, const Vec3& b) {
          EXPECT_LT(norm(rate - (1 / (2 * h)) * (a - b)), 1e-10) << name_of(family) << j;
        };
        same(by.base, up.leg[i].base, down.leg[i].base);
        same(by.platform, up.leg[i].platform, down.leg[i].platform);
        EXPECT_NEAR(by.arm, (up.leg[i].arm - down.leg[i].arm) / (2 * h), 1e-10);
        EXPECT_NEAR(by.rod, (up.leg[i].rod - down.leg[i].rod) / (2 * h), 1e-10);
      }
    }
  }
}

// In a symmetric pose all arms have the same outward angle.
TEST(RobotFamily, OutwardAnglesOfEqualLegsAreEqual) {
  const DesignedRobot at = design(RobotFamily::five_bar, five_bar_values);
  const ArmAngles arms = inverse(at.robot, {{0, 0.3, 0}}, elbows_out(RobotFamily::five_bar));
  ASSERT_EQ(arms.status, Status::done);
  EXPECT_NEAR(arm_angle_of(at, 0, arms.angle[1]), arms.angle[0], 1e-14);
  // Elbows stand further out than the pivots' line to the platform.
  EXPECT_GT(elbow(at.robot.leg[1], arms.angle[1]).x, 0.15);
  EXPECT_LT(elbow(at.robot.leg[0], arms.angle[0]).x, -0.15);
}

TEST(RobotFamily, TellsHowManyDimensionsItHas) {
  EXPECT_EQ(test::message([] { design(RobotFamily::delta, std::vector<double>(3)); }),
            "design: 3 values for 4 dimensions of a delta [values.size() == count]");
}

}  // namespace
}  // namespace linkwright::parallel
