// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/planar/linkage/motion.h"

// A group without closed form: Newton's method on the places of its parts. The Jacobian has one row a joint
// equation, in terms of velocities of part origins and angular speeds; the same matrix gives velocities and
// accelerations and, transposed, the joint forces.
namespace linkwright::planar {

/// Memory for one general group of a plan.
GeneralGroupPointer general_group_memory(const LinkagePlan& plan, const Group& group);

/// Places the parts of the group from the places they have; the known parts must be placed. Quadratic
/// convergence to rounding; `gap` in the motion is the largest joint residual (m).
/// Returns done, singular or not_converged (which includes: no assembly near the start).
Status place_general(const LinkagePlan& plan, const Group& group, std::span<const InputMotion> inputs,
                     LinkageMotion& motion, GeneralGroupMemory& memory);
/// Sign of the determinant at the last place: changes where branches meet.
double determinant_sign(const GeneralGroupMemory& memory);
/// Smallest pivot over largest: near 0 at a dead point.
double conditioning(const GeneralGroupMemory& memory);

void general_velocity(const LinkagePlan& plan, const Group& group, std::span<const InputMotion> inputs,
                      LinkageMotion& motion, GeneralGroupMemory& memory);
void general_acceleration(const LinkagePlan& plan, const Group& group, std::span<const InputMotion> inputs,
                          LinkageMotion& motion, GeneralGroupMemory& memory);

/// Joint wrenches of the group, of the part before on the part after, about the point of the part after; the
/// torques or forces of drives inside (NaN where a joint has none); and the loads of the gears, whose teeth
/// press where their mesh is known, and behind them of racks and strands. `needed` as for dyad_forces.
void general_forces(const LinkagePlan& plan, const Group& group, const LinkageMotion& motion,
                    GeneralGroupMemory& memory, std::span<Wrench<double>> needed,
                    std::span<Wrench<double>> joints, std::span<double> drives,
                    std::span<JointReaction> gears);

}  // namespace linkwright::planar
