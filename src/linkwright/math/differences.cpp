// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/differences.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/finite.h"
#include "linkwright/core/numbers.h"

namespace linkwright::math {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double scale_of(std::span<const double> x, std::span<const double> scale, std::size_t j) {
  return scale.empty() ? std::max(std::abs(x[j]), 1.0) : scale[j];
}

void require_scales(std::span<const double> x, std::span<const double> scale) {
  LINKWRIGHT_REQUIRE(scale.empty() || scale.size() == x.size(), "{} scales for {} variables", scale.size(),
                     x.size());
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double s = scale_of(x, scale, j);
    LINKWRIGHT_REQUIRE(s > 0 && std::isfinite(s), "scale {} of variable {}", s, j);
    LINKWRIGHT_REQUIRE(x[j] + difference_step(s) > x[j] - difference_step(s),
                       "scale {} of variable {} is lost in the rounding of {}", s, j, x[j]);
  }
}

/// Central differences one column at a time.
class Differences {
 public:
  Differences(ResidualFunction function, std::size_t m, std::span<const double> x)
      : function_(function), moved_(x.begin(), x.end()), here_(m), low_(m), high_(m) {}

  /// False, and NaN in the column, where a neighbour cannot be evaluated.
  bool column(std::size_t j, double step, std::span<double> out) {
    const double low = moved_[j] - step, high = moved_[j] + step;
    const bool ok = at(j, low, low_) && at(j, high, high_);
    // Divided by the distance that the rounded neighbours really have.
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = ok ? (high_[i] - low_[i]) / (high - low) : nan;
    return ok;
  }

  /// The same with both neighbours on one side, which the sign of the step says.
  bool one_sided_column(std::size_t j, double step, std::span<double> out) {
    const double near = moved_[j] + step, far = moved_[j] + 2 * step;
    const double a = near - moved_[j], b = far - moved_[j];
    const bool ok = at(j, moved_[j], here_) && at(j, near, low_) && at(j, far, high_);
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = ok ? ((low_[i] - here_[i]) * (b / a) - (high_[i] - here_[i]) * (a / b)) / (b - a) : nan;
    return ok;
  }

 private:
  bool at(std::size_t j, double value, std::vector<double>& out) {
    const double centre = std::exchange(moved_[j], value);
    const bool ok = function_(moved_, out, {}) && all_finite(out);
    moved_[j] = centre;
    return ok;
  }

  ResidualFunction function_;
  std::vector<double> moved_, here_, low_, high_;
};

}  // namespace

double difference_step(double scale) { return std::cbrt(epsilon) * scale; }

Status central_jacobian(ResidualFunction function, std::size_t m, std::span<const double> x,
                        std::span<double> jacobian, std::span<const double> scale) {
  require_scales(x, scale);
  LINKWRIGHT_REQUIRE(jacobian.size() == m * x.size(), "{} entries for {} residuals of {} variables",
                     jacobian.size(), m, x.size());
  Differences differences(function, m, x);
  Status status = Status::done;
  for (std::size_t j = 0; j < x.size(); ++j)
    if (!differences.column(j, difference_step(scale_of(x, scale, j)), jacobian.subspan(j * m, m)))
      status = Status::infeasible;
  return status;
}

Status bounded_jacobian(ResidualFunction function, std::size_t m, std::span<const double> x,
                        std::span<const double> lower, std::span<const double> upper,
                        std::span<double> jacobian, std::span<const double> scale) {
  const std::size_t n = x.size();
  LINKWRIGHT_REQUIRE(scale.empty() || scale.size() == n, "{} scales for {} variables", scale.size(), n);
  LINKWRIGHT_REQUIRE(lower.size() == n && upper.size() == n && jacobian.size() == m * n,
                     "{} and {} bounds, {} entries for {} residuals of {} variables", lower.size(),
                     upper.size(), jacobian.size(), m, n);
  Differences differences(function, m, x);
  Status status = Status::done;
  for (std::size_t j = 0; j < n; ++j) {
    LINKWRIGHT_REQUIRE(lower[j] <= x[j] && x[j] <= upper[j], "variable {} is {}, not between {} and {}", j,
                       x[j], lower[j], upper[j]);
    const std::span<double> column = jacobian.subspan(j * m, m);
    const double step = std::min(difference_step(scale_of(x, scale, j)), (upper[j] - lower[j]) / 4);
    bool ok = true;
    if (x[j] + step == x[j])
      std::fill(column.begin(), column.end(), 0.0);
    else if (x[j] - step < lower[j])
      ok = differences.one_sided_column(j, step, column);
    else if (x[j] + step > upper[j])
      ok = differences.one_sided_column(j, -step, column);
    else
      ok = differences.column(j, step, column);
    if (!ok) status = Status::infeasible;
  }
  return status;
}

Status central_gradient(ScalarFunction function, std::span<const double> x, std::span<double> gradient,
                        std::span<const double> scale) {
  const auto residual = [&](std::span<const double> at, std::span<double> r, std::span<double>) {
    r[0] = function(at);
    return true;
  };
  return central_jacobian(residual, 1, x, gradient, scale);
}

JacobianCheck check_jacobian(ResidualFunction function, std::size_t m, std::span<const double> x,
                             std::span<const double> scale) {
  constexpr double safety = 10, largest_tolerance = 1e-3;
  const std::size_t n = x.size();
  require_scales(x, scale);
  LINKWRIGHT_REQUIRE(m >= 1 && n >= 1, "needs residuals and variables, got {} and {}", m, n);

  JacobianCheck check;
  std::vector<double> size(m), analytic(m * n), near(m * n), far(m * n);
  if (!function(x, size, analytic) || !all_finite(size) || !all_finite(analytic)) {
    check.status = Status::infeasible;
    check.unchecked = n;
    return check;
  }

  for (double& s : size) s = std::abs(s);
  Differences differences(function, m, x);
  std::vector<bool> compared(n);
  for (std::size_t j = 0; j < n; ++j) {
    const double s = scale_of(x, scale, j), step = difference_step(s);
    compared[j] = differences.column(j, step, std::span(near).subspan(j * m, m)) &&
                  differences.column(j, 2 * step, std::span(far).subspan(j * m, m));
    if (!compared[j]) {
      ++check.unchecked;
      continue;
    }
    for (std::size_t i = 0; i < m; ++i) size[i] = std::max(size[i], std::abs(near[j * m + i]) * s);
  }
  if (check.unchecked > 0) check.status = Status::infeasible;

  check.passed = check.status == Status::done;
  double worst = -1;
  for (std::size_t j = 0; j < n; ++j) {
    if (!compared[j]) continue;
    const double s = scale_of(x, scale, j);
    for (std::size_t i = 0; i < m; ++i) {
      const std::size_t k = j * m + i;
      // A residual that is 0 all around has no size: any entry but 0 deviates infinitely.
      const auto relative = [&](double d) { return d == 0 ? 0 : std::abs(d) * s / size[i]; };
      const double deviation = relative(analytic[k] - near[k]);
      const double error = std::pow(epsilon, 2.0 / 3) + relative(far[k] - near[k]) / 3;
      const double tolerance = std::min(safety * error, largest_tolerance);
      if (deviation > tolerance) check.passed = false;
      if (deviation / tolerance <= worst) continue;
      worst = deviation / tolerance;
      check.row = i;
      check.column = j;
      check.analytic = analytic[k];
      check.numeric = near[k];
      check.deviation = deviation;
      check.tolerance = tolerance;
    }
  }
  return check;
}

}  // namespace linkwright::math
