// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/planar/path/slider_crank/problem.h"
#include "linkwright/planar/path/task.h"

namespace linkwright::planar {

using SliderPathSynthesis = PathAnswer<SliderCrankPath>;

/// The recommended method for the path alone. Prescribed timing: the linear unknowns are eliminated, full
/// rotation and pressure angle hold by construction, stroke and lengths by the exact clip of the projection,
/// and Levenberg-Marquardt with the exact Jacobian runs in three unknowns from many starts. Free timing:
/// starts by matching random curves to the path, then Levenberg-Marquardt in all unknowns. Where a bound or
/// limit that the projection does not see is active, an augmented Lagrangian finishes.
SliderPathSynthesis synthesise_path(const SliderPathProblem& problem, const PathSynthesisOptions& options,
                                    RunContext& context);

/// Least path error for each of `strokes` (m, any order) as greatest stroke: points of the front of path
/// error against stroke, those that another one dominates left out. Every point is a search of its own, from
/// many starts and from its neighbours on both sides. Throws ContractError for strokes that are not positive,
/// and unless the crank is to turn fully.
SliderPathSynthesis synthesise_slider_front(const SliderPathProblem& problem, std::span<const double> strokes,
                                            const PathSynthesisOptions& options, RunContext& context);

/// The feasible designs that no other one dominates in error and stroke, by falling stroke.
std::vector<SliderPathDesign> slider_front_of(std::vector<SliderPathDesign> designs);

}  // namespace linkwright::planar
