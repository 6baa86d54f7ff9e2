// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/suspension/compliance/compliance.h"

namespace linkwright::suspension {

/// Forces in the joints of a suspension with rigid links for a load on its carrier.
struct CornerForces {
  Status status = Status::done;    ///< singular: at a fold
  std::vector<JointForce> joints;  ///< links in their order, joint at the body first; R and S have only that
  std::vector<double> couplers;    ///< N, tension
  double support = 0;  ///< N: compression of the spring, or upward force of the height that is held
};

/// Balance of the load by the transposed equations: each equation's force works against its own violation
/// only. `support` spring or spring_held: the spring takes what the links leave (the same without
/// elasticity). A hinge is taken in the middle between its two points. The rack is held.
CornerForces solve_forces(const Suspension& suspension, const CornerPlan& plan,
                          const CornerPosition& position, const WheelLoad& load, Support support);

/// Force along a rod: positive pushes the carrier away from the body. Of the joint of a US or SS link at the
/// carrier or at the body.
double rod_force(const Suspension& suspension, const CornerPosition& position, const JointForce& joint);

}  // namespace linkwright::suspension
