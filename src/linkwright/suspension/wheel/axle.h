// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "linkwright/core/numbers.h"
#include "linkwright/suspension/wheel/parameters.h"

/// Two wheels of an axle, and the axle in its vehicle.
namespace linkwright::suspension {

/// Roll centre (y, z) in the vehicle's frame (m) when both wheels have different positions and travel: where
/// the lines meet that pass through the contact points across their velocities, seen along x. Nothing if they
/// are parallel.
std::optional<std::array<double, 2>> roll_centre(const WheelParameters& left, const WheelParameters& right);

/// The effect of a small roll of the body towards this wheel (rad per rad): both contact points stay on the
/// road, so this one rises against the body by half the track times the roll, the other one falls.
struct RollGains {
  double toe = 0;  ///< roll steer: change of toe
  /// Change of the camber against the road; 1 = the wheel leans with the body, 0 = it stays upright.
  double camber = 0;
};
RollGains roll_gains(const WheelParameters& wheel);

/// The position of an axle in the vehicle, and the layout of the vehicle.
enum class AxlePlace { front, rear };
constexpr std::array<EnumName<AxlePlace>, 2> names(AxlePlace) {
  return {{{AxlePlace::front, "front"}, {AxlePlace::rear, "rear"}}};
}
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
AntiFeatures anti_features(const WheelParameters& wheel, AxlePlace place, const VehicleLayout& layout);

/// The error of the steer angles of both wheels against a common centre of turning on the line of the rear
/// axle.
struct Ackermann {
  double ideal_inner = 0;  ///< rad, what the inner wheel should turn by when the outer one turns by `outer`
  double percent = 0;      ///< 100 = ideal, 0 = parallel, negative = the outer wheel turns more
};
/// `inner` and `outer` are changes of the steer angles from straight ahead (rad, > 0), `track` the distance
/// that the angles refer to (m): of the steering axes at the ground, or of the wheels. Of one wheel: its
/// changes of toe at opposite rack displacements.
Ackermann ackermann(double inner, double outer, double wheelbase, double track);

}  // namespace linkwright::suspension
