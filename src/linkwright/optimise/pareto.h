// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace linkwright::optimise {

/// True if costs a dominate costs b, as many: none is more, and one at least is less.
bool dominates(std::span<const double> a, std::span<const double> b);

/// True if cost a is less than b by more than the accuracy of searches: a limit that holds a cost is met
/// within `tolerance::feasibility` of the size of its constraint, which may be some tens of times the cost.
bool less_by_more_than_rounding(double a, double b);

/// True if none of the costs a, as many as b, is more than that of b by more than rounding: a dominates b, or
/// they are equal to the accuracy of searches. Not transitive: for a list that is shown.
bool no_cost_more(std::span<const double> a, std::span<const double> b);

/// A design and its costs.
struct ParetoPoint {
  std::vector<double> x, costs;
};

/// Numbers of those of n costs vectors (n times `objectives` numbers, one vector after the other) that no
/// other dominates, in order; of equal ones the first.
std::vector<std::size_t> non_dominated(std::span<const double> costs, std::size_t objectives);

/// The same points in the order of their costs, first by the first objective, without those that others
/// dominate or equal: the common front of several runs, for example.
std::vector<ParetoPoint> non_dominated(std::vector<ParetoPoint> points);

/// Keeps the designs that no other one received so far dominates, up to a capacity. When there are more, the
/// one with the least crowding distance goes (Deb et al. 2002, section III.B; of equals the last one
/// received), so that those that remain are spread over the front and the least of every objective is among
/// them. What it keeps depends on the designs and their order alone.
///
/// A design that has gone is forgotten: one that it would dominate may come in later.
///
/// Nothing is allocated after construction but by `points`.
class ParetoArchive {
 public:
  /// Throws ContractError for a capacity of less than twice the objectives.
  ParetoArchive(std::size_t dimension, std::size_t objectives, std::size_t capacity);

  /// Returns true if the design joined the front. It does not if it is dominated, has the costs of one that
  /// is there, or has an infinite cost. Throws ContractError for wrong sizes and a NaN among the costs.
  bool tell(std::span<const double> x, std::span<const double> costs);

  std::size_t objectives() const { return objectives_; }
  std::size_t capacity() const { return capacity_; }
  std::size_t size() const { return size_; }
  /// Variables and costs of design i, in the order in which the designs were added; valid until the next
  /// `tell`.
  std::span<const double> x(std::size_t i) const { return {&x_[i * dimension_], dimension_}; }
  std::span<const double> costs(std::size_t i) const { return {&costs_[i * objectives_], objectives_}; }

  /// In the order of their costs.
  std::vector<ParetoPoint> points() const;

 private:
  void move(std::size_t from, std::size_t to);
  std::size_t most_crowded();

  std::size_t dimension_, objectives_, capacity_, size_ = 0;
  std::size_t refuser_ = 0;        ///< design that refused the last one
  std::vector<double> x_, costs_;  ///< values of all designs, with room for one more
  std::vector<double> distance_;
  std::vector<std::uint32_t> order_;
};

/// A number that ranks candidates as `better` does, for methods that know costs only: the cost of a feasible
/// candidate, limited to +-1e75, and more than 1e79 for an infeasible one, the more the larger its violation
/// (1e100 times its 16th root: violations that differ by rounding only may tie).
double cost_by_feasibility_rules(double cost, double violation);

}  // namespace linkwright::optimise
