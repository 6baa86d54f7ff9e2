// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/serial_arm/serial_arm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::parallel {

namespace {

// Rounding of lengths near the limits of reach.
constexpr double arm_rounding = 4 * std::numeric_limits<double>::epsilon();

using math::dot, math::perpendicular, math::unit, math::Vec2;

// Motion of one arm.
struct Turning {
  double angle, speed, acceleration;
};

// The needs of an arm with its coupler: torque on it, and force on its frame from the frame before.
struct Need {
  double torque = 0;
  Vec2 force{};
};

// Second derivative of r u(x) for r and x that move.
Vec2 second(const PiMotion& r, const PiMotion& x) {
  const Vec2 u = unit(x.value);
  return (r.acceleration - r.value * x.rate * x.rate) * u +
         (2 * r.rate * x.rate + r.value * x.acceleration) * perpendicular(u);
}

Need need_of_pi(double length, const Drive& drive, const DriveAt& at, const PiMasses& m, const Turning& q,
                const Vec2& gravity) {
  if (at.status == Status::no_assembly) return {nan, {nan, nan}};
  const PiJoint joint{length, drive.ratio};
  const Vec2 x = unit(drive.mounting);
  const Vec2 y = double(drive.mirror) * perpendicular(x);
  const PiMotion theta{at.angle, drive.mirror * q.speed, drive.mirror * q.acceleration};
  const PiMotion d = diagonal_motion(joint, theta), phi = direction_motion(joint, theta);
  // First moments along arms and diagonal; their second derivatives give the load on the frame.
  const double arms = 2 * m.arm_mass * m.arm_centre + m.coupler_mass * length;
  const Vec2 inertial =
      second({arms, 0, 0}, theta) + second({m.nut_mass * m.nut_centre + m.rod_mass * (d.value - m.rod_centre),
                                            m.rod_mass * d.rate, m.rod_mass * d.acceleration},
                                           phi);
  const double mass = 2 * m.arm_mass + m.coupler_mass + m.nut_mass + m.rod_mass;
  return {drive.mirror *
              effort(joint, m, {.gravity_x = dot(gravity, x), .gravity_y = dot(gravity, y)}, theta).torque,
          inertial.x * x + inertial.y * y - mass * gravity};
}

Need need_of(double length, const Drive& drive, const DriveAt& at, const SerialMasses& m, const Turning& q,
             const Vec2& gravity) {
  if (m.pi) return need_of_pi(length, drive, at, *m.pi, q, gravity);
  const Vec2 u = unit(q.angle);
  const double moment = m.arm_mass * m.arm_centre + m.coupler_mass * length;
  const double inertia = m.arm_inertia + m.coupler_mass * length * length;
  return {
      inertia * q.acceleration - moment * dot(perpendicular(u), gravity),
      second({moment, 0, 0}, {q.angle, q.speed, q.acceleration}) - (m.arm_mass + m.coupler_mass) * gravity};
}

// Values and efforts of the drives for torques of the arms.
SerialLoads with_efforts(const SerialDrives& drives, const PerArm& torques, const PerArm& speeds,
                         const PerArm& accelerations, double limit) {
  SerialLoads out{.status = drives.status, .joint = drives.joint, .arm_torque = torques};
  for (int k = 1; k >= 0; --k) {
    const DriveAt& at = drives.drive[k];
    const bool lost = std::abs(at.transmission) <= limit;
    out.drive_value[k] = at.value;
    out.drive_speed[k] = at.rate * speeds[k];
    out.drive_acceleration[k] = at.rate * accelerations[k] + at.slope * speeds[k] * speeds[k];
    out.drive_effort[k] = lost ? nan : torques[k] / at.rate;
    out.drive_power[k] = out.drive_effort[k] * out.drive_speed[k];
    if (!lost || out.status == Status::no_assembly) continue;
    out.status = Status::singular;
    out.joint = k;
  }
  return out;
}

std::optional<std::string> problem(const SerialMasses& m, const Drive& drive) {
  for (const auto& [value, what] : {std::pair{m.arm_inertia, "arm inertia = {} kg m2"},
                                    {m.arm_mass, "arm mass = {} kg"},
                                    {m.coupler_mass, "coupler mass = {} kg"}})
    if (!(value >= 0 && std::isfinite(value))) return fmt::format(fmt::runtime(what), value);
  if (!std::isfinite(m.arm_centre)) return fmt::format("arm centre at {} m", m.arm_centre);
  if (!m.pi) return {};
  if (drive.type != DriveType::pi_joint) return "masses of a Pi-joint, but a motor drives it";
  return problem(*m.pi);
}

}  // namespace

std::optional<std::string> problem(const SerialPiArm& arm) {
  for (const double value : {arm.base.x, arm.base.y, arm.offset.x, arm.offset.y})
    if (!std::isfinite(value)) return "base or offset is not finite";
  for (int k = 0; k < 2; ++k) {
    if (!(arm.arm[k] > 0 && std::isfinite(arm.arm[k])))
      return fmt::format("joint {}: arm = {} m", k + 1, arm.arm[k]);
    const Drive& drive = arm.drive[k];
    if (drive.type == DriveType::pi_joint && !(drive.ratio > 0 && std::isfinite(drive.ratio)))
      return fmt::format("joint {}: ratio = {}", k + 1, drive.ratio);
    if (drive.mirror != 1 && drive.mirror != -1)
      return fmt::format("joint {}: mirror = {}", k + 1, drive.mirror);
  }
  return {};
}

std::optional<std::string> problem(const SerialPiArm& arm, const SerialArmMasses& masses) {
  if (!(masses.payload >= 0 && std::isfinite(masses.payload)))
    return fmt::format("payload = {} kg", masses.payload);
  for (int k = 0; k < 2; ++k)
    if (const auto found = problem(masses.joint[k], arm.drive[k]))
      return fmt::format("joint {}: {}", k + 1, *found);
  return {};
}

SerialAngles inverse(const SerialPiArm& arm, const Vec2& point, int mode) {
  LINKWRIGHT_REQUIRE(mode == 1 || mode == -1, "mode is {}, not 1 or -1", mode);
  const auto [a, b] = arm.arm;
  const Vec2 v = point - arm.base - arm.offset;
  const double r = std::hypot(v.x, v.y), far = a + b, near = std::abs(a - b);
  const double slack = arm_rounding * (far + std::abs(point.x) + std::abs(point.y));
  SerialAngles out{.angle = {nan, nan}};
  if (!(r <= far + slack && r >= near - slack)) {
    out.status = Status::no_assembly;
    out.shortfall = r > far ? r - far : r - near;
    return out;
  }
  if (r <= slack) {
    out.status = Status::singular;
    return out;
  }
  // Half the angle between the arms by its tangent: no cosine near its limits.
  const double low = std::max(0.0, (r - near) * (r + near)), high = std::max(0.0, (far - r) * (far + r));
  const double turn = 2 * mode * std::atan2(std::sqrt(high), std::sqrt(low));
  // The two arms as one link at an angle from the first.
  const double first = angle_of(v) - std::atan2(b * std::sin(turn), a + b * std::cos(turn));
  out.angle = {math::wrap_angle(first), math::wrap_angle(first + turn)};
  return out;
}

Vec2 direct(const SerialPiArm& arm, const PerArm& angles) {
  return arm.base + arm.offset + arm.arm[0] * unit(angles[0]) + arm.arm[1] * unit(angles[1]);
}

Matrix2 jacobian(const SerialPiArm& arm, const PerArm& q) {
  return {std::array{-arm.arm[0] * std::sin(q[0]), -arm.arm[1] * std::sin(q[1])},
          {arm.arm[0] * std::cos(q[0]), arm.arm[1] * std::cos(q[1])}};
}

double determinant(const SerialPiArm& arm, const PerArm& q) {
  return arm.arm[0] * arm.arm[1] * std::sin(q[1] - q[0]);
}

double reachable_area(const SerialPiArm& arm) { return 4 * pi * arm.arm[0] * arm.arm[1]; }

SerialDrives drives_at(const SerialPiArm& arm, const PerArm& angles) {
  SerialDrives out;
  for (int k = 0; k < 2; ++k) {
    out.drive[k] = drive_at(arm.drive[k], arm.arm[k], angles[k]);
    if (out.drive[k].status == Status::done || out.joint >= 0) continue;
    out.status = out.drive[k].status;
    out.joint = k;
  }
  return out;
}

SerialAngles arm_angles(const SerialPiArm& arm, const PerArm& values) {
  SerialAngles out;
  for (int k = 0; k < 2; ++k) {
    const ArmAngle at = arm_angle(arm.drive[k], arm.arm[k], values[k]);
    out.angle[k] = at.angle;
    if (at.status != Status::done) out.status = at.status;
  }
  return out;
}

Matrix2 total_jacobian(const SerialPiArm& arm, const PerArm& angles) {
  Matrix2 out = jacobian(arm, angles);
  const SerialDrives drives = drives_at(arm, angles);
  for (auto& row : out)
    for (int k = 0; k < 2; ++k) row[k] /= drives.drive[k].rate;
  return out;
}

SerialResolution resolution(const SerialPiArm& arm, const PerArm& angles) {
  const Matrix2 total = total_jacobian(arm, angles);
  SerialResolution out;
  const Vec2 first = arm.drive[0].quantum * Vec2{total[0][0], total[1][0]};
  const Vec2 other = arm.drive[1].quantum * Vec2{total[0][1], total[1][1]};
  out.along = {std::abs(first.x) + std::abs(other.x), std::abs(first.y) + std::abs(other.y)};
  out.worst = std::max(norm(first + other), norm(first - other));
  return out;
}

Matrix2 compliance(const SerialPiArm& arm, const PerArm& angles) {
  const Matrix2 total = total_jacobian(arm, angles);
  Matrix2 out{};
  for (int r = 0; r < 2; ++r)
    for (int c = 0; c < 2; ++c)
      for (int k = 0; k < 2; ++k) out[r][c] += total[r][k] * total[c][k] / arm.drive[k].stiffness;
  return out;
}

SerialQuality quality(const SerialPiArm& arm, const PerArm& angles, double limit) {
  SerialQuality out{.sine = std::sin(angles[1] - angles[0])};
  out.manipulability = std::abs(determinant(arm, angles));
  // Columns of lengths a1, a2: (s1 +- s2)^2 = a1^2 + a2^2 +- 2 |det|.
  const double squares = arm.arm[0] * arm.arm[0] + arm.arm[1] * arm.arm[1], twice = 2 * out.manipulability;
  const double sum = std::sqrt(squares + twice), difference = std::sqrt(std::max(0.0, squares - twice));
  out.singular_value[0] = 0.5 * (sum + difference);
  // By the product: no digits lost where it is small.
  out.singular_value[1] = out.manipulability / out.singular_value[0];
  out.condition = out.manipulability > 0 ? out.singular_value[0] / out.singular_value[1] : infinity;
  out.singular = std::abs(out.sine) <= limit;
  const SerialDrives drives = drives_at(arm, angles);
  for (int k = 0; k < 2; ++k) {
    out.transmission[k] = drives.drive[k].transmission;
    out.singular = out.singular || std::abs(out.transmission[k]) <= limit;
  }
  return out;
}

SerialLoads static_loads(const SerialPiArm& arm, const PerArm& angles, const Vec2& force, double limit) {
  return inverse_dynamics(arm, {}, angles, {}, {}, force, limit);
}

SerialLoads inverse_dynamics(const SerialPiArm& arm, const SerialArmMasses& masses, const PerArm& angles,
                             const PerArm& speeds, const PerArm& accelerations, const Vec2& force,
                             double limit) {
  const SerialDrives drives = drives_at(arm, angles);
  // The frame of each joint in turn, its acceleration as part of gravity.
  Vec2 gravity = masses.gravity;
  std::array<Need, 2> need;
  for (int k = 0; k < 2; ++k) {
    const Turning q{angles[k], speeds[k], accelerations[k]};
    need[k] = need_of(arm.arm[k], arm.drive[k], drives.drive[k], masses.joint[k], q, gravity);
    gravity = gravity - second({arm.arm[k], 0, 0}, {q.angle, q.speed, q.acceleration});
  }
  // From the tool inwards: what an arm carries at its end.
  Vec2 carried = -masses.payload * gravity - force;
  PerArm torques{};
  for (int k = 1; k >= 0; --k) {
    torques[k] = need[k].torque + arm.arm[k] * dot(perpendicular(unit(angles[k])), carried);
    carried = carried + need[k].force;
  }
  return with_efforts(drives, torques, speeds, accelerations, limit);
}

SerialRates arm_rates(const SerialPiArm& arm, const PerArm& angles, const Vec2& velocity,
                      const Vec2& acceleration, double limit) {
  const double sine = std::sin(angles[1] - angles[0]);
  if (!(std::abs(sine) > limit)) return {Status::singular, {nan, nan}, {nan, nan}};
  // a1 x1 u1' + a2 x2 u2' = w: across the other arm, u1' . u2 = sine = -u2' . u1.
  const Vec2 u1 = unit(angles[0]), u2 = unit(angles[1]);
  const auto solve = [&](const Vec2& w) {
    return PerArm{dot(w, u2) / (arm.arm[0] * sine), -dot(w, u1) / (arm.arm[1] * sine)};
  };
  SerialRates out{.speed = solve(velocity)};
  const auto& [w1, w2] = out.speed;
  out.acceleration = solve(acceleration + arm.arm[0] * w1 * w1 * u1 + arm.arm[1] * w2 * w2 * u2);
  return out;
}

}  // namespace linkwright::parallel
