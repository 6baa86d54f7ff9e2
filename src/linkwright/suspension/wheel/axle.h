// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "linkwright/core/numbers.h"
#include "linkwright/suspension/wheel/parameters.h"

/// @file
/// Two wheels of an axle, and the axle in its vehicle.
namespace linkwright::suspension {

/// The roll centre of an axle when both wheels have different positions and travel: where the lines meet that
/// pass through the contact points across their velocities, seen along x.
///
/// @param left parameters of the left wheel
/// @param right parameters of the right wheel
/// @returns (y, z) in the vehicle's frame (m); nothing if the lines are parallel
std::optional<std::array<double, 2>> roll_centre(const WheelParameters& left, const WheelParameters& right);

/// The effect of a small roll of the body towards this wheel (rad per rad): both contact points stay on the
/// road, so this one rises against the body by half the track times the roll, the other one falls.
struct RollGains {
  double toe = 0;  ///< roll steer: change of toe
  /// Change of the camber against the road; 1 = the wheel leans with the body, 0 = it stays upright.
  double camber = 0;
};

/// The effect of a small roll of the body on a wheel.
///
/// @param wheel parameters of the wheel
/// @returns changes of toe and camber by roll (rad/rad)
RollGains roll_gains(const WheelParameters& wheel);

/// The place of an axle in the vehicle.
enum class AxlePlace {
  front,  ///< the front axle
  rear    ///< the rear axle
};
constexpr std::array<EnumName<AxlePlace>, 2> names(AxlePlace) {
  return {{{AxlePlace::front, "front"}, {AxlePlace::rear, "rear"}}};
}

/// The numbers of the vehicle on which the support of braking and driving depends.
struct VehicleLayout {
  double wheelbase = 0;            ///< m, > 0
  double centre_height = 0;        ///< m, mass centre above the ground, > 0
  double front_brake_share = 0.5;  ///< share of the braking force, 0 to 1
  double axle_drive_share = 1;     ///< share of the driving force at this axle, 0 to 1
};

/// Share of the load transfer that the links take instead of the springs, in percent; 100 = the body does not
/// pitch there (from virtual work). Front: anti-dive, and anti-lift under drive. Rear: anti-lift, and
/// anti-squat.
struct AntiFeatures {
  double outboard_brake = 0;  ///< brake torque taken by the carrier
  double inboard_brake = 0;   ///< brake torque taken by the body
  double inboard_drive = 0;   ///< driving torque taken by the body
  /// The first as drawn: by the line from the contact point to the side centre of the arm planes. NaN without
  /// arm planes.
  double outboard_brake_by_arms = nan;
};

/// The support of braking and driving by the links of a wheel.
///
/// @param wheel parameters of the wheel
/// @param place place of its axle
/// @param layout layout of the vehicle
/// @returns shares of the load transfer in percent
/// @throws ContractError unless wheelbase and height are positive and shares lie in 0 to 1
AntiFeatures anti_features(const WheelParameters& wheel, AxlePlace place, const VehicleLayout& layout);

/// The error of the steer angles of both wheels against a common centre of turning on the line of the rear
/// axle.
struct Ackermann {
  /// Angle (rad) by which the inner wheel should turn when the outer one turns by `outer`.
  double ideal_inner = 0;
  double percent = 0;  ///< 100 = ideal, 0 = parallel, negative = the outer wheel turns more
};

/// The error of the steer angles against a common centre of turning. The angles of one wheel alone are its
/// changes of toe at opposite rack displacements.
///
/// @param inner change of the steer angle of the inner wheel from straight ahead (rad, > 0)
/// @param outer change of the steer angle of the outer wheel (rad, > 0)
/// @param wheelbase m, > 0
/// @param track distance that the angles refer to (m, > 0): of the steering axes at the ground, or of the
///   wheels
/// @returns the ideal angle and the percentage
/// @throws ContractError unless wheelbase, track and the outer angle are positive
Ackermann ackermann(double inner, double outer, double wheelbase, double track);

/// The circles of a turn of a vehicle whose front axle steers, about a centre on the line of the rear axle.
struct TurningCircle {
  double kerb_to_kerb = 0;  ///< diameter of the track of the outer front wheel (m)
  /// Diameter of the path of the outer front corner of the body (m). NaN if its overhang or width is unknown.
  double wall_to_wall = nan;
};

/// The turning circles by the steer angle of the outer wheel.
///
/// @param outer change of the steer angle of the outer wheel from straight ahead (rad, > 0)
/// @param wheelbase m, > 0
/// @param axes distance of the steering axes at the ground (m, > 0)
/// @param scrub from the steering axis of the outer wheel at the ground to its contact point, across the
/// wheel
///   (m, > 0 if the contact is outboard)
/// @param overhang of the body ahead of the front axle (m), or NaN
/// @param width of the body (m), or NaN
/// @returns both diameters
/// @throws ContractError unless wheelbase, distance and angle are positive
TurningCircle turning_circle(double outer, double wheelbase, double axes, double scrub, double overhang = nan,
                             double width = nan);

}  // namespace linkwright::suspension
