// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/serial_arm/serial_arm.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "parallel/robots.h"
#include "support/allocations.h"

namespace linkwright::parallel {
namespace {

constexpr double degree = pi / 180;

// Pi-joints of the reference case, the second a mirror image.
SerialPiArm reference_arm() {
  SerialPiArm out{.offset = {0.06, -0.02}, .arm = {0.3, 0.25}};
  out.drive[0] = {.type = DriveType::pi_joint, .ratio = 0.4, .mounting = 30 * degree};
  out.drive[1] = {.type = DriveType::pi_joint, .ratio = 0.4, .mounting = 0, .mirror = -1};
  for (auto& d : out.drive) d.lowest = -1.5, d.highest = 1.5;
  return out;
}
SerialArmMasses reference_masses() {
  SerialArmMasses out{.payload = 0.8};
  out.joint[0] = {.arm_inertia = 0.03, .arm_mass = 0.9, .arm_centre = 0.14, .coupler_mass = 0.5};
  out.joint[1] = {.arm_inertia = 0.012, .arm_mass = 0.6, .arm_centre = 0.11, .coupler_mass = 0.3};
  return out;
}
SerialArmMasses pi_masses() {
  SerialArmMasses out{.payload = 0.8, .gravity = {0.5, -9.80665}};
  out.joint[0].pi = {.arm_inertia = 0.0153,
                     .arm_mass = 0.375,
                     .arm_centre = 0.15,
                     .coupler_mass = 0.25,
                     .nut_mass = 0.3,
                     .nut_centre = 0.03,
                     .nut_inertia = 2e-4,
                     .rod_mass = 0.12,
                     .rod_centre = 0.22,
                     .rod_inertia = 3e-4,
                     .rotor_inertia = 1.5e-6,
                     .lead = 0.005};
  out.joint[1].pi = out.joint[0].pi;
  out.joint[1].pi->rod_centre = 0.1;
  return out;
}

TEST(SerialPiArm, OfTheReference) {
  const SerialPiArm arm = reference_arm();
  ASSERT_FALSE(problem(arm));
  const Vec3 p = point(test::at(inputs("serial-pi-pi"), "p_m"));
  for (int mode : {1, -1}) {
    const Value& out = test::at(computed("serial-pi-pi"), mode == 1 ? "+1" : "-1");
    const auto numbers = [&](const char* key) { return test::numbers(test::at(out, key)); };
    const SerialAngles q = inverse(arm, {p.x, p.y}, mode);
    EXPECT_EQ(q.status, Status::done);
    const Matrix2 j = jacobian(arm, q.angle);
    const SerialDrives drives = drives_at(arm, q.angle);
    EXPECT_EQ(drives.status, Status::done);
    PerArm values{};
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(q.angle[k], numbers("q_rad")[k], 1e-14);
      EXPECT_NEAR(drives.drive[k].angle, numbers("theta_rad")[k], 1e-14);
      EXPECT_NEAR(values[k] = drives.drive[k].value, numbers("d_m")[k], 1e-15);
      const auto row = test::numbers(test::at(out, "J").as_array()[k]);
      for (int i = 0; i < 2; ++i) EXPECT_NEAR(j[k][i], row[i], 1e-15);
    }
    EXPECT_NEAR(determinant(arm, q.angle), test::number_at(out, "det_J"), 1e-15);
    const SerialAngles back = arm_angles(arm, values);
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(back.angle[k], q.angle[k], 1e-14);
  }
}

TEST(SerialPiArm, DirectUndoesInverse) {
  RandomStream random({.seed = 3});
  for (int trial = 0; trial < 100'000; ++trial) {
    SerialPiArm arm = reference_arm();
    arm.arm = {random.uniform(0.1, 0.5), random.uniform(0.1, 0.5)};
    // 1e-2 rad from the arms in line, where an angle loses digits like 1/sin.
    const double turn = (trial % 2 ? 1 : -1) * random.uniform(0.01, pi - 0.01);
    const double first = random.uniform(-pi, pi);
    const PerArm angles{first, math::wrap_angle(first + turn)};
    const math::Vec2 p = direct(arm, angles);
    const SerialAngles q = inverse(arm, p, turn > 0 ? 1 : -1);
    ASSERT_EQ(q.status, Status::done);
    const math::Vec2 again = direct(arm, q.angle);
    ASSERT_NEAR(again.x, p.x, 1e-12);
    ASSERT_NEAR(again.y, p.y, 1e-12);
    // Rounding of the point is turned by 1/(a sin) at most; near the first pivot by 1/r.
    ASSERT_NEAR(math::wrap_angle(q.angle[0] - angles[0]), 0, 1e-12);
    ASSERT_NEAR(math::wrap_angle(q.angle[1] - angles[1]), 0, 1e-12);
    ASSERT_GT(determinant(arm, q.angle) * turn, 0);
  }
}

TEST(SerialPiArm, Limits) {
  SerialPiArm arm = reference_arm();
  const auto at = [&](double r, int mode) {
    return inverse(arm, {arm.offset.x + r * 0.6, arm.offset.y + r * 0.8}, mode);
  };
  for (double r : {0.55, 0.05})
    for (int mode : {1, -1}) {
      const SerialAngles q = at(r, mode);
      EXPECT_EQ(q.status, Status::done) << r;
      EXPECT_NEAR(std::sin(q.angle[1] - q.angle[0]), 0, 1e-7);
      EXPECT_TRUE(quality(arm, q.angle).singular);
      EXPECT_GT(quality(arm, q.angle).condition, 1e6);
      EXPECT_EQ(arm_rates(arm, q.angle, {1, 0}, {}).status, Status::singular);
    }
  EXPECT_EQ(at(0.56, 1).status, Status::no_assembly);
  EXPECT_NEAR(at(0.56, 1).shortfall, 0.01, 1e-14);
  EXPECT_NEAR(at(0.04, 1).shortfall, -0.01, 1e-14);
  EXPECT_TRUE(std::isnan(at(0.04, 1).angle[0]));
  EXPECT_THROW(at(0.3, 0), ContractError);
  arm.arm[1] = 0.3;
  EXPECT_EQ(at(0, 1).status, Status::singular);
  EXPECT_EQ(at(1e-9, 1).status, Status::done);
  EXPECT_EQ(at(0.6, -1).status, Status::done);
  // Beyond what a Pi-joint can do, and what its screw cannot hold.
  const SerialDrives drives = drives_at(arm, {2.5, 0.2});
  EXPECT_EQ(drives.status, Status::no_assembly);
  EXPECT_EQ(drives.joint, 0);
  EXPECT_EQ(arm_angles(arm, {0.2, 0.5}).status, Status::no_assembly);
  const SerialLoads toggle = static_loads(arm, {0.2, pi / 2}, {0, -10});
  EXPECT_EQ(toggle.status, Status::singular);
  EXPECT_EQ(toggle.joint, 1);
  EXPECT_TRUE(std::isnan(toggle.drive_effort[1]));
  EXPECT_TRUE(std::isfinite(toggle.arm_torque[1] + toggle.drive_effort[0]));
  EXPECT_TRUE(quality(arm, {0.2, pi / 2}).singular);
  EXPECT_EQ(static_loads(arm, {2.5, 0.2}, {0, -10}).status, Status::no_assembly);
}

TEST(SerialPiArm, JacobianStaticsAndQuality) {
  const SerialPiArm arm = reference_arm();
  constexpr double h = 1e-6;
  const PerArm q{0.3, 1.1};
  const math::Vec2 force{7, -20};
  const Matrix2 j = jacobian(arm, q), total = total_jacobian(arm, q);
  const SerialLoads loads = static_loads(arm, q, force);
  const SerialDrives drives = drives_at(arm, q);
  for (int k = 0; k < 2; ++k) {
    PerArm up = q, down = q;
    up[k] += h;
    down[k] -= h;
    const math::Vec2 slope = 1 / (2 * h) * (direct(arm, up) - direct(arm, down));
    EXPECT_NEAR(j[0][k], slope.x, 1e-9);
    EXPECT_NEAR(j[1][k], slope.y, 1e-9);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(total[i][k], j[i][k] / drives.drive[k].rate, 1e-15);
    EXPECT_NEAR(loads.arm_torque[k], -(j[0][k] * force.x + j[1][k] * force.y), 1e-12);
    EXPECT_NEAR(loads.drive_effort[k], -(total[0][k] * force.x + total[1][k] * force.y), 1e-11);
  }
  // Singular values by what they are: extremes of |J x|.
  const SerialQuality quality_at = quality(arm, q);
  double most = 0, least = 1;
  for (int i = 0; i < 20000; ++i) {
    const double x = std::cos(i * 1e-3), y = std::sin(i * 1e-3);
    const double size = std::hypot(j[0][0] * x + j[0][1] * y, j[1][0] * x + j[1][1] * y);
    most = std::max(most, size);
    least = std::min(least, size);
  }
  EXPECT_NEAR(quality_at.singular_value[0], most, 1e-6);
  EXPECT_NEAR(quality_at.singular_value[1], least, 1e-6);
  EXPECT_NEAR(quality_at.condition, most / least, 1e-4);
  EXPECT_NEAR(quality_at.manipulability, std::abs(j[0][0] * j[1][1] - j[0][1] * j[1][0]), 1e-16);
  EXPECT_FALSE(quality_at.singular);
  // Isotropic with arms of equal length at a right angle.
  SerialPiArm equal = arm;
  equal.arm = {0.3, 0.3};
  EXPECT_NEAR(quality(equal, {0.2, 0.2 + pi / 2}).condition, 1, 1e-7);
}

TEST(SerialPiArm, StepsAndSpringsOfTheDrives) {
  SerialPiArm arm = reference_arm();
  const PerArm q{0.3, 1.1};
  EXPECT_EQ(compliance(arm, q)[0][0], 0);  // rigid
  arm.drive[0].quantum = 1e-6;
  arm.drive[1].quantum = 2e-6;
  arm.drive[0].stiffness = 2e6;
  arm.drive[1].stiffness = 5e6;
  const SerialDrives drives = drives_at(arm, q);
  const math::Vec2 start = direct(arm, q);
  const auto moved = [&](double first, double second) {
    const SerialAngles at = arm_angles(arm, {drives.drive[0].value + first, drives.drive[1].value + second});
    return direct(arm, at.angle) - start;
  };
  // By moves of the tool itself: over turns of some 3e-5 rad curvature is as much of them.
  const math::Vec2 one = moved(1e-6, 2e-6), other = moved(1e-6, -2e-6);
  const SerialResolution steps = resolution(arm, q);
  EXPECT_NEAR(steps.worst, std::max(norm(one), norm(other)), 1e-9);
  EXPECT_NEAR(steps.along.x, std::max(std::abs(one.x), std::abs(other.x)), 1e-9);
  EXPECT_NEAR(steps.along.y, std::max(std::abs(one.y), std::abs(other.y)), 1e-9);
  // The screws yield under the forces that hold a load, and so move the tool by the compliance.
  const math::Vec2 force{7, -20};
  const SerialLoads loads = static_loads(arm, q, force);
  const math::Vec2 shift = moved(-loads.drive_effort[0] / 2e6, -loads.drive_effort[1] / 5e6);
  const Matrix2 c = compliance(arm, q);
  EXPECT_EQ(c[0][1], c[1][0]);
  const math::Vec2 give{c[0][0] * force.x + c[0][1] * force.y, c[1][0] * force.x + c[1][1] * force.y};
  EXPECT_GT(std::abs(give.x), 1e-6);
  EXPECT_GT(std::abs(give.y), 1e-6);
  EXPECT_NEAR(shift.x, give.x, 1e-3 * std::abs(give.x));
  EXPECT_NEAR(shift.y, give.y, 1e-3 * std::abs(give.y));
}

TEST(SerialPiArm, ReachableArea) {
  SerialPiArm arm = reference_arm();
  arm.offset = {};
  int inside = 0;
  constexpr int n = 400;
  constexpr double side = 1.2;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k)
      inside += inverse(arm, {side * ((i + 0.5) / n - 0.5), side * ((k + 0.5) / n - 0.5)}, 1).status ==
                Status::done;
  // Some 1300 cells of 9 mm2 lie on the edges and are counted or not at random.
  EXPECT_NEAR(reachable_area(arm), inside * side * side / (n * n), 1e-3);
}

TEST(SerialPiArm, RatesAgreeWithDifferences) {
  const SerialPiArm arm = reference_arm();
  const math::Vec2 p{0.4, 0.22}, v{0.7, -0.4}, a{3, 5};
  constexpr double h = 1e-4;
  const auto angles = [&](double t) { return inverse(arm, p + t * v + t * t / 2 * a, -1).angle; };
  const SerialRates rates = arm_rates(arm, angles(0), v, a);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(rates.speed[k], (angles(h)[k] - angles(-h)[k]) / (2 * h), 1e-6);
    EXPECT_NEAR(rates.acceleration[k], (angles(h)[k] - 2 * angles(0)[k] + angles(-h)[k]) / (h * h), 1e-4);
  }
}

// Energies body by body: what turns about a pivot that moves, and what moves along.
struct Energies {
  double kinetic = 0, potential = 0;
};
Energies energies(const SerialPiArm& arm, const SerialArmMasses& masses, const PerArm& q,
                  const PerArm& speed) {
  Energies out;
  math::Vec2 pivot{}, v{};  // position of the frame of a joint
  const auto particle = [&](double mass, double x, double y, double vx, double vy) {
    out.kinetic += 0.5 * mass * (vx * vx + vy * vy);
    out.potential -= mass * (masses.gravity.x * x + masses.gravity.y * y);
  };
  // Mass at r along direction x from the pivot, r and x moving.
  const auto beside = [&](double mass, double r, double dr, double x, double dx) {
    const double c = std::cos(x), s = std::sin(x);
    particle(mass, pivot.x + r * c, pivot.y + r * s, v.x + dr * c - r * dx * s, v.y + dr * s + r * dx * c);
  };
  for (int k = 0; k < 2; ++k) {
    const SerialMasses& m = masses.joint[k];
    const double w = speed[k], length = arm.arm[k];
    if (m.pi) {
      const PiMasses& p = *m.pi;
      const PiJoint joint{length, arm.drive[k].ratio};
      const double mirror = arm.drive[k].mirror;
      const double theta = drive_at(arm.drive[k], length, q[k]).angle;
      const PiMotion d = diagonal_motion(joint, {theta, mirror * w, 0});
      const PiMotion phi = direction_motion(joint, {theta, mirror * w, 0});
      const double x = arm.drive[k].mounting + mirror * phi.value, dx = mirror * phi.rate;
      beside(2 * p.arm_mass, p.arm_centre, 0, q[k], w);
      beside(p.coupler_mass, length, 0, q[k], w);
      beside(p.nut_mass, p.nut_centre, 0, x, dx);
      beside(p.rod_mass, d.value - p.rod_centre, d.rate, x, dx);
      const double rotor = 2 * pi / p.lead * d.rate;
      const double arms = 2 * (p.arm_inertia - p.arm_mass * p.arm_centre * p.arm_centre);
      out.kinetic +=
          0.5 * (arms * w * w + (p.nut_inertia + p.rod_inertia) * dx * dx + p.rotor_inertia * rotor * rotor);
    } else {
      beside(m.arm_mass, m.arm_centre, 0, q[k], w);
      out.kinetic += 0.5 * (m.arm_inertia - m.arm_mass * m.arm_centre * m.arm_centre) * w * w;
      beside(m.coupler_mass, length, 0, q[k], w);
    }
    pivot.x += length * std::cos(q[k]);
    pivot.y += length * std::sin(q[k]);
    v.x -= length * w * std::sin(q[k]);
    v.y += length * w * std::cos(q[k]);
  }
  particle(masses.payload, pivot.x, pivot.y, v.x, v.y);
  return out;
}

TEST(SerialPiArm, TorquesAgreeWithLagrangesEquation) {
  const SerialPiArm arm = reference_arm();
  const PerArm q{0.3, 1.1}, speed{2.1, -1.4}, second{-12, 25};
  const math::Vec2 force{6, -15};
  SerialArmMasses mixed = pi_masses();
  mixed.joint[0] = reference_masses().joint[0];
  for (const SerialArmMasses& masses : {reference_masses(), pi_masses(), mixed}) {
    ASSERT_FALSE(problem(arm, masses));
    const SerialLoads loads = inverse_dynamics(arm, masses, q, speed, second, force);
    EXPECT_EQ(loads.status, Status::done);
    // Central differences deviate by some 1e-10 of the terms.
    constexpr double h = 1e-5;
    const Matrix2 j = jacobian(arm, q);
    for (int k = 0; k < 2; ++k) {
      const auto momentum = [&](double t) {
        PerArm at{}, up{};
        for (int i = 0; i < 2; ++i) {
          at[i] = q[i] + t * speed[i] + t * t / 2 * second[i];
          up[i] = speed[i] + t * second[i];
        }
        PerArm down = up;
        up[k] += 0.5;
        down[k] -= 0.5;
        return energies(arm, masses, at, up).kinetic - energies(arm, masses, at, down).kinetic;
      };
      PerArm up = q, down = q;
      up[k] += h;
      down[k] -= h;
      const Energies high = energies(arm, masses, up, speed), low = energies(arm, masses, down, speed);
      const double torque = (momentum(h) - momentum(-h)) / (2 * h) -
                            (high.kinetic - low.kinetic - high.potential + low.potential) / (2 * h) -
                            (j[0][k] * force.x + j[1][k] * force.y);
      EXPECT_NEAR(loads.arm_torque[k], torque, 1e-8 * (1 + std::abs(torque)));
      EXPECT_NEAR(loads.drive_power[k], torque * speed[k], 1e-7 * (1 + std::abs(torque)));
    }
  }
}

TEST(SerialPiArm, Problems) {
  SerialPiArm arm = reference_arm();
  arm.arm[1] = 0;
  EXPECT_EQ(problem(arm).value_or(""), "joint 2: arm = 0 m");
  arm = reference_arm();
  arm.drive[0].ratio = -1;
  EXPECT_EQ(problem(arm).value_or(""), "joint 1: ratio = -1");
  arm = reference_arm();
  arm.drive[1].mirror = 0;
  EXPECT_EQ(problem(arm).value_or(""), "joint 2: mirror = 0");
  arm = reference_arm();
  SerialArmMasses masses = pi_masses();
  masses.joint[1].pi->rod_mass = -1;
  EXPECT_EQ(problem(arm, masses).value_or(""), "joint 2: mass of the part at A = -1 kg");
  arm.drive[0] = {};
  EXPECT_EQ(problem(arm, pi_masses()).value_or(""), "joint 1: masses of a Pi-joint, but a motor drives it");
  masses = reference_masses();
  masses.payload = -1;
  EXPECT_EQ(problem(arm, masses).value_or(""), "payload = -1 kg");
}

TEST(SerialPiArm, AllocatesNothing) {
  const SerialPiArm arm = reference_arm();
  const SerialArmMasses masses = pi_masses();
  const std::size_t before = test::allocations();
  const SerialAngles q = inverse(arm, {0.4, 0.22}, -1);
  const SerialRates rates = arm_rates(arm, q.angle, {1, 2}, {3, 4});
  inverse_dynamics(arm, masses, q.angle, rates.speed, rates.acceleration);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace linkwright::parallel
