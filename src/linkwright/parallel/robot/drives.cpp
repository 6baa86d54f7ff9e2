// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/drives.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::parallel {

DriveAt drive_at(const Drive& drive, double arm, double arm_angle) {
  DriveAt out;
  if (drive.type == DriveType::revolute) {
    out.angle = out.value = arm_angle;
  } else {
    const PiJoint joint{arm, drive.ratio};
    out.angle = math::wrap_angle(drive.mirror * (arm_angle - drive.mounting));
    if (std::abs(out.angle) > pi / 2) {
      return {Status::no_assembly, out.angle, nan, nan, nan, nan};
    }
    out.value = diagonal(joint, out.angle);
    out.rate = drive.mirror * jacobian(joint, out.angle);
    out.slope = jacobian_slope(joint, out.angle);
    out.transmission = std::abs(out.rate) / arm;
  }
  if (!(out.angle >= drive.lowest && out.angle <= drive.highest)) out.status = Status::limit_reached;
  return out;
}

ArmAngle arm_angle(const Drive& drive, double arm, double value) {
  if (drive.type == DriveType::revolute) return {Status::done, math::wrap_angle(value)};
  const PiAngle theta = angle_of({arm, drive.ratio}, value);
  return {theta.status, math::wrap_angle(drive.mounting + drive.mirror * theta.angle)};
}

DrivesState drives_at(const Robot& robot, const Drives& drives, std::span<const double> arm_angles) {
  DrivesState out;
  for (int i = 0; i < robot.legs(); ++i) {
    out.drive[i] = drive_at(drives[i], robot.leg[i].arm, arm_angles[i]);
    if (out.drive[i].status == Status::done || out.leg >= 0) continue;
    out.status = out.drive[i].status;
    out.leg = i;
  }
  return out;
}

Vector6 drive_speeds(const Robot& robot, const DrivesAt& at, std::span<const double> arm_speeds) {
  Vector6 out{};
  for (int i = 0; i < robot.legs(); ++i) out[i] = at[i].rate * arm_speeds[i];
  return out;
}

Vector6 drive_accelerations(const Robot& robot, const DrivesAt& at, std::span<const double> arm_speeds,
                            std::span<const double> arm_accelerations) {
  Vector6 out{};
  for (int i = 0; i < robot.legs(); ++i)
    out[i] = at[i].rate * arm_accelerations[i] + at[i].slope * arm_speeds[i] * arm_speeds[i];
  return out;
}

Vector6 drive_efforts(const Robot& robot, const DrivesAt& at, std::span<const double> arm_torques) {
  Vector6 out{};
  for (int i = 0; i < robot.legs(); ++i) out[i] = arm_torques[i] / at[i].rate;
  return out;
}

Matrix6 total_jacobian(const Robot& robot, const Matrix6& jacobian, const DrivesAt& at) {
  Matrix6 out{};
  for (int row = 0; row < robot.legs(); ++row)
    for (int i = 0; i < robot.legs(); ++i) out[row][i] = jacobian[row][i] / at[i].rate;
  return out;
}

Resolution resolution(const Robot& robot, const Drives& drives, const Matrix6& total_jacobian) {
  const int n = robot.legs();
  const auto step = [&](int i) {
    return drives[i].quantum * Vec3{total_jacobian[0][i], total_jacobian[1][i],
                                    robot.freedom == Freedom::plane_translation ? 0 : total_jacobian[2][i]};
  };
  Resolution out;
  for (int i = 0; i < n; ++i) out.along += {std::abs(step(i).x), std::abs(step(i).y), std::abs(step(i).z)};
  // The opposite of a combination has the same length: the first sign stays.
  for (int signs = 0; signs < 1 << (n - 1); ++signs) {
    Vec3 sum = step(0);
    for (int i = 1; i < n; ++i) sum += (signs >> (i - 1) & 1 ? -1.0 : 1.0) * step(i);
    out.worst = std::max(out.worst, norm(sum));
  }
  return out;
}

double speed_factor(const Robot& robot, const Jacobians& at, const DrivesAt& drives) {
  double most = 0;
  for (int i = 0; i < robot.legs(); ++i) {
    double sum = 0;
    for (int r = 0; r < robot.legs(); ++r) sum += std::abs(at.platform[i][r]);
    most = std::max(most, sum * std::abs(drives[i].rate / at.drive[i]));
  }
  return 1 / most;
}

}  // namespace linkwright::parallel
