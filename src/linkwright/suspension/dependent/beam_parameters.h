// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "linkwright/core/numbers.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/dependent/beam_position.h"
#include "linkwright/suspension/wheel/axle.h"

namespace linkwright::suspension {

/// One wheel of a rigid axle at a position. Signs are those of independent suspensions, alike for both
/// wheels.
struct BeamWheel {
  WheelAngles angles;           ///< rad, toe and camber against the body
  double road_camber = 0;       ///< rad, camber against the road that both tyres touch
  Vec3 centre,                  ///< wheel centre, m
      contact;                  ///< lowest point of the tyre, m
  double travel = 0;            ///< m, rise of the wheel centre from the reference
  double recession = 0;         ///< m, wheel centre rearward of that at the reference
  double recession_rate = nan;  ///< m/m, by heave
};

/// The parameters of a rigid axle at a position. Rates by heave hold the roll, rates by roll hold the heave;
/// both as `AxleInputs::heave_roll` defines them.
struct BeamParameters {
  Status status = Status::done;  ///< singular: at a limit, where rates are NaN
  BeamWheel left,                ///< the left wheel
      right;                     ///< the right wheel
  double heave = 0,              ///< m
      roll = 0;                  ///< rad, > 0: the body leans to the left
  double track = 0,              ///< m, between the contact points along y
      track_change = 0;          ///< m, from the reference
  double lateral_shift = 0;      ///< m, of the middle of both contacts to the left, from the reference
  double steer = 0;              ///< rad about +z, mean of both wheels: > 0 steers to the left
  double pitch = 0;              ///< rad, of the beam about the lateral axis, > 0: forward at the top
  double steer_by_heave = nan;   ///< rad/m
  double pitch_by_heave = nan;   ///< rad/m
  double shift_by_heave = nan;   ///< m/m, lateral shift of the middle of both contacts
  /// rad/rad, mean steer angle by roll: at a rear axle negative values understeer, at a front axle positive
  /// ones.
  double roll_steer = nan;
  /// rad, slope of the axis about which a rigid axle rolls against the body, > 0: it rises forward.
  double roll_axis_inclination = nan;
  double twist = nan,       ///< rad, of a beam that twists, the left half forward at the top
      twist_by_roll = nan;  ///< rad/rad
  /// Height above the road of the point in the middle of the track through which the lateral force between
  /// axle and body acts (m).
  double roll_centre_height = nan;
  std::optional<Vec3> roll_centre;  ///< that point in the frame of the body, m
  /// Rise of the line of action of that force along the road to the left: vertical by lateral force.
  double lateral_force_slope = nan;
  /// Instant centre of the beam in side view as it heaves (x, z), m; infinite where the beam only shifts.
  std::array<double, 2> side_centre{nan, nan};
  double side_swing_arm = nan,  ///< m, from the middle of the contacts to the side centre
      side_swing_angle = nan;   ///< rad, of that arm above the ground
  /// Forward per upward velocity at the contacts in heave, of the beam: brakes or the differential on the
  /// beam.
  double anti_pitch_tangent = nan,
         anti_pitch_tangent_free = nan;  ///< the same of the contact points: torque taken by the body
};

/// The parameters of an axle at a position.
///
/// @param plan the plan of the axle
/// @param position the position; it must be done
/// @returns the parameters, with their status
/// @throws ContractError if the position is not done
BeamParameters beam_parameters(const BeamAxlePlan& plan, const BeamPosition& position);

/// The support of braking and driving of a rigid axle by its links.
struct BeamAntiFeatures {
  double brake_on_beam = nan,  ///< per cent, brakes on the beam
      brake_on_body = nan,     ///< per cent, brakes inboard at the differential of a de Dion axle
      drive_on_beam = nan,     ///< per cent, differential on the beam: a live axle
      drive_on_body = nan;     ///< per cent, differential on the body: a de Dion axle
};

/// The support of braking and driving of a rigid axle.
///
/// @param axle parameters of the axle
/// @param place its place in the vehicle
/// @param layout layout of the vehicle
/// @returns shares of the load transfer in percent, as those of independent suspensions
/// @throws ContractError as `anti_features` does
BeamAntiFeatures anti_features(const BeamParameters& axle, AxlePlace place, const VehicleLayout& layout);

/// One of the two axles of a vehicle, for the axes about which the body rolls and pitches.
struct AxleCentre {
  double roll_centre_height = 0;  ///< m, above the road
  /// Slope of the line from the contact points to the instant centre in side view, > 0: it rises towards the
  /// middle of the vehicle.
  double support_slope = 0;
};

/// The axes about which the body of a vehicle rolls and pitches.
struct VehicleAxes {
  double roll_axis_inclination = 0;  ///< rad, > 0: it rises forward
  double pitch_centre_behind = nan,  ///< m, of the pitch centre behind the front axle; NaN of parallel lines
      pitch_centre_height = nan;     ///< m, above the road; NaN of parallel lines
};

/// The axes of a vehicle: the roll axis joins both roll centres, and the lines to both side-view centres meet
/// in the pitch centre.
///
/// @param front the front axle
/// @param rear the rear axle
/// @param wheelbase m, > 0
/// @returns the axes
/// @throws ContractError unless the wheelbase is positive
VehicleAxes vehicle_axes(const AxleCentre& front, const AxleCentre& rear, double wheelbase);

/// A shaft between body and beam with a joint at each end: the propeller shaft of a live axle, a half-shaft
/// of a de Dion axle.
struct BeamShaft {
  Vec3 body,      ///< centre of the joint on the body, m
      beam,       ///< centre of the joint on the beam at the reference, m
      body_axis,  ///< direction of the shaft beyond the joint on the body, of any length
      beam_axis;  ///< direction of the shaft beyond the joint on the beam at the reference, of any length
};

/// A shaft at a position.
struct BeamShaftState {
  double body_angle = 0,  ///< rad, between the shaft and the axis on the body, 0 to pi/2
      beam_angle = 0;     ///< rad, between the shaft and the axis on the beam, 0 to pi/2
  double plunge = 0;      ///< m, distance of both joints less that at the reference
};

/// The angles and the plunge of a shaft at a position.
///
/// @param plan the plan of the axle
/// @param place place of the beam
/// @param shaft the shaft
/// @returns its state
BeamShaftState shaft_state(const BeamAxlePlan& plan, const BeamPlace& place, const BeamShaft& shaft);

}  // namespace linkwright::suspension
