// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/math/motion_law.h"
#include "linkwright/math/zero.h"
#include "linkwright/parallel/tool/path.h"

namespace linkwright::parallel {
namespace {

// Change of speed without acceleration at its ends: jerk for `jerk` s, none for `even` s, the opposite for
// `jerk` s.
struct Ramp {
  double jerk, even;
  double duration() const { return 2 * jerk + even; }
};
Ramp ramp(double change, const RateLimits& limits) {
  const double full = limits.acceleration / limits.jerk;  // time to the largest acceleration
  if (change <= limits.acceleration * full) return {std::sqrt(std::max(0.0, change) / limits.jerk), 0};
  return {full, change / limits.acceleration - full};
}
double ramp_length(double a, double b, const RateLimits& limits) {
  return (a + b) / 2 * ramp(std::abs(b - a), limits).duration();
}

// The largest speed from `low` on, up to that of the limits, whose excess of length is not positive; it grows
// with the speed and is not positive at `low`. Small changes of speed are few digits, and their lengths
// fewer: what is left is run at constant speed.
template <class F>
double largest(F&& excess, double low, const RateLimits& limits) {
  if (excess(limits.speed) <= 0) return limits.speed;
  double v = math::zero_between(excess, low, limits.speed);
  while (v > low && excess(v) > 0) v = std::nextafter(v, low);
  return v;
}

double peak_speed(double length, double start, double end, const RateLimits& limits) {
  const double least = std::max(start, end);
  const auto excess = [&](double peak) {
    return ramp_length(start, peak, limits) + ramp_length(peak, end, limits) - length;
  };
  if (excess(limits.speed) <= 0) return limits.speed;
  if (least == 0) {
    const double a = limits.acceleration, j = limits.jerk, b = a * a / j;
    if (length >= 2 * b * a / j) return 2 * a * length / (b + std::sqrt(b * b + 4 * a * length));
    return std::cbrt(length * length * j / 4);
  }
  return largest(excess, least, limits);
}

}  // namespace

Progress after(const JerkPhase& phase, double time) {
  const auto& [s, v, a, j] = phase.at;
  return {s + time * (v + time * (a / 2 + time * j / 6)), v + time * (a + time * j / 2), a + time * j, j};
}

DoubleS double_s(double length, double start_speed, double end_speed, const RateLimits& limits) {
  LINKWRIGHT_REQUIRE(length > 0 && limits.speed > 0 && limits.acceleration > 0 && limits.jerk > 0,
                     "length {} and limits {}, {}, {} must be more than 0", length, limits.speed,
                     limits.acceleration, limits.jerk);
  LINKWRIGHT_REQUIRE(
      start_speed >= 0 && end_speed >= 0 && start_speed <= limits.speed && end_speed <= limits.speed,
      "speeds {} and {} must be in [0, {}]", start_speed, end_speed, limits.speed);
  const double needed = ramp_length(start_speed, end_speed, limits);
  LINKWRIGHT_REQUIRE(needed <= length, "a length of {} is too short for a change of speed of {}", length,
                     end_speed - start_speed);
  const double peak = peak_speed(length, start_speed, end_speed, limits);
  const Ramp up = ramp(peak - start_speed, limits), down = ramp(peak - end_speed, limits);
  const double even = length - ramp_length(start_speed, peak, limits) - ramp_length(peak, end_speed, limits);

  DoubleS out;
  const std::array<double, 7> times = {up.jerk,   up.even,   up.jerk,  std::max(0.0, even / peak),
                                       down.jerk, down.even, down.jerk};
  const std::array<double, 7> jerks = {limits.jerk, 0, -limits.jerk, 0, -limits.jerk, 0, limits.jerk};
  for (std::size_t i = 0; i < 7; ++i) {
    out.phase[i].start = out.duration;
    out.phase[i].duration = times[i];
    out.duration += times[i];
  }
  // From both ends to the cruise, so that both are met exactly.
  Progress at{0, start_speed, 0, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    out.phase[i].at = {at.length, at.speed, i == 1 || i == 2 ? up.jerk * limits.jerk : 0, jerks[i]};
    at = after(out.phase[i], times[i]);
  }
  at = {length, end_speed, 0, 0};
  for (std::size_t i = 7; i-- > 4;) {
    const Progress begin =
        after(JerkPhase{0, 0, {at.length, at.speed, at.acceleration, jerks[i]}}, -times[i]);
    out.phase[i].at = begin;
    at = begin;
  }
  return out;
}

double reachable_speed(double speed, double length, const RateLimits& limits) {
  if (speed >= limits.speed) return limits.speed;
  return largest([&](double v) { return ramp_length(speed, v, limits) - length; }, speed, limits);
}

Progress shape(TimeLaw law, double x) {
  LINKWRIGHT_REQUIRE(law != TimeLaw::double_s, "a double S has no one shape");
  static const math::MotionCurve polynomial(math::Polynomial345{.to = 1}),
      cycloidal(math::CycloidalMotion{.to = 1});
  const math::Motion m = (law == TimeLaw::polynomial_345 ? polynomial : cycloidal)(std::clamp(x, 0.0, 1.0));
  return {m.value, m.rate, m.acceleration, m.jerk};
}

}  // namespace linkwright::parallel
