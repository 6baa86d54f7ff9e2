// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "linkwright/optimise/problem.h"

namespace linkwright::optimise {

/// One number of the costs of several objectives. Does not decrease when a cost grows; pure.
using CombinedCost = std::function<double(std::span<const double> costs)>;

/// The problem of one objective that the functions below make.
struct Combination {
  Problem problem;  ///< the problem of several objectives
  CombinedCost cost;
  std::vector<double> at_most;  ///< caps, one an objective, or empty
};

/// A problem of one objective, `cost` of the objectives of `problem`: so that methods of one objective
/// minimise it, too. minimise still reports all objectives of what it finds.
///
/// at_most: caps, one an objective, infinite = none; empty = no caps. By how much an objective exceeds its
/// cap is added to the violation (objectives are relative to a reference and so comparable, see Problem).
/// Candidates whose costs do not exist violate anyway and only that counts.
///
/// Throws ContractError for another number of caps than objectives, and for a NaN.
Problem combine(const Problem& problem, CombinedCost cost, std::span<const double> at_most = {});

/// Sum of weight_k f_k. weights: one an objective, at least 0 and not all 0; empty = all alike with the sum
/// 1, which makes it the mean. An objective of weight 0 does not count. Throws ContractError for other
/// weights, and as `combine` does.
Problem weighted_sum(const Problem& problem, std::span<const double> weights = {},
                     std::span<const double> at_most = {});

/// The largest of f_k. For smooth functions with derivatives see minimise_largest.h.
Problem largest(const Problem& problem, std::span<const double> at_most = {});

/// The total excess of the costs over the caps of a combination.
double excess(const Combination& combination, std::span<const double> costs);

}  // namespace linkwright::optimise
