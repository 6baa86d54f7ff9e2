#include "linkwright/report/groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

#include "linkwright/report/markup.h"

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
  const std::string unit = unit_of(*column);
  std::string name = label_of(*column);
  if (!unit.empty()) name.resize(name.size() - unit.size() - 1);
  const std::string_view symbol = unit.empty() ? "" : std::string_view(unit).substr(1, unit.size() - 2);
  std::vector<Group> out;
  for (const double value : values) {
    Group group{fmt::format("{} {}{}{}", name, number(value), symbol.empty() ? "" : " ", symbol), {}};
    for (std::size_t i = 0; i < column->values.size(); ++i)
      if (column->values[i] == value) group.rows.push_back(i);
    out.push_back(std::move(group));
  }
  return out;
}

}  // namespace linkwright::report
