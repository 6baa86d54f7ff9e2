// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/planar/path/four_bar/problem.h"

namespace linkwright::planar {

/// Crank angles at which a given linkage meets the targets of a path best.
struct PathAssignment {
  std::vector<double> angles;  ///< one a target (rad), unwrapped in the sense of rotation
  double error = 0;            ///< sum of squared misses at these angles (m2)
};

/// The best way for `linkage` to meet the targets in their order within one turn, over all ways: every local
/// nearest place of the path counts, so that a target at a crossing or next to a cusp gets the place that
/// leaves the others theirs. Dynamic programming over the cyclic order on a fine grid of crank angles, then a
/// parabola through the grid at each target; exact to the square of the grid's step. Linkages whose crank
/// does not turn fully stay in the interval of inputs that holds `near` (rad). Empty where none holds it.
std::optional<PathAssignment> assign_crank_angles(const PathProblem& problem, const FourBar& linkage,
                                                  double sense, double near);

}  // namespace linkwright::planar
