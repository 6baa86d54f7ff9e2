// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>

#include "linkwright/core/field.h"

/// @file
/// Motion of a point along a path of given length: laws of time from rest to rest within limits, and the
/// fastest one between given speeds. Lengths may as well be angles.
namespace linkwright::parallel {

/// The law of time of a motion from rest to rest.
enum class TimeLaw {
  double_s,        ///< fastest within the limits: seven phases of constant jerk
  polynomial_345,  ///< 10 x^3 - 15 x^4 + 6 x^5: jerk in a step at the ends
  cycloidal        ///< x - sin(2 pi x) / (2 pi): a sine as acceleration
};
constexpr std::array<EnumName<TimeLaw>, 3> names(TimeLaw) {
  return {{{TimeLaw::double_s, "double_s", "fastest within the limits: seven phases of constant jerk"},
           {TimeLaw::polynomial_345, "polynomial_345", "10 x^3 - 15 x^4 + 6 x^5: jerk in a step at the ends"},
           {TimeLaw::cycloidal, "cycloidal", "x - sin(2 pi x) / (2 pi): a sine as acceleration"}}};
}

/// Largest rate and derivatives of it along a path, all more than 0; of a length, or of an angle.
struct RateLimits {
  double speed = 0,      ///< m/s or rad/s
      acceleration = 0,  ///< m/s2 or rad/s2
      jerk = 0;          ///< m/s3 or rad/s3
};

/// Length run through and its derivatives by seconds.
struct Progress {
  double length = 0,     ///< m or rad
      speed = 0,         ///< m/s or rad/s
      acceleration = 0,  ///< m/s2 or rad/s2
      jerk = 0;          ///< m/s3 or rad/s3
};

/// A time of constant jerk that begins with `at`.
struct JerkPhase {
  double start = 0,  ///< s
      duration = 0;  ///< s
  Progress at;       ///< motion at its beginning
};

/// The motion within a phase.
///
/// @param phase the phase
/// @param time time since the phase began (s)
/// @returns length and rates
Progress after(const JerkPhase& phase, double time);

/// Seven phases that follow each other: jerk +, 0, -, (cruise) 0, -, 0, +; any of them may last 0 s.
struct DoubleS {
  std::array<JerkPhase, 7> phase;  ///< the phases in their order
  double duration = 0;             ///< s
};

/// The fastest motion over a length between two speeds, both without acceleration, within the limits
/// (Biagiotti and Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section 3.4). From
/// rest to rest the peak speed is in closed form, else it is a zero found to the last digit.
///
/// @param length m or rad, > 0
/// @param start_speed speed at the start, in [0, limits.speed]
/// @param end_speed speed at the end, in [0, limits.speed]
/// @param limits largest speed, acceleration and jerk
/// @returns the phases
/// @throws ContractError unless length and limits are positive, the speeds are in [0, limits.speed] and the
///   length suffices for their change
DoubleS double_s(double length, double start_speed, double end_speed, const RateLimits& limits);

/// The largest speed, at most that of the limits, that is reached over a length from another speed, both
/// without acceleration. As motions can be run backwards it is also the largest from which that speed is
/// reached.
///
/// @param speed speed at the start
/// @param length m or rad
/// @param limits largest speed, acceleration and jerk
/// @returns the speed
double reachable_speed(double speed, double length, const RateLimits& limits);

/// The shape of a law other than double_s.
///
/// @param law the law
/// @param x share of the time, in [0, 1]
/// @returns share of the length and its derivatives by x
/// @throws ContractError if the law is double_s
Progress shape(TimeLaw law, double x);

}  // namespace linkwright::parallel
