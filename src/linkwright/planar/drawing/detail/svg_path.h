// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/drawing/detail/lines.h"

// Path data of SVG as lines: M L H V C S Q T A Z, absolute and relative.
namespace linkwright::planar::drawing {

/// One command with one set of its numbers.
struct PathCommand {
  char letter = 'M';
  std::array<double, 7> numbers{};
};

/// The numbers of a list such as that of a viewBox, separated by blanks and commas. Throws Fault at `line`
/// for another text.
/// @param what the list in messages: "the viewBox of <svg> in line 2"
std::vector<double> numbers_in(std::string_view text, const std::string& what, int line);

/// The commands of path data, one for each set of numbers; further pairs after M are lines. Throws Fault at
/// `line`, with the place in the data.
/// @param what begins messages: "<path> in line 3: ", or nothing
std::vector<PathCommand> path_commands(std::string_view data, const std::string& what, int line);

/// Number of commands that draw a curve.
std::size_t curves_in(const std::vector<PathCommand>& commands);

/// The lines of path data, each from its M on, with the y axis of SVG, without names; curves have `steps`
/// points.
std::vector<Line> path_lines(const std::vector<PathCommand>& commands, std::size_t steps);

/// The line of an attribute d alone, in mm with the y axis upwards. Throws Fault.
Line svg_path_line(std::string_view data);

}  // namespace linkwright::planar::drawing
