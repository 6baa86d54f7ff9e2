// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/diagnostic.h"
#include "linkwright/suspension/corner/carrier_poses.h"
#include "linkwright/suspension/corner/suspension.h"

/// Slips that a description of a wheel suspension may hold though each of its numbers is one: units mixed up,
/// axes swapped. Reported before they become a suspension that cannot be put together.
namespace linkwright::suspension {

/// Finds values that look like a slip. All measures are relative to the suspension itself - distances from
/// the wheel centre, the tyre's radius - but the size of the whole, which is that of a vehicle within factors
/// of ten. Errors where no wheel suspension could be meant (a factor of fifty and more), warnings where it is
/// unlikely. Keys are those of `check`: "wheel", "link.<name>", "spring", "coupler.<name>", and "hard_points"
/// for the whole.
Diagnostics implausible(const Suspension& suspension);

/// The same for positions of a carrier: how far the wheel centre goes from its reference, which way, and the
/// rack. Keys are "pose"; rows count from 1.
Diagnostics implausible(const CarrierTargets& targets);

}  // namespace linkwright::suspension
