// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstddef>
#include <string>
#include <vector>

// The lines of a drawing, joined end to end where they meet: a traced point follows one line.
namespace linkwright::planar::drawing {

/// A line of a drawing, in mm.
struct Line {
  std::vector<std::complex<double>> points;
  bool closed = false;
  std::string name;               ///< in messages: "<path> in line 3"
  std::string layer = {};         ///< layer of DXF, or the innermost group of SVG that has a name
  std::complex<double> centre{};  ///< of a circle
  double radius = 0;              ///< of a circle; 0: another line
};

/// Points of each curve of a drawing: at most `most`, and fewer where there are very many curves, but 2.
std::size_t curve_steps(std::size_t curves, std::size_t most);

/// The length of a line, with the side that closes it.
double length_of(const Line& line);

/// The one line that the lines of a drawing make. Ends within 1e-4 of the drawing's size meet, in any order
/// and direction; a chain that returns to its beginning is closed. Throws Fault where they make none or
/// several.
/// @param all lines with at least two points each
/// @param where the drawing in messages: "the DXF drawing"
/// @param hint how to keep one line of several
Line one_line(std::vector<Line> all, const std::string& where, const std::string& hint);

}  // namespace linkwright::planar::drawing
