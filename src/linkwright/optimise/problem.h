// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/sentence.h"
#include "linkwright/optimise/population.h"

namespace linkwright::optimise {

/// One unknown of a problem with its bounds (SI units).
struct Variable {
  std::string name;  ///< key with unit, as in the study file: "crank_m"
  double lower = 0;  ///< lower bound
  double upper = 1;  ///< upper bound
};

/// One reason why a candidate is not feasible; amounts are dimensionless and comparable, 0 = met.
struct Violation {
  std::string reason;  ///< name of the constraint: "crank_rotates_fully"
  double amount = 0;   ///< dimensionless, >= 0
};

/// A violation in words: "violates crank_rotates_fully by 0.02".
///
/// @param violation the violation
/// @returns the sentence
inline Sentence violation_text(const Violation& violation) {
  return say("violates {} by {}", violation.reason, plain_number(violation.amount, 3));
}

/// The combination that makes one objective of several, see combine.h.
struct Combination;

/// The function to be minimised. An optimiser asks for the costs of a whole population, never of one
/// candidate, and knows nothing else of the problem.
struct Problem {
  std::vector<Variable> variables;  ///< the unknowns with their bounds

  /// Number of objectives that are minimised together. Several are to be given relative to a reference, so
  /// that 1 is as good as the reference: methods and reports compare and average them.
  std::size_t objectives = 1;

  /// For each candidate i: cost[i * objectives + k] of every objective k, and violation[i] = sum of the
  /// constraint violations (0 = feasible). A cost that does not exist is +infinity with violation > 0, never
  /// NaN. Must be pure: same input, same bits, for any split of the population; called from several threads
  /// at once.
  std::function<void(const PopulationView& candidates, std::span<double> cost, std::span<double> violation)>
      evaluate;

  /// Explains why one candidate is infeasible, for reports; may be empty.
  std::function<std::vector<Violation>(std::span<const double> x)> explain;

  /// The combination that made its one objective, see combine.h; null if there is none. `minimise` evaluates
  /// that instead of `evaluate`, for the objectives of what it finds.
  std::shared_ptr<const Combination> combination;
};

/// "Better" by the feasibility rules of Deb (2000): feasible before infeasible, then by cost; infeasible ones
/// by violation.
///
/// @param cost_a cost of the one
/// @param violation_a sum of its violations, 0 = feasible
/// @param cost_b cost of the other
/// @param violation_b sum of its violations
/// @returns true if the one is better
inline bool better(double cost_a, double violation_a, double cost_b, double violation_b) {
  if (violation_a > 0 || violation_b > 0) {
    if (violation_a != violation_b) return violation_a < violation_b;
  }
  return cost_a < cost_b;
}

/// "Better" by all objectives of a and b, as many: both feasible and every cost of a less, or else less
/// violation (Boskovic 2018, Algorithm 2.5, with the conjunction that its text asks for). With one objective
/// the same as above. With several it is no ranking: of two feasible ones often neither is better.
///
/// @param costs_a costs of the one
/// @param violation_a sum of its violations, 0 = feasible
/// @param costs_b costs of the other, as many
/// @param violation_b sum of its violations
/// @returns true if the one is better
inline bool better(std::span<const double> costs_a, double violation_a, std::span<const double> costs_b,
                   double violation_b) {
  if (costs_a.size() == 1) return better(costs_a[0], violation_a, costs_b[0], violation_b);
  if (violation_a > 0 || violation_b > 0) return violation_a < violation_b;
  for (std::size_t k = 0; k < costs_a.size(); ++k)
    if (!(costs_a[k] < costs_b[k])) return false;
  return true;
}

}  // namespace linkwright::optimise
