// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/study/result.h"
#include "linkwright/suspension/studies/indirect.h"

namespace linkwright::suspension {

/// Every rod through seven positions, complex solutions too, and the hinged arms that rods in families stand
/// for: what there is to choose from, where the search takes one rod for each box.
void add_seven_poses(study::Result& result, const IndirectStudy& s, const CarrierTargets& targets);

}  // namespace linkwright::suspension
