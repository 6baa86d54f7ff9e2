// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/run_context.h"
#include "linkwright/planar/type_synthesis/polish.h"

namespace linkwright::planar {

/// From the least sum of squares to the least greatest error of a function, with all limits kept: a
/// sequential quadratic programme on the errors of all samples. Given ground pivots are met at every step.
/// The machine stays as it is where that finds nothing better.
void lessen_greatest_error(const MotionTarget& target, const MachineLimits& limits, FittedMachine& machine,
                           RunContext& context);

}  // namespace linkwright::planar
