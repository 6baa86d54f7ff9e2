// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/table.h"

namespace linkwright {

/// Text of an editor or a spreadsheet as UTF-8: byte order marks are taken off, UTF-16 (by its mark or by its
/// zero bytes) and, where the bytes are no UTF-8, Windows-1252 are converted. Nothing, with the reason in
/// `problem`, for what is no text: an Excel workbook, a broken UTF-16.
std::optional<std::string> to_utf8(std::string_view bytes, std::string& problem);

/// True if these are the bytes of an Excel workbook (.xlsx or .xls) or of another packed file.
bool is_workbook(std::string_view bytes);

/// Reads a table of numbers from CSV text, RFC 4180 and as spreadsheets write it:
/// - a header line of column keys with units, `x_mm` or `X [mm]`; a last column `status` goes to
///   Table::status, a first column `name` to Table::names;
/// - columns separated by commas, semicolons or tabs (recognised by the header line, or by a line `sep=;`);
/// - a decimal point, or a decimal comma where commas do not separate (or within quotes);
/// - empty cells are NaN; lines of nothing but separators, lines that begin with `#` and empty columns at the
///   end are passed over; any encoding that `to_utf8` knows.
/// All problems are appended with line and column under the name `file`; nothing is returned if there is an
/// error. `lines`, if given, receives the line of each row.
std::optional<Table> read_csv(std::string_view text, const std::string& file, Diagnostics& diagnostics,
                              std::vector<int>* lines = nullptr);

}  // namespace linkwright
