// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/suspension/corner/hard_points.h"

/// Lists of hard points as drawings, spreadsheets and other programs write them.
namespace linkwright::suspension {

/// Reads a list of points, in the list's own frame but in metres. The first line distinguishes two of its
/// forms:
/// - columns with the headings name, x, y and z in any order, separated by commas, semicolons or tabs. Units
///   are in the headings (x_mm, X [mm]), in a row of their own below them, or are `unit`; columns with
///   other headings are ignored;
/// - plain text, one point a line: its name, of one or several words, quoted or not, with or without a number
///   before it, then x, y, z, separated by blanks, tabs, commas, semicolons, brackets, = or :. Names may also
///   follow the coordinates, as words or as a comment (`[1 2 3]; % tie rod`). Units may follow the numbers.
///   Commas are decimal points where something else separates. Comments begin with # $ ! % or //; lines
///   without digits are headings.
/// A property file with a section [HARDPOINT] is read by its rows 'name' 'symmetry' x y z, with the unit of
/// length of its section [UNITS]; other sections are passed over. A point of both sides (left/right) is that
/// of the left one; the name of a point of the right side alone ends with right.
/// Names are made plain: "Lower wishbone, front pivot" becomes lower_wishbone_front_pivot.
/// A line with numbers that is not read is a warning where it cannot be a point (`mass 24.5`), and an error
/// where it may be one. Problems are appended with their line under the name `file`; nothing is returned if
/// there is an error, such as two points of one name at different positions, or no point at all.
std::optional<std::vector<HardPoint>> read_hard_points(std::string_view text, const std::string& file,
                                                       PointUnit unit, Diagnostics& diagnostics);

}  // namespace linkwright::suspension
