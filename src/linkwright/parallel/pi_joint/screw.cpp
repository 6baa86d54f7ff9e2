// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/screw.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"

namespace linkwright::parallel {

namespace {

// Beyond this speed the motor has no torque.
double last_speed(const PiMotor& motor) {
  return motor.torque.size() > 1 ? std::min(motor.top_speed, motor.torque.back().speed) : motor.top_speed;
}

// At a speed of at most last_speed.
double torque_at(const PiMotor& motor, double speed) {
  const auto& points = motor.torque;
  if (points.empty()) return infinity;
  if (points.size() == 1) return points.front().torque;
  const auto after = std::upper_bound(points.begin() + 1, points.end() - 1, speed,
                                      [](double s, const MotorTorque& p) { return s < p.speed; });
  const MotorTorque &left = after[-1], &right = *after;
  return left.torque + (right.torque - left.torque) * ((speed - left.speed) / (right.speed - left.speed));
}

bool positive(double x) { return x > 0; }

}  // namespace

double back_driving_efficiency(const PiScrew& screw) { return 2 - 1 / screw.efficiency; }

bool self_locking(const PiScrew& screw) { return back_driving_efficiency(screw) <= 0; }

double motor_torque(const PiScrew& screw, double force, double rate) {
  const double lossless = force * screw.lead / full_turn;
  return force * rate < 0 ? lossless * back_driving_efficiency(screw) : lossless / screw.efficiency;
}

double rate_of(const PiScrew& screw, double motor_speed) { return screw.lead * motor_speed / full_turn; }

double motor_speed_of(const PiScrew& screw, double rate) { return rate * full_turn / screw.lead; }

std::optional<std::string> problem(const PiDrive& drive) {
  const auto& [screw, motor, force_limit, rate_limit] = drive;
  if (!(screw.lead > 0 && std::isfinite(screw.lead))) return fmt::format("lead = {} m", screw.lead);
  if (!(screw.efficiency > 0 && screw.efficiency <= 1))
    return fmt::format("efficiency = {}, allowed: above 0, at most 1", screw.efficiency);
  if (!(motor.steps_per_turn >= 0 && std::isfinite(motor.steps_per_turn)))
    return fmt::format("steps per turn = {}", motor.steps_per_turn);
  if (!positive(motor.top_speed)) return fmt::format("top speed = {} rad/s", motor.top_speed);
  if (!positive(force_limit)) return fmt::format("force limit = {} N", force_limit);
  if (!positive(rate_limit)) return fmt::format("rate limit = {} m/s", rate_limit);
  for (std::size_t i = 0; i < motor.torque.size(); ++i) {
    const auto [speed, torque] = motor.torque[i];
    if (!(torque >= 0 && std::isfinite(torque)))
      return fmt::format("torque curve, point {}: {} N m", i + 1, torque);
    if (i == 0 ? speed != 0 : !(speed > motor.torque[i - 1].speed && std::isfinite(speed)))
      return fmt::format("torque curve, point {}: {} rad/s; speeds start at 0 and increase", i + 1, speed);
  }
  return {};
}

double quantum(const PiDrive& drive) {
  return drive.motor.steps_per_turn > 0 ? drive.screw.lead / drive.motor.steps_per_turn : 0;
}

double top_rate(const PiDrive& drive) {
  return std::min(drive.rate_limit, rate_of(drive.screw, last_speed(drive.motor)));
}

double available_force(const PiDrive& drive, double rate, PowerFlow flow) {
  if (std::abs(rate) > top_rate(drive)) return 0;
  // The motor's speed at the top rate may be more than its last one by rounding.
  const double speed = std::min(motor_speed_of(drive.screw, std::abs(rate)), last_speed(drive.motor));
  const double loss = flow == PowerFlow::motor_drives ? 1 / drive.screw.efficiency
                                                      : std::abs(back_driving_efficiency(drive.screw));
  const double per_force = drive.screw.lead / full_turn * loss;
  // A screw on the verge of locking holds any load without a torque of the motor.
  return per_force == 0 ? drive.force_limit
                        : std::min(drive.force_limit, torque_at(drive.motor, speed) / per_force);
}

PiOutput output(const PiJoint& joint, const PiDrive& drive, double angle) {
  const double j = jacobian(joint, angle);
  return {.torque = j == 0 ? 0 : j * available_force(drive, 0),
          .speed = top_rate(drive) / j,
          .resolution = quantum(drive) == 0 ? 0 : quantum(drive) / j};
}

double available_torque(const PiJoint& joint, const PiDrive& drive, double angle, double angular_speed) {
  const double j = jacobian(joint, angle);
  return j == 0 ? 0 : j * available_force(drive, j * angular_speed);
}

}  // namespace linkwright::parallel
