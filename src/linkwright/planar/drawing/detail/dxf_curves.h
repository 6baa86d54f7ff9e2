// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstddef>
#include <string>
#include <vector>

// Points of the curves of DXF: arcs, ellipses, and splines of control points with knots.
namespace linkwright::planar::drawing {

/// Appends an ellipse by its centre, its half axes as vectors, and the range of its parameter (rad), with
/// both ends; `per_turn` points for each turn.
void add_ellipse(std::complex<double> centre, std::complex<double> major, std::complex<double> minor,
                 double from, double span, std::size_t per_turn, std::vector<std::complex<double>>& out);

/// Appends the arc from a to b whose bulge is the tangent of a quarter of its angle, positive
/// counterclockwise; without b.
void add_bulge(std::complex<double> a, std::complex<double> b, double bulge, std::size_t per_turn,
               std::vector<std::complex<double>>& out);

/// A B-spline; a weight for each control point, 1 where it is not rational.
struct DrawnSpline {
  double degree = 3;
  std::vector<double> knots;
  std::vector<std::complex<double>> control;
  std::vector<double> weights;
};

/// The reason why these numbers are no spline; empty if they are one.
std::string spline_fault(const DrawnSpline& spline);

/// Points of a spline without fault, `steps` between two knots, with both ends.
std::vector<std::complex<double>> spline_points(const DrawnSpline& spline, std::size_t steps);

}  // namespace linkwright::planar::drawing
