// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/core/numbers.h"

namespace linkwright::math {

/// @param radians angle (rad)
/// @returns angle (deg)
constexpr double degrees(double radians) { return radians * (180 / pi); }
/// @param degrees angle (deg)
/// @returns angle (rad)
constexpr double radians(double degrees) { return degrees * (pi / 180); }

/// The angle in (-pi, pi] that differs by whole turns. Exact for the double nearest to 2 pi, so wrapping
/// twice changes nothing.
/// @param angle any angle (rad)
/// @returns angle (rad) in (-pi, pi]
double wrap_angle(double angle);

/// The angle in a range that differs by whole turns.
/// @param angle any angle (rad)
/// @param lower lower end of the range (rad)
/// @param upper upper end of the range (rad)
/// @returns angle (rad) in the range; `angle` where there is none
double into_range(double angle, double lower, double upper);

/// Smallest rotation from one direction to another: what to add to `from` to arrive at `to` up to whole
/// turns.
/// @param to direction at the end (rad)
/// @param from direction at the start (rad)
/// @returns rotation (rad) in (-pi, pi]
double angle_difference(double to, double from);

/// Adds whole turns so that neighbours differ by at most half a turn; the first angle stays as it is. A
/// sequence of true steps below pi is recovered exactly up to rounding; NaNs are passed over.
/// @param angles angles (rad) in their order, changed in place
void unwrap_angles(std::span<double> angles);

}  // namespace linkwright::math
