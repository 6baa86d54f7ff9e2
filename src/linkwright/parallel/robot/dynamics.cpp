// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/dynamics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"

namespace linkwright::parallel {

namespace {

Vector6 nothing_known() {
  Vector6 out;
  out.fill(nan);
  return out;
}

// Masses of a rod seen from the accelerations of its ends, elbow first.
struct RodMasses {
  double elbow, both, platform;  // m11, m12, m22 of the consistent mass matrix
  double weight;                 // share of its weight at the platform (kg)
};

RodMasses rod_masses(const Leg& leg, const LegMasses& m) {
  if (m.rod_split)
    return {(1 - *m.rod_split) * m.rod_mass, 0, *m.rod_split * m.rod_mass, *m.rod_split * m.rod_mass};
  const double c = m.rod_centre, moment = m.rod_mass * c;
  const double transverse = m.rod_inertia ? *m.rod_inertia / (leg.rod * leg.rod) : m.rod_mass / 12;
  const double platform = moment * c + transverse;
  return {m.rod_mass - 2 * moment + platform, moment - platform, platform, moment};
}

Mat3 inertia_of(const PlatformMasses& m) {
  const auto& [xx, yy, zz] = m.inertia;
  const auto& [xy, yz, zx] = m.deviation;
  return {{Vec3{xx, xy, zx}, Vec3{xy, yy, yz}, Vec3{zx, yz, zz}}};
}

// A robot in a place, with what the equations of motion take from it.
struct Placement {
  Status status = Status::done;
  int leg = -1;
  bool known = false;  // the motion of the arms follows from that of the platform
  int toggle = -1;     // first leg whose Pi-joint is without lever
  Jacobians at;
  DrivesAt drives;
  Vector6 angle;
};

Placement placed(const Robot& robot, const Drives& drives, const WorkingMode& mode, const Pose& pose,
                 double limit) {
  Placement out;
  const ArmAngles arms = inverse(robot, pose, mode);
  out.angle = arms.angle;
  out.status = arms.status;
  out.leg = arms.leg;
  if (arms.status != Status::done) return out;
  out.at = jacobians(robot, pose, arms.angle);
  const DrivesState state = drives_at(robot, drives, arms.angle);
  out.drives = state.drive;
  // An impossible pose is reported before a singular one.
  for (int i = 0; i < robot.legs(); ++i) {
    out.leg = i;
    if ((out.status = out.drives[i].status) == Status::no_assembly) return out;
    out.status = Status::singular;
    if (std::abs(out.at.drive[i]) <= limit * robot.leg[i].arm * robot.leg[i].rod) return out;
    if (out.toggle < 0 && std::abs(out.drives[i].transmission) <= limit) out.toggle = i;
  }
  out.known = true;
  out.status = state.status;
  out.leg = state.leg;
  return out;
}

// Torque that the arm itself needs.
double own_torque(const Leg& leg, const Drive& drive, const DriveAt& drive_at, const LegMasses& m,
                  const Vec3& gravity, const Vec3& normal, double speed, double acceleration) {
  if (!m.pi) return m.arm_inertia * acceleration - m.arm_mass * m.arm_centre * dot(normal, gravity);
  const double c = std::cos(drive.mounting), s = std::sin(drive.mounting);
  const double ahead = dot(leg.ahead, gravity), aside = dot(leg.aside, gravity);
  const PiLoad load{.gravity_x = c * ahead + s * aside, .gravity_y = drive.mirror * (c * aside - s * ahead)};
  const PiMotion motion{drive_at.angle, drive.mirror * speed, drive.mirror * acceleration};
  return drive.mirror * effort({leg.arm, drive.ratio}, *m.pi, load, motion).torque;
}

// The efforts that a motion needs: at the platform, and at the arms apart from it.
struct Needs {
  Vector6 arm_acceleration{};
  Vector6 arm{};       // torque for the arm, its elbow and the rod's elbow end
  Vector6 platform{};  // wrench for the platform and the rods' platform ends, less the load
  std::array<Vec3, max_legs> elbow_end{}, platform_end{};  // forces on a rod apart from what passes through
};

Needs needs(const Robot& robot, const Drives& drives, const RobotMasses& masses, const Jacobians& at,
            const DrivesAt& drives_at, const Vector6& speed, const DynamicState& state, const Vec3& gravity,
            const Wrench& load) {
  Needs out;
  const auto& [linear, angular] = state.acceleration;
  const Vec3& turning = state.velocity.angular;
  out.arm_acceleration = arm_accelerations(robot, at, state.velocity, state.acceleration);
  const PlatformMasses& p = masses.platform;
  Vec3 force = (p.mass + p.payload) * (linear - gravity) - load.force, moment = -load.moment;
  if (robot.freedom == Freedom::space) {
    const Mat3& r = state.pose.rotation;
    const auto inertia = [&, body = inertia_of(p), back = math::transposed(r)](const Vec3& v) {
      return r * (body * (back * v));
    };
    moment += inertia(angular) + cross(turning, inertia(turning));
  }
  for (int i = 0; i < robot.legs(); ++i) {
    const Leg& leg = robot.leg[i];
    const LegMasses& m = masses.leg[i];
    const RodMasses rod = rod_masses(leg, m);
    const Vec3& lever = at.lever[i];
    const Vec3 joint = linear + cross(angular, lever) + cross(turning, cross(turning, lever));
    const Vec3 elbow = leg.arm * (out.arm_acceleration[i] * at.normal[i] - speed[i] * speed[i] * at.arm[i]);
    out.platform_end[i] = rod.both * elbow + rod.platform * joint - rod.weight * gravity;
    out.elbow_end[i] = rod.elbow * elbow + rod.both * joint - (m.rod_mass - rod.weight) * gravity;
    out.arm[i] = own_torque(leg, drives[i], drives_at[i], m, gravity, at.normal[i], speed[i],
                            out.arm_acceleration[i]) +
                 leg.arm * dot(at.normal[i], out.elbow_end[i] + m.elbow_mass * (elbow - gravity));
    force += out.platform_end[i];
    moment += cross(lever, out.platform_end[i]);
  }
  out.platform = components(robot, force, moment);
  return out;
}

// Everything seen from the platform: W + J^-T arm.
Vector6 at_platform(const Robot& robot, const Jacobians& at, const Vector6& wrench, const Vector6& arm) {
  Vector6 out = wrench;
  for (int i = 0; i < robot.legs(); ++i)
    for (int k = 0; k < robot.legs(); ++k) out[k] += arm[i] / at.drive[i] * at.platform[i][k];
  return out;
}

void require_motion(const Robot& robot, const DynamicState& state) {
  const auto& [v, w] = state.velocity;
  const auto& [a, e] = state.acceleration;
  if (robot.freedom != Freedom::space)
    LINKWRIGHT_REQUIRE(w == Vec3{} && e == Vec3{},
                       "a platform that does not turn has angular velocity ({}, {}, {}) rad/s", w.x, w.y,
                       w.z);
  if (robot.freedom == Freedom::plane_translation)
    LINKWRIGHT_REQUIRE(v.z == 0 && a.z == 0, "a planar platform moves along z: {} m/s, {} m/s2", v.z, a.z);
}

std::optional<std::string> problem(const LegMasses& m, const Drive& drive) {
  for (const auto& [value, lowest, highest, what] :
       {std::tuple{m.rod_mass, 0.0, infinity, "rod mass = {} kg"},
        {m.rod_centre, 0.0, 1.0, "rod centre at {} of its length"},
        {m.rod_inertia.value_or(0), 0.0, infinity, "rod inertia = {} kg m2"},
        {m.rod_split.value_or(0), 0.0, 1.0, "share {} of the rod's mass at the platform"},
        {m.elbow_mass, 0.0, infinity, "elbow mass = {} kg"},
        {m.arm_inertia, 0.0, infinity, "arm inertia = {} kg m2"},
        {m.arm_mass, 0.0, infinity, "arm mass = {} kg"},
        {m.arm_centre, -infinity, infinity, "arm centre at {} m"}})
    if (!(value >= lowest && value <= highest) || !std::isfinite(value))
      return fmt::format(fmt::runtime(what), value);
  if (!m.pi) return {};
  if (drive.type != DriveType::pi_joint) return "masses of a Pi-joint, but a motor drives it";
  return problem(*m.pi);
}

}  // namespace

RobotMasses equal_legs(const PlatformMasses& platform, const LegMasses& leg, const Vec3& gravity) {
  RobotMasses out{.platform = platform, .gravity = gravity};
  out.leg.fill(leg);
  return out;
}

std::optional<std::string> problem(const Robot& robot, const Drives& drives, const RobotMasses& masses) {
  const PlatformMasses& p = masses.platform;
  const auto& [a, b, c] = p.inertia;
  for (const auto& [value, what] :
       {std::pair{p.mass, "platform mass = {} kg"}, {p.payload, "payload = {} kg"}})
    if (!(value >= 0 && std::isfinite(value))) return fmt::format(fmt::runtime(what), value);
  // Two moments of inertia of a body are never less than the third, in whatever axes.
  if (!(a >= 0 && b >= 0 && c >= 0 && std::isfinite(a + b + c)) || a + b < c || b + c < a || c + a < b)
    return fmt::format("platform inertia = ({}, {}, {}) kg m2", a, b, c);
  for (int i = 0; i < robot.legs(); ++i)
    if (const auto found = problem(masses.leg[i], drives[i])) return fmt::format("leg {}: {}", i + 1, *found);
  return {};
}

DynamicLoads inverse_dynamics(const Robot& robot, const Drives& drives, const RobotMasses& masses,
                              const WorkingMode& mode, const DynamicState& state, const Wrench& load,
                              double limit) {
  require_motion(robot, state);
  const Placement place = placed(robot, drives, mode, state.pose, limit);
  DynamicLoads out{.status = place.status, .leg = place.leg, .arm_angle = place.angle};
  if (!place.known) {
    for (Vector6* v :
         {&out.arm_speed, &out.arm_acceleration, &out.arm_torque, &out.drive_value, &out.drive_speed,
          &out.drive_acceleration, &out.drive_effort, &out.drive_power, &out.rod_force})
      *v = nothing_known();
    out.platform_force.fill({nan, nan, nan});
    out.elbow_force.fill({nan, nan, nan});
    return out;
  }
  const Jacobians& at = place.at;
  out.arm_speed = arm_speeds(robot, at, state.velocity);
  const Needs need =
      needs(robot, drives, masses, at, place.drives, out.arm_speed, state, masses.gravity, load);
  out.arm_acceleration = need.arm_acceleration;
  Vector6 lambda = nothing_known();
  if (place.toggle >= 0) {
    out.status = Status::singular;
    out.leg = place.toggle;
  }
  if (std::abs(rods_determinant(robot, at)) > limit) {
    lambda = solve(robot, transposed(robot, at.platform), need.platform);
  } else {
    out.status = Status::singular;
    out.leg = -1;
  }
  for (int i = 0; i < robot.legs(); ++i) {
    const Vec3 through = lambda[i] * at.rod[i];
    out.platform_force[i] = through - need.platform_end[i];
    out.elbow_force[i] = need.elbow_end[i] + through;
    out.rod_force[i] = dot(out.platform_force[i], at.rod[i]) / robot.leg[i].rod;
    out.arm_torque[i] = need.arm[i] + at.drive[i] * lambda[i];
    out.drive_value[i] = place.drives[i].value;
  }
  out.drive_speed = drive_speeds(robot, place.drives, out.arm_speed);
  out.drive_acceleration = drive_accelerations(robot, place.drives, out.arm_speed, out.arm_acceleration);
  out.drive_effort = drive_efforts(robot, place.drives, out.arm_torque);
  for (int i = 0; i < robot.legs(); ++i) {
    if (std::abs(place.drives[i].transmission) <= limit) out.drive_effort[i] = nan;
    out.drive_power[i] = out.drive_effort[i] * out.drive_speed[i];
  }
  return out;
}

Matrix6 mass_matrix(const Robot& robot, const Drives& drives, const RobotMasses& masses, const Jacobians& at,
                    const Pose& pose, const DrivesAt& drives_at) {
  Matrix6 out{};
  for (int k = 0; k < robot.legs(); ++k) {
    Vector6 alone{};
    alone[k] = 1;
    const Needs need = needs(robot, drives, masses, at, drives_at, {},
                             {.pose = pose, .acceleration = twist(robot, alone)}, {}, {});
    const Vector6 column = at_platform(robot, at, need.platform, need.arm);
    for (int i = 0; i < robot.legs(); ++i) out[i][k] = column[i];
  }
  return out;
}

PlatformAcceleration direct_dynamics(const Robot& robot, const Drives& drives, const RobotMasses& masses,
                                     const WorkingMode& mode, const DynamicState& state,
                                     std::span<const double> drive_efforts, const Wrench& load,
                                     double limit) {
  LINKWRIGHT_REQUIRE(static_cast<int>(drive_efforts.size()) >= robot.legs(), "needs {} efforts, got {}",
                     robot.legs(), drive_efforts.size());
  require_motion(robot, state);
  const Placement place = placed(robot, drives, mode, state.pose, limit);
  PlatformAcceleration out{place.status, place.leg, {{nan, nan, nan}, {nan, nan, nan}}};
  if (!place.known) return out;
  const Vector6 speed = arm_speeds(robot, place.at, state.velocity);
  Needs need = needs(robot, drives, masses, place.at, place.drives, speed,
                     {.pose = state.pose, .velocity = state.velocity}, masses.gravity, load);
  for (int i = 0; i < robot.legs(); ++i) need.arm[i] -= drive_efforts[i] * place.drives[i].rate;
  Vector6 right = at_platform(robot, place.at, need.platform, need.arm);
  Matrix6 matrix = mass_matrix(robot, drives, masses, place.at, state.pose, place.drives);
  // Scaled to a diagonal of ones, so that turning compares with moving.
  Vector6 scale{};
  for (int i = 0; i < robot.legs(); ++i) scale[i] = 1 / std::sqrt(matrix[i][i]);
  for (int i = 0; i < robot.legs(); ++i) {
    right[i] *= -scale[i];
    for (int k = 0; k < robot.legs(); ++k) matrix[i][k] *= scale[i] * scale[k];
  }
  if (!(determinant(robot, matrix) > tolerance::closure)) {
    out.status = Status::singular;
    out.leg = -1;
    return out;
  }
  Vector6 x = solve(robot, matrix, right);
  for (int i = 0; i < robot.legs(); ++i) x[i] *= scale[i];
  out.acceleration = twist(robot, x);
  return out;
}

SplitError split_error(const Robot& robot, const Drives& drives, const RobotMasses& masses,
                       const WorkingMode& mode, std::span<const DynamicState> states, double share) {
  SplitError out;
  RobotMasses split = masses;
  for (LegMasses& leg : split.leg) leg.rod_split = share;
  RobotMasses whole = masses;
  for (LegMasses& leg : whole.leg) leg.rod_split.reset();
  for (const DynamicState& state : states) {
    const DynamicLoads exact = inverse_dynamics(robot, drives, whole, mode, state);
    if (exact.status != Status::done && exact.status != Status::limit_reached) continue;
    const DynamicLoads simplified = inverse_dynamics(robot, drives, split, mode, state);
    double error = 0, torque = 0;
    for (int i = 0; i < robot.legs(); ++i) {
      error = std::max(error, std::abs(simplified.arm_torque[i] - exact.arm_torque[i]));
      torque = std::max(torque, std::abs(exact.arm_torque[i]));
    }
    out.largest = std::max(out.largest, error / torque);
    out.mean += error / torque;
    ++out.states;
  }
  if (out.states == 0) return {nan, nan, 0};
  out.mean /= out.states;
  return out;
}

}  // namespace linkwright::parallel
