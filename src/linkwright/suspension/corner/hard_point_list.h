// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/core/units.h"
#include "linkwright/suspension/corner/hard_points.h"

/// Lists of hard points as drawings, spreadsheets and other programs write them.
namespace linkwright::suspension {

/// The forms of lists.
enum class ListFormat {
  text,         ///< one point a line: name x y z
  property,     ///< a property file with a section [HARDPOINT]
  csv,          ///< columns with headings, separated by commas
  spreadsheet,  ///< columns with headings, separated by semicolons, with decimal commas
  sections,     ///< columns separated by commas, under titles Front and Rear
  json          ///< an object whose arrays of three numbers are points
};
constexpr std::array<EnumName<ListFormat>, 6> names(ListFormat) {
  return {{{ListFormat::text, "text", "one point a line: name x y z"},
           {ListFormat::property, "property", "property file with a section [HARDPOINT]"},
           {ListFormat::csv, "csv", "columns separated by commas"},
           {ListFormat::spreadsheet, "spreadsheet", "columns separated by semicolons, with decimal commas"},
           {ListFormat::sections, "sections", "columns separated by commas, under titles Front and Rear"},
           {ListFormat::json, "json", "object whose arrays of three numbers are points"}}};
}

/// Place of a number in the text of a list.
struct ListNumber {
  std::size_t begin = 0, size = 0;
  const Unit* unit = nullptr;  ///< unit of length that it is read in
  bool decimal_comma = false;
};

/// A point as a list has it.
struct ListedPoint {
  HardPoint point;
  std::string label;                              ///< name as the list writes it
  std::vector<std::array<ListNumber, 3>> places;  ///< x, y, z; several where the list repeats the point
};

/// A list that was read, from which it can be written again with other coordinates.
struct HardPointList {
  ListFormat format = ListFormat::text;
  std::string text;  ///< the whole list, with signs of ASCII
  std::vector<ListedPoint> points;
};

/// Reads a list of points, in the list's own frame but in metres. The first line distinguishes two of its
/// forms:
/// - columns with the headings name, x, y and z in any order, separated by commas, semicolons or tabs; lines
///   without numbers may precede the headings, the last of which may hold the unit of all coordinates. Units
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
/// Where a list has the titles Front and Rear, in lines of their own, the names of the points below begin
/// with front and rear; other titles and repeated headings between points in columns are passed over. An
/// object of JSON is read by its arrays of three numbers, each named by its key after those of the objects it
/// is in; those of inertias, axes, directions, orientations and colours are none. Names are made plain:
/// "Lower wishbone, front pivot" becomes lower_wishbone_front_pivot. Four numbers in a line and no name are
/// the number of a point, which is its name, and its coordinates. A line with numbers that is not read is a
/// warning where it cannot be a point (`mass 24.5`), and an error where it may be one. Problems are appended
/// with their line under the name `file`; nothing is returned if there is an error, such as two points of one
/// name at different positions, or no point at all.
std::optional<HardPointList> read_hard_point_list(std::string_view text, const std::string& file,
                                                  PointUnit unit, Diagnostics& diagnostics);
/// Its points alone.
std::optional<std::vector<HardPoint>> read_hard_points(std::string_view text, const std::string& file,
                                                       PointUnit unit, Diagnostics& diagnostics);

/// The text of a list with other coordinates of its points, in the list's frame (m) and in the order of the
/// list; everything else in it is kept, and so are the numbers of points that have not moved. Coordinates
/// have as many digits as they need to be read with the same bits, or 17 where no number of the list's unit
/// is read so.
std::string write_hard_points(const HardPointList& list, std::span<const Vec3> at);

/// A new list of points (m) with labels as names, in a form and a unit. In a property file a point at y = 0
/// is single, one whose name ends with "right" is of the right side alone, and all others are of both sides,
/// given for the left one; points whose names begin with front and rear are in sections of these titles. A
/// label that the form cannot hold is written as its plain_name.
std::string write_hard_points(std::span<const HardPoint> points, ListFormat format, PointUnit unit);

}  // namespace linkwright::suspension
