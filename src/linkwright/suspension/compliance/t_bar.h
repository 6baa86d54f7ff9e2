// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "linkwright/core/status.h"
#include "linkwright/math/vector3.h"

/// @file
/// The anti-roll bar of the shape of a T between the wheels of an axle.
namespace linkwright::suspension {

using math::Vec3;

/// A T bar at the reference. Its post stands in the middle of the vehicle and tilts freely about the lateral
/// axis through its foot; the crossbar at its top carries a droplink at each end. Both droplinks moving
/// equally tilt the post, both moving oppositely twist it.
struct TBar {
  Vec3 foot,                    ///< foot of the post, m
      top;                      ///< its top, m
  std::array<Vec3, 2> end;      ///< joints of the left and the right droplink on the crossbar, m
  std::array<double, 2> rod{};  ///< lengths of both droplinks, m
};

/// A point that moves along a path, with its derivatives by the coordinate of the path.
struct PathPoint {
  Vec3 at,     ///< m
      rate,    ///< first derivative
      change;  ///< second derivative
};

/// The position of a T bar, and its derivatives along the path of the droplinks.
struct TBarPosition {
  Status status =
      Status::done;      ///< not_converged, or singular where a droplink can neither tilt nor twist it
  double tilt = 0,       ///< rad, right-handed about the lateral axis to the left: the top of an upright post
                         ///< moves forward
      twist = 0;         ///< rad, of the crossbar against the foot, right-handed from foot to top
  double tilt_rate = 0,  ///< first derivative of the tilt
      twist_rate = 0;    ///< first derivative of the twist
  double twist_change = 0;  ///< second derivative of the twist
};

/// The position of a T bar by the other ends of its droplinks.
///
/// @param bar the bar
/// @param other the other ends of the left and the right droplink, moving along a path
/// @param tilt where the search for the tilt begins, rad
/// @returns the position, with its status
TBarPosition t_bar_position(const TBar& bar, const std::array<PathPoint, 2>& other, double tilt = 0);

}  // namespace linkwright::suspension
