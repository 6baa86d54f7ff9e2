// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/planar/linkage/linkage.h"

namespace linkwright::planar {

/// What the thread of a screw does, whatever its load.
struct ScrewThread {
  double lead_angle = 0;      ///< rad, of the pitch diameter
  double friction_angle = 0;  ///< rad, on the flanks; 0 without friction
  double efficiency = 1;      ///< of the spindle that moves the nut against its load
  double margin = 0;  ///< tangent of the friction angle over that of the lead angle: above 1 it locks itself
};

/// The properties of a thread.
///
/// @param screw the screw
/// @returns its angles, efficiency and margin
ScrewThread thread_of(const Screw& screw);

/// The torque of the spindle that moves a nut.
///
/// @param screw the screw
/// @param thrust force of the spindle on the nut along the slide (N)
/// @param speed speed of the nut (m/s); at rest the torque is the least one that holds the nut
/// @param acceleration acceleration of the nut (m/s2), with which the spindle turns
/// @returns torque on the spindle (N m), positive in the sense that moves a right-hand nut forward
double spindle_torque(const Screw& screw, double thrust, double speed, double acceleration);

/// The turning of the spindle for a unit of displacement.
///
/// @param screw the screw
/// @returns rad/m, negative of a left-hand thread
double spindle_turning(const Screw& screw);

}  // namespace linkwright::planar
