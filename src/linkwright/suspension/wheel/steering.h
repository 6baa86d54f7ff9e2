// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "linkwright/suspension/wheel/parameters.h"

namespace linkwright::suspension {

/// The steering parameters of a wheel at a position, while `lock` is held: height of the wheel centre or of
/// the contact, or the spring. Exact, from the steering motion.
///
/// A lever arm is the moment about the steering axis by a unit force, as virtual work over the rate of toe;
/// its sign is that of the toe (for both wheels), and a force the other way turns the other way.
struct SteeringParameters {
  Driver lock = Driver::spring;  ///< coordinate that is held
  double toe_by_rack = 0;        ///< rad/m
  /// rad/m, steer angle about +z, of either wheel > 0 if a rack to the left steers left.
  double steer_by_rack = 0;
  double camber_by_toe = 0;  ///< rad/rad
  /// rad/rad, carrier about the wheel's axis: what caster the wheel's bearing keeps.
  double carrier_pitch_by_toe = 0;
  /// m: force forward at the contact, braked by the carrier (outboard brake): > 0 where braking toes out.
  double brake_arm = 0;
  /// m: force forward at the contact, the wheel free to turn on its carrier (drive shaft, inboard brake).
  double drive_arm = 0;
  double lateral_arm = 0;  ///< m: force outboard at the contact
  /// m: force upward at the contact; also the rise of the contact against the body by toe (m/rad). With the
  /// spring held that is jacking: where the contact rises, the body sinks.
  double load_arm = 0;
  double contact_rise_by_rack = 0;  ///< m/m, the same by rack
};

/// The steering parameters of a wheel.
///
/// @param plan the plan of the suspension
/// @param position the position
/// @param lock coordinate that is held
/// @returns the parameters; nothing for a suspension that no rack moves, at a limit of travel, and where the
///   rack does not turn the wheel
/// @throws ContractError if the spring is to be held and there is none
std::optional<SteeringParameters> steering_parameters(const CornerPlan& plan, const CornerPosition& position,
                                                      Driver lock);

/// Test for steered wheels.
///
/// @param plan the plan of the suspension
/// @returns true if any link of the suspension is on the rack
bool is_steered(const CornerPlan& plan);

/// The ratio of a steering: turn of the steering wheel (with its pinion) by steer angle.
///
/// @param steer_by_rack steer angle by rack (rad/m, either sign)
/// @param rack_per_turn rack travel by a turn of the pinion (m, > 0), the C factor
/// @returns the ratio, > 0
/// @throws ContractError unless rack_per_turn is positive
double steering_ratio(double steer_by_rack, double rack_per_turn);

}  // namespace linkwright::suspension
