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
  std::vector<double> knots;         ///< increasing, at least two
  std::size_t terms = 0;             ///< coefficients of a piece, at least one
  std::vector<double> coefficients;  ///< knots.size() - 1 times `terms`
};

/// Outside the knots the first or last piece continues. At an inner knot the piece to the right counts.
/// @param polynomial the pieces
/// @param t place, in the unit of the knots
/// @returns value and the first three derivatives by t
std::array<double, 4> evaluate(const PiecewisePolynomial& polynomial, double t);

/// Degree of the pieces.
enum class SplineDegree {
  cubic,   ///< two continuous derivatives
  quintic  ///< four continuous derivatives
};

/// The condition at both ends.
enum class SplineEnds {
  /// The derivatives of orders 2 (cubic) or 3 and 4 (quintic) vanish: least integral of the squared second or
  /// third derivative.
  natural,
  /// The derivatives of order 1 (cubic) or 1 and 2 (quintic) vanish.
  rest,
  /// All derivatives that are continuous inside are so from the last point to the first, too; the values
  /// themselves may differ, so that a turning angle grows from period to period.
  periodic
};

/// The smooth curve through points (t_i, y_i): pieces of degree 3 whose first 2 derivatives are continuous,
/// or of degree 5 with 4.
/// @param t places of the points, increasing, at least 2; at least 3 for a periodic or a natural quintic
/// spline
/// @param y values of the points, as many
/// @param degree degree of the pieces
/// @param ends condition at both ends
/// @returns the pieces, whose knots are t
/// @throws ContractError unless t is increasing, all numbers are finite, both have the same length and there
/// are enough points
PiecewisePolynomial interpolating_spline(std::span<const double> t, std::span<const double> y,
                                         SplineDegree degree, SplineEnds ends);

}  // namespace linkwright::math
