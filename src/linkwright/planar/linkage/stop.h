// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// The distance of a joint from its stop, and its rates: negative beyond the stop.
struct StopMotion {
  double gap = 0,        ///< rad or m
      rate = 0,          ///< rad/s or m/s
      acceleration = 0;  ///< rad/s2 or m/s2
};

/// The motion of a joint against its stop, from the motion of the linkage. Pins count their turns as
/// PlanTwist does.
///
/// @param linkage the linkage
/// @param plan its plan
/// @param motion its motion; rates and accelerations as far as they have been solved for
/// @param stop index of the stop
/// @returns gap and rates
StopMotion stop_motion(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                       std::size_t stop);

/// The effort of a stop: of one that gives way by its gap and rate, of a rigid one from LinkageMotion::stops.
///
/// @param linkage the linkage
/// @param plan its plan
/// @param motion its motion, with velocities
/// @param stop index of the stop
/// @returns torque of a pin (N m) or force (N), 0 or positive, that pushes the joint off the stop
double stop_effort(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                   std::size_t stop);

/// Appends the effort of a stop as loads on both bodies of its joint.
///
/// @param linkage the linkage
/// @param plan its plan
/// @param motion its motion, with velocities
/// @param stop index of the stop
/// @param loads receives the loads, if the stop has an effort
void add_stop_loads(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                    std::size_t stop, std::vector<AppliedLoad>& loads);

/// The rigid stop of a linkage that a joint has passed at a position.
///
/// @param linkage the linkage
/// @param plan its plan
/// @param motion a position
/// @param slack gap that does not count yet, rad or sizes of the linkage
/// @returns index of the stop; -1 if there is none
int passed_stop(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion, double slack);

}  // namespace linkwright::planar
