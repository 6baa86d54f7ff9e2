// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "linkwright/planar/linkage/linkage.h"

// The motion of Geneva drives.
namespace linkwright::planar {

/// The radius on which the pin enters the slots along them: the distance of the axes times sin(pi / slots).
/// @param slots slots of the wheel
/// @param distance distance of the axes (m)
/// @returns radius of the pin (m)
double geneva_crank(const GenevaSlots& slots, double distance);

/// The angle of the wheel by that of the crank, with three derivatives. With s = sin(pi / n), the pin in a
/// slot turns the wheel by psi = atan2(s sin t, 1 -+ s cos t), minus for an external drive, against the
/// crank; outside the slots the wheel is locked, pi / n on either side. The second derivative jumps at the
/// entry.
/// @param slots slots of the wheel
/// @param crank angle of the crank (rad): 0 where the pin lies on the line of the axes, nearest to the axis
/// of
///   an external wheel, farthest from that of an internal one; whole turns are counted
/// @returns angle of the wheel (rad, rad/rad, ...), 0 at the crank angle 0
std::array<double, 4> geneva_motion(const GenevaSlots& slots, double crank);

}  // namespace linkwright::planar
