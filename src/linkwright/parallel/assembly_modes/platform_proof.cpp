// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/assembly_modes/platform_proof.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace linkwright::parallel {
namespace {

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;
constexpr double gamma = 64 * unit_roundoff;
// Sums of magnitudes are rounded, too.
constexpr double up = 1 + 1e-9;

double magnitude(const Six& six, int i) { return std::hypot(six.re[i], six.im[i]); }

// Magnitudes of the linear map e -> w of one leg, and of its square.
struct LegBounds {
  double map[4][4];
  double square;

  LegBounds(const PlatformLegs& legs, int i) {
    double joint[3];
    for (int k = 0; k < 3; ++k) joint[k] = magnitude(legs.base[k], i) + magnitude(legs.platform[k], i);
    const double a = joint[0], b = joint[1], c = joint[2];
    const double rows[4][4] = {{0, a, b, c}, {a, 0, c, b}, {b, c, 0, a}, {c, b, a, 0}};
    std::copy(&rows[0][0], &rows[0][0] + 16, &map[0][0]);
    square = magnitude(legs.square, i);
  }
};

// Bounds of the magnitudes that are added up in a value, and, of a row of the Jacobian, in its numbers; sums
// over the second derivatives of each derivative.
struct RowBounds {
  double value = 0;
  std::array<double, 8> jacobian{}, second{};
};

RowBounds bounds_of_leg(const PlatformLegs& legs, int i, const std::array<double, 8>& x) {
  const LegBounds leg(legs, i);
  RowBounds out;
  double w[4], n = 0, h = 0;
  for (int q = 0; q < 4; ++q) {
    w[q] = 0;
    for (int j = 0; j < 4; ++j) w[q] += leg.map[q][j] * x[j];
    n += x[q] * x[q];
    h += x[4 + q] * x[4 + q];
  }
  out.value = leg.square * n + (i == 0 ? h : 0);
  for (int q = 0; q < 4; ++q) {
    out.value += w[q] * (w[q] + 2 * x[4 + q]);
    out.jacobian[4 + q] = 2 * w[q] + (i == 0 ? 2 * x[4 + q] : 0);
    if (i == 0) out.second[4 + q] = 2;
    out.jacobian[q] += 2 * leg.square * x[q];
    out.second[q] += 2 * leg.square;
    for (int j = 0; j < 4; ++j) {
      out.jacobian[j] += 2 * leg.map[q][j] * (w[q] + x[4 + q]);
      out.second[j] += 2 * leg.map[q][j];
      out.second[4 + q] += 2 * leg.map[q][j];
      for (int k = 0; k < 4; ++k) out.second[j] += 2 * leg.map[q][j] * leg.map[q][k];
    }
  }
  return out;
}

RowBounds bounds(const PlatformLegs& legs, int row, const std::array<double, 8>& x, int chart) {
  if (row < 6) return bounds_of_leg(legs, row, x);
  RowBounds out;
  if (row == 6) {
    for (int k = 0; k < 8; ++k) {
      out.value += x[k] * x[(k + 4) % 8] / 2;
      out.jacobian[k] = x[(k + 4) % 8];
      out.second[k] = 1;
    }
  } else {
    out.jacobian[chart] = 1;  // x[chart] - 1, without an error
  }
  return out;
}

int greatest(const PlatformPoint& x) {
  return static_cast<int>(
      std::max_element(x.begin(), x.end(),
                       [](const Complex& a, const Complex& b) { return std::norm(a) < std::norm(b); }) -
      x.begin());
}

bool is_real(const Six& six) {
  return std::all_of(std::begin(six.im), std::end(six.im), [](double im) { return im == 0; });
}
bool is_real(const PlatformLegs& legs) {
  return is_real(legs.square) &&
         std::all_of(legs.base.begin(), legs.base.end(), [](const Six& s) { return is_real(s); }) &&
         std::all_of(legs.platform.begin(), legs.platform.end(), [](const Six& s) { return is_real(s); });
}

}  // namespace

PlatformProof prove(const PlatformLegs& legs, const PlatformPoint& point) {
  const int chart = greatest(point);
  PlatformPoint x = point, unit{};
  for (Complex& c : x) c /= point[chart];
  x[chart] = unit[chart] = 1;
  PlatformValues values;
  EightLu lu;
  evaluate(legs, x, unit, values);
  values.value[7] = 0;
  if (!lu.factor(values.jacobian)) return {};
  // One more Newton step, as the scaling has cost the last digits.
  lu.solve(values.value);
  for (int k = 0; k < 8; ++k) x[k] -= values.value[k];
  x[chart] = 1;
  evaluate(legs, x, unit, values);
  values.value[7] = 0;

  std::array<PlatformPoint, 8> inverse;  // columns of A
  for (int j = 0; j < 8; ++j) {
    inverse[j] = {};
    inverse[j][j] = 1;
    lu.solve(inverse[j]);
  }
  std::array<double, 8> sizes;
  for (int k = 0; k < 8; ++k) sizes[k] = std::abs(x[k]);
  std::array<RowBounds, 8> row;
  for (int i = 0; i < 8; ++i) row[i] = bounds(legs, i, sizes, chart);

  double beta = 0, delta = 0, kappa = 0;
  for (int i = 0; i < 8; ++i) {
    double step = 0, second = 0, rest = 0;
    for (int k = 0; k < 8; ++k) {
      const double a = std::abs(inverse[k][i]);
      step += a * (std::abs(values.value[k]) + gamma * row[k].value);
      for (int j = 0; j < 8; ++j) second += a * row[k].second[j];
    }
    for (int j = 0; j < 8; ++j) {
      Complex sum = i == j ? 1 : 0;
      double error = i == j ? gamma : 0;
      for (int k = 0; k < 8; ++k) {
        sum -= inverse[k][i] * Complex{values.jacobian.re[j][k], values.jacobian.im[j][k]};
        error += 2 * gamma * std::abs(inverse[k][i]) * row[k].jacobian[j];
      }
      rest += std::abs(sum) + error;
    }
    beta = std::max(beta, up * step);
    delta = std::max(delta, up * rest);
    kappa = std::max(kappa, up * second);
  }
  PlatformProof out;
  // The radius has room to spare: the root of the condition is at most 2 beta / (1 - delta).
  const double radius = 2.1 * beta / (1 - delta);
  out.unique = delta < 0.5 && up * (beta + delta * radius + kappa * radius * radius / 2) <= radius &&
               up * (delta + kappa * radius) < 1;
  if (!out.unique) return {};
  // The point given, not the one after the step, is the centre for those who call.
  double moved = 0;
  for (int k = 0; k < 8; ++k) moved = std::max(moved, std::abs(x[k] - point[k] / point[chart]));
  out.radius = up * (radius + moved) + gamma;

  Complex n = 0;
  double change = 0;
  for (int k = 0; k < 4; ++k) {
    n += x[k] * x[k];
    change += 2 * sizes[k] * radius + radius * radius + gamma * sizes[k] * sizes[k];
  }
  out.finite = std::abs(n) > up * change;
  const bool real = std::all_of(x.begin(), x.end(), [](const Complex& c) { return c.imag() == 0; });
  out.real = real && is_real(legs);
  out.complex =
      std::any_of(x.begin(), x.end(), [&](const Complex& c) { return std::abs(c.imag()) > radius; });
  return out;
}

bool apart(const PlatformPoint& x, const PlatformProof& a, const PlatformPoint& y, const PlatformProof& b) {
  if (!a.unique || !b.unique) return false;
  // A ball of radius r about a point of length >= 1 is seen from 0 within asin(sqrt(8) r).
  return distance(x, y) > 4 * (a.radius + b.radius) + gamma;
}

}  // namespace linkwright::parallel
