// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/suspension/studies/axle.h"
#include "linkwright/suspension/studies/corner.h"
#include "linkwright/suspension/wheel/derivatives.h"

// The twist of an anti-roll bar, a U or a T, by the travels of both wheels.
namespace linkwright::suspension {

/// The twist of a bar along a path of both wheels, with its derivatives by the coordinate of the path.
struct BarTwist {
  double value = WheelParameters::missing,   ///< rad, of the left against the right arm
      by_travel = WheelParameters::missing,  ///< rad/m
      change = WheelParameters::missing,     ///< rad/m2, second derivative
      tilt = WheelParameters::missing;       ///< rad, of a T bar
};

/// The twist of the bar of an axle at a position of both wheels.
///
/// @param both descriptions with the bar
/// @param left motions of the left wheel
/// @param right motions of the right wheel
/// @param left_share travel of the left wheel by the coordinate of the path
/// @param right_share travel of the right wheel by it; -1 beside 1 for opposite travel
/// @returns the twist; NaN where a T bar has no position
BarTwist bar_twist(const AxleDescription& both, const CornerMotions& left, const CornerMotions& right,
                   double left_share, double right_share);

/// The rate of the bar of a symmetric axle at each wheel, where both travel oppositely from the same
/// position: half of its stiffness times the square of the twist by travel.
///
/// @param corner the description of one wheel with the bar
/// @param here motions of that wheel
/// @returns N/m
double anti_roll_rate(const CornerDescription& corner, const CornerMotions& here);

}  // namespace linkwright::suspension
