#pragma once

#include "linkwright/parallel/dexterity_synthesis_model.h"

/// One local search of dexterity_synthesis.h, and the search between nodes.
namespace linkwright::parallel {

/// From a start of all unknowns to a design that no node objects to: sequential quadratic programming on a
/// working set of poses, to which the nodes that miss a limit most, or are worse than the worst so far, are
/// added. `x` of the result are the unknowns.
DexterityStart descend(const DexterityModel& model, const DexterityOptions& options,
                       std::vector<double> start, RunContext& context);

/// The place near a node where an index is extreme in the direction that its limit does not like.
struct BetweenNodes {
  DexterityModel::At at;
  double value = 0;  ///< of the Extreme that it would be
  std::int64_t poses = 0;
};
BetweenNodes between_nodes(const DexterityModel& model, const DesignedRobot& designed, PoseLimit which,
                           RunContext& context);

}  // namespace linkwright::parallel
