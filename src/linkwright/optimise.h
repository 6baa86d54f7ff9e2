// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @defgroup optimise Optimisation
/// Problems and populations, as path syntheses state them. The methods that solve them are reached through
/// study files.
///
/// @code
/// using namespace linkwright::optimise;
/// Problem problem;
/// problem.variables = {{.name = "crank_m", .lower = 0.01, .upper = 0.1}};
/// problem.evaluate = [](const PopulationView& candidates, std::span<double> cost,
///                       std::span<double> violation) {
///   for (std::size_t i = 0; i < candidates.size; ++i) {
///     cost[i] = std::abs(candidates.row(0)[i] - 0.05);
///     violation[i] = 0;
///   }
/// };
/// @endcode

/// @namespace linkwright::optimise
/// Problems of minimisation and populations of candidates.

#include "linkwright/optimise/problem.h"
