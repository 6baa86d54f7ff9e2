// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/statics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "parallel/random_vector.h"
#include "parallel/robots.h"
#include "support/allocations.h"

namespace linkwright::parallel {
namespace {

struct StaticsCase {
  Robot robot;
  Drives drives;
  Pose pose;
  WorkingMode mode = all_positive;

  Vector6 angles() const { return inverse(robot, pose, mode).angle; }
  Jacobians at() const { return jacobians(robot, pose, angles()); }
  DrivesAt drives_state() const { return drives_at(robot, drives, angles()).drive; }
};

const StaticsCase statics_cases[] = {
    {reference_delta(), reference_drives(), {{0.2, -0.1, -0.85}}},
    {reference_hexa(), reference_drives(), {{0.05, -0.03, -0.5}, math::turn_about(Vec3{0.15, -0.2, 0.25})}},
    {reference_five_bar(), mirrored_drives(), {{0.05, 0.45, 0}}, {-1, 1}},
    {reference_platform(), mirrored_drives(), {{0.03, 0.42, 0}}, {-1, 1}}};

Drives elastic(Drives drives) {
  for (auto& d : drives) d.stiffness = 1.1e7;
  return drives;
}

TEST(Statics, OfTheReferenceDelta) {
  const StaticsCase c = statics_cases[0];
  const Value& out = computed("delta-statics");
  const StaticLoads loads =
      static_loads(c.robot, c.at(), c.drives_state(),
                   {.force = point(test::at(inputs("delta-statics"), "force_on_platform_N"))});
  EXPECT_EQ(loads.status, Status::done);
  for (int i = 0; i < 3; ++i) {
    const auto expected = [&](const char* key) { return test::numbers(test::at(out, key))[i]; };
    EXPECT_NEAR(loads.arm_torque[i], expected("tau_Nm"), 1e-12);
    EXPECT_NEAR(loads.drive_effort[i], expected("screw_force_N"), 1e-11);
    EXPECT_NEAR(loads.rod_force[i], expected("rod_axial_force_N"), 1e-12);
  }
  const Drives drives = elastic(c.drives);
  const Stiffness k = stiffness(c.robot, drives, c.at(), c.drives_state(), 1);
  EXPECT_EQ(k.status, Status::done);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(k.eigenvalue[i], test::numbers(test::at(out, "stiffness_eigenvalues_N_m"))[i], 1e-5);
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(k.matrix[i][j], test::numbers(test::at(out, "stiffness_N_m").as_array()[i])[j], 1e-5);
  }
}

TEST(Statics, OfTheReferenceHexa) {
  const StaticsCase c = statics_cases[1];
  const auto wrench = test::numbers(test::at(inputs("hexa-dynamics-statics"), "wrench_on_platform"));
  const StaticLoads loads =
      static_loads(c.robot, c.at(), c.drives_state(),
                   {{wrench[0], wrench[1], wrench[2]}, {wrench[3], wrench[4], wrench[5]}});
  const Value& out = computed("hexa-dynamics-statics");
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(loads.arm_torque[i], test::numbers(test::at(out, "tau_static_Nm"))[i], 1e-12);
    EXPECT_NEAR(loads.drive_effort[i], test::numbers(test::at(out, "screw_force_static_N"))[i], 1e-11);
  }
}

TEST(Statics, VirtualWorkAndTheRodsAgree) {
  RandomStream random({.seed = 11});
  for (StaticsCase c : statics_cases)
    for (int trial = 0; trial < 200; ++trial) {
      const bool plane = c.robot.freedom == Freedom::plane_translation;
      StaticsCase moved = c;
      const Vec3 shift = random_vector(random, 0.04);
      moved.pose.position += {shift.x, shift.y, plane ? 0 : shift.z};
      if (c.robot.freedom == Freedom::space)
        moved.pose.rotation = math::turn_about(random_vector(random, 0.1)) * moved.pose.rotation;
      const Jacobians at = moved.at();
      const Wrench load{random_vector(random, 50), random_vector(random, 5)};
      const StaticLoads loads = static_loads(c.robot, at, moved.drives_state(), load);
      ASSERT_EQ(loads.status, Status::done);
      // tau = -J^T W, without the rods.
      const Matrix6 j = jacobian(c.robot, at);
      const Vector6 w = components(c.robot, load.force, load.moment);
      for (int i = 0; i < c.robot.legs(); ++i) {
        double torque = 0, size = 0;
        for (int k = 0; k < c.robot.legs(); ++k) {
          torque -= j[k][i] * w[k];
          size += std::abs(j[k][i] * w[k]);
        }
        // Rounding, some ten times that of the terms for the condition of Jx.
        EXPECT_NEAR(loads.arm_torque[i], torque, 1e-12 * size);
      }
      // The rods hold the platform.
      Vec3 force = load.force, moment = load.moment;
      for (int i = 0; i < c.robot.legs(); ++i) {
        const Vec3 push = loads.rod_force[i] / c.robot.leg[i].rod * at.rod[i];
        force += push;
        moment += cross(at.lever[i], push);
      }
      if (plane) force.z = 0;
      EXPECT_LT(norm(force), 1e-11);
      if (c.robot.freedom == Freedom::space) {
        EXPECT_LT(norm(moment), 1e-12);
      }
    }
}

TEST(Statics, SingularPosesAreTold) {
  // Level platform of the HEXA at the yaw where the rods do not hold it.
  StaticsCase yaw = statics_cases[1];
  yaw.pose = {{0, 0, -0.5},
              math::turn_z(test::numbers(test::at(computed("hexa-singular-yaw"), "yaw_rad"))[1])};
  const Wrench load{{1, 2, 3}, {0.1, 0, 0.2}};
  StaticLoads loads = static_loads(yaw.robot, yaw.at(), yaw.drives_state(), load);
  EXPECT_EQ(loads.status, Status::singular);
  EXPECT_EQ(loads.leg, -1);
  EXPECT_TRUE(std::isnan(loads.rod_force[0]));
  EXPECT_EQ(displacement(yaw.robot, elastic(yaw.drives), yaw.at(), yaw.drives_state(), load).status,
            Status::singular);
  // Its stiffness exists and is 0 in one direction, about z for the most part.
  const Stiffness soft = stiffness(yaw.robot, elastic(yaw.drives), yaw.at(), yaw.drives_state(), 0.09);
  EXPECT_EQ(soft.status, Status::done);
  EXPECT_NEAR(soft.eigenvalue[0], 0, 1e-9 * soft.eigenvalue[5]);
  EXPECT_GT(soft.eigenvalue[1], 1e-4 * soft.eigenvalue[5]);

  // An arm that its screw cannot hold: the leg and its effort are reported, torques and rod forces are kept.
  StaticsCase toggle = statics_cases[0];
  const Vector6 angles = toggle.angles();
  toggle.drives[1].mounting = angles[1] - pi / 2;
  loads = static_loads(toggle.robot, toggle.at(), toggle.drives_state(), load);
  EXPECT_EQ(loads.status, Status::singular);
  EXPECT_EQ(loads.leg, 1);
  EXPECT_TRUE(std::isnan(loads.drive_effort[1]));
  EXPECT_TRUE(std::isfinite(loads.drive_effort[0] + loads.arm_torque[1] + loads.rod_force[1]));
  const Stiffness limp =
      stiffness(toggle.robot, elastic(toggle.drives), toggle.at(), toggle.drives_state(), 1);
  EXPECT_NEAR(limp.eigenvalue[0], 0, 1e-9 * limp.eigenvalue[2]);
  // Beyond that the Pi-joint is not there.
  toggle.drives[1].mounting -= 0.1;
  loads = static_loads(toggle.robot, toggle.at(), toggle.drives_state(), load);
  EXPECT_EQ(loads.status, Status::no_assembly);
  EXPECT_EQ(loads.leg, 1);

  // A stretched leg needs no torque to hold along itself, and does not give way there unless it is elastic.
  StaticsCase stretched = statics_cases[0];
  stretched.pose = {{0, 0, test::number_at(computed("delta-singular"), "type1_z_m")}};
  stretched.drives = {};
  for (auto& d : stretched.drives) d.stiffness = 1e5;
  loads = static_loads(stretched.robot, stretched.at(), stretched.drives_state(), {{0, 0, -30}});
  EXPECT_EQ(loads.status, Status::done);
  EXPECT_NEAR(loads.arm_torque[0], 0, 1e-6);
  Stiffness k = stiffness(stretched.robot, stretched.drives, stretched.at(), stretched.drives_state(), 1);
  EXPECT_EQ(k.status, Status::singular);
  EXPECT_EQ(k.leg, 0);
  EXPECT_TRUE(std::isnan(k.eigenvalue[0]));
  LegStiffnesses own;
  own.fill({.rod = 1e7});
  k = stiffness(stretched.robot, stretched.drives, stretched.at(), stretched.drives_state(), 1, own);
  EXPECT_EQ(k.status, Status::done);
  const double cosine = (0.35 + 0.8) / -stretched.pose.position.z;  // 1 / cosine of the legs from z
  EXPECT_NEAR(k.matrix[2][2], 3 * 1e7 / (cosine * cosine), 1);
}

TEST(Statics, StiffnessTimesDisplacementIsTheLoad) {
  const Wrench load{{10, -20, 30}, {1, 2, -3}};
  for (StaticsCase c : statics_cases) {
    c.drives = elastic(c.drives);
    c.drives[1].stiffness = 4e6;
    LegStiffnesses own;
    own.fill({.rod = 2e7, .arm_along = 5e7, .arm_bending = 3e6, .arm_lateral = 1e6});
    for (const LegStiffnesses& legs : {LegStiffnesses{}, own}) {
      const Jacobians at = c.at();
      const DrivesAt drives = c.drives_state();
      const Displacement moved = displacement(c.robot, c.drives, at, drives, load, legs);
      const Stiffness k = stiffness(c.robot, c.drives, at, drives, 0.09, legs);
      const Vector6 x = components(c.robot, moved.shift, moved.turn);
      const Vector6 w = components(c.robot, load.force, load.moment);
      for (int i = 0; i < c.robot.legs(); ++i) {
        double sum = 0;
        for (int j = 0; j < c.robot.legs(); ++j) sum += k.matrix[i][j] * x[j];
        // A matrix of condition 1e3 at most: rounding.
        EXPECT_NEAR(sum, w[i], 1e-11 * 30);
      }
    }
    // Rigid legs and drives hold still.
    Drives rigid = c.drives;
    for (auto& d : rigid) d.stiffness = infinity;
    const Displacement none = displacement(c.robot, rigid, c.at(), c.drives_state(), load);
    EXPECT_EQ(none.status, Status::done);
    EXPECT_EQ(norm(none.shift), 0);
    EXPECT_EQ(stiffness(c.robot, rigid, c.at(), c.drives_state(), 1).status, Status::singular);
  }
}

// Displacement by another way: the springs are let go by what holds them, and the robot is put together anew.
TEST(Statics, DisplacementIsThatOfTheRobotWithItsSpringsPressed) {
  const Wrench load{{3, -2, -4}, {0.2, -0.1, 0.3}};
  for (StaticsCase c : statics_cases) {
    c.drives = elastic(c.drives);
    LegStiffnesses own;
    own.fill({.rod = 2e7});
    const StaticLoads held = static_loads(c.robot, c.at(), c.drives_state(), load);
    Robot pressed = c.robot;
    Vector6 angles = c.angles();
    const DrivesAt drives = c.drives_state();
    for (int i = 0; i < c.robot.legs(); ++i) {
      pressed.leg[i].rod -= held.rod_force[i] / own[i].rod;
      angles[i] -= held.drive_effort[i] / c.drives[i].stiffness / drives[i].rate;
    }
    const Placed placed = direct_near(pressed, angles, c.pose);
    const Displacement moved = displacement(c.robot, c.drives, c.at(), drives, load, own);
    const Vec3 shift = placed.pose.position - c.pose.position;
    // Some um; rest: second order of small displacements.
    EXPECT_GT(norm(shift), 1e-6);
    EXPECT_LT(norm(shift - moved.shift), 1e-9 + 1e-4 * norm(shift));
    if (c.robot.freedom != Freedom::space) continue;
    const Mat3 turn = placed.pose.rotation * math::transposed(c.pose.rotation);
    EXPECT_NEAR(moved.turn.z, turn.row[1].x, 1e-8);
    EXPECT_NEAR(moved.turn.x, turn.row[2].y, 1e-8);
  }
}

TEST(Statics, AllocateNothing) {
  const StaticsCase c = statics_cases[1];
  const Jacobians at = c.at();
  const DrivesAt drives = c.drives_state();
  const Drives springs = elastic(c.drives);
  const std::size_t before = test::allocations();
  static_loads(c.robot, at, drives, {{1, 2, 3}, {}});
  stiffness(c.robot, springs, at, drives, 0.09);
  displacement(c.robot, springs, at, drives, {{1, 2, 3}, {}});
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace linkwright::parallel
