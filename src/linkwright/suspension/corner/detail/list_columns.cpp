// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/detail/list_columns.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "linkwright/core/csv.h"

namespace linkwright::suspension::lists {
namespace {

/// The side that a word of a heading names.
ListSide side_of(std::string_view word) {
  if (word == "left" || word == "lh" || word == "l") return ListSide::left;
  return word == "right" || word == "rh" || word == "r" ? ListSide::right : ListSide::none;
}

}  // namespace

Axis axis_of(std::string_view heading) {
  Axis out;
  std::string rest;
  const std::string plain = plain_name(heading);
  for (std::string_view words = plain; !words.empty();) {
    const std::string_view word = words.substr(0, words.find('_'));
    words.remove_prefix(std::min(word.size() + 1, words.size()));
    const ListSide side = side_of(word);
    if (side != ListSide::none && out.side != ListSide::none) return {};
    if (side != ListSide::none)
      out.side = side;
    else
      (rest += rest.empty() ? "" : "_") += word;
  }
  if (rest.size() > 2 && rest[1] == '_') out.unit = unit_of(std::string_view(rest).substr(2));
  if (out.unit) rest.resize(1);
  const auto at = std::string_view("xyz").find(rest);
  if (rest.size() != 1 || at == std::string_view::npos) return {};
  out.axis = static_cast<int>(at);
  return out;
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> out;
  bool open = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') open = !open;
    if (i < line.size() && (open || line[i] != separator)) continue;
    out.push_back(without_blanks(line.substr(begin, i - begin)));
    begin = i + 1;
  }
  return out;
}

namespace {

/// The line without a comment behind its last number.
std::string_view without_comment(std::string_view line, char separator) {
  std::size_t cell = 0;
  bool open = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') open = !open;
    if (open) continue;
    if (line[i] == separator) cell = i + 1;
    if (begins_comment(line.substr(i)) &&
        word_of(std::string(without_blanks(line.substr(cell, i - cell))), separator != ',').number)
      return line.substr(0, i);
  }
  return line;
}

/// Puts the side and the unit of headings that span several columns into the groups below them. False if the
/// groups of coordinates are not those of the left and of the right side.
bool take_headings_above(std::vector<ColumnGroup>& groups, std::string_view above, char separator) {
  const std::size_t open = above.find_first_of("[("),
                    close = above.find_first_of("])", std::min(open, above.size()));
  const Unit* unit =
      close != std::string_view::npos ? unit_of(plain_name(above.substr(open, close - open))) : nullptr;
  const std::vector<std::string_view> cells = cells_of(above, separator);
  for (ColumnGroup& group : groups) {
    for (const Unit*& own : group.units)
      if (!own) own = unit;
    const std::size_t first = std::min({*group.at[0], *group.at[1], *group.at[2]});
    for (std::size_t i = std::min(first + 1, cells.size()); i-- > 0 && group.side == ListSide::none;)
      if (!cells[i].empty()) {
        // "Left", "Left side [mm]"
        const std::string plain = plain_name(cells[i]);
        group.side = side_of(plain.substr(0, plain.find('_')));
        break;
      }
  }
  if (groups.size() == 1) {
    groups[0].side = ListSide::none;  // the title of the whole list
    return true;
  }
  return groups.size() == 2 && groups[0].side != ListSide::none && groups[1].side != ListSide::none &&
         groups[0].side != groups[1].side;
}

}  // namespace

std::optional<Header> header_of(std::string_view line, char separator, std::string_view above) {
  if (separator == 0) {
    for (const char c : {';', '\t', ','})
      if (separator == 0 && line.find(c) != std::string_view::npos) separator = c;
    if (separator == 0) return std::nullopt;
  }
  Header out{.separator = separator, .name = {}, .groups = {ColumnGroup()}};
  std::vector<std::string_view> cells = cells_of(line, separator);
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
  out.columns = cells.size();
  std::optional<std::size_t> text;
  std::size_t axes = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Axis axis = axis_of(cells[i]);
    const std::string plain = plain_name(cells[i]);
    if (axis.axis >= 0) {
      const auto k = static_cast<std::size_t>(axis.axis);
      if (out.groups.back().at[k]) {
        if (axes % 3 != 0) return std::nullopt;
        out.groups.emplace_back();
      }
      ColumnGroup& group = out.groups.back();
      if (axis.side != ListSide::none) group.side = axis.side;
      group.at[k] = i;
      group.units[k] = axis.unit;
      ++axes;
    } else if (!out.name && (plain == "name" || plain == "point" || plain == "hard_point" ||
                             plain == "hardpoint" || plain == "label" || plain == "joint")) {
      out.name = i;
    } else if (!text) {
      text = i;
    }
  }
  if (axes == 0 || (axes < 3 && !out.name) || (axes > 3 && axes % 3 != 0)) return std::nullopt;
  if (!out.name) out.name = text;
  // Headings over several rows: the name stands above, and so do the unit and the side of coordinates.
  if (!out.name && !above.empty())
    for (std::size_t i = 0; i < cells.size() && !out.name; ++i)
      if (cells[i].empty()) out.name = i;
  if (axes >= 3 && !take_headings_above(out.groups, above, separator)) return std::nullopt;
  return out;
}

namespace {

/// True for a row between the points of sections that has no point: a title, sides, or headings.
bool is_title(std::span<const std::string_view> cells) {
  std::ptrdiff_t filled = 0, sides = 0, axes = 0;
  for (const std::string_view cell : cells) {
    filled += cell.empty() ? 0 : 1;
    sides += side_of(plain_name(cell)) != ListSide::none ? 1 : 0;
    axes += axis_of(cell).axis >= 0 ? 1 : 0;
  }
  return filled == 1 || filled == sides || axes >= 3;
}

/// The points of one group of columns.
class GroupReader {
 public:
  GroupReader(std::string_view text, int header_line, const Header& header, const ColumnGroup& group,
              const std::vector<ListSection>& sections, ListCollector& collect)
      : text_(text),
        header_line_(header_line),
        header_(header),
        group_(group),
        units_(group.units),
        sections_(sections),
        collect_(collect) {}

  void read(const std::string& file, const Unit* given, Diagnostics& diagnostics) {
    int line = 1;
    for (std::string_view rest = text_; !rest.empty(); ++line) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      if (line > header_line_) take(line, rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    const auto unit = [&](std::size_t i) { return units_[i] ? units_[i] : given; };
    std::string ordered(static_cast<std::size_t>(header_line_ - 1), '\n');
    ordered += "name";
    for (std::size_t i = 0; i < 3; ++i)
      ordered += fmt::format("{}{}_{}", header_.separator, "xyz"[i], unit(i) -> suffix);
    ordered += body_;
    std::vector<int> lines;
    Diagnostics problems;
    const std::optional<Table> table = read_csv(ordered, file, problems, &lines);
    for (Diagnostic& d : problems) {
      d.position.column = 1;  // the column in the reordered line means nothing to the user
      diagnostics.push_back(std::move(d));
    }
    if (!table) return collect_.fail();
    for (std::size_t row = 0; row < table->rows(); ++row) {
      std::array<double, 3> at{};
      std::array<ListNumber, 3>& place = places_[lines[row]];
      for (std::size_t i = 0; i < 3; ++i) {
        place[i].unit = unit(i);
        at[i] = place[i].unit->to_si(table->columns[i].values[row]);
      }
      const std::string name = table->names[row] + (group_.side == ListSide::right ? " right" : "");
      if (std::isfinite(at[0]) && std::isfinite(at[1]) && std::isfinite(at[2]))
        collect_.add(lines[row], name, {at[0], at[1], at[2]}, place);
      else
        collect_.problem(lines[row], plain_name(name), "a coordinate is missing");
    }
  }

 private:
  bool first_group() const { return &group_ == header_.groups.data(); }

  void take(int line, std::string_view plain) {
    const std::string_view row = without_comment(plain, header_.separator);
    body_ += '\n';
    if (begins_comment(without_blanks(row))) return;
    std::vector<std::string_view> cells = cells_of(row, header_.separator);
    while (!cells.empty() && cells.back().empty()) cells.pop_back();
    if (cells.empty() || (!sections_.empty() && is_title(cells))) return;
    std::size_t needed = *header_.name + 1;
    for (const ColumnGroup& group : header_.groups)
      needed = std::max({needed, *group.at[0] + 1, *group.at[1] + 1, *group.at[2] + 1});
    if (cells.size() > header_.columns || (cells.size() < needed && cells.size() < 3)) {
      const bool decimals = header_.separator == ',' && cells.size() == 2 * header_.columns;
      if (first_group())
        collect_.problem(line, plain_name(*header_.name < cells.size() ? cells[*header_.name] : ""),
                         fmt::format("{} is not read: {} values, the header has {} columns", quoted(plain),
                                     cells.size(), header_.columns),
                         decimals ? "with decimal commas separate the columns by semicolons"
                                  : "put remarks behind #, or give their column a heading");
      return;
    }
    cells.resize(std::max(cells.size(), needed));
    const auto cell_at = [&](std::size_t i) { return cells[*group_.at[i]]; };
    // A point of one side alone.
    if (header_.groups.size() > 1 && cell_at(0).empty() && cell_at(1).empty() && cell_at(2).empty()) return;
    if (first_ && take_units(line, {cell_at(0), cell_at(1), cell_at(2)})) return;
    first_ = false;
    body_ += cells[*header_.name];
    for (std::size_t i = 0; i < 3; ++i) {
      std::string_view cell = cell_at(i);
      (body_ += header_.separator) += cell;
      if (cell.size() > 1 && cell.front() == '"') cell = cell.substr(1, cell.size() - 2);
      if (cell.empty()) continue;
      places_[line][i] = {static_cast<std::size_t>(cell.data() - text_.data()), cell.size(), nullptr,
                          cell.find(',') != std::string_view::npos};
    }
  }

  /// A row of units below the headings.
  bool take_units(int line, const std::array<std::string_view, 3>& cells) {
    std::array<const Unit*, 3> units{};
    for (std::size_t i = 0; i < 3; ++i) units[i] = unit_of(plain_name(cells[i]));
    if (!units[0] || !units[1] || !units[2]) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      if (units_[i] && units_[i] != units[i])
        collect_.problem(
            line, std::string(1, "xyz"[i]),
            fmt::format("is in {} here and in {} in the header", units[i]->suffix, units_[i]->suffix));
      units_[i] = units[i];
    }
    return true;
  }

  std::string_view text_;
  int header_line_;
  const Header& header_;
  const ColumnGroup& group_;
  std::array<const Unit*, 3> units_;
  const std::vector<ListSection>& sections_;
  ListCollector& collect_;
  std::string body_;
  std::map<int, std::array<ListNumber, 3>> places_;
  bool first_ = true;
};

}  // namespace

std::optional<std::vector<ListedPoint>> read_columns(std::string_view text, int header_line,
                                                     const Header& header, const std::string& file,
                                                     const Unit* given,
                                                     const std::vector<ListSection>& sections,
                                                     Diagnostics& diagnostics) {
  ListCollector collect(file, diagnostics, sections);
  for (std::size_t i = 0; i < 3; ++i)
    if (const std::string axis(1, "xyz"[i]); !header.groups[0].at[i])
      collect.problem(header_line, axis, "this column is missing", fmt::format("write {}_mm", axis));
  if (!header.name)
    collect.problem(header_line, "name", "this column is missing", "write name,x_mm,y_mm,z_mm");
  if (collect.failed()) return std::nullopt;
  for (const ColumnGroup& group : header.groups)
    GroupReader(text, header_line, header, group, sections, collect).read(file, given, diagnostics);
  return collect.finish();
}

}  // namespace linkwright::suspension::lists
