// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/planar/cam/disc_cam.h"

/// @file
/// Forces between a cam and its follower at a constant speed of the cam: contact force, torque of the cam,
/// the speed at which the follower lifts off, and the preload that holds it down. Guides are free of
/// friction. An effort is a force (N) along the guide of a translating follower, or a torque (N m) about the
/// pivot of an oscillating one.
namespace linkwright::planar {

/// The follower and what presses it on the cam.
struct FollowerLoad {
  double inertia = 0;    ///< mass (kg) or moment of inertia about the pivot (kg m2), >= 0
  double stiffness = 0;  ///< of the spring, N/m or N m/rad, >= 0
  double preload = 0;    ///< effort of the spring where the programme is 0 (N or N m)
  double load = 0;       ///< constant effort towards the cam, such as the weight (N or N m)
  double speed = 0;      ///< speed of the cam (rad/s), >= 0
};

/// Forces at one angle of the cam.
struct FollowerForces {
  double effort = 0;   ///< effort that the cam must exert on the follower (N or N m); < 0: contact is lost
  double contact = 0;  ///< contact force along the normal (N); NaN where it has no effect on the follower
  double torque = 0;   ///< torque of the drive on the cam in its sense (N m)
};

/// The forces at one angle, as if the contact could pull.
/// @param state geometry of the cam at that angle
/// @param motion programme at that angle, by radians of the cam
/// @param load follower and speed
/// @returns effort, contact force and torque
FollowerForces follower_forces(const CamState& state, const math::Motion& motion, const FollowerLoad& load);

/// The least speed of the cam at which the contact force touches zero.
/// @param curve the programme
/// @param load follower; its speed is not used
/// @returns speed (rad/s) and the angle of the cam; a speed of 0 if contact is lost at rest; nothing if the
/// follower never lifts off; of a rise and a return that are alike it is the return that is reported
std::optional<CamExtreme> lift_off_speed(const ProgrammeCurve& curve, const FollowerLoad& load);

/// The least preload that holds the follower on the cam at its speed.
/// @param curve the programme
/// @param load follower and speed; its preload is not used
/// @returns preload (N or N m), negative if there is more force than needed, and the angle that asks for it
CamExtreme needed_preload(const ProgrammeCurve& curve, const FollowerLoad& load);

/// The ranges in which the cam would have to pull the follower. In a groove they are those in which the other
/// flank carries.
/// @param curve the programme
/// @param load follower and speed
/// @returns ranges of the angle of the cam
std::vector<CamRange> ranges_without_contact(const ProgrammeCurve& curve, const FollowerLoad& load);

}  // namespace linkwright::planar
