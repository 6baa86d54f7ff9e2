// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/drives.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

struct Reference {
  const char* id;
  Robot robot;
  Drives drives;
  WorkingMode mode = all_positive;
};

Reference references[] = {{"delta-pose-0_0_-0.8", reference_delta(), reference_drives()},
                          {"delta-pose-0.2_-0.1_-0.85", reference_delta(), reference_drives()},
                          {"delta-pose--0.15_0.25_-0.7", reference_delta(), reference_drives()},
                          {"delta-pose-0.3_0.2_-0.9", reference_delta(), reference_drives()},
                          {"hexa-pose-home", reference_hexa(), reference_drives()},
                          {"hexa-pose-tilted", reference_hexa(), reference_drives()},
                          {"five-bar-pi", reference_five_bar(), mirrored_drives(), {-1, 1}},
                          {"const-orientation-pose", reference_platform(), mirrored_drives(), {-1, 1}}};

TEST(Drives, OfTheReferencePoses) {
  for (const auto& [id, robot, drives, mode] : references) {
    SCOPED_TRACE(id);
    Pose pose{point(test::at(inputs(id), "p_m"))};
    if (inputs(id).find("rotation_matrix"))
      for (int i = 0; i < 3; ++i)
        pose.rotation.row[i] = point(test::at(inputs(id), "rotation_matrix").as_array()[i]);
    const auto angles = inverse(robot, pose, mode).angle;
    const DrivesState at = drives_at(robot, drives, angles);
    const Matrix6 total = total_jacobian(robot, jacobian(robot, jacobians(robot, pose, angles)), at.drive);
    const Value& out = computed(id);
    EXPECT_EQ(at.status == Status::done, test::at(out, "pi_range_ok").as_bool());
    for (int i = 0; i < robot.legs(); ++i) {
      const auto expected = [&](const char* key) { return test::numbers(test::at(out, key))[i]; };
      EXPECT_NEAR(at.drive[i].angle, expected("theta_rad"), 1e-12);
      EXPECT_NEAR(at.drive[i].value, expected("d_m"), 1e-13);
      EXPECT_NEAR(at.drive[i].rate, expected("Jeff_m"), 1e-13);
      const auto row = test::numbers(test::at(out, "J_total").as_array()[i]);
      for (int k = 0; k < robot.legs(); ++k) EXPECT_NEAR(total[i][k], row[k], 1e-9);
      EXPECT_NEAR(arm_angle(drives[i], robot.leg[i].arm, at.drive[i].value).angle, angles[i], 1e-14);
    }
    const Resolution step = resolution(robot, drives, total);
    const auto box = test::numbers(test::at(out, "resolution_box_m"));
    EXPECT_NEAR(step.along.x, box[0], 1e-15);
    EXPECT_NEAR(step.along.y, box[1], 1e-15);
    EXPECT_NEAR(step.worst, test::number_at(out, "resolution_worst_m"), 1e-15);
  }
}

TEST(Drives, MapOfResolutionAndSpeed) {
  const Robot robot = reference_delta();
  const Drives drives = reference_drives();
  const auto& rows = test::at(computed("delta-resolution-map"), "rows").as_array();
  ASSERT_GT(rows.size(), 50u);
  for (const Value& row : rows) {
    const auto expected = test::numbers(row);
    const Pose pose{{expected[0], expected[1], expected[2]}};
    const auto angles = inverse(robot, pose).angle;
    const Jacobians at = jacobians(robot, pose, angles);
    const DrivesState state = drives_at(robot, drives, angles);
    EXPECT_EQ(state.status, Status::done);
    const Resolution step =
        resolution(robot, drives, total_jacobian(robot, jacobian(robot, at), state.drive));
    EXPECT_NEAR(std::max({step.along.x, step.along.y, step.along.z}), expected[3], 1e-15);
    EXPECT_NEAR(step.worst, expected[4], 1e-15);
    EXPECT_NEAR(1 / quality(robot, at, 1).condition, expected[5], 1e-12);
    EXPECT_NEAR(speed_factor(robot, at, state.drive), expected[6], 1e-11);
  }
}

TEST(Drives, AMirroredPiJointTurnsTheOtherWay) {
  Drive drive = mirrored_drives()[1];
  ASSERT_EQ(drive.mirror, -1);
  constexpr double arm = 0.25, h = 1e-6;
  RandomStream random({.seed = 4});
  for (int trial = 0; trial < 200; ++trial) {
    const double alpha = drive.mounting + random.uniform(-1.2, 1.2) + 2 * pi * (trial % 3 - 1);
    const DriveAt at = drive_at(drive, arm, alpha), before = drive_at(drive, arm, alpha - h),
                  after = drive_at(drive, arm, alpha + h);
    EXPECT_LT(at.rate, 0);
    EXPECT_NEAR(at.angle, math::wrap_angle(drive.mounting - alpha), 1e-14);
    EXPECT_NEAR(at.rate, (after.value - before.value) / (2 * h), 1e-9);
    EXPECT_NEAR(at.slope, (after.rate - before.rate) / (2 * h), 1e-9);
  }
}

TEST(Drives, TellWhereAPiJointEnds) {
  Drive drive = reference_drives()[0];
  EXPECT_EQ(drive_at(drive, 0.35, drive.mounting + 61 * degree).status, Status::limit_reached);
  EXPECT_EQ(drive_at(drive, 0.35, drive.mounting + 95 * degree).status, Status::no_assembly);
  EXPECT_TRUE(std::isnan(drive_at(drive, 0.35, drive.mounting + 95 * degree).value));
  // At a right angle the screw has no lever.
  drive.highest = 2;
  const DriveAt toggle = drive_at(drive, 0.35, drive.mounting + pi / 2);
  EXPECT_EQ(toggle.status, Status::done);
  EXPECT_NEAR(toggle.rate, 0, 1e-16);
  EXPECT_EQ(arm_angle(drive, 0.35, 0.6).status, Status::no_assembly);
  // The first leg with the trouble is reported.
  const Robot robot = reference_delta();
  const DrivesState state = drives_at(robot, reference_drives(), std::array{0.5, -1.0, 3.0});
  EXPECT_EQ(state.status, Status::limit_reached);
  EXPECT_EQ(state.leg, 1);
}

TEST(Drives, AMotorIsItsArm) {
  const Robot robot = reference_five_bar();
  const Drives motors{};
  const std::array angles{1.9, 0.9};
  const DrivesState at = drives_at(robot, motors, angles);
  EXPECT_EQ(at.status, Status::done);
  EXPECT_EQ(at.drive[0].value, 1.9);
  EXPECT_EQ(drive_efforts(robot, at.drive, std::array{3.0, -2.0})[1], -2.0);
  EXPECT_EQ(drive_accelerations(robot, at.drive, std::array{5.0, 6.0}, std::array{7.0, 8.0})[0], 7.0);
  EXPECT_EQ(drive_speeds(robot, at.drive, std::array{5.0, 6.0})[1], 6.0);
  EXPECT_EQ(arm_angle(motors[0], 0.25, 7.0).angle, math::wrap_angle(7.0));
}

}  // namespace
}  // namespace linkwright::parallel
