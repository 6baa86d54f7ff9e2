// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace linkwright::math {

/// Polynomials that follow each other. Piece i covers [knots[i], knots[i + 1]] and is
/// sum over p of coefficients[i * terms + p] x^p with x = (t - knots[i]) / (knots[i + 1] - knots[i]).
struct PiecewisePolynomial {
  std::vector<double> knots;  ///< increasing, at least two
  std::size_t terms = 0;      ///< coefficients of a piece, at least one
  std::vector<double> coefficients;
};

/// Value and the first three derivatives at t; outside the knots the first or last piece continues. At an
/// inner knot the piece to the right counts.
std::array<double, 4> evaluate(const PiecewisePolynomial& polynomial, double t);

enum class SplineDegree { cubic, quintic };

/// The condition at both ends. `natural`: the derivatives of orders 2 (cubic) or 3 and 4 (quintic) vanish:
/// least integral of the squared second or third derivative. `rest`: those of order 1 (cubic) or 1 and 2
/// (quintic) vanish. `periodic`: all that are continuous inside are so from the last point to the first, too;
/// the values themselves may differ, so that a turning angle grows from period to period.
enum class SplineEnds { natural, rest, periodic };

/// The smooth curve through points (t_i, y_i): pieces of degree 3 whose first 2 derivatives are continuous,
/// or of degree 5 with 4.
///
/// Throws ContractError unless t is increasing, all numbers are finite, both have the same length and there
/// are at least 2 points (3 when periodic; a natural quintic needs 3 as well).
PiecewisePolynomial interpolating_spline(std::span<const double> t, std::span<const double> y,
                                         SplineDegree degree, SplineEnds ends);

}  // namespace linkwright::math
