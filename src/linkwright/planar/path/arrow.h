// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace linkwright::planar {

/// Normal equations of a least-squares problem over points of which each has an unknown of its own, its crank
/// angle, beside unknowns that all share: an arrow. Rows that tie an angle to the next one, as the order of
/// the points does, make the block of the angles tridiagonal. The angles are eliminated from a step, which so
/// costs O(points). Holds its memory; nothing is allocated after construction.
class ArrowEquations {
 public:
  static constexpr std::size_t max_shared = 10;
  using Shared = std::array<double, max_shared>;  ///< entries beyond the number of shared unknowns are 0

  /// `regular`: what is added to the diagonal of each shared unknown, in the unit of its entry. Throws
  /// ContractError for more than `max_shared` unknowns or fewer than two points.
  ArrowEquations(std::span<const double> regular, std::size_t points, bool with_angles);

  void clear();
  /// Both residuals of a point, their derivatives by the shared unknowns and by its angle.
  void add_point(std::size_t point, double x, double y, const Shared& x_by, const Shared& y_by,
                 double x_by_angle, double y_by_angle);
  /// A row sqrt(weight) r with its derivatives; `by_angle` is that by the angle of `point`.
  void add_row(double weight, double r, const Shared& by, std::size_t point, double by_angle);
  /// A row sqrt(weight) r, dr = change (d angle_next - d angle_point) for the point and the one after it, the
  /// first after the last. That last row would break the tridiagonal form: its corner is replaced by an upper
  /// bound on the diagonal.
  void add_step(double weight, double r, std::size_t point, double change);

  /// Step (A + lambda diag A) s = -g, with the shared unknowns that are `held` left out; false when the
  /// equations are not positive definite.
  bool solve(double lambda, std::span<const bool> held);

  const Shared& gradient() const { return gradient_; }
  const std::vector<double>& angle_gradient() const { return angle_gradient_; }
  const Shared& step() const { return step_; }
  const std::vector<double>& angle_step() const { return angle_step_; }

 private:
  double& entry(std::size_t i, std::size_t j) { return hessian_[i * max_shared + j]; }

  std::size_t shared_, points_;
  bool with_angles_;
  Shared regular_{}, gradient_{}, step_{};
  std::array<double, max_shared * max_shared> hessian_{};
  std::vector<double> coupling_, diagonal_, neighbour_, angle_gradient_, angle_step_;
  std::vector<double> eliminated_, pivots_;
};

}  // namespace linkwright::planar
