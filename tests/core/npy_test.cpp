// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/npy.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "linkwright/core/check.h"

namespace linkwright {
namespace {

std::string whole(const Table& table, std::size_t* pieces = nullptr) {
  NpyPieces file(table);
  std::string out;
  for (std::string_view piece = file.next(); !piece.empty(); piece = file.next()) {
    out += piece;
    if (pieces) ++*pieces;
  }
  EXPECT_TRUE(file.next().empty());
  return out;
}

// The bytes by the definition of the format; tests/python/tables_test.py reads such files with NumPy itself.
TEST(Npy, HasAHeaderAndARecordForEachRow) {
  Table table{.name = "t"};
  table.add("x_m", "x (m)", {1.5, -2.0});
  table.add("it's\\_N", "force (N)", {std::numeric_limits<double>::quiet_NaN(), 4.0});
  table.status = {"done", "no_assembly"};
  const std::string text = whole(table);
  ASSERT_EQ(text.substr(0, 8), std::string("\x93NUMPY\x01\0", 8));
  const std::size_t header = static_cast<unsigned char>(text[8]) + 256u * static_cast<unsigned char>(text[9]);
  EXPECT_EQ((10 + header) % 64, 0u);
  EXPECT_EQ(text[9 + header], '\n');
  EXPECT_EQ(
      text.substr(10, text.find_last_not_of(' ', 8 + header) - 9),
      "{'descr': [('x_m', '<f8'), ('it\\'s\\\\_N', '<f8'), ('status', '|S16')], 'fortran_order': False, "
      "'shape': (2,), }");
  ASSERT_EQ(text.size(), 10 + header + 2 * 32);
  const char* row = text.data() + 10 + header + 32;
  double number = 0;
  std::memcpy(&number, row + 8, 8);
  EXPECT_EQ(number, 4.0);
  EXPECT_STREQ(row + 16, "no_assembly");
}

TEST(Npy, NamesStandBeforeTheColumns) {
  Table table{.name = "t", .names = {"first", "a name of more bytes"}};
  table.add("x_m", "x (m)", {1, 2});
  const std::string text = whole(table);
  EXPECT_NE(text.find("[('name', '|S24'), ('x_m', '<f8'), ('status', '|S8')]"), std::string::npos);
  EXPECT_EQ(std::string(text.data() + text.size() - 40), "a name of more bytes");
  EXPECT_EQ(std::string(text.data() + text.size() - 8), "done");
}

TEST(Npy, LettersBeyondAsciiTakeTheThirdVersion) {
  Table table{.name = "t"};
  table.add("öffnung_m", "", {1});
  const std::string text = whole(table);
  EXPECT_EQ(text.substr(0, 8), std::string("\x93NUMPY\x03\0", 8));
  EXPECT_EQ((12 + static_cast<unsigned char>(text[8])) % 64, 0);
}

TEST(Npy, ComesInPieces) {
  Table table{.name = "t"};
  table.add("x_m", "", std::vector<double>(200000, 1.0));
  std::size_t pieces = 0;
  const std::string text = whole(table, &pieces);
  EXPECT_EQ(text.size(), 128 + 200000u * 16);
  EXPECT_EQ(pieces, 5u);
}

TEST(Npy, ColumnsHaveOneLength) {
  Table table{.name = "t"};
  table.add("x_m", "", {1, 2});
  table.add("y_m", "", {1});
  EXPECT_THROW(NpyPieces{table}, ContractError);
}

}  // namespace
}  // namespace linkwright
