// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/statics.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/numbers.h"
#include "linkwright/math/singular_values.h"
#include "linkwright/parallel/robot/detail/legs_kernel.h"

namespace linkwright::parallel {

namespace {

Vector6 nothing_known() {
  Vector6 out;
  out.fill(nan);
  return out;
}

// A Pi-joint without lever.
bool lost(const DriveAt& drive, double limit) { return std::abs(drive.transmission) <= limit; }

// c of dx by lambda: Jx dx = -c lambda.
double compliance(const Leg& leg, const Drive& drive, const DriveAt& drive_at, const LegStiffness& own,
                  const Jacobians& at, int i) {
  const Vec3& s = at.rod[i];
  const double along = dot(s, at.arm[i]), bending = dot(s, at.normal[i]),
               lateral = dot(s, cross(at.arm[i], at.normal[i]));
  const double turning = at.drive[i] == 0 ? 0 : at.drive[i] / drive_at.rate;
  return turning * turning / drive.stiffness + leg.rod * leg.rod / own.rod + along * along / own.arm_along +
         bending * bending / own.arm_bending + lateral * lateral / own.arm_lateral;
}

bool elastic(const LegStiffness& own) {
  return std::isfinite(std::min({own.rod, own.arm_along, own.arm_bending, own.arm_lateral}));
}

// lambda of Jx^T lambda = -W.
Vector6 rod_factors(const Robot& robot, const Jacobians& at, const Wrench& load) {
  const Vector6 right = components(robot, -load.force, -load.moment);
  return solve(robot, transposed(robot, at.platform), right);
}

}  // namespace

double rods_determinant(const Robot& robot, const Jacobians& at) {
  double scale = robot.freedom == Freedom::space ? std::pow(platform_size(robot), 3) : 1;
  for (int i = 0; i < robot.legs(); ++i) scale *= robot.leg[i].rod;
  return determinant(robot, at) / scale;
}

StaticLoads static_loads(const Robot& robot, const Jacobians& at, const DrivesAt& drives, const Wrench& load,
                         double limit) {
  StaticLoads out;
  if (!(std::abs(rods_determinant(robot, at)) > limit)) {
    out.status = Status::singular;
    out.arm_torque = out.rod_force = out.drive_effort = nothing_known();
    return out;
  }
  const Vector6 lambda = rod_factors(robot, at, load);
  for (int i = 0; i < robot.legs(); ++i) {
    out.rod_force[i] = lambda[i] * robot.leg[i].rod;
    out.arm_torque[i] = lambda[i] * at.drive[i];
    if (!lost(drives[i], limit))
      out.drive_effort[i] = out.arm_torque[i] / drives[i].rate;
    else
      out.drive_effort[i] = nan;
    if (std::isfinite(out.drive_effort[i]) || out.leg >= 0) continue;
    out.leg = i;
    out.status = lost(drives[i], limit) ? Status::singular : Status::no_assembly;
  }
  return out;
}

Stiffness stiffness(const Robot& robot, const Drives& drives, const Jacobians& at, const DrivesAt& drives_at,
                    double characteristic_length, const LegStiffnesses& own, double limit) {
  Stiffness out;
  const int n = robot.legs();
  const auto scale = [&](int i) { return i < 3 ? 1 : characteristic_length; };
  Matrix6 scaled{};
  for (int leg = 0; leg < n; ++leg) {
    const Leg& l = robot.leg[leg];
    const double c = compliance(l, drives[leg], drives_at[leg], own[leg], at, leg);
    const bool aligned = std::abs(at.drive[leg]) <= limit * l.arm * l.rod;
    if (!(c > 0) || (aligned && !elastic(own[leg]))) {
      out.status = std::isnan(c) ? Status::no_assembly : Status::singular;
      out.leg = leg;
      for (auto& row : out.matrix) row = nothing_known();
      out.eigenvalue = out.softest = nothing_known();
      return out;
    }
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        const double entry = at.platform[leg][i] * at.platform[leg][k] / c;
        out.matrix[i][k] += entry;
        scaled[i][k] += entry / (scale(i) * scale(k));
      }
  }
  // A symmetric matrix without negative eigenvalues: they are its singular values.
  sized(robot, [&](auto size) {
    std::array<std::array<double, size>, size> matrix;
    for (int i = 0; i < size; ++i)
      for (int k = 0; k < size; ++k) matrix[i][k] = scaled[i][k];
    const auto values = math::singular_values<size>(matrix);
    std::array<int, size> order;
    for (int i = 0; i < size; ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](int a, int b) { return values.value[a] < values.value[b]; });
    for (int i = 0; i < size; ++i) {
      out.eigenvalue[i] = values.value[order[i]];
      out.softest[i] = values.right[i][order[0]];
    }
  });
  return out;
}

Displacement displacement(const Robot& robot, const Drives& drives, const Jacobians& at,
                          const DrivesAt& drives_at, const Wrench& load, const LegStiffnesses& own,
                          double limit) {
  const StaticLoads held = static_loads(robot, at, drives_at, load, limit);
  if (held.status != Status::done) return {held.status, {nan, nan, nan}, {nan, nan, nan}};
  Vector6 right{};
  for (int i = 0; i < robot.legs(); ++i)
    right[i] = -compliance(robot.leg[i], drives[i], drives_at[i], own[i], at, i) * held.rod_force[i] /
               robot.leg[i].rod;
  const Twist small = twist(robot, solve(robot, at.platform, right));
  return {.shift = small.linear, .turn = small.angular};
}

}  // namespace linkwright::parallel
