// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/quantity_columns.h"

#include <fmt/core.h>

#include <utility>

#include "linkwright/core/units.h"

namespace linkwright {
namespace {

void report(const std::string& file, std::string key, std::string message, std::string hint,
            Diagnostics& diagnostics) {
  diagnostics.push_back(
      {.file = file, .key = std::move(key), .message = std::move(message), .hint = std::move(hint)});
}

std::vector<double> in_si(const std::vector<double>& values, const Unit& unit) {
  std::vector<double> out;
  out.reserve(values.size());
  for (const double v : values) out.push_back(unit.to_si(v));
  return out;
}

}  // namespace

std::optional<std::vector<double>> quantity(const Table& table, std::string_view base, Dimension dimension) {
  for (const Column& column : table.columns) {
    if (dimension == Dimension::none) {
      if (column.key == base) return column.values;
      continue;
    }
    const auto key = split_unit(column.key);
    if (key && key->base == base && key->dimension == dimension) return in_si(column.values, *key->unit);
  }
  return std::nullopt;
}

Quantities read_quantities(const Table& table, std::span<const QuantityColumn> known,
                           std::string_view columns, const std::string& file, Diagnostics& diagnostics) {
  Quantities out{std::vector<std::string>(known.size()), std::vector<std::vector<double>>(known.size())};
  for (const Column& column : table.columns) {
    const auto key = split_unit(column.key);
    std::size_t k = 0;
    const auto is = [&](std::string_view word) {
      return !word.empty() && (column.key == word || (key && key->base == word));
    };
    while (k < known.size() && !is(known[k].base) && !is(known[k].former)) ++k;
    if (k == known.size()) {
      report(file, column.key, "unknown column", fmt::format("columns are {}, each with its unit", columns),
             diagnostics);
      continue;
    }
    const QuantityColumn& wanted = known[k];
    if (!out.keys[k].empty()) {
      report(file, column.key, fmt::format("{} is given twice", wanted.base), {}, diagnostics);
      continue;
    }
    out.keys[k] = column.key;
    const Unit* unit = key ? find_unit(wanted.dimension, key->unit->suffix) : nullptr;
    if (unit)
      out.values[k] = in_si(column.values, *unit);
    else
      report(file, column.key, fmt::format("needs the unit of {}", describe(wanted.dimension)),
             fmt::format("write {}", si_key(wanted.base, wanted.dimension)), diagnostics);
  }
  return out;
}

void report_missing(const QuantityColumn& column, const std::string& file, Diagnostics& diagnostics) {
  report(file, std::string(column.base), "column is missing",
         fmt::format("add {}", si_key(column.base, column.dimension)), diagnostics);
}

}  // namespace linkwright
