// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// The states of the joints with friction during a motion under forces: which of them slide, in which sense,
/// and which stick. All vectors have one entry a joint of the linkage.
struct FrictionStates {
  /// 1, -1: the joint slides with or against its coordinate; 0: it sticks; NaN: the sign of its rate decides.
  std::vector<double> senses;
  /// True: the next solution finds the states of the joints that stick, or stop just now: they stick on as
  /// long as their friction at rest is enough, and begin to slide in the sense of their acceleration
  /// otherwise.
  bool decide = false;
  /// Share of their friction at rest that decisions count on: less than 1 frees joints that are at the limit.
  std::vector<double> reserve;
  // What a solution found:
  std::vector<double> shares;   ///< effort of a sticking joint by what it can bear; NaN for others
  std::vector<double> normals;  ///< normal force of a slide or slot (N); NaN for others
  std::size_t held = 0;         ///< number of independent motions that sticking joints prevent

  /// States of no joint.
  FrictionStates() = default;
  /// States that follow the rates.
  ///
  /// @param joints number of joints of the linkage
  explicit FrictionStates(std::size_t joints);
};

/// The coefficient of friction of a joint that slides.
///
/// @param joint the joint
/// @param speed speed of sliding (m/s; of a pin at its rim), in the sense of its friction
/// @returns the coefficient
double friction_coefficient(const LinkageJoint& joint, double speed);

/// The coefficient of friction of a joint at rest.
///
/// @param joint the joint
/// @returns the coefficient
double friction_at_rest(const LinkageJoint& joint);

/// Coulomb friction of all joints that slide: adds it to the loads of `forces`, which hold everything else
/// that acts, and to the joint forces. `balance` finds these for the loads as they are; accelerations may
/// change with them, as long as all of it is affine in the loads. After it has been called once.
///
/// Joint forces are affine in the sizes of the frictions, and these are functions of the joint forces, times
/// their coefficients. Of several solutions it is the one that grows out of that without friction, found to
/// 1e-14 of the largest. Where it ceases to exist before friction has its size the status is self_locking: no
/// finite forces keep the linkage going on as it does; else done. Without `states`, joints at rest relative
/// to each other have no friction; with them, the friction of a joint that sticks is the effort that keeps
/// its acceleration zero (stick_efforts), for which `balance` has to let the accelerations give way.
Status settle_friction(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                       const std::function<void()>& balance, LinkageForces& forces,
                       FrictionStates* states = nullptr);

}  // namespace linkwright::planar
