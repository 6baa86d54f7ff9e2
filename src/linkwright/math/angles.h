// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/core/numbers.h"

namespace linkwright::math {

constexpr double degrees(double radians) { return radians * (180 / pi); }
constexpr double radians(double degrees) { return degrees * (pi / 180); }

/// The angle in (-pi, pi] that differs from `angle` (rad) by whole turns. Exact for the double nearest to 2
/// pi, so wrapping twice changes nothing.
double wrap_angle(double angle);

/// The angle in a range (rad) that differs from `angle` by whole turns, `angle` where there is none.
double into_range(double angle, double lower, double upper);

/// Smallest rotation from `from` to `to` (rad), in (-pi, pi]: what to add to `from` to arrive at `to` up to
/// whole turns.
double angle_difference(double to, double from);

/// Adds whole turns so that neighbours differ by at most half a turn; the first angle (rad) stays as it is.
/// A sequence of true steps below pi is recovered exactly up to rounding; NaNs are passed over.
void unwrap_angles(std::span<double> angles);

}  // namespace linkwright::math
