// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/tool/timing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "linkwright/math/function_ref.h"
#include "linkwright/math/minimum.h"
#include "linkwright/math/zero.h"

namespace linkwright::parallel {
namespace {

RateLimits least(const RateLimits& a, const RateLimits& b) {
  return {std::min(a.speed, b.speed), std::min(a.acceleration, b.acceleration), std::min(a.jerk, b.jerk)};
}

// From both ends: no part is entered faster than the rest can be run, nor left faster than it can be reached.
// A curved part is either run at one speed, up to its steady speed, or within its limits along, up to theirs.
ToolTiming fastest(const ToolRun& run, const ToolLimits& limits) {
  const double whole = length_of(run), angle = norm(run.turn);
  const std::size_t n = run.parts.size();
  std::vector<RateLimits> along(n);
  std::vector<double> steady(n);
  for (std::size_t i = 0; i < n; ++i) {
    const ToolPart& part = run.parts[i];
    // Limits of rotation in proportion to the length.
    RateLimits turning{INFINITY, INFINITY, INFINITY};
    if (angle > 0) {
      const double share = whole / angle;
      turning = {limits.angular_speed * share, limits.angular_acceleration * share,
                 limits.angular_jerk * share};
    }
    if (norm(part.curve.tangent) == 0) {
      along[i] = turning;
      steady[i] = turning.speed;
    } else {
      const RateLimits all{std::min({limits.speed, part.speed, turning.speed}), limits.acceleration,
                           limits.jerk};
      along[i] = least(limits_along(part.curve, all), turning);
      steady[i] = steady_speed(part.curve, all);
    }
  }
  const auto reached = [&](std::size_t i, double speed) {
    return speed > along[i].speed ? speed : reachable_speed(speed, run.parts[i].curve.length, along[i]);
  };
  std::vector<double> speed(n + 1, 0);
  for (std::size_t i = 0; i + 1 < n; ++i)
    speed[i + 1] = std::min({steady[i], steady[i + 1], reached(i, speed[i])});
  for (std::size_t i = n - 1; i > 0; --i) speed[i] = std::min(speed[i], reached(i, speed[i + 1]));

  ToolTiming out;
  double offset = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double length = run.parts[i].curve.length;
    if (speed[i] > along[i].speed) {
      const double time = length / speed[i];
      out.phases.push_back({out.duration, time, {offset, speed[i], 0, 0}});
      out.duration += time;
    } else {
      const DoubleS motion = double_s(length, speed[i], speed[i + 1], along[i]);
      for (JerkPhase phase : motion.phase) {
        if (phase.duration <= 0) continue;
        phase.start += out.duration;
        phase.at.length += offset;
        out.phases.push_back(phase);
      }
      out.duration += motion.duration;
    }
    offset += length;
  }
  return out;
}

// The largest value of a smooth function on [a, b]: the best of samples, each hill of them climbed by golden
// sections until rounding.
double largest(math::FunctionRef<double(double)> f, double a, double b) {
  constexpr int samples = 64;
  std::array<double, samples + 1> values;
  const auto place = [&](int i) { return a + (b - a) * i / samples; };
  for (int i = 0; i <= samples; ++i) values[i] = f(place(i));
  double best = std::max(values.front(), values.back());
  for (int i = 1; i < samples; ++i) {
    if (values[i] < values[i - 1] || values[i] < values[i + 1]) continue;
    math::GoldenSection section{[&](double x) { return -f(x); }, place(i - 1), place(i + 1)};
    // Eight digits of the place are all digits of the value.
    for (int step = 0; step < 32; ++step) section.narrow();
    best = std::max({best, values[i], -section.at_left, -section.at_right});
  }
  return best;
}

double min_duration(const ToolRun& run, TimeLaw law, const ToolLimits& limits) {
  const double whole = length_of(run), angle = norm(run.turn);
  double duration = 0, offset = 0, begin = 0;
  for (const ToolPart& part : run.parts) {
    offset += part.curve.length;
    const double end =
        &part == &run.parts.back()
            ? 1
            : math::zero_between([&](double x) { return whole * shape(law, x).length - offset; }, begin, 1);
    // The motion in shares of the time.
    const auto moved_at = [&](double x) {
      const Progress s = shape(law, x);
      const double length = std::clamp(whole * s.length - offset + part.curve.length, 0.0, part.curve.length);
      return moved(point_at(part.curve, length),
                   {0, whole * s.speed, whole * s.acceleration, whole * s.jerk});
    };
    const double v = largest([&](double x) { return norm(moved_at(x).velocity); }, begin, end);
    const double a = largest([&](double x) { return norm(moved_at(x).acceleration); }, begin, end);
    const double j = largest([&](double x) { return norm(moved_at(x).jerk); }, begin, end);
    duration = std::max({duration, v / std::min(limits.speed, part.speed), std::sqrt(a / limits.acceleration),
                         std::cbrt(j / limits.jerk)});
    begin = end;
  }
  if (angle > 0) {
    const double v = largest([&](double x) { return shape(law, x).speed; }, 0, 1);
    const double a = largest([&](double x) { return std::abs(shape(law, x).acceleration); }, 0, 1);
    const double j = largest([&](double x) { return std::abs(shape(law, x).jerk); }, 0, 1);
    duration = std::max({duration, angle * v / limits.angular_speed,
                         std::sqrt(angle * a / limits.angular_acceleration),
                         std::cbrt(angle * j / limits.angular_jerk)});
  }
  return duration;
}

}  // namespace

double length_of(const ToolRun& run) {
  double length = 0;
  for (const ToolPart& part : run.parts) length += part.curve.length;
  return length;
}

ToolTiming timed(const ToolRun& run, TimeLaw law, const ToolLimits& limits) {
  if (law == TimeLaw::double_s) return fastest(run, limits);
  return {.duration = min_duration(run, law, limits), .phases = {}};
}

}  // namespace linkwright::parallel
