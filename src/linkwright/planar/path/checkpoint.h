#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/core/value.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/path/four_bar/synthesis.h"

namespace linkwright::planar {

/// What one seed of a path synthesis study came to.
struct PathSeedRun {
  Status status = Status::done;
  std::vector<PathDesign> designs;  ///< best first
  std::vector<SearchPoint> history;
  std::int64_t evaluations = 0;
};

/// A finished seed (status done or infeasible) as a checkpoint keeps it: the linkages, not what they achieve.
Value kept(const PathSeedRun& run);

/// The seed that was kept, with the same bits. Its designs are measured against the problem again, so that
/// no result can be read that the linkage does not give. Throws CheckpointError, naming `what`, for
/// everything that `kept` cannot have made.
PathSeedRun restored(const Value& value, const PathProblem& problem, std::string_view what);

}  // namespace linkwright::planar
