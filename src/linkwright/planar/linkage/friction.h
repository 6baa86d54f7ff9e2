// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// Coulomb friction of all joints that slide: adds it to the loads of `forces`, which hold everything else
/// that acts, and to the joint forces. `balance` finds these for the loads as they are; accelerations may
/// change with them, as long as all of it is affine in the loads. After it has been called once.
///
/// Joint forces are affine in the sizes of the frictions, and these are functions of the joint forces, times
/// their coefficients. Of several solutions it is the one that grows out of that without friction, found to
/// 1e-14 of the largest. Where it ceases to exist before friction has its size the status is self_locking: no
/// finite forces keep the linkage going on as it does; else done. Joints at rest relative to each other have
/// no friction.
Status settle_friction(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                       const std::function<void()>& balance, LinkageForces& forces);

}  // namespace linkwright::planar
