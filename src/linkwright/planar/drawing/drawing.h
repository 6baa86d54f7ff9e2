// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"

// The one line of a drawing, from SVG or ASCII DXF.
namespace linkwright::planar {

/// The line of a drawing, with its curves as points.
struct DrawnLine {
  std::vector<std::complex<double>> points;  ///< m, y upwards; neighbours differ; a closed one ends before
                                             ///< its first point comes again
  bool closed = false;                       ///< the last point is followed by the first
  bool has_unit = true;  ///< the drawing says in which unit its numbers are; without one they are mm
};

/// Forms of drawings that are read.
enum class DrawingFormat {
  none,      ///< no drawing: a table, or something else
  svg,       ///< an SVG file
  svg_path,  ///< the attribute d of a path alone, "M 0 0 L 40 0"
  dxf        ///< an ASCII DXF file, or a binary one, which `read_drawing` refuses
};

/// The form of a text by its first characters.
/// @param text text in UTF-8, without a byte order mark
/// @returns the form
DrawingFormat drawing_format(std::string_view text);

/// Reads the line of a drawing: a path, polyline, polygon, line, rectangle, circle or ellipse of SVG with the
/// transforms around it and the scale of the page; a polyline with bulges, line, arc, circle, ellipse or
/// spline of DXF with its $INSUNITS. Several lines that meet end to end are one, whatever their order and
/// direction. Curves become 24 points (SVG) or 96 a turn (DXF), fewer where a drawing has more than 20 000.
/// Time and memory grow with the length of the text alone.
/// @param text text in UTF-8, without a byte order mark, in a form that `drawing_format` knows
/// @param file name of the file in diagnostics
/// @param diagnostics receives the error, with its line where there is one
/// @returns the line; none, with one error in `diagnostics`, where the text draws no line or several
std::optional<DrawnLine> read_drawing(std::string_view text, const std::string& file,
                                      Diagnostics& diagnostics);

/// Something that a drawing holds.
struct DrawnShape {
  std::vector<std::complex<double>> points;  ///< corners, m, y upwards; curves are points as in DrawnLine
  bool closed = false;                       ///< the last point is followed by the first
  std::complex<double> centre{};             ///< of a circle, m
  double radius = 0;                         ///< of a circle, m; 0: another shape
  std::string layer;                         ///< layer of DXF, innermost named group of SVG
  std::string name;                          ///< in messages: "LINE in line 12"
};
/// Everything that a drawing holds.
struct DrawnShapes {
  std::vector<DrawnShape> shapes;  ///< in the order of the file
  bool has_unit = true;  ///< the drawing says in which unit its numbers are; without one they are mm
};

/// Reads the shapes of a drawing one by one, of the same elements as `read_drawing`.
/// @param text text in UTF-8, without a byte order mark: an SVG file or an ASCII DXF
/// @param file name of the file in diagnostics
/// @param diagnostics receives the error, with its line where there is one
/// @returns the drawing; none, with one error in `diagnostics`, where nothing is drawn
std::optional<DrawnShapes> read_shapes(std::string_view text, const std::string& file,
                                       Diagnostics& diagnostics);

}  // namespace linkwright::planar
