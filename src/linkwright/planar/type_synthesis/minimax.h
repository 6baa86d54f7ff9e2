// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/run_context.h"
#include "linkwright/planar/type_synthesis/polish.h"

namespace linkwright::planar {

/// From the least sum of squares to the least greatest error of a function, the pair angles kept: a
/// sequential quadratic programme on the errors of all samples. The machine stays as it is where that finds
/// nothing better; what else limits it is not looked at.
void lessen_greatest_error(const MotionTarget& target, const MachineLimits& limits, FittedMachine& machine,
                           RunContext& context);

}  // namespace linkwright::planar
