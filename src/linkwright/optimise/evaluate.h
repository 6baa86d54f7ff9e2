// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/core/run_context.h"
#include "linkwright/optimise/problem.h"

namespace linkwright::optimise {

/// Problem::evaluate on up to `threads` threads (0 = all): populations of more than 256 candidates in parts.
void evaluate(const Problem& problem, const PopulationView& candidates, std::span<double> cost,
              std::span<double> violation, int threads);

/// The same on the threads of a run, which is looked at before each part but the first: throws Interrupted
/// when it is to stop, as `problem` itself may. Costs and violations of parts that were not evaluated then
/// are NaN.
void evaluate(const Problem& problem, const PopulationView& candidates, std::span<double> cost,
              std::span<double> violation, const RunContext& context);

}  // namespace linkwright::optimise
