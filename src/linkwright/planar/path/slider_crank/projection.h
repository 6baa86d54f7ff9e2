// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <span>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/planar/path/slider_crank/problem.h"

namespace linkwright::planar {

/// A path problem of the slider-crank with prescribed timing in separable form. For given ratios rho = L3/L2
/// and eta = offset/L2 and given phases phi_k = theta2_k - delta, with u = e^(i phi) and v = e^(i (theta3 -
/// delta)), the tracing point
///
///     C_k = p + a u_k + b v_k,   a = L2 e^(i delta),   b = L4 e^(i (beta + delta))
///
/// is linear in the complex numbers p, a and b, which come from a linear least-squares problem; only rho, eta
/// and one phase stay. Once p and b are eliminated the error is isotropic in a, so whatever limits the length
/// of the crank at given ratios - bounds of crank, rod and offset, and the stroke, |a| S(rho, eta) - is met
/// exactly by moving a radially into an interval. So are the crank direction that given crank angles fix and
/// a guide of fixed direction: then a keeps to a ray.
///
/// Where the crank is to turn fully with a pressure angle of at most alpha, the unknowns are the logarithms
/// of A, B > 0 with s = sin alpha, rho = (1 + (A + B)/2) / s, eta = (B - A)/2: one-to-one onto all such
/// mechanisms. Else they are ln rho and eta. Bounds of point and pivot are not seen. Holds its scratch
/// memory: one per thread; nothing is allocated after construction but by `design`.
class SliderPathProjection {
 public:
  /// True if the unknowns of a problem are free as this form needs: timing prescribed, rod, offset and
  /// tracing point not fixed, both pivot coordinates or none, and start angle or guide angle free or fixed as
  /// a whole.
  static bool applies(const SliderPathProblem& problem);

  /// Throws ContractError when it does not apply.
  SliderPathProjection(const SliderPathProblem& problem, SliderSide side, double sense);

  std::size_t variables() const { return phase_fixed_ ? 2 : 3; }
  std::size_t residuals() const { return 2 * x_.size(); }

  /// Limits the stroke (m) anew, as SliderPathProblem::stroke does.
  void limit_stroke(const Range& stroke);

  /// Residuals of the best linear unknowns (m) and, unless empty, their Jacobian after Kaufman 1975
  /// (column-major), whose product with the residuals is the exact gradient of half the sum of squares. False
  /// when the ratios are no mechanism, the rod does not reach the guide at a point, or the limits leave no
  /// length of the crank.
  bool evaluate(std::span<const double> q, std::span<double> residual, std::span<double> jacobian);

  /// Mechanism at q, and its crank angle at the first point less the offset of that point.
  struct Recovered {
    SliderCrankMechanism linkage;
    double start = 0;
  };
  /// Throws ContractError when q does not evaluate.
  Recovered recover(std::span<const double> q);
  /// The same measured against the problem. Its error is the sum of squared residuals.
  SliderPathDesign design(const SliderPathProblem& problem, std::span<const double> q);

  /// Unknowns of a mechanism, for a start of the search. With a crank that turns fully, ratios on the limit
  /// are moved just inside.
  std::vector<double> unknowns(const SliderCrankForm& form, double start) const;

  /// Random unknowns: the slacks A and B uniform in the logarithm over [-3, 3] (crank that turns fully), else
  /// the ratio over [-1.5, 1.5] and the offset over [-1, 1]; any phase.
  std::vector<double> random(RandomStream& stream) const;

 private:
  // Interval of |a| at given ratios, and how its ends change with them.
  struct Length {
    double value = 0, by_rho = 0, by_eta = 0;
  };
  bool ratios(std::span<const double> q);
  bool limits(Length& low, Length& high) const;
  bool project(std::span<const double> q);

  double side_, sense_, size_ = 1, sine_ = 1;
  bool turns_, pivot_fixed_ = false, guide_fixed_ = false, start_fixed_ = false, phase_fixed_ = false;
  double guide_ = 0, start_ = 0;
  std::complex<double> pivot_;
  Range crank_, rod_, offset_, stroke_;
  std::vector<double> x_, y_, offset_x_, offset_y_;

  double rho_ = 1, eta_ = 0, phase_ = 0;
  std::vector<double> ux_, uy_, vx_, vy_;      // directions
  std::vector<double> qux_, quy_, qvx_, qvy_;  // orthonormal: v without its mean, u without mean and v
  std::vector<double> rest_;
  std::complex<double> a_, b_, p_, ray_;
  enum class Along { plane, ray, circle, none } along_ = Along::plane;  // locus on which a is free
  Length active_;                                                       // the end of the interval a lies at
};

}  // namespace linkwright::planar
