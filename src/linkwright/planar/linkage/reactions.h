// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// The load that a joint carries: force (N, global frame) and moment (N m) of its first body on its second.
/// Revolute joints and pins in slots have no moment; that of a driven joint includes the torque or force of
/// its drive. The moment of a gear is what it turns its second body with; its force is that of the teeth at
/// the pitch point, where that is known (Gear::mesh). Friction of the joint is not included: it is among the
/// loads.
struct JointReaction {
  math::Vec2 point{0, 0};  ///< position of the point of the second body, global, m
  math::Vec2 force{0, 0};  ///< N, global
  double moment = 0;       ///< N m, about `point`
  /// gear: force across the line of centres on its second body (N), positive to the left of the line from the
  /// first centre to the second; NaN where the mesh is not known. rack: force along the pitch line on the
  /// rack.
  double tangential = 0,
         separating = 0;  ///< gear, rack: force that presses the wheels apart (N); NaN likewise
};

/// A load on a body: a force at a point of the global frame and a torque.
struct AppliedLoad {
  int body = 0;            ///< index of the body
  math::Vec2 point{0, 0};  ///< global, m
  math::Vec2 force{0, 0};  ///< N, global
  double torque = 0;       ///< N m
};

/// Joint forces of a linkage at one instant; use one again and again.
struct LinkageForces {
  /// Status of the motion; self_locking when friction blocks it; limit_reached when a gas spring is beyond
  /// its stroke.
  Status status = Status::done;
  std::vector<JointReaction> joints;  ///< one a joint of the linkage
  /// One a strand of the plan: `tangential` is its tension (N), negative where it would have to push; the
  /// force is that on the second wheel, and acts on the first one along the same line.
  std::vector<JointReaction> strands;
  std::vector<double> drives;  ///< one an input: torque (N m) or force (N) of the first body on the second
  std::vector<AppliedLoad> loads;  ///< springs, loads, struts, friction as they acted; no weight
  /// Force of the mechanism, and of bodies welded to the ground, on the ground (N), weight included.
  math::Vec2 shaking_force{0, 0};
  /// Moment on the ground about Linkage::moment_centre (N m), with everything that acts on it.
  double shaking_moment_with_drive = 0;
  /// The same without the torques of drives that are mounted on the ground (N m).
  double shaking_moment = 0;
  double drive_power = 0;    ///< W, of all drives
  double load_power = 0;     ///< W, of springs, forces, torques and friction on the moving bodies
  double weight_power = 0;   ///< W
  double kinetic_power = 0;  ///< W: rate of the kinetic energy by velocities and accelerations
  int iterations = 0;        ///< iterations of the friction; 0 = none
  // Memory.
  std::vector<Wrench<double>> needed,      ///< memory: what the parts need
      group_joints;                        ///< memory: forces in the joints of a group
  std::vector<double> group_drives;        ///< memory: drives of a group
  std::vector<JointReaction> group_gears;  ///< memory: gears, racks and strands of a group
  std::vector<double> preload;             ///< memory: tension that all strands of a belt have in common
};

/// Forces of springs, dampers, forces, torques and struts at the present motion, appended to `loads` in this
/// order, two for each spring, torque and strut.
///
/// @param linkage the linkage
/// @param plan its plan
/// @param motion its motion, velocities included
/// @param time time for load tables (s)
/// @param input value of the first input for load tables (rad or m)
/// @param loads receives the loads at its end
void applied_loads(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion, double time,
                   double input, std::vector<AppliedLoad>& loads);

/// A function that is given the drives (N m or N, one an input) that the accelerations in the motion ask for,
/// and changes these accelerations so that the free inputs ask for none.
using FreeAccelerations = std::function<void(std::span<const double> drives)>;

/// All joint forces, drive torques and the loads on the ground, by d'Alembert's principle along the
/// decomposition, last group first: 3 x 3 (in fact 2 x 2) equations a dyad. It needs solve_acceleration of
/// the same motion. A plan made `all_at_once` leads to the Newton-Euler equations of all bodies in one linear
/// system, the independent route. Friction of joints is that of settle_friction, with its status.
///
/// The status is that of the motion; forces are NaN unless it is done.
///
/// @param linkage the linkage, with masses and loads
/// @param plan its plan
/// @param motion its motion, accelerations included
/// @param time time for load tables (s)
/// @param input value of the first input for load tables (rad or m)
/// @param forces receives the forces; use one again and again
/// @param answer for inputs that no drive prescribes: their accelerations give way to friction; empty if all
///   are driven
/// @throws ContractError when a body has no mass (see LinkagePlan::massless)
///
/// @throws ContractError if a body has no mass (see LinkagePlan::massless)
void solve_forces(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion, double time,
                  double input, LinkageForces& forces, const FreeAccelerations& answer = {});

}  // namespace linkwright::planar
