// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/parallel/tool/layout.h"
#include "linkwright/parallel/tool/path.h"

/// The time that a tool takes along parts that join, from rest to rest.
namespace linkwright::parallel {

struct ToolTiming {
  double duration = 0;            ///< s
  std::vector<JerkPhase> phases;  ///< phases of the double S, by the length covered; empty for other laws
};

/// Length of all parts of a run; of a turn on the spot the angle.
double length_of(const ToolRun& run);

/// The least time for a run with parts, within limits that are all more than 0.
///
/// The double S keeps the limits of each part (limits_along, steady_speed) and passes from part to part at
/// the largest speed from which the rest can be run. Another law stretches over the whole run; in shares of
/// its time it is one curve whose derivatives shrink with the powers of the duration, so that the least one
/// follows from their maxima.
ToolTiming timed(const ToolRun& run, TimeLaw law, const ToolLimits& limits);

}  // namespace linkwright::parallel
