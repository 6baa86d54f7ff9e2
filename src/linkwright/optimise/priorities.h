// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/optimise/problem.h"

namespace linkwright::optimise {

/// Objectives by priority. One is met when its cost is at most its tolerance; those of lower priority count
/// only when all above them are met.
struct Priorities {
  std::vector<double> tolerances;  ///< one an objective, more than 0; empty = all 1
  std::vector<std::size_t> order;  ///< all objectives, the most important first; empty = as they come
};

/// The key that ranks costs.
struct PriorityKey {
  std::size_t met = 0;  ///< objectives met before the first that is not
  /// Cost over tolerance of that first one, more than 1; the largest of all, at most 1, when all are met.
  double ratio = 0;
};

/// The key of costs, one an objective and none less than 0. Throws ContractError for tolerances or an order
/// that are none, or do not fit the costs.
PriorityKey priority_key(std::span<const double> costs, const Priorities& priorities);

/// True if a is better: more objectives met or, of as many, the lesser ratio. The rule of the
/// wheel-suspension studies, Eq. (78) there, which compares the ratios alone: by that a design that misses
/// the first objective by 1.5 were better than one that misses only the second, by 55.
bool better(const PriorityKey& a, const PriorityKey& b);

/// The key as one number, 1 - met - 1 / (1 + ratio), for methods that compare numbers: of two keys the better
/// one never has the larger number. Proof: let n be the number of objectives. 1 - 1 / (1 + ratio) is at least
/// 1/2 and at most 1 for a ratio more than 1, and at least 0 and at most 1/2 for one in [0, 1], so keys with
/// `met` of n - 1 or less have numbers in [1/2 - met, 1 - met], those with n in [-n, 1/2 - n]: the intervals
/// of two values of `met` have no point in common, the larger `met` lies lower. Within one, each operation
/// increases with the ratio, and rounding keeps to that. Ratios that differ by less than about
/// (1 + ratio)^2 met eps may have the same number.
///
/// All n objectives are met exactly when the number is at most 1/2 - n, a target cost for minimise.
double priority_cost(const PriorityKey& key);

/// A problem of one objective, priority_cost of the objectives of `problem`; see combine.h.
Problem by_priority(const Problem& problem, const Priorities& priorities = {});

}  // namespace linkwright::optimise
