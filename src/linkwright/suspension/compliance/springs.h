// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/suspension/compliance/spring_law.h"
#include "linkwright/suspension/wheel/derivatives.h"

namespace linkwright::suspension {

/// The effect of a spring at the wheel, with rigid joints and no friction. Rates are by the travel of the
/// wheel, the rack held. Of a torsion bar read rad for m and N m for N along its length.
struct WheelRate {
  Status status = Status::done;       ///< singular: at a limit of travel, and where the spring holds nothing
  double motion_ratio = 0;            ///< -dl/dz: compression of the spring by travel
  double motion_ratio_by_travel = 0;  ///< 1/m, -d2l/dz2
  double spring_force = 0;            ///< N, F
  double wheel_force = 0;             ///< N, -F dl/dz: upward force at the wheel that it balances, from below
  double by_stiffness = 0;            ///< N/m, k (dl/dz)^2
  double by_motion_ratio = 0;         ///< N/m, -F d2l/dz2: what the linkage does with the force it carries
  double rate = 0;                    ///< N/m, the sum: slope of the wheel force
};

/// The effect at the wheel of a force that depends on a length: the wheel rate is k (dl/dz)^2 - F d2l/dz2.
///
/// @param length the length along the travel of the wheel, as `corner_motions` gives it
/// @param force force that pushes the ends apart, and its slope by compression
/// @returns force and rate at the wheel; singular where the length is not known
WheelRate wheel_rate(const TravelRates& length, const SpringForce& force);

/// The effect of the spring of a suspension at the wheel.
///
/// @param plan the plan of a suspension with a spring
/// @param position a position of it
/// @param law the law of the spring
/// @returns force and rate at the wheel by the height of the wheel centre
/// @throws ContractError if the suspension has no spring, and as `force_of` does
WheelRate wheel_rate(const DerivativePlan& plan, const CornerPosition& position, const SpringLaw& law);

}  // namespace linkwright::suspension
