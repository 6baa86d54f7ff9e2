// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/quantity.h"

namespace linkwright {

/// One column of numbers. The key carries the unit: "crank_angle_rad". NaN = missing.
struct Column {
  std::string key;
  std::string label;  ///< for people, with unit: "crank angle (rad)"
  std::vector<double> values;
};

/// Columns of equal length and a status per row ("done" or why the row is incomplete).
/// Written as CSV with the column keys as header, `name` as first column if rows have names, and `status` as
/// last column.
struct Table {
  std::string name;
  std::vector<std::string> names = {};  ///< names of the rows; empty = they have none
  std::vector<Column> columns = {};
  std::vector<std::string> status = {};  ///< one per row; empty = every row is done

  std::size_t rows() const { return columns.empty() ? names.size() : columns.front().values.size(); }
  const Column* find(std::string_view key) const;
  /// Adds a column and returns it; its length must match the columns that are there already when it is
  /// written.
  Column& add(std::string key, std::string label, std::vector<double> values = {});
  Column& add(const Quantity& what, std::vector<double> values = {}) {
    return add(what.column_key(), what.label(), std::move(values));
  }
};

/// Throws ContractError when columns, names or status differ in length.
void require_whole(const Table& table);

/// RFC 4180 text of a table; shortest digits that read back to the same number; missing values are empty.
/// Throws ContractError when the columns differ in length.
std::string to_csv(const Table& table);

}  // namespace linkwright
