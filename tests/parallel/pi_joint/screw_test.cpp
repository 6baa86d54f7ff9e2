// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/screw.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/parallel/pi_joint/samples.h"
#include "parallel/pi_joints.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

using math::radians;
using test::number_at;
using test::numbers;

TEST(PiScrew, ActuatorOfThePrototype) {
  const Value &given = inputs("pi-prototype-actuator"), &expected = computed("pi-prototype-actuator");
  PiDrive drive = pi_prototype_drive();
  const double turning = number_at(given, "rpm") * 2 * pi / 60;
  expect_same(rate_of(drive.screw, turning), number_at(expected, "speed_from_rpm_m_s"));
  expect_same(quantum(drive) * number_at(given, "pps"), number_at(expected, "speed_from_pps_m_s"));
  expect_same(drive.screw.lead / number_at(given, "step_m"), number_at(expected, "steps_per_rev"));
  // The printed 50 mm/s are less than its motor can do.
  EXPECT_EQ(top_rate(drive), 0.05);
  drive.rate_limit = INFINITY;
  expect_same(top_rate(drive), 0.0508);
  expect_same(motor_speed_of(drive.screw, 0.0508), turning);
}

TEST(PiScrew, OutputOfThePrototype) {
  const Value& expected = computed("pi-prototype-output");
  const auto at = numbers(test::at(inputs("pi-prototype-output"), "theta_deg"));
  const auto torque = numbers(test::at(expected, "torque_Nm"));
  const auto speed = numbers(test::at(expected, "speed_rad_s"));
  const auto resolution = numbers(test::at(expected, "resolution_rad"));
  ASSERT_EQ(at.size(), 5u);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const PiOutput found = output(pi_prototype(), pi_prototype_drive(), radians(at[i]));
    expect_same(found.torque, torque[i]);
    expect_same(found.speed, speed[i]);
    expect_same(found.resolution, resolution[i]);
  }
  expect_same(motor_torque(pi_prototype_drive().screw, 130, 0),
              number_at(expected, "motor_torque_times_eta_Nm"));
}

TEST(PiScrew, CurvesOfFigures15To17) {
  const Value& curves = *computed("pi-curves").find("prototype");
  const auto at = numbers(test::at(curves, "theta_deg")), torque = numbers(test::at(curves, "torque_Nm"));
  const auto speed = numbers(test::at(curves, "speed_rad_s"));
  const auto resolution = numbers(test::at(curves, "resolution_rad"));
  ASSERT_EQ(at.size(), 25u);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const PiOutput found = output(pi_prototype(), pi_prototype_drive(), radians(at[i]));
    expect_same(found.torque, torque[i]);
    expect_same(found.speed, speed[i]);
    expect_same(found.resolution, resolution[i]);
  }
}

TEST(PiScrew, NothingComesThroughAtTheEnds) {
  const PiOutput end = output(pi_prototype(), pi_prototype_drive(), -pi / 2);
  EXPECT_EQ(end.torque, 0);
  EXPECT_EQ(end.speed, INFINITY);
  EXPECT_EQ(end.resolution, INFINITY);
  EXPECT_EQ(available_torque(pi_prototype(), pi_prototype_drive(), -pi / 2, 1), 0);
  // Nor does a drive without limits give a torque there: no 0 times infinity.
  EXPECT_EQ(output(pi_prototype(), {.screw = {.lead = 0.002}}, -pi / 2).torque, 0);
  EXPECT_EQ(output(pi_prototype(), {.screw = {.lead = 0.002}}, -pi / 2).resolution, 0);
}

TEST(PiScrew, PowerThroughTheScrew) {
  const PiScrew ball{.lead = 0.005, .efficiency = 0.9}, trapezoidal{.lead = 0.002, .efficiency = 0.35};
  // Energy of one turn: the motor feeds the load and the friction, which takes the same both ways.
  const double friction = 1000 * 0.005 * (1 / 0.9 - 1);
  for (double force : {1000.0, -1000.0})
    for (double rate : {0.1, -0.1}) {
      const double fed = motor_torque(ball, force, rate) * (rate > 0 ? 2 * pi : -2 * pi);
      expect_same(fed, force * (rate > 0 ? 0.005 : -0.005) + friction);
    }
  EXPECT_EQ(motor_torque(ball, 1000, 0), motor_torque(ball, 1000, 0.1));
  EXPECT_FALSE(self_locking(ball));
  EXPECT_TRUE(self_locking(trapezoidal));
  EXPECT_TRUE(self_locking({.lead = 0.002, .efficiency = 0.5}));
  // Let down, a load on a self-locking screw needs help.
  EXPECT_LT(motor_torque(trapezoidal, 1000, -0.1), 0);
}

TEST(PiScrew, ForceAlongATorqueCurve) {
  PiDrive drive{.screw = {.lead = 2 * pi * 0.001, .efficiency = 0.8},
                .motor = {.torque = {{0, 2}, {100, 2}, {300, 1}}},
                .force_limit = 1500};
  ASSERT_EQ(problem(drive), std::nullopt);
  // 1 N m makes 800 N; rates are a thousandth of the motor's speed.
  EXPECT_EQ(available_force(drive, 0), 1500);
  drive.force_limit = INFINITY;
  EXPECT_DOUBLE_EQ(available_force(drive, 0), 1600);
  EXPECT_DOUBLE_EQ(available_force(drive, -0.1), 1600);
  EXPECT_DOUBLE_EQ(available_force(drive, 0.2), 1200);
  EXPECT_DOUBLE_EQ(available_force(drive, top_rate(drive)), 800);
  EXPECT_EQ(available_force(drive, 0.3001), 0);
  // Held back, friction helps: eta_b = 0.75.
  EXPECT_DOUBLE_EQ(available_force(drive, 0.2, PowerFlow::load_drives), 1500 / 0.75);
  drive.screw.efficiency = 0.5;
  drive.force_limit = 700;
  EXPECT_EQ(available_force(drive, 0.2, PowerFlow::load_drives), 700);
  drive.motor.top_speed = 150;
  EXPECT_DOUBLE_EQ(top_rate(drive), 0.15);
  EXPECT_EQ(available_force(drive, 0.16), 0);
  drive.motor = {.torque = {{0, 0.5}}};
  EXPECT_EQ(top_rate(drive), INFINITY);
  EXPECT_DOUBLE_EQ(available_force(drive, 10), 250);
}

TEST(PiScrew, TorqueFallsWithTheSpeedOfTheJoint) {
  const PiDrive drive{.screw = {.lead = 2 * pi * 0.001}, .motor = {.torque = {{0, 2}, {300, 0}}}};
  const double j = jacobian(pi_prototype(), 0.3);
  EXPECT_DOUBLE_EQ(available_torque(pi_prototype(), drive, 0.3, 0), j * 2000);
  EXPECT_DOUBLE_EQ(available_torque(pi_prototype(), drive, 0.3, 0.15 / j), j * 1000);
  EXPECT_EQ(available_torque(pi_prototype(), drive, 0.3, 0.31 / j), 0);
}

TEST(PiScrew, TellsWhatIsWrong) {
  const auto with = [](auto&& change) {
    PiDrive drive = pi_prototype_drive();
    change(drive);
    return problem(drive).value_or("nothing");
  };
  EXPECT_EQ(with([](PiDrive& d) { d.screw.lead = 0; }), "lead = 0 m");
  EXPECT_EQ(with([](PiDrive& d) { d.screw.efficiency = 1.2; }),
            "efficiency = 1.2, allowed: above 0, at most 1");
  EXPECT_EQ(with([](PiDrive& d) { d.motor.steps_per_turn = -1; }), "steps per turn = -1");
  EXPECT_EQ(with([](PiDrive& d) { d.motor.top_speed = 0; }), "top speed = 0 rad/s");
  EXPECT_EQ(with([](PiDrive& d) { d.force_limit = NAN; }), "force limit = nan N");
  EXPECT_EQ(with([](PiDrive& d) { d.rate_limit = -1; }), "rate limit = -1 m/s");
  EXPECT_EQ(with([](PiDrive& d) {
              d.motor.torque = {{0, 1}, {0, 1}};
            }),
            "torque curve, point 2: 0 rad/s; speeds start at 0 and increase");
  EXPECT_EQ(with([](PiDrive& d) {
              d.motor.torque = {{5, 1}};
            }),
            "torque curve, point 1: 5 rad/s; speeds start at 0 and increase");
  EXPECT_EQ(with([](PiDrive& d) { d.motor.torque = {{0, -1}}; }), "torque curve, point 1: -1 N m");
}

}  // namespace
}  // namespace linkwright::parallel
