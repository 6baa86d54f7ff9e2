// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"
#include "linkwright/math/function_ref.h"

namespace linkwright::math {

/// Residuals r(x) and, when `jacobian` is not empty, dr_i/dx_j at jacobian[j * m + i] (column-major, m rows).
/// Returns false when r cannot be evaluated here: the step is shortened. Values that are not finite count as
/// false.
using ResidualFunction =
    FunctionRef<bool(std::span<const double> x, std::span<double> residuals, std::span<double> jacobian)>;

/// The factor D of the damping in (J'J + lambda D) step = -J'r.
enum class Damping {
  /// D = I (Levenberg 1944): variables of like size, short steps along directions that hardly matter.
  identity,
  diagonal,  ///< D = diag(J'J) (Marquardt 1963): independent of the units of the variables
};

struct LeastSquaresOptions {
  Damping damping = Damping::diagonal;
  double lambda0 = 1e-2;        ///< damping at the start
  double lambda_success = 0.2;  ///< factor after a step that lowers the cost
  double lambda_failure = 4;    ///< factor after one that does not
  double lambda_max = 1e8;      ///< ends the search: no step lowers the cost any more
  int max_iterations = 60;      ///< steps tried, successful or not
  double step_clip = infinity;  ///< largest change of a variable in one step
  /// Adds the second-order correction of Transtrum & Sethna 2012 to each step: it follows curved narrow
  /// valleys, where plain steps shorten to a crawl, for one more evaluation of the residuals a step.
  bool geodesic_acceleration = false;
  /// Ends are judged on the cost, half the sum of squared residuals, and on J'r.
  double decrease_tolerance = 1e-13;  ///< stop when a step lowers the cost by at most this much, absolute
  double relative_decrease_tolerance = 0;  ///< the same, times the cost
  double gradient_tolerance = 0;           ///< stop when max |J'r| over the free variables is at most this
  double step_tolerance = 0;               ///< stop when max |step_j| / (1 + |x_j|) is at most this
  double cost_tolerance = 0;               ///< stop when the cost is at most this
  /// Ask for the Jacobian together with the residuals of every trial point: saves the second evaluation of
  /// each successful step. Switch off when a Jacobian costs much more than residuals.
  bool jacobian_at_trials = true;
};

/// The reason why a search ended.
enum class LeastSquaresEnd { gradient, decrease, step, cost, damping, iterations, start };
constexpr std::array<EnumName<LeastSquaresEnd>, 7> names(LeastSquaresEnd) {
  return {{{LeastSquaresEnd::gradient, "gradient", "gradient below its tolerance"},
           {LeastSquaresEnd::decrease, "decrease", "decrease below its tolerance"},
           {LeastSquaresEnd::step, "step", "step below its tolerance"},
           {LeastSquaresEnd::cost, "cost", "cost below its tolerance"},
           {LeastSquaresEnd::damping, "damping", "no damping lowers the cost"},
           {LeastSquaresEnd::iterations, "iterations", "iterations used up"},
           {LeastSquaresEnd::start, "start", "start cannot be evaluated"}}};
}

struct LeastSquaresReport {
  /// done: a tolerance or the damping limit was met; not_converged: iterations used up; infeasible: the start
  /// cannot be evaluated (x is left as it was).
  Status status = Status::done;
  LeastSquaresEnd end = LeastSquaresEnd::decrease;
  double cost = infinity;      ///< half the sum of squared residuals at x
  double gradient = infinity;  ///< max |J'r| over variables not held by a bound
  double lambda = 0;
  int iterations = 0;   ///< steps tried
  int evaluations = 0;  ///< calls of the residual function
};

/// Memory of a search; use one again and again (per thread) and nothing is allocated after the first call of
/// a size.
class LeastSquaresWorkspace {
 public:
  /// Makes room for m residuals of n variables.
  void resize(std::size_t m, std::size_t n);

  /// Residuals (m) and Jacobian (m x n, column-major) at the x of the last search.
  std::span<const double> residuals() const { return residuals_; }
  std::span<const double> jacobian() const { return jacobian_; }

 private:
  friend LeastSquaresReport minimise_least_squares(ResidualFunction, std::size_t, std::span<double>,
                                                   std::span<const double>, std::span<const double>,
                                                   const LeastSquaresOptions&, LeastSquaresWorkspace&);
  std::vector<double> residuals_, jacobian_, trial_residuals_, trial_jacobian_;
  std::vector<double> normal_, damped_, gradient_, step_, acceleration_, trial_;
};

/// Minimises half the sum of squares of m residuals over lower <= x <= upper by damped Gauss-Newton steps
/// (Levenberg 1944, Marquardt 1963) with the exact Jacobian; m may be smaller than n. For small dense
/// problems: the normal equations are factorised by Cholesky.
///
/// Bounds: variables held by a bound (at it, the gradient pushing outwards) leave the system, the rest of the
/// step is clipped to the box. Empty spans mean unbounded; +-infinity is allowed. x is moved into the box
/// first.
///
/// Throws ContractError for spans of wrong length, lower > upper, or options out of range.
LeastSquaresReport minimise_least_squares(ResidualFunction function, std::size_t m, std::span<double> x,
                                          std::span<const double> lower, std::span<const double> upper,
                                          const LeastSquaresOptions& options,
                                          LeastSquaresWorkspace& workspace);

/// Without bounds.
inline LeastSquaresReport minimise_least_squares(ResidualFunction function, std::size_t m,
                                                 std::span<double> x, const LeastSquaresOptions& options,
                                                 LeastSquaresWorkspace& workspace) {
  return minimise_least_squares(function, m, x, {}, {}, options, workspace);
}

}  // namespace linkwright::math
