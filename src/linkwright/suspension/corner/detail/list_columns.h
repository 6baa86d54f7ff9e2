// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/suspension/corner/detail/list_collector.h"

/// Lists of hard points in columns: CSV and what spreadsheets export.
namespace linkwright::suspension::lists {

/// The side of the vehicle that a column belongs to.
enum class ListSide { none, left, right };

struct Axis {
  int axis = -1;  ///< 0 x, 1 y, 2 z
  const Unit* unit = nullptr;
  ListSide side = ListSide::none;
};

/// A heading such as x, x_mm, "X [mm]" or "Left X [mm]".
Axis axis_of(std::string_view heading);

/// The cells of a line as they are written, with their quotes.
std::vector<std::string_view> cells_of(std::string_view line, char separator);

/// Three columns of coordinates.
struct ColumnGroup {
  std::array<std::optional<std::size_t>, 3> at;
  std::array<const Unit*, 3> units{};
  ListSide side = ListSide::none;
};

struct Header {
  char separator = 0;
  std::size_t columns = 0;
  std::optional<std::size_t> name;
  std::vector<ColumnGroup> groups;  ///< one, or those of both sides
};

/// The header of a list in columns; nothing for plain text. `above` is the line before it, where a heading
/// that spans several columns may give their unit or their side.
std::optional<Header> header_of(std::string_view line, char separator, std::string_view above = {});

/// A list in columns, brought into the order name, x, y, z line by line and read as CSV. Where it has columns
/// of both sides, the points of the right one follow, and their names end with right; a row may leave out one
/// side.
std::optional<std::vector<ListedPoint>> read_columns(std::string_view text, int header_line,
                                                     const Header& header, const std::string& file,
                                                     const Unit* given,
                                                     const std::vector<ListSection>& sections,
                                                     Diagnostics& diagnostics);

}  // namespace linkwright::suspension::lists
