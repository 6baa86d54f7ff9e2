// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "linkwright/optimise/smooth_problem.h"
#include "linkwright/planar/four_bar/as_linkage.h"
#include "linkwright/planar/studies/balancing.h"

namespace linkwright::planar {

/// Acceleration of free fall (m/s2) along -y, as closed forms have it; nothing when it points elsewhere.
std::optional<double> weight_along_y(const Linkage& linkage);

/// The machine of one design.
FourBarMechanism four_bar_of(const BalancingStudy& study, std::span<const double> x);

/// The problem of a study of a four-bar with designed lengths and masses, evaluated many machines at a time
/// (balancing_values) instead of the general method. Nothing when the study asks for more than that knows:
/// other design variables, other quantities than components of forces and torques, or constraints.
std::optional<optimise::SmoothProblem> four_bar_problem(const BalancingStudy& study,
                                                        const BalancingProblem& problem);

}  // namespace linkwright::planar
