// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <span>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/planar/path/four_bar/problem.h"

namespace linkwright::planar {

/// The linkages that the ratios describe.
enum class RatioKind { crank_rocker, double_crank, any };

/// Link ratios r1, r3, r4 = L1/L2, L3/L2, L4/L2 of a kind at q (three logarithms), see PathProjection; not
/// all positive when q is no linkage.
std::array<double, 3> link_ratios(RatioKind kind, std::span<const double> q);

/// Random q = logarithms (and start angle) of PathProjection for a kind: slacks uniform in the logarithm over
/// [-3, 3], ratios (kind any) over [-1.5, 1.5]; a double-crank has a ground link of positive length.
std::vector<double> random_ratios(RatioKind kind, std::size_t variables, RandomStream& stream);

/// A path problem with prescribed or relative timing in separable form. For given link ratios r_j = L_j / L2
/// and crank angles, the coupler point C_k = p + a u_k + b v_k is linear in the complex numbers p (pivot), a
/// (scale and rotation) and b (tracing point), so these come from a linear least-squares problem and only q =
/// (q1, q2, q3[, start angle]) stay. The ratios follow from q by kind; with A_i = e^(q_i):
///   crank_rocker: r1 = 1 + (A2 + A3)/2, r3 = 1 + (A1 + A2)/2, r4 = 1 + (A1 + A3)/2
///   double_crank: r1 = 1 - (A2 + A3)/2, r3 = 1 + (A1 - A3)/2, r4 = 1 + (A1 - A2)/2
/// which are one-to-one onto all linkages with a fully turning crank; `any`: r1, r3, r4 = A1, A2, A3.
/// Bounds of the problem are not seen. Holds its scratch memory: one per thread.
class PathProjection {
 public:
  /// True if the linear unknowns of a problem are free as this form needs: both pivot coordinates or none
  /// fixed, link lengths and coupler point free; timing not free.
  static bool applies(const PathProblem& problem);

  /// Throws ContractError when it does not apply.
  PathProjection(const PathProblem& problem, RatioKind kind, Branch branch, double sense);

  std::size_t variables() const { return start_is_variable_ ? 4 : 3; }
  std::size_t residuals() const { return 2 * x_.size(); }

  /// Random unknowns, see random_ratios.
  std::vector<double> random(RandomStream& stream) const;

  /// Residuals of the best linear unknowns (m) and, unless empty, their Jacobian after Kaufman 1975
  /// (column-major), whose product with the residuals is the exact gradient. False when the ratios are no
  /// linkage or it does not assemble at a point.
  bool evaluate(std::span<const double> q, std::span<double> residual, std::span<double> jacobian);

  /// Design at q: the linear unknowns turned back into lengths and positions. Its error is the sum of squared
  /// residuals, except where a fixed frame angle asks for a crank of negative length: then it is larger.
  /// Throws ContractError when q does not evaluate.
  PathDesign design(const PathProblem& problem, std::span<const double> q);

 private:
  bool project(std::span<const double> q);

  RatioKind kind_;
  Branch branch_;
  double sense_, size_ = 1;
  bool start_is_variable_ = false, pivot_fixed_ = false, frame_fixed_ = false;
  std::complex<double> pivot_, frame_;
  std::vector<double> x_, y_, offset_x_, offset_y_;
  std::size_t columns_ = 0;
  std::array<double, 3> ratio_{};
  std::vector<double> ux_, uy_, vx_, vy_, q_, rest_;  // q_: orthonormal columns; rest_: residual
  std::array<double, 36> r_{};                        // upper triangle of the factorisation
  std::array<double, 6> coefficient_{};
};

}  // namespace linkwright::planar
