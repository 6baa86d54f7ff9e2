#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/core/table.h"

namespace linkwright::study {

/// Reads a table of numbers as RFC 4180: the first line holds the column keys ("x_m, y_m"), spaces around
/// cells do not count, empty cells are NaN, empty lines and lines that begin with "#" are skipped. A column
/// `status` is taken as texts. Problems, all of them up to 50, are appended to `diagnostics` with line and
/// column; then nothing is returned.
std::optional<Table> read_csv_text(std::string_view text, const std::string& file, Diagnostics& diagnostics);
std::optional<Table> read_csv(const std::filesystem::path& file, Diagnostics& diagnostics);

/// The numbers of a column in SI units: `base` is its key without unit, found with any unit of the dimension
/// (with Dimension::none the key itself). Missing columns and missing values are diagnostics; then nothing is
/// returned.
std::optional<std::vector<double>> si_column(const Table& table, std::string_view base, Dimension dimension,
                                             const std::string& file, Diagnostics& diagnostics);

}  // namespace linkwright::study
