// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"
#include "linkwright/math/function_ref.h"
#include "linkwright/math/least_squares.h"

namespace linkwright::math {

/// f(x); a value that is not finite says that f cannot be evaluated here.
using ScalarFunction = FunctionRef<double(std::span<const double> x)>;

/// Step of a central difference, cbrt(epsilon) * scale = 6.1e-6 scale, for a variable of scale `scale` > 0:
/// the length over which the function changes by its own size.
///
/// Error model, for |f| the size of the function (of its intermediate results, where they cancel): truncation
/// h^2/6 |f'''| with |f'''| = |f| / scale^3, and rounding eps |f| / h. Their sum is least near
/// h = cbrt(3 eps) scale; at h = cbrt(eps) scale it is 7/6 eps^(2/3) |f| / scale = 4.3e-11 |f| / scale.
/// A scale q times too long makes the truncation q^2 times as large, one q times too short the rounding q
/// times.
double difference_step(double scale);

/// df/dx_j by central differences into gradient[j], 2 evaluations per variable.
///
/// `scale` holds one positive scale per variable; empty means max(|x_j|, 1), which suits variables that are
/// given in fitting units. Where f cannot be evaluated at x +- h the entry is NaN and the status
/// `infeasible`; else it is `done`.
///
/// Throws ContractError for spans of wrong length and for scales that are not positive and finite or so small
/// that x +- h rounds to x.
Status central_gradient(ScalarFunction function, std::span<const double> x, std::span<double> gradient,
                        std::span<const double> scale = {});

/// The same for m residuals: dr_i/dx_j into jacobian[j * m + i] (column-major, m rows). The function is
/// called without a Jacobian; a column is NaN where it returns false or a value that is not finite.
Status central_jacobian(ResidualFunction function, std::size_t m, std::span<const double> x,
                        std::span<double> jacobian, std::span<const double> scale = {});

/// The same where the function is only asked for between bounds: nearer to one than a step, a column is the
/// derivative of the parabola through x and two places inside, of the same order. The step is at most a
/// quarter of the range; a variable without a range has a column of zeros. x must lie between the bounds.
Status bounded_jacobian(ResidualFunction function, std::size_t m, std::span<const double> x,
                        std::span<const double> lower, std::span<const double> upper,
                        std::span<double> jacobian, std::span<const double> scale = {});

/// The result of check_jacobian: the entry that exceeds its tolerance most, or comes nearest to it.
struct JacobianCheck {
  /// done: every column was compared; infeasible: residuals or Jacobian cannot be evaluated at x, or
  /// residuals not at the neighbours x +- h and x +- 2h of some column.
  Status status = Status::done;
  bool passed = false;        ///< status is done and no entry deviates by more than its tolerance
  std::size_t unchecked = 0;  ///< columns not compared; all of them when x itself cannot be evaluated
  std::size_t row = 0, column = 0;
  double analytic = nan;  ///< entry of the function's own Jacobian
  double numeric = nan;   ///< the same by central differences
  double deviation = 0;   ///< |analytic - numeric| relative to size_ij, see check_jacobian
  double tolerance = 0;   ///< on the deviation, derived for this entry
};

/// Compares the Jacobian that `function` returns with central differences of its residuals; for a gradient,
/// m = 1. `scale` as in central_gradient. 4 evaluations per variable and one with the Jacobian.
///
/// A deviation is taken relative to size_ij = R_i / scale_j, where R_i is the largest of |r_i| and of the
/// changes |dr_i/dx_k| scale_k: what residual i is made of. That does not depend on the units of residuals
/// and variables, and is the scale of rounding errors.
///
/// The tolerance of an entry is ten times the error of the difference itself: rounding eps^(2/3) of size_ij,
/// and truncation as the step shows it, |D(2h) - D(h)| / 3. Ten, because a residual of some dozen operations
/// is known to a few eps only. It is never more than 1e-3, so that a function too rough for its scales is
/// found and not passed. A poor scale therefore costs sharpness, or fails, but passes nothing wrong by more
/// than that.
///
/// Choose x with some care: where a residual vanishes with all of its derivatives there is no size to compare
/// with, and an entry far smaller than others of its row (by 1e-10) is lost in rounding.
///
/// Throws ContractError as central_gradient.
JacobianCheck check_jacobian(ResidualFunction function, std::size_t m, std::span<const double> x,
                             std::span<const double> scale = {});

}  // namespace linkwright::math
