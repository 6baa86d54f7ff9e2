// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/smooth_differences.h"

#include <algorithm>
#include <cmath>

namespace linkwright::optimise {
namespace {

// Cube root of the rounding of a value: where the error of a central difference is least.
constexpr double step = 0x1p-17;

}  // namespace

SmoothDifferences::SmoothDifferences(const SmoothProblem& problem)
    : problem_(problem), single_(problem.variables.size(), 1) {
  for (std::size_t j = 0; j < problem.variables.size(); ++j) {
    const Variable& v = problem.variables[j];
    if (v.lower < v.upper) free_.push_back(j);
    single_(j, 0) = v.lower;
  }
  const std::size_t n = free_.size(), width = problem.values();
  neighbours_ = Population(problem.variables.size(), 2 * n);
  for (std::size_t j = 0; j < problem.variables.size(); ++j)
    for (std::size_t i = 0; i < 2 * n; ++i) neighbours_(j, i) = problem.variables[j].lower;
  at_.resize(n);
  values_.resize(width);
  around_.resize(2 * n * width);
  jacobian_.resize(width * n);
  ahead_.resize(n);
  behind_.resize(n);
}

double SmoothDifferences::width(std::size_t j) const {
  const Variable& v = problem_.variables[free_[j]];
  return v.upper - v.lower;
}

void SmoothDifferences::to_unit(std::span<const double> x, std::span<double> u) const {
  for (std::size_t j = 0; j < free_.size(); ++j)
    u[j] = std::clamp((x[free_[j]] - problem_.variables[free_[j]].lower) / width(j), 0.0, 1.0);
}

void SmoothDifferences::from_unit(std::span<const double> u, std::span<double> x) const {
  for (std::size_t j = 0; j < problem_.variables.size(); ++j) x[j] = problem_.variables[j].lower;
  for (std::size_t j = 0; j < free_.size(); ++j) {
    const Variable& v = problem_.variables[free_[j]];
    x[free_[j]] = u[j] == 1 ? v.upper : v.lower + width(j) * u[j];
  }
}

std::span<const double> SmoothDifferences::values(std::span<const double> u) {
  if (have_values_ && std::equal(u.begin(), u.end(), at_.begin(), at_.end())) return values_;
  std::copy(u.begin(), u.end(), at_.begin());
  for (std::size_t j = 0; j < free_.size(); ++j) {
    const Variable& v = problem_.variables[free_[j]];
    single_(free_[j], 0) = u[j] == 1 ? v.upper : v.lower + width(j) * u[j];
  }
  problem_.evaluate(single_.view(), values_);
  ++evaluations_;
  have_values_ = true;
  have_jacobian_ = false;
  return values_;
}

std::span<const double> SmoothDifferences::jacobian(std::span<const double> u) {
  values(u);
  if (have_jacobian_) return jacobian_;
  const std::size_t n = free_.size(), width_of = problem_.values();
  for (std::size_t j = 0; j < n; ++j) {
    const Variable& v = problem_.variables[free_[j]];
    // Two neighbours, on both sides or on one.
    ahead_[j] = u[j] + step <= 1 ? step : -step;
    behind_[j] = u[j] - step >= 0 ? -step : step;
    if (ahead_[j] == behind_[j]) behind_[j] = 2 * ahead_[j];
    for (std::size_t i = 0; i < n; ++i) {
      const double same = single_(free_[i], 0);
      neighbours_(free_[i], 2 * j) = same;
      neighbours_(free_[i], 2 * j + 1) = same;
    }
    neighbours_(free_[j], 2 * j) = std::clamp(v.lower + width(j) * (u[j] + ahead_[j]), v.lower, v.upper);
    neighbours_(free_[j], 2 * j + 1) = std::clamp(v.lower + width(j) * (u[j] + behind_[j]), v.lower, v.upper);
  }
  problem_.evaluate(neighbours_.view(), around_);
  evaluations_ += static_cast<std::int64_t>(2 * n);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < width_of; ++k) {
      const double f = values_[k], a = around_[2 * j * width_of + k], b = around_[(2 * j + 1) * width_of + k];
      const double ha = ahead_[j], hb = behind_[j];
      double d = 0;
      if (std::isfinite(a) && std::isfinite(b))
        // Derivative of the parabola through the three points.
        d = ((a - f) * hb / ha - (b - f) * ha / hb) / (hb - ha);
      else if (std::isfinite(a))
        d = (a - f) / ha;
      else if (std::isfinite(b))
        d = (b - f) / hb;
      jacobian_[k * n + j] = std::isfinite(d) ? d : 0;
    }
  have_jacobian_ = true;
  return jacobian_;
}

}  // namespace linkwright::optimise
