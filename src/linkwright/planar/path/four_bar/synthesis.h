// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/run_context.h"
#include "linkwright/planar/path/answer.h"
#include "linkwright/planar/path/four_bar/problem.h"

namespace linkwright::planar {

/// The outcome of one seed of the synthesis of four-bars.
using PathSynthesis = PathAnswer<FourBarPath>;

/// Synthesis of a four-bar for a path by the recommended method. Prescribed and relative timing: the linear
/// unknowns (scale, rotation, position, tracing point) are eliminated (variable projection), full crank
/// rotation holds by construction, and Levenberg-Marquardt with the exact Jacobian runs from many starts.
/// Free timing: see search_free_timing. Where a bound or limit is active, an augmented Lagrangian finishes.
/// When the best design has drawbacks (usability.h), the best one without them is looked for and returned
/// with it.
///
/// @param problem the problem
/// @param options seed, number of starts and of designs
/// @param context progress, deadline, cancellation and threads of the run
/// @returns the designs and the course of the search
/// @throws ContractError as require_valid does, and unless starts >= 0 and max_solutions >= 1
PathSynthesis synthesise_path(const PathProblem& problem, const PathSynthesisOptions& options,
                              RunContext& context);

}  // namespace linkwright::planar
