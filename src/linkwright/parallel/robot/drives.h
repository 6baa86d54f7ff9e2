// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/parallel/pi_joint/pi_joint.h"
#include "linkwright/parallel/robot/robot.h"

/// The drives of a robot's arms: motors at their pivots, or Pi-joints whose screws set their diagonals
/// (Milutinovic et al. 2014). A drive's value is the arm angle (rad) or the diagonal (m), and its effort the
/// torque (N m) or the screw's force (N).
namespace linkwright::parallel {

enum class DriveType { revolute, pi_joint };
constexpr std::array<EnumName<DriveType>, 2> names(DriveType) {
  return {{{DriveType::revolute, "revolute", "motor at the arm's pivot"},
           {DriveType::pi_joint, "pi_joint",
            "Pi-joint: the arm is one side of a parallelogram with a screw as diagonal"}}};
}

/// Drive of one arm. A Pi-joint's arm is the robot's arm; it is mounted so that alpha = mounting + mirror
/// theta.
struct Drive {
  DriveType type = DriveType::revolute;
  double ratio = 0.4;         ///< k of a Pi-joint
  double mounting = 0;        ///< arm angle at theta = 0 of a Pi-joint (rad)
  int mirror = 1;             ///< 1, or -1: theta turns against alpha
  double lowest = -infinity;  ///< travel: theta, or alpha of a motor (rad)
  double highest = infinity;
  double quantum = 0;           ///< smallest step of the value (m or rad)
  double stiffness = infinity;  ///< effort per value (N/m or N m/rad)
};
using Drives = std::array<Drive, max_legs>;

/// A drive at an arm angle.
struct DriveAt {
  /// no_assembly: a Pi-joint does not turn so far; limit_reached: beyond travel.
  Status status = Status::done;
  double angle = 0;  ///< theta, or alpha of a motor (rad)
  double value = 0;  ///< d (m), or alpha (rad)
  double rate = 1;   ///< j = dvalue/dalpha, with its sign: speed of the value = j dalpha/dt, torque of the
                     ///< arm = j effort (m, or 1)
  double slope = 0;  ///< dj/dalpha
  double transmission = 1;  ///< sin of the angle between diagonal and arm; 1 for a motor
};
/// `arm`: length of the arm (m). At +-90 deg of a Pi-joint its screw cannot hold the arm: rate 0.
DriveAt drive_at(const Drive& drive, double arm, double arm_angle);

/// The arm angle (rad, in (-pi, pi]) that a value gives; no_assembly where the diagonal cannot be.
struct ArmAngle {
  Status status = Status::done;
  double angle = 0;
};
ArmAngle arm_angle(const Drive& drive, double arm, double value);

using DrivesAt = std::array<DriveAt, max_legs>;
/// Drives of all legs; `status` and `leg` give the first that is not done.
struct DrivesState {
  Status status = Status::done;
  int leg = -1;
  DrivesAt drive{};
};
DrivesState drives_at(const Robot& robot, const Drives& drives, std::span<const double> arm_angles);

/// Rate and acceleration of the values for those of the arms.
Vector6 drive_speeds(const Robot& robot, const DrivesAt& at, std::span<const double> arm_speeds);
Vector6 drive_accelerations(const Robot& robot, const DrivesAt& at, std::span<const double> arm_speeds,
                            std::span<const double> arm_accelerations);
/// Efforts for torques at the arms; not finite where a Pi-joint is singular.
Vector6 drive_efforts(const Robot& robot, const DrivesAt& at, std::span<const double> arm_torques);

/// J diag(1/j): twist by rates of the values.
Matrix6 total_jacobian(const Robot& robot, const Matrix6& jacobian, const DrivesAt& at);

/// The displacement of the platform point by one step of each drive.
struct Resolution {
  Vec3 along{};      ///< bound along each axis (m)
  double worst = 0;  ///< largest displacement over all combinations of signs (m)
};
Resolution resolution(const Robot& robot, const Drives& drives, const Matrix6& total_jacobian);

/// Speed along every axis at once, for a speed 1 of each drive's value (rows of turning are in rad/s):
/// 1/max_i sum_r |Jtot^-1|_ir. Times the drives' speed it is what the platform can do in any direction of the
/// box.
double speed_factor(const Robot& robot, const Jacobians& at, const DrivesAt& drives);

}  // namespace linkwright::parallel
