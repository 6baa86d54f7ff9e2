// SPDX-License-Identifier: BSD-3-Clause

// Builds a table from the bytes - one number of columns, then keys, states and numbers - and reads its CSV
// back.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/table.h"
#include "require.h"

namespace {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool empty() const { return size_ == 0; }
  std::uint8_t byte() {
    if (size_ == 0) return 0;
    --size_;
    return *data_++;
  }
  std::string text() {
    std::string result(byte() % 8, ' ');
    for (char& c : result) c = static_cast<char>(byte());
    return result;
  }
  double number() {
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

// A reader of RFC 4180 of its own, as strict as the standard: cells by row.
std::vector<std::vector<std::string>> read_csv(std::string_view text) {
  std::vector<std::vector<std::string>> rows;
  std::size_t i = 0;
  while (i < text.size()) {
    rows.emplace_back();
    while (true) {
      std::string cell;
      if (i < text.size() && text[i] == '"') {
        for (++i;; ++i) {
          FUZZ_REQUIRE(i < text.size());
          if (text[i] != '"') {
            cell += text[i];
          } else if (i + 1 < text.size() && text[i + 1] == '"') {
            cell += text[i++];
          } else {
            ++i;
            break;
          }
        }
      } else {
        while (i < text.size() && text[i] != ',' && text[i] != '\r') {
          FUZZ_REQUIRE(text[i] != '"' && text[i] != '\n');
          cell += text[i++];
        }
      }
      rows.back().push_back(cell);
      FUZZ_REQUIRE(i < text.size());
      if (text[i] == ',') {
        ++i;
        continue;
      }
      FUZZ_REQUIRE(text.substr(i, 2) == "\r\n");
      i += 2;
      break;
    }
  }
  return rows;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  linkwright::Table table;
  const std::size_t columns = 1 + bytes.byte() % 4;
  for (std::size_t i = 0; i < columns; ++i) table.add(bytes.text(), "");
  while (!bytes.empty() && table.rows() < 100) {
    table.status.push_back(bytes.text());
    for (linkwright::Column& column : table.columns) column.values.push_back(bytes.number());
  }

  const auto cells = read_csv(to_csv(table));
  FUZZ_REQUIRE(cells.size() == table.rows() + 1);
  for (std::size_t i = 0; i < columns; ++i) FUZZ_REQUIRE(cells[0][i] == table.columns[i].key);
  FUZZ_REQUIRE(cells[0].back() == "status");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    FUZZ_REQUIRE(cells[row + 1].size() == columns + 1);
    FUZZ_REQUIRE(cells[row + 1].back() == table.status[row]);
    for (std::size_t i = 0; i < columns; ++i) {
      const double value = table.columns[i].values[row];
      const std::string& cell = cells[row + 1][i];
      if (std::isfinite(value)) {
        FUZZ_REQUIRE(std::strtod(cell.c_str(), nullptr) == value);
      } else {
        FUZZ_REQUIRE(cell.empty());
      }
    }
  }
  return 0;
}
