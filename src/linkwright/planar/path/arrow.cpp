// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/arrow.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::planar {
namespace {
constexpr double regular_angle = 1e-14;
}

ArrowEquations::ArrowEquations(std::span<const double> regular, std::size_t points, bool with_angles)
    : shared_(regular.size()), points_(points), with_angles_(with_angles) {
  LINKWRIGHT_REQUIRE(shared_ <= max_shared && points >= 2, "{} shared unknowns, {} points", shared_, points);
  std::copy(regular.begin(), regular.end(), regular_.begin());
  for (auto* v : {&diagonal_, &neighbour_, &angle_gradient_, &angle_step_, &pivots_}) v->resize(points);
  coupling_.resize(points * max_shared);
  eliminated_.resize(points * (max_shared + 1));
}

void ArrowEquations::clear() {
  hessian_.fill(0);
  gradient_.fill(0);
  for (auto* v : {&diagonal_, &neighbour_, &angle_gradient_, &coupling_})
    std::fill(v->begin(), v->end(), 0.0);
}

void ArrowEquations::add_point(std::size_t point, double x, double y, const Shared& x_by, const Shared& y_by,
                               double x_by_angle, double y_by_angle) {
  for (std::size_t i = 0; i < shared_; ++i) {
    gradient_[i] += x_by[i] * x + y_by[i] * y;
    for (std::size_t j = 0; j < shared_; ++j) entry(i, j) += x_by[i] * x_by[j] + y_by[i] * y_by[j];
    coupling_[point * max_shared + i] += x_by_angle * x_by[i] + y_by_angle * y_by[i];
  }
  diagonal_[point] += x_by_angle * x_by_angle + y_by_angle * y_by_angle;
  angle_gradient_[point] += x_by_angle * x + y_by_angle * y;
}

void ArrowEquations::add_row(double weight, double r, const Shared& by, std::size_t point, double by_angle) {
  for (std::size_t i = 0; i < shared_; ++i) {
    if (by[i] == 0) continue;
    gradient_[i] += weight * r * by[i];
    for (std::size_t j = 0; j < shared_; ++j) entry(i, j) += weight * by[i] * by[j];
    coupling_[point * max_shared + i] += weight * by[i] * by_angle;
  }
  angle_gradient_[point] += weight * r * by_angle;
  diagonal_[point] += weight * by_angle * by_angle;
}

void ArrowEquations::add_step(double weight, double r, std::size_t point, double change) {
  const std::size_t next = (point + 1) % points_;
  angle_gradient_[point] -= weight * r * change;
  angle_gradient_[next] += weight * r * change;
  const double square = weight * change * change;
  if (next != 0) {
    diagonal_[point] += square;
    diagonal_[next] += square;
    neighbour_[point] -= square;
  } else {
    diagonal_[point] += 2 * square;
    diagonal_[0] += 2 * square;
  }
}

bool ArrowEquations::solve(double lambda, std::span<const bool> held) {
  constexpr std::size_t columns = max_shared + 1;
  // (T + lambda D) Z = [coupling, gradient] by elimination in the tridiagonal block.
  if (with_angles_) {
    double previous = 0;
    for (std::size_t k = 0; k < points_; ++k) {
      double* row = &eliminated_[k * columns];
      for (std::size_t j = 0; j < shared_; ++j) row[j] = coupling_[k * max_shared + j];
      row[max_shared] = angle_gradient_[k];
      double pivot = diagonal_[k] * (1 + lambda) + regular_angle;
      if (k > 0) {
        const double factor = neighbour_[k - 1] / previous;
        pivot -= factor * neighbour_[k - 1];
        const double* above = row - columns;
        for (std::size_t j = 0; j < shared_; ++j) row[j] -= factor * above[j];
        row[max_shared] -= factor * above[max_shared];
      }
      if (!(pivot > 0)) return false;
      pivots_[k] = previous = pivot;
    }
    for (std::size_t k = points_; k-- > 0;) {
      double* row = &eliminated_[k * columns];
      const double* below = row + columns;
      const auto settle = [&](std::size_t j) {
        if (k + 1 < points_) row[j] -= neighbour_[k] * below[j];
        row[j] /= pivots_[k];
      };
      for (std::size_t j = 0; j < shared_; ++j) settle(j);
      settle(max_shared);
    }
  }
  // The shared block that is left, and its Cholesky factor in place.
  std::array<double, max_shared* max_shared> a = hessian_;
  Shared b{};
  const auto at = [&](std::size_t i, std::size_t j) -> double& { return a[i * max_shared + j]; };
  for (std::size_t i = 0; i < shared_; ++i) b[i] = -gradient_[i];
  if (with_angles_)
    for (std::size_t k = 0; k < points_; ++k) {
      const double *c = &coupling_[k * max_shared], *row = &eliminated_[k * columns];
      for (std::size_t i = 0; i < shared_; ++i) {
        b[i] += c[i] * row[max_shared];
        for (std::size_t j = 0; j < shared_; ++j) at(i, j) -= c[i] * row[j];
      }
    }
  for (std::size_t i = 0; i < shared_; ++i) at(i, i) += lambda * entry(i, i) + regular_[i];
  for (std::size_t i = 0; i < shared_; ++i) {
    if (!held[i]) continue;
    for (std::size_t j = 0; j < shared_; ++j) at(i, j) = at(j, i) = 0;
    at(i, i) = 1;
    b[i] = 0;
  }
  for (std::size_t j = 0; j < shared_; ++j) {
    for (std::size_t k = 0; k < j; ++k) at(j, j) -= at(j, k) * at(j, k);
    if (!(at(j, j) > 0)) return false;
    at(j, j) = std::sqrt(at(j, j));
    for (std::size_t i = j + 1; i < shared_; ++i) {
      for (std::size_t k = 0; k < j; ++k) at(i, j) -= at(i, k) * at(j, k);
      at(i, j) /= at(j, j);
    }
  }
  for (std::size_t i = 0; i < shared_; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= at(i, k) * b[k];
    b[i] /= at(i, i);
  }
  for (std::size_t i = shared_; i-- > 0;) {
    for (std::size_t k = i + 1; k < shared_; ++k) b[i] -= at(k, i) * b[k];
    b[i] /= at(i, i);
    if (!std::isfinite(b[i])) return false;
  }
  step_ = b;
  if (with_angles_)
    for (std::size_t k = 0; k < points_; ++k) {
      double sum = -eliminated_[k * columns + max_shared];
      for (std::size_t j = 0; j < shared_; ++j) sum -= eliminated_[k * columns + j] * b[j];
      angle_step_[k] = sum;
    }
  return true;
}

}  // namespace linkwright::planar
