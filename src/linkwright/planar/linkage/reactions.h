// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// The load that a joint carries: force (N, global frame) and moment (N m) of its first body on its second,
/// at `point`: where the point of the second body is. Revolute joints and pins in slots have no moment; of a
/// driven joint the drive's torque or force is included. A gear's moment is what it turns its second body
/// with; its force is that of the teeth at the pitch point, where that is known (Gear::mesh). Friction of the
/// joint is not in it: it is among the loads.
struct JointReaction {
  Vec<double> point{0, 0};
  Vec<double> force{0, 0};
  double moment = 0;
  /// gear: force along the teeth on its second body, positive to the left of the line from the first centre
  /// to the second, and how strongly the wheels are pressed apart; NaN where the mesh is not known.
  double tangential = 0, separating = 0;
};

/// A load on a body: a force at a point of the global frame and a torque.
struct AppliedLoad {
  int body = 0;
  Vec<double> point{0, 0};
  Vec<double> force{0, 0};
  double torque = 0;
};

/// Joint forces of a linkage at one instant; use one again and again.
struct LinkageForces {
  Status status = Status::done;       ///< status of the motion; self_locking when friction blocks it
  std::vector<JointReaction> joints;  ///< one a joint of the linkage
  std::vector<double> drives;  ///< one an input: torque (N m) or force (N) of the first body on the second
  std::vector<AppliedLoad> loads;  ///< springs, forces, torques, friction as they acted; no weight
  /// Force of the mechanism, and of bodies welded to the ground, on the ground, weight included.
  Vec<double> shaking_force{0, 0};
  /// The moment on the ground about Linkage::moment_centre, with everything that acts on it ...
  double shaking_moment_with_drive = 0;
  /// ... and without the torques of drives that are mounted on the ground.
  double shaking_moment = 0;
  double drive_power = 0;    ///< W, of all drives
  double load_power = 0;     ///< W, of springs, forces, torques and friction on the moving bodies
  double weight_power = 0;   ///< W
  double kinetic_power = 0;  ///< W: rate of the kinetic energy by velocities and accelerations
  int iterations = 0;        ///< iterations of the friction; 0 = none
  // Memory.
  std::vector<Wrench<double>> needed, group_joints;
  std::vector<double> group_drives;
};

/// Forces of springs, dampers, forces and torques at the present motion, appended to `loads` in this order,
/// two for each spring and torque. `time` in s and `input` (value of the first input, rad or m) are what load
/// tables may depend on.
void applied_loads(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion, double time,
                   double input, std::vector<AppliedLoad>& loads);

/// Given the drives (N m or N, one an input) that the accelerations in the motion ask for, changes these
/// accelerations so that the free inputs ask for none.
using FreeAccelerations = std::function<void(std::span<const double> drives)>;

/// All joint forces, drive torques and the loads on the ground, by d'Alembert's principle along the
/// decomposition, last group first: 3 x 3 (in fact 2 x 2) equations a dyad. After solve_acceleration of the
/// same motion; with a plan made `all_at_once` the Newton-Euler equations of all bodies in one linear system,
/// the independent route. Friction of joints is that of settle_friction, with its status.
///
/// `answer` is for inputs that no drive prescribes: their accelerations give way to friction. Else the status
/// is that of the motion; forces are NaN unless it is done. Throws ContractError when a body has no mass (see
/// LinkagePlan::massless).
void solve_forces(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion, double time,
                  double input, LinkageForces& forces, const FreeAccelerations& answer = {});

}  // namespace linkwright::planar
