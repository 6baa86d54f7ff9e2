// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/data_sheet.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "linkwright/core/units.h"
#include "linkwright/study/kind.h"

namespace linkwright::suspension {
namespace {

constexpr std::size_t line_width = 110, least_width = 10;

/// Millimetres, degrees, newtons, and what follows from them.
study::DisplayUnits sheet_units() {
  study::DisplayUnits out;
  for (const char* key : {"x_mm", "x_deg", "x_N", "x_N_per_mm", "x_N_m", "x_N_s_per_m"})
    if (const auto unit = split_unit(key)) out.choose(*unit);
  out.follow();
  return out;
}

/// Six significant digits, as data sheets have them.
std::string number_text(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (size < 1e-9) return "0";
  if (size >= 1e6 || size < 1e-4) return fmt::format("{:.5e}", value);
  const int before = size >= 1 ? static_cast<int>(std::floor(std::log10(size))) + 1 : 1;
  return fmt::format("{:.{}f}", value, std::max(0, 6 - before));
}

/// A column as it is printed: name, unit, numbers.
struct Printed {
  std::string name, unit;
  std::vector<std::string> cells;
  std::size_t width() const {
    std::size_t out = std::max({least_width, name.size(), unit.size() + 2});
    for (const std::string& cell : cells) out = std::max(out, cell.size());
    return out;
  }
};

/// A key as name and unit; units that divide others stay together: toe_deg_per_kN.
std::pair<std::string, std::string> name_and_unit(std::string_view key) {
  const auto parts = split_unit(key);
  if (!parts) return {std::string(key), "-"};
  std::string unit = readable_unit(parts->unit->suffix);
  std::string_view base = parts->base;
  for (const std::string_view per : {"_per", "_per_100"}) {
    if (!base.ends_with(per)) continue;
    const std::string_view above = base.substr(0, base.size() - per.size());
    if (const auto over = split_unit(above))
      return {std::string(over->base),
              fmt::format("{}/{}{}", over->unit->suffix, per == "_per" ? "" : "100 ", unit)};
  }
  return {std::string(base), std::move(unit)};
}

std::vector<Printed> printed(const Table& table) {
  std::vector<Printed> out;
  for (const Column& c : table.columns) {
    auto [name, unit] = name_and_unit(c.key);
    Printed one{std::move(name), std::move(unit), {}};
    for (const double value : c.values) one.cells.push_back(number_text(value));
    out.push_back(std::move(one));
  }
  return out;
}

/// Rows of a table, or nothing of a missing one.
Table rows_of_table(const study::Result& result, const char* name) {
  const Table* table = result.table(name);
  return table ? study::in_units(*table, sheet_units()) : Table{};
}

/// The rows of the table sweep at one displacement of the rack, without it.
Table at_rack(const Table& sweep, double rack) {
  const Column* racks = sweep.find("rack_m");
  Table out{.name = sweep.name};
  for (const Column& c : sweep.columns) {
    if (c.key == "rack_m" || c.key == "closure_residual_m") continue;
    std::vector<double> values;
    for (std::size_t i = 0; i < c.values.size(); ++i)
      if (!racks || racks->values[i] == rack) values.push_back(c.values[i]);
    out.add(c.key, c.label, std::move(values));
  }
  return out;
}

std::string heading(std::string_view words) {
  return fmt::format("\n{}\n{}\n\n", words, std::string(words.size(), '-'));
}

std::string design_values(const Table& sweep, std::size_t row) {
  std::string out;
  for (const Column& c : sweep.columns) {
    if (row >= c.values.size() || !std::isfinite(c.values[row])) continue;
    const std::string unit = name_and_unit(c.key).second;
    out += fmt::format("  {:<88} {:>14} {}\n", unit == "-" ? c.label : c.label.substr(0, c.label.rfind(" (")),
                       number_text(c.values[row]), unit);
  }
  return out;
}

}  // namespace

std::string columns_as_text(const Table& table) {
  const std::vector<Printed> columns = printed(table);
  if (columns.empty()) return {};
  std::string out;
  const std::size_t names = table.names.empty() ? 0
                                                : std::max_element(
                                                      table.names.begin(), table.names.end(),
                                                      [](const auto& a, const auto& b) {
                                                        return a.size() < b.size();
                                                      })->size() +
                                                      2;
  const std::size_t lead = table.names.empty() ? 1 : 0;  // the first column is that of the rows
  for (std::size_t first = lead; first < columns.size() || (first == lead && lead == 1);) {
    std::vector<const Printed*> shown;
    std::size_t width = names;
    const auto take = [&](const Printed& one) {
      shown.push_back(&one);
      width += one.width() + 2;
    };
    if (lead == 1) take(columns[0]);
    std::size_t next = first;
    while (next < columns.size() && (next == first || width + columns[next].width() + 2 <= line_width))
      take(columns[next++]);
    const auto line = [&](std::string_view name, auto&& cell) {
      std::string text = names > 0 ? fmt::format("{:<{}}", name, names) : std::string();
      for (const Printed* one : shown) text += fmt::format("{:>{}}", cell(*one), one->width() + 2);
      out += text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
    };
    line("", [](const Printed& one) { return one.name; });
    line("", [](const Printed& one) { return "[" + one.unit + "]"; });
    for (std::size_t i = 0; i < table.rows(); ++i)
      line(names > 0 ? std::string_view(table.names[i]) : std::string_view(),
           [&](const Printed& one) { return one.cells[i]; });
    out += "\n";
    if (next == first) break;
    first = next;
  }
  return out;
}

std::string data_sheet(const study::Result& result, std::string_view title, double rack, std::size_t stated) {
  const study::DisplayUnits units = sheet_units();
  std::string out = fmt::format(
      "{}\n{}\n\nFrame: x forward, y to the left, z up. Toe-in, camber with the top outboard, caster with "
      "the top of "
      "the axis\nrearward, and bump count positive.\n",
      title, std::string(title.size(), '='));
  if (const Table* sweep = result.table("sweep")) {
    Table row = *sweep;
    std::erase_if(row.columns, [](const Column& c) { return c.key == "closure_residual_m"; });
    out += heading("Design values") + design_values(study::in_units(std::move(row), units), stated);
  }
  if (const Table points = rows_of_table(result, "hard_points"); points.rows() > 0)
    out += heading("Hard points") + columns_as_text(points);
  if (const Table* sweep = result.table("sweep"))
    out += heading(fmt::format("Over wheel travel, rack {}", units.text(rack, Dimension::length))) +
           columns_as_text(study::in_units(at_rack(*sweep, rack), units));
  for (const auto& [name, words] : std::array<std::pair<const char*, const char*>, 5>{
           {{"opposite", "Over opposite travel"},
            {"roll", "Over roll of the body"},
            {"single", "Over travel of the left wheel alone"},
            {"steer", "Over the rack: steering"},
            {"axle_compliance", "Compliance of the axle: 1 kN, 100 N m on each wheel"}}})
    if (const Table table = rows_of_table(result, name); table.rows() > 0)
      out += heading(words) + columns_as_text(table);
  if (const Table table = rows_of_table(result, "compliance"); table.rows() > 0) {
    out += heading("Compliance coefficients");
    for (std::size_t i = 0; i < table.rows(); ++i)
      out += fmt::format("  {:<72} {:>14}\n", table.names[i], number_text(table.columns[0].values[i]));
  }
  if (const Table table = rows_of_table(result, "compliance_over_travel"); table.rows() > 0)
    out += heading("Compliance over wheel travel") + columns_as_text(table);
  return out;
}

}  // namespace linkwright::suspension
