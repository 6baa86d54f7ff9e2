// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/path/local_fit.h"

namespace linkwright::planar {

using PathFit = PathFitOf<FourBar>;

/// Local search in all unknowns of a path problem, on the branch of the start: link lengths, tracing point,
/// pivot, frame angle, and the start angle (equal steps) or every crank angle (free timing).
/// Levenberg-Marquardt with the exact Jacobian (spelled out in Boskovic 2018 symbols: d theta3 / d q of the
/// loop closure); bounds by an active set; full crank rotation (on the side of change point where the start
/// lies), transmission angle, packaging and order by an augmented Lagrangian. The crank angles are eliminated
/// from each step (their block is tridiagonal), so a step costs O(points); where no order limit couples them,
/// a point counts across the path and, damped, along it (the Schur complement of its angle). Holds its
/// scratch memory: one per thread.
class PathFitter {
 public:
  PathFitter(const PathProblem& problem, double sense);

  /// `angles`: crank angle of each point at the start; with prescribed timing only the first one is used.
  PathFit fit(const FourBar& start, const std::vector<double>& angles, const PathFitOptions& options);

 private:
  static constexpr std::size_t shared = four_bar_parameter_count;

  bool evaluate(const std::array<double, shared>& q, const std::vector<double>& angles, bool derivatives,
                double& merit);
  double crank_angle(const std::array<double, shared>& q, const std::vector<double>& angles,
                     std::size_t k) const;
  // `by_angle`: derivative for the crank angle of `point`, where that is an unknown of its own.
  void add_constraint(std::size_t row, double value, const std::array<double, shared>& gradient,
                      bool derivatives, double& merit, std::size_t point = 0, double by_angle = 0);
  void evaluate_constraints(const std::array<double, shared>& q, const std::vector<double>& angles,
                            bool derivatives, double& merit);
  void evaluate_box(const PackagingBox& box, std::size_t row, const std::array<double, shared>& q,
                    bool derivatives, double& merit);
  void evaluate_order(const std::vector<double>& angles, bool derivatives, double& merit);
  void eliminate_angles(double lambda, double* a, double* b);
  bool solve_step(double lambda);
  double shrink_to_longest() const;
  bool solve_within_bounds(double lambda);
  double descend(const PathFitOptions& options);

  const PathProblem& problem_;
  double sense_, size_, branch_ = 1;
  bool free_timing_, bands_, crank_shorter_ = true, angles_coupled_ = false, regular_ = true;
  std::array<bool, shared> variable_{};
  std::array<double, shared> lower_{}, upper_{};

  // Point of the search.
  std::array<double, shared> q_{}, trial_q_{}, step_q_{};
  std::vector<double> angles_, trial_angles_, step_angles_;
  // Normal equations: shared block, one row of coupling a point, tridiagonal block of the crank angles.
  // Of free timing the part of the shared block along the path at each point stands apart (`along_`): without
  // order limits eliminating the crank angles leaves the share lambda / (1 + lambda) of it.
  std::array<double, shared * shared> hessian_{}, along_{};
  std::array<double, shared> gradient_{}, along_gradient_{};
  std::array<bool, shared> held_{};
  std::array<double, shared>
      held_step_{};  // steps of variables that do not take part: 0, or up to their bound
  std::vector<double> coupling_, diagonal_, neighbour_, angle_gradient_, elimination_, eliminated_;
  // Augmented Lagrangian.
  double penalty_ = 1, error_ = 0;
  std::vector<double> multipliers_, values_;
  std::int64_t evaluations_ = 0;
};

}  // namespace linkwright::planar
