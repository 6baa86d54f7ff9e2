// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/detail/list_columns.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "linkwright/core/csv.h"

namespace linkwright::suspension::lists {
Axis axis_of(std::string_view heading) {
  const std::string plain = plain_name(heading);
  const Unit* unit = nullptr;
  std::string base = plain;
  if (plain.size() > 2 && plain[1] == '_') unit = unit_of(plain.substr(2));
  if (unit) base = plain.substr(0, 1);
  const auto at = std::string_view("xyz").find(base);
  return base.size() == 1 && at != std::string_view::npos ? Axis{static_cast<int>(at), unit} : Axis{};
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

}  // namespace

std::optional<Header> header_of(std::string_view line, char separator, std::string_view above) {
  if (separator == 0) {
    for (const char c : {';', '\t', ','})
      if (separator == 0 && line.find(c) != std::string_view::npos) separator = c;
    if (separator == 0) return std::nullopt;
  }
  Header out{.separator = separator, .name = {}, .at = {}};
  std::vector<std::string_view> cells = cells_of(line, separator);
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
  out.columns = cells.size();
  std::optional<std::size_t> text;
  int axes = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Axis axis = axis_of(cells[i]);
    const std::string plain = plain_name(cells[i]);
    if (axis.axis >= 0) {
      const auto k = static_cast<std::size_t>(axis.axis);
      if (out.at[k]) return std::nullopt;
      out.at[k] = i;
      out.units[k] = axis.unit;
      ++axes;
    } else if (!out.name && (plain == "name" || plain == "point" || plain == "hard_point" ||
                             plain == "hardpoint" || plain == "label" || plain == "joint")) {
      out.name = i;
    } else if (!text) {
      text = i;
    }
  }
  if (axes == 0 || (axes < 3 && !out.name)) return std::nullopt;
  if (!out.name) out.name = text;
  if (above.empty()) return out;
  // Headings over several rows: the name stands above, and so does the unit of all coordinates.
  if (!out.name)
    for (std::size_t i = 0; i < cells.size() && !out.name; ++i)
      if (cells[i].empty()) out.name = i;
  const std::size_t open = above.find_first_of("[("),
                    close = above.find_first_of("])", std::min(open, above.size()));
  if (close != std::string_view::npos)
    if (const Unit* unit = unit_of(plain_name(above.substr(open, close - open))))
      for (const Unit*& own : out.units)
        if (!own) own = unit;
  return out;
}

std::optional<std::vector<ListedPoint>> read_columns(std::string_view text, int header_line, Header header,
                                                     const std::string& file, const Unit* given,
                                                     const std::vector<ListSection>& sections,
                                                     Diagnostics& diagnostics) {
  ListCollector collect(file, diagnostics, sections);
  for (std::size_t i = 0; i < 3; ++i)
    if (const std::string axis(1, "xyz"[i]); !header.at[i])
      collect.problem(header_line, axis, "this column is missing", fmt::format("write {}_mm", axis));
  if (!header.name)
    collect.problem(header_line, "name", "this column is missing", "write name,x_mm,y_mm,z_mm");
  if (collect.failed()) return std::nullopt;
  std::string body;
  std::map<int, std::array<ListNumber, 3>> places;
  const char* const whole = text.data();
  bool first = true;
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view plain = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line <= header_line) continue;
    const std::string_view row = without_comment(plain, header.separator);
    body += '\n';
    if (begins_comment(without_blanks(row))) continue;
    std::vector<std::string_view> cells = cells_of(row, header.separator);
    while (!cells.empty() && cells.back().empty()) cells.pop_back();
    if (cells.empty()) continue;
    // Titles and repeated headings between the points of sections.
    if (!sections.empty() && (std::count(cells.begin(), cells.end(), std::string_view()) + 1 ==
                                  static_cast<std::ptrdiff_t>(cells.size()) ||
                              header_of(row, header.separator)))
      continue;
    const bool decimals = header.separator == ',' && cells.size() == 2 * header.columns;
    const std::size_t needed = std::max({*header.name, *header.at[0], *header.at[1], *header.at[2]}) + 1;
    if (cells.size() > header.columns || (cells.size() < needed && cells.size() < 3)) {
      collect.problem(line, plain_name(*header.name < cells.size() ? cells[*header.name] : ""),
                      fmt::format("{} is not read: {} values, the header has {} columns", quoted(plain),
                                  cells.size(), header.columns),
                      decimals ? "with decimal commas separate the columns by semicolons"
                               : "put remarks behind #, or give their column a heading");
      continue;
    }
    cells.resize(std::max(cells.size(), needed));
    // A row of units below the headings.
    std::array<const Unit*, 3> units{};
    for (std::size_t i = 0; i < 3; ++i) units[i] = unit_of(plain_name(cells[*header.at[i]]));
    if (first && units[0] && units[1] && units[2]) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (header.units[i] && header.units[i] != units[i])
          collect.problem(line, std::string(1, "xyz"[i]),
                          fmt::format("is in {} here and in {} in the header", units[i]->suffix,
                                      header.units[i]->suffix));
        header.units[i] = units[i];
      }
      continue;
    }
    first = false;
    body += cells[*header.name];
    for (std::size_t i = 0; i < 3; ++i) {
      std::string_view cell = cells[*header.at[i]];
      (body += header.separator) += cell;
      if (cell.size() > 1 && cell.front() == '"') cell = cell.substr(1, cell.size() - 2);
      if (cell.empty()) continue;
      places[line][i] = {static_cast<std::size_t>(cell.data() - whole), cell.size(), nullptr,
                         cell.find(',') != std::string_view::npos};
    }
  }
  std::string ordered(static_cast<std::size_t>(header_line - 1), '\n');
  ordered += "name";
  for (std::size_t i = 0; i < 3; ++i)
    ordered += fmt::format("{}{}_{}", header.separator, "xyz"[i],
                           (header.units[i] ? header.units[i] : given) -> suffix);
  ordered += body;
  std::vector<int> lines;
  Diagnostics problems;
  const std::optional<Table> table = read_csv(ordered, file, problems, &lines);
  for (Diagnostic& d : problems) {
    d.position.column = 1;  // the column in the reordered line means nothing to the user
    diagnostics.push_back(std::move(d));
  }
  if (!table) return std::nullopt;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    std::array<double, 3> at{};
    std::array<ListNumber, 3>& place = places[lines[row]];
    for (std::size_t i = 0; i < 3; ++i) {
      place[i].unit = header.units[i] ? header.units[i] : given;
      at[i] = place[i].unit->to_si(table->columns[i].values[row]);
    }
    if (std::isfinite(at[0]) && std::isfinite(at[1]) && std::isfinite(at[2]))
      collect.add(lines[row], table->names[row], {at[0], at[1], at[2]}, place);
    else
      collect.problem(lines[row], plain_name(table->names[row]), "a coordinate is missing");
  }
  return collect.finish();
}

}  // namespace linkwright::suspension::lists
