// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/cone_scaling.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"

namespace linkwright::optimise {
namespace {

using In = Eigen::Map<const Eigen::VectorXd>;
using Out = Eigen::Map<Eigen::VectorXd>;

// All rows of a block, and those behind the first.
In rows(std::span<const double> v, const ConeBlock& b) {
  return {v.data() + b.first, static_cast<Eigen::Index>(b.size)};
}
In tail(std::span<const double> v, const ConeBlock& b) {
  return {v.data() + b.first + 1, static_cast<Eigen::Index>(b.size - 1)};
}
Out tail(std::span<double> v, const ConeBlock& b) {
  return {v.data() + b.first + 1, static_cast<Eigen::Index>(b.size - 1)};
}

// Root of v_0^2 - |v_1|^2, without the cancellation.
double j_norm(std::span<const double> v, const ConeBlock& b) {
  const double first = v[b.first], rest = tail(v, b).norm();
  return std::sqrt(std::max(0.0, (first - rest) * (first + rest)));
}

}  // namespace

void ConeScaling::reset(std::size_t count) {
  beta.assign(blocks.size(), 1.0);
  w.assign(count, 0.0);
  lambda.assign(count, 0.0);
  for (const ConeBlock& b : blocks) w[b.first] = 1;
}

bool ConeScaling::update(std::span<const double> s, std::span<const double> z) {
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const ConeBlock& b = blocks[k];
    if (!(s[b.first] > 0) || !(z[b.first] > 0)) return false;
    if (b.size == 1) {
      beta[k] = std::sqrt(s[b.first] / z[b.first]);
      continue;
    }
    const double sn = j_norm(s, b), zn = j_norm(z, b);
    if (!(sn > 0) || !(zn > 0)) return false;
    beta[k] = std::sqrt(sn / zn);
    const double gamma = std::sqrt((1 + rows(s, b).dot(rows(z, b)) / (sn * zn)) / 2);
    Out w1 = tail(std::span(w), b);
    w1 = (tail(s, b) / sn - tail(z, b) / zn) / (2 * gamma);
    w[b.first] = std::sqrt(1 + w1.squaredNorm());
  }
  apply(z, false, lambda);
  return std::all_of(lambda.begin(), lambda.end(), [](double v) { return std::isfinite(v); });
}

void ConeScaling::apply(std::span<const double> v, bool inverse, std::span<double> out) const {
  const double sign = inverse ? -1 : 1;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const ConeBlock& b = blocks[k];
    const double factor = inverse ? 1 / beta[k] : beta[k], v0 = v[b.first];
    if (b.size == 1) {
      out[b.first] = factor * v0;
      continue;
    }
    const double w0 = w[b.first];
    const In w1 = tail(std::span<const double>(w), b);
    const double dot = sign * w1.dot(tail(v, b));
    out[b.first] = factor * (w0 * v0 + dot);
    tail(out, b) = factor * (tail(v, b) + sign * (v0 + dot / (1 + w0)) * w1);
  }
}

double ConeScaling::longest_step(std::span<const double> direction) const {
  double most = 0;
  for (const ConeBlock& b : blocks) {
    const double d0 = direction[b.first];
    if (b.size == 1) {
      most = std::max(most, -d0 / lambda[b.first]);
      continue;
    }
    const double norm = j_norm(lambda, b), l0 = lambda[b.first] / norm;
    const In l1 = tail(std::span<const double>(lambda), b), d1 = tail(direction, b);
    const double r0 = l0 * d0 - l1.dot(d1) / norm;
    const double r1 = (d1 - (r0 + d0) / (l0 + 1) / norm * l1).norm();
    most = std::max(most, (r1 - r0) / norm);
  }
  return most > 0 ? 1 / most : infinity;
}

void ConeScaling::divide(std::span<const double> d, std::span<double> out) const {
  for (const ConeBlock& b : blocks) {
    const double l0 = lambda[b.first], d0 = d[b.first];
    if (b.size == 1) {
      out[b.first] = d0 / l0;
      continue;
    }
    const In l1 = tail(std::span<const double>(lambda), b);
    const double norm = j_norm(lambda, b), first = (l0 * d0 - l1.dot(tail(d, b))) / (norm * norm);
    out[b.first] = first;
    tail(out, b) = (tail(d, b) - first * l1) / l0;
  }
}

void ConeScaling::product(std::span<const double> a, std::span<const double> b, std::span<double> out) const {
  for (const ConeBlock& k : blocks) {
    const double a0 = a[k.first], b0 = b[k.first], first = rows(a, k).dot(rows(b, k));
    tail(out, k) = a0 * tail(b, k) + b0 * tail(a, k);
    out[k.first] = first;
  }
}

double ConeScaling::outside(std::span<const double> v) const {
  double most = -infinity;
  for (const ConeBlock& b : blocks) most = std::max(most, tail(v, b).norm() - v[b.first]);
  return most;
}

void ConeScaling::add_unit(double a, std::span<double> v) const {
  for (const ConeBlock& b : blocks) v[b.first] += a;
}

}  // namespace linkwright::optimise
