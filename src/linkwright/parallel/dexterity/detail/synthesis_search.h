// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/parallel/dexterity/detail/synthesis_model.h"

/// One local search of dexterity_synthesis.h, and the search between nodes.
namespace linkwright::parallel {

/// From a start of all unknowns to a design that no node objects to: sequential quadratic programming on a
/// working set of poses, to which the nodes that miss a limit most, or are worse than the worst so far, are
/// added. `x` of its start are the unknowns.
struct Descent {
  DexterityStart start;
  /// True if `extremes` cover all nodes there; false when the run ended before all had been measured once:
  /// then `start` has no objective.
  bool known = false;
  Extremes extremes;
};
Descent descend(const DexterityModel& model, const DexterityOptions& options, std::vector<double> start,
                RunContext& context);

/// A place where an index goes furthest in the direction that its limit does not like, nearby.
struct BetweenNodes {
  DexterityModel::At at;
  double value = 0;  ///< value, as in Extremes
};
/// Such places, worst first: from the worst nodes that lie apart and come close to the worst of all, within
/// `close`, a search without derivatives in the cells around each. `poses` grows by what was measured.
std::vector<BetweenNodes> between_nodes(const DexterityModel& model, const DesignedRobot& designed,
                                        PoseLimit::Kind kind, int leg, double close, RunContext& context,
                                        std::int64_t& poses);

}  // namespace linkwright::parallel
