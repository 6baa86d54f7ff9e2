// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/table.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "linkwright/core/check.h"

namespace linkwright {
namespace {

// Quoted is also what a reader would take for a remark or for a blank line.
std::string csv_cell(std::string_view text) {
  if (!text.empty() && text.find_first_of(",\"\r\n#") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

const Column* Table::find(std::string_view key) const {
  for (const Column& column : columns)
    if (column.key == key) return &column;
  return nullptr;
}

Column& Table::add(std::string key, std::string label, std::vector<double> values) {
  columns.push_back({std::move(key), std::move(label), std::move(values)});
  return columns.back();
}

void require_whole(const Table& table) {
  const std::size_t rows = table.rows();
  for (const Column& column : table.columns)
    LINKWRIGHT_REQUIRE(column.values.size() == rows, "column '{}' has {} rows, expected {}", column.key,
                       column.values.size(), rows);
  LINKWRIGHT_REQUIRE(table.status.empty() || table.status.size() == rows, "{} status entries for {} rows",
                     table.status.size(), rows);
  LINKWRIGHT_REQUIRE(table.names.empty() || table.names.size() == rows, "{} names for {} rows",
                     table.names.size(), rows);
}

std::string to_csv(const Table& table) {
  require_whole(table);
  const std::size_t rows = table.rows();
  fmt::memory_buffer text;
  text.reserve(rows * table.columns.size() * 20);
  const auto put = [&](std::string_view part) { text.append(part.data(), part.data() + part.size()); };
  if (!table.names.empty()) put("name,");
  for (const Column& column : table.columns) put(csv_cell(column.key) + ',');
  put("status\r\n");
  for (std::size_t row = 0; row < rows; ++row) {
    if (!table.names.empty()) put(csv_cell(table.names[row]) + ',');
    for (const Column& column : table.columns) {
      if (const double value = column.values[row]; std::isfinite(value))
        fmt::format_to(fmt::appender(text), "{}", value);
      text.push_back(',');
    }
    put(table.status.empty() ? "done" : csv_cell(table.status[row]));
    put("\r\n");
  }
  return fmt::to_string(text);
}

}  // namespace linkwright
