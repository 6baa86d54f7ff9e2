// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/drawing/drawing.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/drawing/detail/dxf_file.h"
#include "linkwright/planar/drawing/detail/fault.h"
#include "linkwright/planar/drawing/detail/svg_file.h"
#include "linkwright/planar/drawing/detail/svg_path.h"

namespace linkwright::planar {
namespace {

constexpr double millimetre = 1e-3;  // m

std::string_view without_blanks_before(std::string_view text) {
  while (!text.empty() && drawing::is_blank(text.front())) text.remove_prefix(1);
  return text;
}

/// True for the first groups of a DXF file: 0 with a word that may begin one, or a remark.
bool begins_as_dxf(std::string_view text) {
  const std::size_t end = text.find_first_of("\r\n");
  if (end == text.npos) return false;
  const std::string_view code = drawing::trimmed(text.substr(0, end));
  if (code == "999") return true;
  if (code != "0") return false;
  const std::string_view rest = without_blanks_before(text.substr(end));
  const std::string_view word = drawing::trimmed(rest.substr(0, rest.find_first_of("\r\n")));
  constexpr std::array<std::string_view, 9> words{"SECTION", "LWPOLYLINE", "POLYLINE", "LINE", "ARC",
                                                  "CIRCLE",  "ELLIPSE",    "SPLINE",   "EOF"};
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Neighbours that differ, and no first point again at the end of a closed line.
DrawnLine tidied(const drawing::Line& line) {
  DrawnLine out{.points = {}, .closed = line.closed};
  double left = infinity, right = -infinity, bottom = infinity, top = -infinity;
  for (const std::complex<double>& p : line.points) {
    const std::complex<double> at(millimetre * p.real() + 0.0, millimetre * p.imag() + 0.0);  // no -0
    if (out.points.empty() || at != out.points.back()) out.points.push_back(at);
    left = std::min(left, at.real()), right = std::max(right, at.real());
    bottom = std::min(bottom, at.imag()), top = std::max(top, at.imag());
  }
  const double size = std::max(right - left, top - bottom);
  const bool meets = std::abs(out.points.front() - out.points.back()) <= 1e-6 * size;
  if (meets && out.points.size() > 3) out.closed = true;
  if (meets && out.closed && out.points.size() > 1) out.points.pop_back();
  return out;
}

Diagnostic diagnostic_of(const drawing::Fault& fault, const std::string& file) {
  return {.file = file,
          .position = {.line = fault.line, .column = fault.line > 0 ? 1 : 0},
          .key = {},
          .message = fault.message,
          .hint = fault.hint};
}

}  // namespace

DrawingFormat drawing_format(std::string_view text) {
  text = without_blanks_before(text);
  if (text.starts_with('<')) return DrawingFormat::svg;
  if (text.starts_with("AutoCAD Binary DXF") || begins_as_dxf(text)) return DrawingFormat::dxf;
  if (!text.starts_with('m') && !text.starts_with('M')) return DrawingFormat::none;
  text = without_blanks_before(text.substr(1));
  const bool number = !text.empty() && std::string_view("-+.0123456789").find(text[0]) != text.npos;
  return number ? DrawingFormat::svg_path : DrawingFormat::none;
}

std::optional<DrawnLine> read_drawing(std::string_view text, const std::string& file,
                                      Diagnostics& diagnostics) {
  try {
    bool has_unit = false;
    switch (drawing_format(text)) {
      case DrawingFormat::svg:
      case DrawingFormat::dxf: {
        const bool svg = drawing_format(text) == DrawingFormat::svg;
        const drawing::Line line =
            svg ? drawing::svg_file_line(text, has_unit) : drawing::dxf_file_line(text, has_unit);
        DrawnLine out = tidied(line);
        out.has_unit = has_unit;
        return out;
      }
      case DrawingFormat::svg_path: {
        DrawnLine out = tidied(drawing::svg_path_line(text));
        out.has_unit = false;
        return out;
      }
      case DrawingFormat::none:
        throw drawing::Fault{0, "this is neither an SVG file nor an ASCII DXF drawing",
                             "save the path as plain SVG, or as an ASCII DXF"};
    }
  } catch (const drawing::Fault& fault) {
    diagnostics.push_back(diagnostic_of(fault, file));
  }
  return std::nullopt;
}

std::optional<DrawnShapes> read_shapes(std::string_view text, const std::string& file,
                                       Diagnostics& diagnostics) {
  try {
    DrawnShapes out;
    const DrawingFormat format = drawing_format(text);
    if (format != DrawingFormat::svg && format != DrawingFormat::dxf)
      throw drawing::Fault{0, "this is neither an SVG file nor an ASCII DXF drawing",
                           "save the drawing as plain SVG, or as an ASCII DXF"};
    std::vector<drawing::Line> lines = format == DrawingFormat::svg
                                           ? drawing::svg_file_lines(text, out.has_unit)
                                           : drawing::dxf_file_lines(text, out.has_unit);
    for (drawing::Line& line : lines) {
      DrawnShape shape{.points = {},
                       .closed = line.closed,
                       .centre = millimetre * line.centre,
                       .radius = millimetre * line.radius,
                       .layer = std::move(line.layer),
                       .name = std::move(line.name)};
      if (shape.radius == 0)
        for (const std::complex<double>& p : line.points) shape.points.push_back(millimetre * p);
      std::vector<std::complex<double>> places = shape.points;
      if (shape.radius > 0) places = {shape.centre, shape.centre + shape.radius};
      for (const std::complex<double>& p : places)
        if (!std::isfinite(p.real()) || !std::isfinite(p.imag()))
          throw drawing::Fault{0, fmt::format("{} lies too far away to be drawn", shape.name),
                               "check the unit of the drawing"};
      out.shapes.push_back(std::move(shape));
    }
    return out;
  } catch (const drawing::Fault& fault) {
    diagnostics.push_back(diagnostic_of(fault, file));
  }
  return std::nullopt;
}

}  // namespace linkwright::planar
