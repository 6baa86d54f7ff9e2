// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/combine.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "linkwright/core/check.h"

namespace linkwright::optimise {
namespace {

/// By how much cost k exceeds its cap; of one that does not exist nothing is said.
double excess(const Combination& combination, std::span<const double> costs, std::size_t k) {
  return std::isfinite(costs[k]) ? std::max(costs[k] - combination.at_most[k], 0.0) : 0;
}

void evaluate(const Combination& combination, const PopulationView& candidates, std::span<double> cost,
              std::span<double> violation) {
  // Memory of the thread, taken away while in use: a part may be combined of others itself.
  thread_local std::vector<double> spare;
  std::vector<double> all = std::exchange(spare, {});
  const std::size_t m = combination.problem.objectives;
  all.resize(candidates.size * m);
  combination.problem.evaluate(candidates, all, violation);
  for (std::size_t i = 0; i < candidates.size; ++i) {
    const std::span<const double> costs(&all[i * m], m);
    cost[i] = combination.cost(costs);
    violation[i] += excess(combination, costs);
  }
  spare = std::move(all);
}

std::vector<Violation> explain(const Combination& combination, std::span<const double> x) {
  const Problem& problem = combination.problem;
  std::vector<Violation> reasons;
  if (problem.explain) reasons = problem.explain(x);
  Population one(x.size(), 1);
  one.set(0, x);
  std::vector<double> costs(problem.objectives), violation(1);
  problem.evaluate(one.view(), costs, violation);
  for (std::size_t k = 0; k < costs.size(); ++k)
    if (const double amount = excess(combination, costs, k); amount > 0)
      reasons.push_back({fmt::format("objective_{}_at_most", k + 1), amount});
  return reasons;
}

}  // namespace

double excess(const Combination& combination, std::span<const double> costs) {
  double sum = 0;
  for (std::size_t k = 0; k < combination.at_most.size(); ++k) sum += excess(combination, costs, k);
  return sum;
}

Problem combine(const Problem& problem, CombinedCost cost, std::span<const double> at_most) {
  LINKWRIGHT_REQUIRE(at_most.empty() || at_most.size() == problem.objectives, "{} caps for {} objectives",
                     at_most.size(), problem.objectives);
  for (std::size_t k = 0; k < at_most.size(); ++k)
    LINKWRIGHT_REQUIRE(!std::isnan(at_most[k]), "cap {}: {}", k, at_most[k]);
  const auto combination = std::make_shared<const Combination>(
      Combination{problem, std::move(cost), {at_most.begin(), at_most.end()}});
  Problem out;
  out.variables = problem.variables;
  out.combination = combination;
  out.evaluate = [combination](const PopulationView& candidates, std::span<double> c,
                               std::span<double> violation) {
    evaluate(*combination, candidates, c, violation);
  };
  out.explain = problem.explain;
  if (!at_most.empty())
    out.explain = [combination](std::span<const double> x) { return explain(*combination, x); };
  return out;
}

Problem weighted_sum(const Problem& problem, std::span<const double> weights,
                     std::span<const double> at_most) {
  const std::size_t m = problem.objectives;
  LINKWRIGHT_REQUIRE(weights.empty() || weights.size() == m, "{} weights for {} objectives", weights.size(),
                     m);
  std::vector<double> w(weights.begin(), weights.end());
  if (w.empty()) w.assign(m, 1 / static_cast<double>(m));
  for (std::size_t k = 0; k < m; ++k)
    LINKWRIGHT_REQUIRE(w[k] >= 0 && std::isfinite(w[k]), "weight {} must be at least 0, got {}", k, w[k]);
  LINKWRIGHT_REQUIRE(std::any_of(w.begin(), w.end(), [](double v) { return v > 0; }), "all weights are 0");
  return combine(
      problem,
      [w](std::span<const double> costs) {
        double sum = 0;
        for (std::size_t k = 0; k < costs.size(); ++k)
          if (w[k] > 0) sum += w[k] * costs[k];  // 0 times infinity is not meant
        return sum;
      },
      at_most);
}

Problem largest(const Problem& problem, std::span<const double> at_most) {
  return combine(
      problem, [](std::span<const double> costs) { return *std::max_element(costs.begin(), costs.end()); },
      at_most);
}

}  // namespace linkwright::optimise
