#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/table.h"

namespace linkwright {

/// Reads a table of numbers from CSV text (RFC 4180, header line of column keys; a last column `status` goes
/// to Table::status, a first column `name` to Table::names; empty cells are NaN; a byte order mark and blank lines at the end are passed over). All
/// problems are appended with line and column under the name `file`; nothing is returned if there is an
/// error.
std::optional<Table> read_csv(std::string_view text, const std::string& file, Diagnostics& diagnostics);

}  // namespace linkwright
