// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/field.h"

namespace linkwright {

/// A physical quantity in a column of a table. The unit of its dimension is part of key and label.
struct Quantity {
  std::string key;                        ///< without unit: "crank_speed"
  std::string words;                      ///< for people: "crank speed"
  Dimension dimension = Dimension::none;  ///< none = a number without unit

  /// @returns the key with the SI unit: "crank_speed_rad_per_s"
  std::string column_key() const;
  /// @returns the words with the SI unit: "crank speed (rad/s)"
  std::string label() const;
};

/// One column of numbers. The key carries the unit: "crank_angle_rad". NaN = missing.
struct Column {
  std::string key;             ///< unique in a table: "crank_angle_rad"
  std::string label;           ///< for people, with unit: "crank angle (rad)"
  std::vector<double> values;  ///< one for each row; NaN = missing
};

/// Columns of equal length and a status per row ("done" or why the row is incomplete).
/// Written as CSV with the column keys as header, `name` as first column if rows have names, and `status` as
/// last column.
struct Table {
  std::string name;                      ///< name of the table and of its CSV file: "sweep"
  std::vector<std::string> names = {};   ///< names of the rows; empty = they have none
  std::vector<Column> columns = {};      ///< columns in the order in which they are written
  std::vector<std::string> status = {};  ///< one per row; empty = every row is done

  /// @returns number of rows
  std::size_t rows() const { return columns.empty() ? names.size() : columns.front().values.size(); }
  /// @param key key of a column, with its unit
  /// @returns the column; nullptr if there is none
  const Column* find(std::string_view key) const;
  /// Adds a column; its length must match the columns that are there already when the table is written.
  /// @param key key with the unit: "crank_angle_rad"
  /// @param label words for people, with the unit: "crank angle (rad)"
  /// @param values one for each row, in the unit of the key; NaN = missing
  /// @returns the column, valid until the next one is added
  Column& add(std::string key, std::string label, std::vector<double> values = {});
  /// Adds a column in the SI unit of a quantity.
  /// @param what quantity that gives key and label
  /// @param values one for each row (SI); NaN = missing
  /// @returns the column, valid until the next one is added
  Column& add(const Quantity& what, std::vector<double> values = {}) {
    return add(what.column_key(), what.label(), std::move(values));
  }
};

/// Checks that a table is rectangular.
/// @param table the table
/// @throws ContractError if columns, names or status differ in length
void require_whole(const Table& table);

/// RFC 4180 text of a table: shortest digits that read back to the same number; values that are missing or
/// not finite are empty.
/// @param table the table
/// @returns the text: a line of keys, then a line for each row; lines end in CR LF
/// @throws ContractError if columns, names or status differ in length
std::string to_csv(const Table& table);

}  // namespace linkwright
