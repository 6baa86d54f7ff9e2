// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/least_squares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::math {
namespace {

using Matrix = Eigen::Map<Eigen::MatrixXd>;
using Vector = Eigen::Map<Eigen::VectorXd>;

// Geodesic acceleration: part of the step at which the curvature of the residuals is looked at, and the
// largest correction allowed, as a part of the step; where it is larger, the step is too long for a model of
// second order (both as in the paper; neither is critical).
constexpr double probe_length = 0.1;
constexpr double largest_acceleration = 0.75;

double half_sum_of_squares(const std::vector<double>& r) {
  double sum = 0;
  for (const double v : r) sum += v * v;
  return sum / 2;
}

}  // namespace

void LeastSquaresWorkspace::resize(std::size_t m, std::size_t n) {
  residuals_.resize(m);
  trial_residuals_.resize(m);
  jacobian_.resize(m * n);
  trial_jacobian_.resize(m * n);
  normal_.resize(n * n);
  damped_.resize(n * n);
  gradient_.resize(n);
  step_.resize(n);
  acceleration_.resize(n);
  trial_.resize(n);
}

LeastSquaresReport minimise_least_squares(ResidualFunction function, std::size_t m, std::span<double> x,
                                          std::span<const double> lower, std::span<const double> upper,
                                          const LeastSquaresOptions& o, LeastSquaresWorkspace& w) {
  const std::size_t n = x.size();
  LINKWRIGHT_REQUIRE(m >= 1 && n >= 1, "needs residuals and variables, got {} and {}", m, n);
  LINKWRIGHT_REQUIRE((lower.empty() || lower.size() == n) && (upper.empty() || upper.size() == n),
                     "{} lower and {} upper bounds for {} variables", lower.size(), upper.size(), n);
  LINKWRIGHT_REQUIRE(o.lambda0 > 0 && o.lambda_success > 0 && o.lambda_success <= 1 && o.lambda_failure > 1,
                     "lambda0 {}, factors {} and {}", o.lambda0, o.lambda_success, o.lambda_failure);
  LINKWRIGHT_REQUIRE(o.step_clip > 0, "step_clip {}", o.step_clip);
  const auto low = [&](std::size_t j) { return lower.empty() ? -infinity : lower[j]; };
  const auto high = [&](std::size_t j) { return upper.empty() ? infinity : upper[j]; };
  for (std::size_t j = 0; j < n; ++j)
    LINKWRIGHT_REQUIRE(low(j) <= high(j), "bounds of variable {}: {} > {}", j, low(j), high(j));
  w.resize(m, n);

  LeastSquaresReport report;
  report.lambda = o.lambda0;
  const auto evaluate = [&](std::span<const double> at, std::vector<double>& r, std::span<double> jacobian) {
    ++report.evaluations;
    if (!function(at, r, jacobian)) return infinity;
    double cost = half_sum_of_squares(r);
    // One infinite or NaN entry makes the sum so, without a test of each.
    double sum = 0;
    for (const double v : jacobian) sum += v * 0;
    if (!std::isfinite(cost) || sum != 0) cost = infinity;
    return cost;
  };
  const auto end = [&](LeastSquaresEnd why, Status status = Status::done) {
    report.end = why;
    report.status = status;
    return report;
  };

  std::copy(x.begin(), x.end(), w.trial_.begin());
  for (std::size_t j = 0; j < n; ++j) w.trial_[j] = std::clamp(x[j], low(j), high(j));
  report.cost = evaluate(w.trial_, w.residuals_, w.jacobian_);
  if (!std::isfinite(report.cost)) return end(LeastSquaresEnd::start, Status::infeasible);
  std::copy(w.trial_.begin(), w.trial_.end(), x.begin());

  const auto rows = static_cast<Eigen::Index>(m), columns = static_cast<Eigen::Index>(n);
  Matrix normal(w.normal_.data(), columns, columns), damped(w.damped_.data(), columns, columns);
  Vector gradient(w.gradient_.data(), columns), step(w.step_.data(), columns),
      acceleration(w.acceleration_.data(), columns);

  // Adds to the step half of what the second derivative of the residuals along it asks for; false where that
  // is too much. A probe that cannot be evaluated leaves the step as it is: the trial will say.
  const auto accelerate = [&](const auto& factor, const auto& weight) {
    for (std::size_t j = 0; j < n; ++j)
      w.trial_[j] = std::clamp(x[j] + probe_length * w.step_[j], low(j), high(j));
    if (!std::isfinite(evaluate(w.trial_, w.trial_residuals_, {}))) return true;
    // r'' = 2 / h ((r(x + h step) - r(x)) / h - J step), and J' of it is what the normal equations need.
    const Matrix jacobian(w.jacobian_.data(), rows, columns);
    Vector bend(w.trial_residuals_.data(), rows);
    bend -= Vector(w.residuals_.data(), rows);
    for (Eigen::Index j = 0; j < columns; ++j)
      bend -= (w.trial_[static_cast<std::size_t>(j)] - x[static_cast<std::size_t>(j)]) * jacobian.col(j);
    double along = 0, across = 0;
    for (Eigen::Index j = 0; j < columns; ++j) {
      const bool held = gradient[j] == 0;
      acceleration[j] = held ? 0 : -2 / (probe_length * probe_length) * jacobian.col(j).dot(bend);
    }
    factor.solveInPlace(acceleration);
    for (Eigen::Index j = 0; j < columns; ++j) {
      along += weight(j) * step[j] * step[j];
      across += weight(j) * acceleration[j] * acceleration[j];
    }
    if (4 * across > largest_acceleration * largest_acceleration * along) return false;
    step += acceleration / 2;
    return true;
  };

  bool moved = true;
  std::optional<LeastSquaresEnd> reached;  // after a step: reported with the gradient at the new place
  while (true) {
    if (moved) {
      // Lazy products: Eigen's blocked ones allocate, and here the matrices are small.
      const Matrix jacobian(w.jacobian_.data(), rows, columns);
      const Vector residuals(w.residuals_.data(), rows);
      for (Eigen::Index j = 0; j < columns; ++j) {
        gradient[j] = jacobian.col(j).dot(residuals);
        for (Eigen::Index i = j; i < columns; ++i) normal(i, j) = jacobian.col(i).dot(jacobian.col(j));
      }
      report.gradient = 0;
      for (std::size_t j = 0; j < n; ++j) {
        const auto k = static_cast<Eigen::Index>(j);
        const bool held = (x[j] <= low(j) && gradient[k] > 0) || (x[j] >= high(j) && gradient[k] < 0);
        if (held) {  // leaves the system: unit diagonal, no coupling, no gradient
          normal.row(k).head(k).setZero();
          normal.col(k).tail(columns - k).setZero();
          normal(k, k) = 1;
          gradient[k] = 0;
        }
        report.gradient = std::max(report.gradient, std::abs(gradient[k]));
      }
      if (report.cost <= o.cost_tolerance) return end(LeastSquaresEnd::cost);
      if (report.gradient <= o.gradient_tolerance) return end(LeastSquaresEnd::gradient);
      if (reached) return end(*reached);
    }
    if (report.lambda > o.lambda_max) return end(LeastSquaresEnd::damping);
    if (report.iterations >= o.max_iterations) return end(LeastSquaresEnd::iterations, Status::not_converged);
    ++report.iterations;

    damped.triangularView<Eigen::Lower>() = normal;
    const double largest = normal.diagonal().maxCoeff();
    // The floor keeps a variable that moves nothing here from making the system singular.
    const auto weight = [&](Eigen::Index j) {
      return o.damping == Damping::identity ? 1 : std::max(normal(j, j), 1e-12 * largest);
    };
    for (Eigen::Index j = 0; j < columns; ++j) damped(j, j) += report.lambda * weight(j);
    Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(damped);
    moved = false;
    if (factor.info() == Eigen::Success) {
      step = -gradient;
      factor.solveInPlace(step);
      if (o.geodesic_acceleration && !accelerate(factor, weight)) {
        report.lambda *= o.lambda_failure;
        continue;
      }
      double size = 0;
      for (std::size_t j = 0; j < n; ++j) {
        const double clipped = std::clamp(w.step_[j], -o.step_clip, o.step_clip);
        w.trial_[j] = std::clamp(x[j] + clipped, low(j), high(j));
        size = std::max(size, std::abs(w.trial_[j] - x[j]) / (1 + std::abs(x[j])));
      }
      if (size == 0) return end(LeastSquaresEnd::step);
      std::span<double> trial_jacobian;
      if (o.jacobian_at_trials) trial_jacobian = w.trial_jacobian_;
      double cost = evaluate(w.trial_, w.trial_residuals_, trial_jacobian);
      if (cost < report.cost && !o.jacobian_at_trials)
        cost = evaluate(w.trial_, w.trial_residuals_, w.trial_jacobian_);
      if (cost < report.cost) {
        const double decrease = report.cost - cost;
        const bool small =
            decrease <= o.decrease_tolerance || decrease <= o.relative_decrease_tolerance * report.cost;
        std::copy(w.trial_.begin(), w.trial_.end(), x.begin());
        std::swap(w.residuals_, w.trial_residuals_);
        std::swap(w.jacobian_, w.trial_jacobian_);
        report.cost = cost;
        report.lambda *= o.lambda_success;
        moved = true;
        if (small)
          reached = LeastSquaresEnd::decrease;
        else if (size <= o.step_tolerance)
          reached = LeastSquaresEnd::step;
      } else if (size <= o.step_tolerance) {
        return end(LeastSquaresEnd::step);
      }
    }
    if (!moved) report.lambda *= o.lambda_failure;
  }
}

}  // namespace linkwright::math
