// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/planar/simulation/simulation.h"

namespace linkwright::planar {

/// The same motion as `simulate`, by another route: equations of motion in the places of all parts,
///   M a - J^T lambda = loads,  J a = gamma,
/// with one row of J a joint equation, solved at once for accelerations and joint forces (index 1), and
/// places and velocities projected back onto the joints after every step, in the metric of M. No joint is
/// special, so that dead points of the free joints are passed, with the assembly mode changing as the motion
/// has it; change points are passed as rounding has it. Rows within rounding of a dead point of a free joint
/// have the status singular and hold inputs and energies only. `at_change_point` is not used; nothing but the
/// last paragraph differs from `simulate`.
///
/// Throws ContractError also for the method adams, which takes no projection, and for joints with friction.
SimulationReport simulate_all_coordinates(const Linkage& linkage, const LinkagePlan& plan,
                                          std::span<const InputDrive> drives, std::span<const double> times,
                                          const SimulationOptions& options, const SimulationOutput& output,
                                          const RunContext* context = nullptr);

}  // namespace linkwright::planar
