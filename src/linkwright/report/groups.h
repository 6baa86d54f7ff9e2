// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "linkwright/core/table.h"
#include "linkwright/study/result.h"

/// The common parts of the diagrams of a table: names of columns, and rows by the values of one.
namespace linkwright::report {

/// The label of a column, or its key when it has none.
std::string label_of(const Column& column);

/// "(N)" of a column labelled "O1 x (N)"; empty = none.
std::string unit_of(const Column& column);

/// Rows of one value of a diagram's group column.
struct Group {
  std::string label;  ///< "rack -30 mm", in the unit that is shown; empty = all rows
  std::vector<std::size_t> rows;
};

/// One group for each value of the group column, in rising order; rows without a value belong to none. One
/// group of all rows when the diagram has no group column or the table does not have it.
std::vector<Group> groups_of(const study::Plot& plot, const Table& table);

}  // namespace linkwright::report
