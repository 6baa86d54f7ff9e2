// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/spline.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::math {
namespace {

// A piece of degree 2 m + 1 is given by value and m derivatives at both ends. All are taken with x = 0..1
// over the piece, so the derivative of order k is h^k times that over t: ends[e][k], e = 0, 1.
template <std::size_t m>
using Ends = std::array<std::array<double, m + 1>, 2>;

template <std::size_t m>
std::array<double, 2 * m + 2> coefficients(const Ends<m>& e) {
  const double d = e[1][0] - e[0][0], v0 = e[0][1], v1 = e[1][1];
  if constexpr (m == 1) {
    return {e[0][0], v0, 3 * d - 2 * v0 - v1, -2 * d + v0 + v1};
  } else {
    const double a0 = e[0][2], a1 = e[1][2];
    return {e[0][0],
            v0,
            a0 / 2,
            10 * d - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1,
            -15 * d + 8 * v0 + 7 * v1 + 1.5 * a0 - a1,
            6 * d - 3 * v0 - 3 * v1 - 0.5 * a0 + 0.5 * a1};
  }
}

template <std::size_t terms>
double derivative(const std::array<double, terms>& c, std::size_t order, double x) {
  double sum = 0;
  for (std::size_t p = terms; p-- > order;) {
    double factor = 1;
    for (std::size_t k = 0; k < order; ++k) factor *= static_cast<double>(p - k);
    sum = sum * x + factor * c[p];
  }
  return sum;
}

template <std::size_t m>
PiecewisePolynomial solve(std::span<const double> t, std::span<const double> y, SplineEnds ends) {
  const std::size_t pieces = t.size() - 1;
  const bool periodic = ends == SplineEnds::periodic;
  const std::size_t nodes = periodic ? pieces : pieces + 1;
  const auto unknown = [&](std::size_t node, std::size_t order) {
    return static_cast<Eigen::Index>((node % nodes) * m + order - 1);
  };
  const auto width = [&](std::size_t piece) { return t[piece + 1] - t[piece]; };
  const auto size = static_cast<Eigen::Index>(nodes * m);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);

  // Adds sign * scale^order * (derivative of that order over t at one end of a piece) to an equation.
  const auto add = [&](Eigen::Index row, std::size_t piece, int end, std::size_t order, double factor) {
    const double h = width(piece), scaled = factor / std::pow(h, static_cast<double>(order));
    const auto part = [&](const Ends<m>& e) { return scaled * derivative(coefficients<m>(e), order, end); };
    Ends<m> e{};
    e[1][0] = y[piece + 1] - y[piece];  // derivatives do not depend on the level
    right(row) -= part(e);
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t k = 1; k <= m; ++k) {
        Ends<m> unit{};
        unit[side][k] = std::pow(h, static_cast<double>(k));
        entries.emplace_back(row, unknown(piece + side, k), part(unit));
      }
  };
  Eigen::Index row = 0;
  for (std::size_t node = 0; node < nodes; ++node) {
    const bool first = node == 0 && !periodic, last = node == pieces && !periodic;
    for (std::size_t k = 1; k <= m; ++k, ++row) {
      const std::size_t order = m + k, left = (node + pieces - 1) % pieces;
      if ((first || last) && ends == SplineEnds::rest)
        entries.emplace_back(row, unknown(node, k), 1.0);
      else if (first)
        add(row, 0, 0, order, std::pow(width(0), static_cast<double>(order)));
      else if (last)
        add(row, left, 1, order, std::pow(width(left), static_cast<double>(order)));
      else {
        const double scale = std::pow(std::min(width(left), width(node)), static_cast<double>(order));
        add(row, left, 1, order, scale);
        add(row, node, 0, order, -scale);
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(matrix);
  LINKWRIGHT_REQUIRE(factors.info() == Eigen::Success, "the spacing of {} points is too uneven for a spline",
                     t.size());
  const Eigen::VectorXd slopes = factors.solve(right);

  PiecewisePolynomial out{.knots{t.begin(), t.end()}, .terms = 2 * m + 2, .coefficients{}};
  out.coefficients.reserve(pieces * out.terms);
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    Ends<m> e{};
    for (std::size_t side = 0; side < 2; ++side) {
      e[side][0] = y[piece + side];
      for (std::size_t k = 1; k <= m; ++k)
        e[side][k] = slopes(unknown(piece + side, k)) * std::pow(width(piece), static_cast<double>(k));
    }
    for (double c : coefficients<m>(e)) out.coefficients.push_back(c);
  }
  return out;
}

}  // namespace

std::array<double, 4> evaluate(const PiecewisePolynomial& polynomial, double t) {
  const auto& knots = polynomial.knots;
  const auto inner = std::upper_bound(knots.begin() + 1, knots.end() - 1, t);
  const auto piece = static_cast<std::size_t>(inner - knots.begin() - 1);
  const double h = knots[piece + 1] - knots[piece], x = (t - knots[piece]) / h;
  const double* c = polynomial.coefficients.data() + piece * polynomial.terms;
  // Horner's scheme for the polynomial and its Taylor coefficients at x.
  std::array<double, 4> s{};
  for (std::size_t p = polynomial.terms; p-- > 0;) {
    s[3] = s[3] * x + s[2];
    s[2] = s[2] * x + s[1];
    s[1] = s[1] * x + s[0];
    s[0] = s[0] * x + c[p];
  }
  return {s[0], s[1] / h, 2 * s[2] / (h * h), 6 * s[3] / (h * h * h)};
}

PiecewisePolynomial interpolating_spline(std::span<const double> t, std::span<const double> y,
                                         SplineDegree degree, SplineEnds ends) {
  const bool needs_three =
      ends == SplineEnds::periodic || (ends == SplineEnds::natural && degree == SplineDegree::quintic);
  LINKWRIGHT_REQUIRE(t.size() == y.size(), "{} places and {} values must be as many", t.size(), y.size());
  LINKWRIGHT_REQUIRE(t.size() >= (needs_three ? 3u : 2u), "{} points are too few, at least {} are needed",
                     t.size(), needs_three ? 3 : 2);
  for (std::size_t i = 0; i < t.size(); ++i) {
    LINKWRIGHT_REQUIRE(std::isfinite(t[i]) && std::isfinite(y[i]), "point {} ({}, {}) must be finite", i,
                       t[i], y[i]);
    LINKWRIGHT_REQUIRE(i == 0 || t[i] > t[i - 1], "places must increase: {} follows {}", t[i], t[i - 1]);
  }
  return degree == SplineDegree::cubic ? solve<1>(t, y, ends) : solve<2>(t, y, ends);
}

}  // namespace linkwright::math
