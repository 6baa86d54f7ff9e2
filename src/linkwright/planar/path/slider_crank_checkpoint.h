#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "linkwright/core/value.h"
#include "linkwright/planar/path/slider_crank/synthesis.h"

namespace linkwright::planar {

/// A finished seed (status done or infeasible) as a checkpoint keeps it: the mechanisms, not what they
/// achieve.
Value kept(const SliderPathSynthesis& run);

/// The seed that was kept, with the same bits. Its designs are measured against the problem again, so that no
/// result can be read that the mechanism does not give. Throws CheckpointError, naming `what`, for everything
/// that `kept` cannot have made.
SliderPathSynthesis restored(const Value& value, const SliderPathProblem& problem, std::string_view what);

}  // namespace linkwright::planar
