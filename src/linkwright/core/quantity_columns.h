// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/core/table.h"

namespace linkwright {

/// The values of a quantity in a table, in SI: of the column `base` with any unit of `dimension` (`x_mm`), or
/// of the bare key for Dimension::none. NaN = missing. Nothing if there is no such column.
std::optional<std::vector<double>> quantity(const Table& table, std::string_view base, Dimension dimension);

/// A quantity that a table may have as a column.
struct QuantityColumn {
  std::string_view base;
  Dimension dimension;
  std::string_view former = {};  ///< another word for it that files may use
};

/// Quantities of a table, in the order of those asked for.
struct Quantities {
  std::vector<std::string> keys;            ///< keys of the column in the table; empty = it has none
  std::vector<std::vector<double>> values;  ///< in SI, NaN = missing; empty where there is no column
};

/// Reads all columns of a table as quantities. Columns that are unknown (`columns` says which there are),
/// lack their unit or come twice are reported under the name `file`.
Quantities read_quantities(const Table& table, std::span<const QuantityColumn> known,
                           std::string_view columns, const std::string& file, Diagnostics& diagnostics);

/// Reports a column that is missing.
void report_missing(const QuantityColumn& column, const std::string& file, Diagnostics& diagnostics);

}  // namespace linkwright
