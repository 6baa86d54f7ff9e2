// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/closing_row.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"

namespace linkwright {
namespace {

// Rounding of a period that is computed in two ways, loads with cancellation included.
constexpr double repeats = 1e-9;

}  // namespace

bool has_closing_row(const Table& table) {
  const std::size_t rows = table.rows();
  if (rows < 3 || table.columns.size() < 2) return false;
  if (std::any_of(table.status.begin(), table.status.end(), [](const auto& s) { return s != "done"; }))
    return false;
  const Column& over = table.columns.front();
  const double span = std::abs(over.values.back() - over.values.front());
  if (over.key.ends_with("_rad")) {
    const double turns = span / (2 * pi);
    if (!(turns > 0.5) || std::abs(turns - std::round(turns)) > repeats * turns) return false;
  } else if (!over.key.ends_with("_s") || !(span > 0)) {
    return false;
  }
  // Residuals and what cancels are rounding of the other columns of their unit.
  std::map<std::string_view, double> largest;
  const auto unit_of = [](const Column& c) {
    const auto unit = split_unit(c.key);
    return unit ? std::string_view(unit->unit->suffix) : std::string_view();
  };
  for (const Column& c : table.columns)
    for (const double v : c.values) largest[unit_of(c)] = std::max(largest[unit_of(c)], std::abs(v));
  return std::all_of(table.columns.begin() + 1, table.columns.end(), [&](const Column& c) {
    if (c.values.size() != rows ||
        std::any_of(c.values.begin(), c.values.end(), [](double v) { return std::isnan(v); }))
      return false;
    const double apart = c.values.back() - c.values.front();
    if (c.key.ends_with("_rad")) return std::abs(std::remainder(apart, 2 * pi)) <= repeats;
    return std::abs(apart) <= repeats * largest[unit_of(c)];
  });
}

}  // namespace linkwright
