// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/sentence.h"
#include "linkwright/core/status.h"

namespace linkwright::optimise {

using linkwright::better;

/// Read-only matrix of candidates, one row per variable, so that a vector register holds one variable of
/// several candidates. Rows start at multiples of 64 bytes and may be read (not used) up to `stride`.
struct PopulationView {
  const double* data = nullptr;  ///< first row
  std::size_t dimension = 0;     ///< variables
  std::size_t size = 0;          ///< candidates
  std::size_t stride = 0;        ///< distance of two rows, a multiple of 8

  /// The row of a variable.
  ///
  /// @param variable index of the variable
  /// @returns its values, one a candidate
  const double* row(std::size_t variable) const { return data + variable * stride; }
  /// A variable of a candidate.
  ///
  /// @param variable index of the variable
  /// @param candidate index of the candidate
  /// @returns its value
  double operator()(std::size_t variable, std::size_t candidate) const { return row(variable)[candidate]; }
  /// The candidates [first, first + count).
  ///
  /// @param first index of the first candidate, a multiple of 8
  /// @param count number of candidates
  /// @returns a view of them
  PopulationView slice(std::size_t first, std::size_t count) const {
    return {data + first, dimension, count, stride};
  }
};

/// Owns a matrix of candidates in the layout of PopulationView; padding candidates hold zeros at first.
class Population {
 public:
  /// An empty population.
  Population() = default;
  /// A population whose variables are all zero.
  ///
  /// @param dimension number of variables
  /// @param size number of candidates
  Population(std::size_t dimension, std::size_t size);

  /// The number of variables. @returns the number
  std::size_t dimension() const { return dimension_; }
  /// The number of candidates. @returns the number
  std::size_t size() const { return size_; }
  /// The row of a variable.
  ///
  /// @param variable index of the variable
  /// @returns its values, one a candidate
  double* row(std::size_t variable) { return data_.get() + variable * stride_; }
  /// The row of a variable.
  ///
  /// @param variable index of the variable
  /// @returns its values, one a candidate
  const double* row(std::size_t variable) const { return data_.get() + variable * stride_; }
  /// A variable of a candidate, to be changed.
  ///
  /// @param variable index of the variable
  /// @param candidate index of the candidate
  /// @returns its value
  double& operator()(std::size_t variable, std::size_t candidate) { return row(variable)[candidate]; }
  /// A variable of a candidate.
  ///
  /// @param variable index of the variable
  /// @param candidate index of the candidate
  /// @returns its value
  double operator()(std::size_t variable, std::size_t candidate) const { return row(variable)[candidate]; }
  /// The population as a matrix to be read. @returns the view; valid as long as the population
  PopulationView view() const { return {data_.get(), dimension_, size_, stride_}; }

  /// Sets the variables of a candidate.
  ///
  /// @param candidate index of the candidate
  /// @param x its variables
  /// @throws ContractError unless there is such a candidate and a value for each variable
  void set(std::size_t candidate, std::span<const double> x);
  /// Reads the variables of a candidate.
  ///
  /// @param candidate index of the candidate
  /// @param x receives its variables
  /// @throws ContractError unless there is such a candidate and room for each variable
  void get(std::size_t candidate, std::span<double> x) const;

 private:
  struct Free {
    void operator()(double* p) const;
  };
  std::unique_ptr<double[], Free> data_;
  std::size_t dimension_ = 0, size_ = 0, stride_ = 0;
};

/// One unknown of a problem with its bounds (SI units).
struct Variable {
  std::string name;  ///< key with unit, as in the study file: "crank_m"
  double lower = 0;  ///< lower bound
  double upper = 1;  ///< upper bound
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
