// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/hard_point_list.h"

#include <fmt/core.h>

#include <cmath>
#include <span>
#include <utility>

#include "linkwright/core/units.h"
#include "linkwright/suspension/corner/detail/list_collector.h"
#include "linkwright/suspension/corner/detail/list_columns.h"
#include "linkwright/suspension/corner/detail/list_json.h"
#include "linkwright/suspension/corner/detail/list_property.h"

namespace linkwright::suspension::lists {
namespace {

/// A heading of plain text: it may name the axes, in one order, and the unit of all of them.
void read_heading(int line, std::span<const Word> words, ListCollector& collect, const Unit*& unit) {
  std::string axes;
  const Unit* found = nullptr;
  bool one = true, units_alone = true;
  for (const Word& word : words) {
    const Axis axis = axis_of(word.text);
    const Unit* own = axis.unit ? axis.unit : unit_of(plain_name(word.text));
    if (axis.axis >= 0) axes += "xyz"[axis.axis];
    if (own) one = one && (!found || found == own), found = own;
    if (!own && !plain_name(word.text).empty()) units_alone = false;
  }
  const bool named = axes.size() == 3;
  if (named && axes != "xyz")
    collect.problem(
        line, {}, fmt::format("the coordinates are in the order {}, {}, {}", axes[0], axes[1], axes[2]),
        "write them in the order x, y, z, or the list as CSV with the columns name,x_mm,y_mm,z_mm");
  const bool declared = !words.empty() && plain_name(words[0].text).starts_with("unit");
  if (!found || !(named || units_alone || declared)) return;
  if (one)
    unit = found;
  else
    collect.problem(line, {}, "the coordinates have different units",
                    "give such a list as CSV with the columns name,x_mm,y_mm,z_m");
}

/// Reads a text without byte order mark and with signs of ASCII.
std::optional<HardPointList> read_list(std::string_view text, const std::string& file, const Unit* unit,
                                       Diagnostics& diagnostics) {
  const auto of = [&](ListFormat format, std::optional<std::vector<ListedPoint>> points) {
    std::optional<HardPointList> out;
    if (points) out = HardPointList{.format = format, .text = {}, .points = *std::move(points)};
    return out;
  };
  for (std::string_view rest = text; !rest.empty();)
    if (section_of(take_line(rest)) == "hardpoint")
      return of(ListFormat::property, read_property_table(text, file, unit, diagnostics));
  if (is_json(text)) return of(ListFormat::json, read_json_points(text, file, unit, diagnostics));
  const std::vector<ListSection> sections = sections_of(text);
  ListCollector collect(file, diagnostics, sections);
  const std::string_view whole = text;
  std::string_view above;
  char separator = 0;
  bool headings = true;
  for (int line = 1; !text.empty(); ++line) {
    const std::string_view row = take_line(text);
    if (headings && row.size() == 5 && row.starts_with("sep=")) separator = row.back();
    // A semicolon begins comments of some programs, and rows without a name.
    const bool comment = begins_comment(row) || (row.starts_with(';') && row.find(';', 1) == row.npos);
    if (row.empty() || comment || row.starts_with("sep=")) continue;
    if (headings)
      if (const auto header = header_of(row, separator, above)) {
        if (collect.failed()) return std::nullopt;  // by a heading before it
        return of(header->separator != ',' ? ListFormat::spreadsheet
                  : sections.empty()       ? ListFormat::csv
                                           : ListFormat::sections,
                  read_columns(whole, line, *header, file, unit, sections, diagnostics));
      }
    const Line read = read_line(row);
    if (read.numbers > 0) headings = false;
    above = row;
    if (read.point) {
      const Vec3 at = metres_of(read, unit);
      if (std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z))
        collect.add(line, read.name, at,
                    places_of(read, static_cast<std::size_t>(row.data() - whole.data()), unit),
                    read.number_in_name);
      else
        collect.problem(line, plain_name(read.name), "a coordinate is not finite");
    } else if (read.numbers > 0) {
      collect.unread(line, row, read);
    } else {
      read_heading(line, read.words, collect, unit);
    }
  }
  return of(ListFormat::text, collect.finish());
}

}  // namespace
}  // namespace linkwright::suspension::lists

namespace linkwright::suspension {

std::optional<HardPointList> read_hard_point_list(std::string_view text, const std::string& file,
                                                  PointUnit unit, Diagnostics& diagnostics) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::string plain = lists::plain_signs(text);
  auto out = lists::read_list(plain, file, find_unit(Dimension::length, name_of(unit)), diagnostics);
  if (out) out->text = std::move(plain);
  return out;
}

std::optional<std::vector<HardPoint>> read_hard_points(std::string_view text, const std::string& file,
                                                       PointUnit unit, Diagnostics& diagnostics) {
  const auto list = read_hard_point_list(text, file, unit, diagnostics);
  if (!list) return std::nullopt;
  std::vector<HardPoint> out;
  for (const ListedPoint& p : list->points) out.push_back(p.point);
  return out;
}

}  // namespace linkwright::suspension
