// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/groups.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "linkwright/report/units.h"

namespace linkwright::report {

std::string label_of(const Column& column) { return column.label.empty() ? column.key : column.label; }

std::string unit_of(const Column& column) {
  const std::size_t at = column.label.rfind(" (");
  return at != std::string::npos && column.label.back() == ')' ? column.label.substr(at + 1) : "";
}

std::vector<Group> groups_of(const study::Plot& plot, const Table& table) {
  const Column* column = plot.group.empty() ? nullptr : table.find(plot.group);
  if (!column) {
    std::vector<std::size_t> rows(table.rows());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    return {{"", std::move(rows)}};
  }
  std::vector<double> values;
  for (const double v : column->values)
    if (std::isfinite(v)) values.push_back(v);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  DisplayUnit unit = display_unit(
      column->key, values.empty() ? 0 : std::max(std::abs(values.front()), std::abs(values.back())));
  const std::string own = unit_of(*column);
  if (unit.symbol.empty() && !own.empty()) unit.symbol = own.substr(1, own.size() - 2);
  std::string name = label_with(*column, unit);
  if (!unit.symbol.empty()) name.resize(name.size() - unit.symbol.size() - 3);
  std::vector<Group> out;
  for (const double value : values) {
    const bool named =
        value >= 1 && value <= static_cast<double>(plot.group_names.size()) && value == std::floor(value);
    Group group{
        named ? plot.group_names[static_cast<std::size_t>(value) - 1] : name + " " + quantity(value, unit),
        {}};
    for (std::size_t i = 0; i < column->values.size(); ++i)
      if (column->values[i] == value) group.rows.push_back(i);
    out.push_back(std::move(group));
  }
  return out;
}

}  // namespace linkwright::report
