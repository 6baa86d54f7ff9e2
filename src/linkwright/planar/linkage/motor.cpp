// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/motor.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {

double rms_of_steps(std::span<const double> values, std::span<const double> durations) {
  LINKWRIGHT_REQUIRE(values.size() == durations.size(), "{} values, {} durations", values.size(),
                     durations.size());
  double squares = 0, time = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    squares += values[i] * values[i] * durations[i];
    time += durations[i];
  }
  LINKWRIGHT_REQUIRE(time > 0, "durations sum up to {} s", time);
  return std::sqrt(squares / time);
}

double rms_over(std::span<const double> times, std::span<const double> values) {
  LINKWRIGHT_REQUIRE(values.size() == times.size() && !values.empty(), "{} values, {} times", values.size(),
                     times.size());
  double squares = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double a = values[i - 1], b = values[i];
    squares += (a * a + a * b + b * b) / 3 * (times[i] - times[i - 1]);
  }
  const double time = times.back() - times.front();
  return time > 0 ? std::sqrt(squares / time) : std::abs(values.front());
}

MotorUse motor_use(const Motor& motor, double gear_ratio, const MotorLoad& load) {
  const std::size_t n = load.time.size();
  LINKWRIGHT_REQUIRE(n > 0 && load.effort.size() == n && load.speed.size() == n &&
                         load.acceleration.size() == n && load.inertia.size() == n,
                     "{} times, {} efforts, {} speeds, {} accelerations, {} inertias", n, load.effort.size(),
                     load.speed.size(), load.acceleration.size(), load.inertia.size());
  MotorUse out{.gear_ratio = gear_ratio,
               .turning = motor.lead > 0 ? gear_ratio * full_turn / motor.lead : gear_ratio};
  double inertia = 0;
  for (std::size_t i = 0; i < n; ++i) {
    // Losses of the gear add to what the motor drives and take from what drives it.
    const bool drives = load.effort[i] * load.speed[i] >= 0;
    const double passed = drives ? 1 / motor.gear_efficiency : motor.gear_efficiency;
    out.torque.push_back(passed * load.effort[i] / out.turning +
                         motor.inertia * out.turning * load.acceleration[i]);
    out.speed.push_back(out.turning * load.speed[i]);
    out.peak_torque = std::max(out.peak_torque, std::abs(out.torque.back()));
    out.peak_speed = std::max(out.peak_speed, std::abs(out.speed.back()));
    inertia = std::max(inertia, load.inertia[i] / (out.turning * out.turning));
  }
  out.rms_torque = rms_over(load.time, out.torque);
  out.inertia_ratio = motor.inertia > 0 ? inertia / motor.inertia : nan;
  out.share = std::max({out.rms_torque / motor.rated_torque, out.peak_torque / motor.peak_torque,
                        out.peak_speed / motor.max_speed});
  return out;
}

}  // namespace linkwright::planar
