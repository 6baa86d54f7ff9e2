// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "linkwright/core/sentence.h"
#include "linkwright/core/table.h"
#include "linkwright/planar/path/task.h"
#include "linkwright/study/result.h"
#include "linkwright/study/scene.h"

// Reports of the targets of a path and of the deviations of a tracing point, for any mechanism.
namespace linkwright::planar {

/// Distances below this share of the size of the path are rounding.
inline constexpr double exact_share = 1e-12;

/// "passes the 9 points within 0.2 mm (root mean square 0.1 mm)"; `error`: sum of squares (m2).
Sentence how_near(const PathTargets& targets, const PathErrors& errors, double error);

/// The fact "worst point".
study::Fact worst_fact(const PathTargets& targets, const PathErrors& errors);

/// Targets, the crank angles there (rad), where the design comes, and how far off; with tolerances, where
/// there are any, and how far beyond them.
Table point_table(const PathTargets& targets, const std::vector<double>& angles, const PathErrors& errors,
                  std::string name);

/// The targets in a drawing: points that can be dragged, or gates with their posts.
void add_targets(study::Scene& scene, const PathTargets& targets, const std::vector<double>& angles,
                 const PathErrors& errors);

}  // namespace linkwright::planar
