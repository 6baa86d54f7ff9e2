// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "linkwright/core/run_context.h"
#include "linkwright/optimise/nlopt_bridge.h"

namespace linkwright::optimise {

/// Minimises the largest of several smooth functions, max_k f_k(x) / reference_k, over lower <= x <= upper
/// subject to m constraints g_i(x) <= 0. The largest has kinks, its epigraph has none: x and t are sought
/// with the least t such that f_k(x) / reference_k <= t (for example Boyd and Vandenberghe 2004, section
/// 4.1.3), by slsqp, so that objectives and constraints need derivatives.
///
/// references: one a function, more than 0, for example what each is to be compared with; empty = all 1.
/// x is the start, and the best point evaluated in the end, as for minimise_local. In the report `cost` is
/// the largest ratio at x, and `violation` is of the constraints. For a local minimum only: begin from
/// several starts where there may be others.
///
/// Throws ContractError as minimise_local does, and for references of the wrong number or not above 0, no
/// functions, or another method than slsqp.
LocalReport minimise_largest(std::size_t functions, ValuesFunction objectives,
                             std::span<const double> references, std::size_t m, ValuesFunction constraints,
                             std::span<double> x, std::span<const double> lower,
                             std::span<const double> upper, const LocalOptions& options, RunContext& context);

/// Without constraints.
LocalReport minimise_largest(std::size_t functions, ValuesFunction objectives,
                             std::span<const double> references, std::span<double> x,
                             std::span<const double> lower, std::span<const double> upper,
                             const LocalOptions& options, RunContext& context);

}  // namespace linkwright::optimise
