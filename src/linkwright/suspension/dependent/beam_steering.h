// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "linkwright/core/status.h"
#include "linkwright/suspension/dependent/beam_axle.h"

namespace linkwright::suspension {

/// The steering of a rigid front axle: knuckles turn about kingpins on the beam, a drag link leads from the
/// Pitman arm to the left knuckle, a track rod from there to the right one. Points are those straight ahead
/// (m).
struct BeamSteering {
  std::array<Vec3, 2>
      kingpin,       ///< two points of the left kingpin, the lower one first; the right mirrors them
      pitman_axis;   ///< two points on the axis of the Pitman arm's shaft
  Vec3 drag_body,    ///< joint of the drag link on the Pitman arm
      drag_knuckle;  ///< joint of the drag link on the left knuckle
  std::array<Vec3, 2> track_rod;  ///< joints of the track rod on the left and on the right knuckle
};

/// The wheels of a steered axle.
struct BeamSteer {
  Status status = Status::done;       ///< no_assembly: drag link or track rod do not reach; see the reason
  std::string reason;                 ///< empty, or which rod ends the steering, by how much
  std::array<double, 2> turn{};       ///< rad, of the left and the right knuckle about its upward kingpin
  std::array<WheelAngles, 2> angles;  ///< rad, toe and camber against the body, left and right
  std::array<double, 2> steer{};      ///< rad about +z, left and right: > 0 steers to the left
};

/// Steers an axle at a place of its beam, in closed form, on the branch straight ahead. The beam keeps the
/// place that it has with wheels straight ahead.
///
/// @param plan the plan of the axle
/// @param steering the steering
/// @param place place of the beam
/// @param pitman angle of the Pitman arm, rad, right-handed about its axis from the first point to the second
/// @returns the wheels, with their status
/// @throws ContractError if `problem` finds anything
BeamSteer steer_beam(const BeamAxlePlan& plan, const BeamSteering& steering, const BeamPlace& place,
                     double pitman);

/// The reason why a steering cannot steer.
///
/// @param steering the steering
/// @returns empty, or what is wrong
std::string problem(const BeamSteering& steering);

}  // namespace linkwright::suspension
