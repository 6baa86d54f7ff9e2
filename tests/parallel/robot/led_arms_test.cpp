// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/led_arms.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/parallel/robot/path_trouble.h"
#include "parallel/random_vector.h"
#include "parallel/robots.h"
#include "support/allocations.h"

namespace linkwright::parallel {
namespace {

constexpr double length = 0.09;
const Pose home{{0, 0, -0.5}};

LedPose led(const Robot& robot, const Vector6& angles) {
  return lead_arms(robot, home, inverse(robot, home).angle, angles, length);
}

// The arms of a platform follow a free path of it.
TEST(LedArms, ComeToThePoseThatTheirAnglesBelongTo) {
  const Robot robot = reference_hexa();
  const auto task = trouble_task(robot, home, all_positive, length);
  RandomStream random({.seed = 4});
  int looked = 0;
  while (looked < 60) {
    const Pose to{home.position + random_vector(random, 0.08), math::turn_about(random_vector(random, 0.35))};
    if (inverse(robot, to).status != Status::done || first_trouble(*task, home, to)) continue;
    ++looked;
    const LedPose found = led(robot, inverse(robot, to).angle);
    ASSERT_EQ(found.status, Status::done);
    EXPECT_EQ(found.share, 1);
    EXPECT_NEAR(norm(found.pose.position - to.position), 0, 1e-9);
    EXPECT_NEAR(norm(math::turn_of(found.pose.rotation * transposed(to.rotation))), 0, 1e-8);
    EXPECT_LT(found.residual, 1e-12);
  }
}

// The arms of a pose beyond the singular yaw: they are led to it, or to the same angles in home's assembly,
// but never handed out with another sign than home's.
TEST(LedArms, DoNotHandOutAnotherAssembly) {
  const Robot robot = reference_hexa();
  const double sign = determinant(robot, jacobians(robot, home, inverse(robot, home).angle));
  int stopped = 0, came = 0;
  for (int yaw = 95; yaw <= 175; yaw += 5) {
    const Pose beyond{home.position, math::turn_z(math::radians(yaw))};
    const ArmAngles arms = inverse(robot, beyond);
    ASSERT_EQ(arms.status, Status::done);
    const LedPose found = led(robot, arms.angle);
    if (found.status == Status::done) {
      ++came;
      const double there = determinant(robot, jacobians(robot, found.pose, arms.angle));
      EXPECT_GT(sign * there, 0) << yaw;
    } else {
      ++stopped;
      EXPECT_GT(found.share, 0);
      EXPECT_LT(found.share, 1);
    }
  }
  EXPECT_EQ(came + stopped, 17);
}

TEST(LedArms, SayWhereTheRodsNoLongerHold) {
  // All arms up: the platform comes to where rods and platform are in one plane, or the rods do not fit.
  const Robot robot = reference_hexa();
  Vector6 angles;
  angles.fill(math::radians(-150));
  const LedPose found = led(robot, angles);
  if (found.status == Status::singular) {
    Vector6 there{};
    const ArmAngles start = inverse(robot, home);
    for (int i = 0; i < 6; ++i)
      there[i] = start.angle[i] + found.share * math::wrap_angle(angles[i] - start.angle[i]);
    EXPECT_NEAR(min_rods(robot, jacobians(robot, found.pose, there), length), 1e-3, 1e-4);
  }
  EXPECT_NE(found.status, Status::branch_lost);
}

TEST(LedArms, AllocateNothingAndRefuseAHomeThatIsSingular) {
  const Robot robot = reference_hexa();
  const Vector6 angles = inverse(robot, {{0.02, 0.01, -0.52}}).angle;
  led(robot, angles);
  const auto before = test::allocations();
  led(robot, angles);
  EXPECT_EQ(test::allocations(), before);
  const Pose singular{home.position, math::turn_z(1.6147137688767494)};
  EXPECT_THROW(lead_arms(robot, singular, inverse(robot, singular).angle, angles, length), ContractError);
}

}  // namespace
}  // namespace linkwright::parallel
