#pragma once

#include <span>

#include "linkwright/optimise/population.h"
#include "linkwright/optimise/problem.h"

namespace linkwright::optimise {

/// Problem::evaluate on up to `threads` threads (0 = all): populations of more than 256 candidates in parts.
void evaluate(const Problem& problem, const PopulationView& candidates, std::span<double> cost,
              std::span<double> violation, int threads);

}  // namespace linkwright::optimise
