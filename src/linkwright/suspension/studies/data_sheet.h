// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "linkwright/core/field.h"
#include "linkwright/core/table.h"
#include "linkwright/study/result.h"

// The tables of a wheel suspension as a data sheet in plain text, in the units of chassis engineers: mm, deg,
// N, N/mm.
namespace linkwright::suspension {

/// `[data_sheet]`.
struct DataSheetForm {
  std::string title;
};
template <class Visitor>
void fields(Visitor&& visit, DataSheetForm& d) {
  visit(field::entry("title", "of the sheet; default: that of the study"), d.title);
}

/// A table in columns of numbers under their names and units, so many beside each other as fit on a line; the
/// first column is repeated in each part.
std::string columns_as_text(const Table& table);

/// Design values at the row `stated` of the table `sweep`, hard points, then columns over travel with the
/// rack at `rack` (m), over roll, steering and opposite travel, and the coefficients of compliance, as far as
/// the result has these tables.
std::string data_sheet(const study::Result& result, std::string_view title, double rack, std::size_t stated);

}  // namespace linkwright::suspension
