// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/priorities.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/optimise/combine.h"

namespace linkwright::optimise {
namespace {

void require_valid(const Priorities& priorities, std::size_t objectives) {
  const std::vector<double>& tolerances = priorities.tolerances;
  const std::vector<std::size_t>& order = priorities.order;
  LINKWRIGHT_REQUIRE(tolerances.empty() || tolerances.size() == objectives, "{} tolerances for {} objectives",
                     tolerances.size(), objectives);
  for (std::size_t k = 0; k < tolerances.size(); ++k)
    LINKWRIGHT_REQUIRE(tolerances[k] > 0 && std::isfinite(tolerances[k]),
                       "tolerance {} must be more than 0, got {}", k, tolerances[k]);
  LINKWRIGHT_REQUIRE(order.empty() || order.size() == objectives, "an order of {} for {} objectives",
                     order.size(), objectives);
  for (std::size_t k = 0; k < order.size(); ++k)
    LINKWRIGHT_REQUIRE(std::find(order.begin(), order.end(), k) != order.end(),
                       "objective {} is missing in the order", k);
}

PriorityKey key_of(std::span<const double> costs, const Priorities& priorities) {
  PriorityKey key;
  for (; key.met < costs.size(); ++key.met) {
    const std::size_t k = priorities.order.empty() ? key.met : priorities.order[key.met];
    const double ratio = priorities.tolerances.empty() ? costs[k] : costs[k] / priorities.tolerances[k];
    if (ratio > 1) {
      key.ratio = ratio;
      return key;
    }
    key.ratio = std::max(key.ratio, ratio);
  }
  return key;
}

}  // namespace

PriorityKey priority_key(std::span<const double> costs, const Priorities& priorities) {
  require_valid(priorities, costs.size());
  for (std::size_t k = 0; k < costs.size(); ++k)
    LINKWRIGHT_REQUIRE(costs[k] >= 0, "cost {} must be at least 0, got {}", k, costs[k]);
  return key_of(costs, priorities);
}

bool better(const PriorityKey& a, const PriorityKey& b) {
  if (a.met != b.met) return a.met > b.met;
  return a.ratio < b.ratio;
}

double priority_cost(const PriorityKey& key) {
  return (1 - static_cast<double>(key.met)) - 1 / (1 + key.ratio);
}

Problem by_priority(const Problem& problem, const Priorities& priorities) {
  require_valid(priorities, problem.objectives);
  return combine(problem, [priorities](std::span<const double> costs) {
    return priority_cost(key_of(costs, priorities));
  });
}

}  // namespace linkwright::optimise
