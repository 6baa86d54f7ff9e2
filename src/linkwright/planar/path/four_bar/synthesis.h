// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/run_context.h"
#include "linkwright/planar/path/answer.h"
#include "linkwright/planar/path/four_bar/problem.h"

namespace linkwright::planar {

using PathSynthesis = PathAnswer<FourBarPath>;

/// The recommended method. Prescribed and relative timing: the linear unknowns (scale, rotation, position,
/// tracing point) are eliminated (variable projection), full crank rotation holds by construction, and
/// Levenberg-Marquardt with the exact Jacobian runs from many starts. Free timing: see
/// search_free_timing. Where a bound or limit is active, an augmented Lagrangian finishes. When the best
/// design has drawbacks (usability.h), the best one without them is looked for and stands beside it.
PathSynthesis synthesise_path(const PathProblem& problem, const PathSynthesisOptions& options,
                              RunContext& context);

}  // namespace linkwright::planar
