// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/planar/type_synthesis/polish.h"

namespace linkwright::planar {

/// Machines of two dyads that lead a body through poses, or near them: a crank and a link, a slide on the
/// ground or a swinging sleeve, from all dyads that five poses have, those that fit more poses best, or a
/// sweep of those that fewer poses have. At their crank angles at the poses, those first that keep the limits
/// best, and at most `count`; none of other families than four-bars, slider-cranks and inverted sliders.
///
/// @param target poses of a body at any crank angles
/// @param limits what the order of the machines heeds
/// @param family the family of all of them
/// @param count largest number
/// @param context may end it early
std::vector<FittedMachine> pose_starts(const MotionTarget& target, const MachineLimits& limits,
                                       MachineFamily family, std::size_t count, const RunContext& context);

}  // namespace linkwright::planar
