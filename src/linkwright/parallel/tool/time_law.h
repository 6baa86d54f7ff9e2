// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>

#include "linkwright/core/field.h"

/// Motion of a point along a path of given length: laws of time from rest to rest within limits, and the
/// fastest one between given speeds. Lengths may as well be angles.
namespace linkwright::parallel {

enum class TimeLaw { double_s, polynomial_345, cycloidal };
constexpr std::array<EnumName<TimeLaw>, 3> names(TimeLaw) {
  return {{{TimeLaw::double_s, "double_s", "fastest within the limits: seven phases of constant jerk"},
           {TimeLaw::polynomial_345, "polynomial_345", "10 x^3 - 15 x^4 + 6 x^5: jerk in a step at the ends"},
           {TimeLaw::cycloidal, "cycloidal", "x - sin(2 pi x) / (2 pi): a sine as acceleration"}}};
}

/// Largest rate and derivatives of it along a path, all more than 0; m/s, m/s2, m/s3, or of an angle.
struct RateLimits {
  double speed = 0, acceleration = 0, jerk = 0;
};

/// Length run through and its derivatives by seconds.
struct Progress {
  double length = 0, speed = 0, acceleration = 0, jerk = 0;
};

/// A time of constant jerk that begins with `at`.
struct JerkPhase {
  double start = 0, duration = 0;  ///< s
  Progress at;
};
/// The motion `time` (s) after the phase began.
Progress after(const JerkPhase& phase, double time);

/// Seven phases that follow each other: jerk +, 0, -, (cruise) 0, -, 0, +; any of them may last 0 s.
struct DoubleS {
  std::array<JerkPhase, 7> phase;
  double duration = 0;  ///< s
};

/// The fastest motion over `length` > 0 from `start_speed` to `end_speed`, both without acceleration, within
/// the limits (Biagiotti and Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section
/// 3.4). From rest to rest the peak speed is in closed form, else it is a zero found to the last digit.
///
/// Throws ContractError unless the speeds are in [0, limits.speed] and the length suffices for their change.
DoubleS double_s(double length, double start_speed, double end_speed, const RateLimits& limits);

/// The largest speed, at most that of the limits, that is reached over `length` from `speed`, both without
/// acceleration. As motions can be run backwards it is also the largest from which `speed` is reached.
double reachable_speed(double speed, double length, const RateLimits& limits);

/// Shape of a law other than double_s: share of the length and its derivatives by x at the share x in [0, 1]
/// of the time.
Progress shape(TimeLaw law, double x);

}  // namespace linkwright::parallel
