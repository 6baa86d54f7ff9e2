// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// For programs that use pagmo themselves; link Linkwright::pagmo_adapters. It is the one header of this
// library that shows pagmo. Programs that include pagmo's CMA-ES or xNES (or pagmo/pagmo.hpp) are to be
// compiled without -march, -mavx and sanitizers: these headers bring code for Eigen's matrices along, which
// allocates memory in another way with such flags, and pagmo itself is built without them; it crashes when
// they differ. Our cma_es does not mind.

#include <cstdint>
#include <pagmo/algorithm.hpp>
#include <pagmo/problem.hpp>

#include "linkwright/optimise/methods.h"
#include "linkwright/optimise/problem.h"

namespace linkwright::optimise {

/// A problem for the algorithms of pagmo, with as many objectives and its bounds, one at a time or in
/// batches. It has no constraints, as most of those algorithms take none: candidates that violate constraints
/// have in every objective the cost of `cost_by_feasibility_rules`. Algorithms that leave the bounds (CMA-ES
/// and xNES unless they are set to keep them) evaluate outside of them.
pagmo::problem pagmo_problem(Problem problem);

/// One of our population methods for a population of pagmo, of a problem with one objective, with or without
/// constraints (the sum of what exceeds their tolerances is the violation).
///
/// `evolve` begins with the members and costs of the population, instead of the first random ones, and
/// runs the generations of the options; the population of the options does not count. Schedules and
/// adapted factors begin again with each `evolve`. At its end the members of the method are evaluated once
/// more, as pagmo asks for their costs, and the best candidate found takes the place of the worst member if
/// it is not among them. Batches are used where the problem takes them. Integer variables are refused.
///
/// The seed decides all; every further `evolve` of one algorithm draws other numbers.
pagmo::algorithm pagmo_algorithm(const OptimiserOptions& method, unsigned seed);

}  // namespace linkwright::optimise
