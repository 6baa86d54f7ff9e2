// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

/// @file
/// Forces of dampers over the speed of their ends.
namespace linkwright::suspension {

/// The characteristic of a damper. It acts against its speed: both have the same sign.
struct DamperCurve {
  std::vector<double> speed,  ///< m/s, ascending, > 0 in compression
      force;                  ///< N, as many, > 0 in compression
};

/// A damper's force and its slope at a speed.
struct DamperForce {
  double force = 0,  ///< N, > 0: it pushes its ends apart
      damping = 0;   ///< N s/m, the slope by the speed of compression
};

/// Checks a characteristic.
///
/// @param curve its points
/// @returns empty, or why they are none: fewer than two, of different number, not ascending, not finite, of
/// one
///   sense of motion only, a force that drives the motion, a force at rest
std::string problem(const DamperCurve& curve);

/// The characteristic with the point of no speed and no force, which a table may leave out.
///
/// @param curve points without a problem
/// @returns the same points and that one
DamperCurve with_rest(DamperCurve curve);

/// The force at a speed. Between the points it is cubic and monotone as that of a spring's characteristic;
/// beyond the ends it is straight.
///
/// @param curve the points
/// @param speed of compression, m/s
/// @returns force and slope
/// @throws ContractError if the curve has a problem
DamperForce force_of(const DamperCurve& curve, double speed);

}  // namespace linkwright::suspension
