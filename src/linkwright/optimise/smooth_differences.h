// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "linkwright/optimise/problem.h"
#include "linkwright/optimise/smooth_problem.h"

namespace linkwright::optimise {

/// Values and derivatives of a smooth problem at one point, in the unit cube of its free variables: u_j in
/// [0, 1] for each variable whose bounds differ, in their order. Derivatives are differences of second order,
/// central, or one-sided at a bound and beside a neighbour that does not exist; all neighbours are evaluated
/// as one population. Allocates nothing after construction.
class SmoothDifferences {
 public:
  explicit SmoothDifferences(const SmoothProblem& problem);

  std::size_t free() const { return free_.size(); }
  std::span<const std::size_t> variables() const { return free_; }  ///< index of each free variable
  double width(std::size_t j) const;  ///< distance between the bounds of free variable j

  void to_unit(std::span<const double> x, std::span<double> u) const;
  void from_unit(std::span<const double> u, std::span<double> x) const;

  /// Values at u, kept until the next call. At the point of the last call nothing is evaluated again.
  std::span<const double> values(std::span<const double> u);
  /// And their derivatives: d value k / d u_j at [k free() + j], 0 where no difference exists.
  std::span<const double> jacobian(std::span<const double> u);
  /// Candidates evaluated so far.
  std::int64_t evaluations() const { return evaluations_; }

 private:
  const SmoothProblem& problem_;
  std::vector<std::size_t> free_;
  Population single_, neighbours_;
  std::vector<double> at_, values_, around_, jacobian_, ahead_, behind_;
  bool have_values_ = false, have_jacobian_ = false;
  std::int64_t evaluations_ = 0;
};

}  // namespace linkwright::optimise
