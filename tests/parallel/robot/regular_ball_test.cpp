// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/regular_ball.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/random.h"
#include "linkwright/parallel/robot/constraint.h"
#include "parallel/robots.h"
#include "support/allocations.h"

namespace linkwright::parallel {
namespace {

TEST(RegularBall, MeasuresAreThoseOfThePose) {
  for (const Robot& robot : {reference_delta(), reference_hexa(), reference_five_bar()}) {
    const Pose pose =
        robot.freedom == Freedom::plane_translation ? Pose{{0.05, 0.4, 0}} : Pose{{0.05, 0.02, -0.52}};
    const RegularAt there = regular_at(robot, pose, all_positive, 0.09);
    ASSERT_TRUE(there.reached);
    const ArmAngles arms = inverse(robot, pose);
    const Jacobians at = jacobians(robot, pose, arms.angle);
    const Quality q = quality(robot, at, 0.09);
    EXPECT_EQ(there.marks.assembly, determinant(robot, at) > 0 ? 1 : -1);
    EXPECT_NEAR(there.rods, min_rods(robot, at, 0.09), 1e-14);
    double least = 1;
    for (int i = 0; i < robot.legs(); ++i) {
      EXPECT_NEAR(std::sqrt(there.legs[i].square) / robot.leg[i].rod, std::abs(q.input[i]), 1e-13);
      least = std::min(least, q.input[i] * q.input[i]);
    }
    EXPECT_NEAR(there.reach, least, 1e-13);
    EXPECT_EQ(there.constraint, robot.freedom == Freedom::space_translation ? q.constraint_index : 1);
    const auto before = test::allocations();
    regular_at(robot, pose, all_positive, 0.09);
    change_within(robot, there, {0.01, 0.01}, 0.09);
    EXPECT_EQ(test::allocations(), before);
  }
  const RegularAt far = regular_at(reference_delta(), {{0, 0, -2}}, all_positive, 1);
  EXPECT_FALSE(far.reached);
  EXPECT_EQ(far.leg, 0);
  EXPECT_LT(far.reach, 0);
  EXPECT_FALSE(change_within(reference_delta(), far, {1e-6, 0}, 1));
  EXPECT_EQ(clear_radius(reference_delta(), far, 1), 0);
}

// (B.3), (B.4): random robots, poses and displacements; how much of the allowance is used.
TEST(RegularBall, ChangesAreNeverLargerThanTheBound) {
  RandomStream random({.seed = 8});
  double used = 0;
  int looked = 0, of_hexa = 0;
  while (looked < 3000) {
    const int kind = static_cast<int>(3 * random.uniform(0, 1));
    Robot robot = kind == 0 ? reference_hexa() : kind == 1 ? reference_five_bar() : reference_delta();
    for (int i = 0; i < robot.legs(); ++i) {
      robot.leg[i].arm *= random.uniform(0.6, 1.4);
      robot.leg[i].rod *= random.uniform(0.7, 1.3);
    }
    const bool planar = robot.freedom == Freedom::plane_translation, turns = robot.freedom == Freedom::space;
    const auto draw = [&](double size) {
      return Vec3{random.uniform(-size, size), random.uniform(-size, size),
                  planar ? 0 : random.uniform(-size, size)};
    };
    Pose pose{draw(0.4) + (planar ? Vec3{0, 0.4, 0} : Vec3{0, 0, -0.6})};
    if (turns) pose.rotation = math::turn_about(draw(0.5));
    const double length = random.uniform(0.05, 0.2);
    const RegularAt at = regular_at(robot, pose, all_positive, length);
    const double shift = std::pow(10, random.uniform(-4, -1)),
                 turn = turns ? shift * random.uniform(0, 4) : 0;
    const auto change = change_within(robot, at, {shift, turn}, length);
    if (!change) continue;
    ++looked;
    of_hexa += turns;
    for (int n = 0; n < 4; ++n) {
      const Vec3 way = draw(1);
      Pose there{pose.position + (random.uniform(0, 1) * shift / norm(way)) * way, pose.rotation};
      if (turns) {
        const Vec3 axis = draw(1);
        there.rotation = math::turn_about((random.uniform(0, 1) * turn / norm(axis)) * axis) * pose.rotation;
      }
      const RegularAt moved = regular_at(robot, there, all_positive, length);
      // Reach is vouched for, too.
      ASSERT_TRUE(moved.reached);
      EXPECT_LE(std::abs(moved.rods - at.rods), *change + 1e-14);
      EXPECT_LE(std::abs(moved.constraint - at.constraint), *change + 1e-14);
      used = std::max({used, std::abs(moved.rods - at.rods) / *change,
                       std::abs(moved.constraint - at.constraint) / *change});
    }
  }
  EXPECT_GT(of_hexa, 400);
  EXPECT_GT(used, 0.3);  // the bound is no idle one
}

TEST(RegularBall, NothingIsSingularWithinTheClearRadius) {
  RandomStream random({.seed = 2});
  const Robot clear = delta({.base_radius = 0.145, .platform_radius = 0.045, .arm = 0.5, .rod = 0.5});
  for (const Robot& robot : {clear, reference_delta(), reference_hexa()})
    for (int n = 0; n < 100; ++n) {
      const Pose pose{{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.7, -0.3)}};
      const RegularAt at = regular_at(robot, pose, all_positive, 0.09);
      const double radius = clear_radius(robot, at, 0.09);
      EXPECT_GE(radius, 0);
      if (radius == 0) continue;
      for (int k = 0; k < 20; ++k) {
        const Vec3 way{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        const RegularAt moved =
            regular_at(robot, {pose.position + (radius / norm(way)) * way}, all_positive, 0.09);
        ASSERT_TRUE(moved.reached);
        EXPECT_EQ(moved.marks, at.marks);
        EXPECT_GE(moved.constraint, constraint_floor / 2);
        EXPECT_GE(moved.rods, rods_floor / 2);
      }
    }
}

}  // namespace
}  // namespace linkwright::parallel
