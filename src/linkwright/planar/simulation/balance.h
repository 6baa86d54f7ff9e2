// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/planar/simulation/simulation.h"

namespace linkwright::planar {

/// True if a linkage whose inputs are all free is in unstable balance where they are: at rest, without
/// acceleration but for rounding, and with a displacement that grows by itself, as an inverted pendulum has.
/// There the rounding of the start decides when the linkage leaves its place, and to which side.
///
/// Balance means accelerations below those of a displacement by 1e-9 rad (or sizes of the linkage);
/// displacements are tried at 1e-4. False with friction, which holds such a linkage, where a drive moves an
/// input, and where the start cannot be assembled. Throws ContractError when the drives do not fit the plan
/// or a body has no mass.
bool in_unstable_balance(const Linkage& linkage, const LinkagePlan& plan, std::span<const InputDrive> drives,
                         double time);

}  // namespace linkwright::planar
