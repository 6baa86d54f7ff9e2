// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/csv.h"

#include <gmock/gmock.h>

#include <cmath>

#include "support/message.h"

namespace linkwright {
namespace {

std::string problems(std::string_view text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_csv(text, "path.csv", diagnostics));
  return test::lines_of(diagnostics);
}

TEST(ReadCsv, ReadsNamesOfRows) {
  Diagnostics diagnostics;
  const auto table = read_csv("name,x_mm\n\"tie rod, inner\",-12.5\nupper front ,3\n", "p.csv", diagnostics);
  ASSERT_TRUE(table) << to_string(diagnostics.at(0));
  EXPECT_EQ(table->names, (std::vector<std::string>{"tie rod, inner", "upper front"}));
  ASSERT_EQ(table->columns.size(), 1U);
  EXPECT_EQ(table->columns[0].values, (std::vector{-12.5, 3.0}));
  EXPECT_EQ(to_csv(*table), "name,x_mm,status\r\n\"tie rod, inner\",-12.5,done\r\nupper front,3,done\r\n");
}

TEST(ReadCsv, ReadsWhatTablesWrite) {
  Table table{.name = "points"};
  table.add("x_m", "x (m)", {0.1, std::nan(""), 1e-300});
  table.add("y,m", "y (m)", {-2, 0, 3});
  table.status = {"done", "no_assembly", "a \"b\""};
  Diagnostics diagnostics;
  const auto back = read_csv(to_csv(table), "points.csv", diagnostics);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->columns[1].key, "y,m");
  EXPECT_EQ(back->columns[1].values, table.columns[1].values);
  EXPECT_EQ(back->columns[0].values[2], 1e-300);
  EXPECT_TRUE(std::isnan(back->columns[0].values[1]));
  EXPECT_EQ(back->status, table.status);
}

TEST(ReadCsv, TakesSpreadsheetHabits) {
  Diagnostics diagnostics;
  const auto table = read_csv("\xEF\xBB\xBFx_mm , y_mm\r\n1, +2\r\n\"3\",4\n\n", "p.csv", diagnostics);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->columns[0].key, "x_mm");
  EXPECT_EQ(table->columns[0].values, (std::vector<double>{1, 3}));
  EXPECT_EQ(table->columns[1].values, (std::vector<double>{2, 4}));
}

TEST(ReadCsv, TellsWhatIsWrongAndWhere) {
  using ::testing::HasSubstr;
  EXPECT_THAT(problems(""), HasSubstr("path.csv:1:1: error: the file is empty"));
  EXPECT_EQ(
      problems("0.5,1.1\n1,2\n"),
      "path.csv:1:1: error: the first line holds numbers ('0.5'): the header line is missing; write the "
      "column keys with their units above them, for example x_mm,y_mm\n");
  EXPECT_THAT(problems("x_m,0.5\n"), HasSubstr("the header has '0.5' where a column key is expected"));
  EXPECT_THAT(problems("x_m,y_m\n1,2\n3\n"),
              HasSubstr("path.csv:3:1: error: 1 values, the header has 2 columns"));
  EXPECT_THAT(problems("x_m,y_m\n1,two\n"), HasSubstr("path.csv:2:3: error: y_m: 'two' is not a number"));
  EXPECT_THAT(problems("status\ndone\n"), HasSubstr("the header names no column of numbers"));
  EXPECT_THAT(problems("x\x01_m,y_m\n"), HasSubstr("where a column key is expected"));
  EXPECT_THAT(problems("x_m\ninf\n"), HasSubstr("'inf' is not finite"));
  EXPECT_THAT(problems("x_m,x_m\n"), HasSubstr("x_m: duplicate column"));
  EXPECT_THAT(problems("x_m\n\"1\n"), HasSubstr("a quote is not closed"));
}

/// Reads a table and fails the test with its problems if there are any.
Table read(std::string_view text) {
  Diagnostics diagnostics;
  const auto table = read_csv(text, "p.csv", diagnostics);
  for (const Diagnostic& d : diagnostics) ADD_FAILURE() << to_string(d);
  return table.value_or(Table{});
}
/// Keys and numbers, NaN as "-": "x_mm,y_mm|0.5,1.5".
std::string contents(std::string_view text) {
  const Table table = read(text);
  std::string out;
  for (const Column& column : table.columns) out += (out.empty() ? "" : ",") + column.key;
  for (std::size_t row = 0; row < table.rows(); ++row)
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const double value = table.columns[c].values[row];
      out +=
          (c == 0 ? "|" : ",") + (std::isnan(value) ? std::string("-") : std::to_string(value).substr(0, 4));
    }
  return out;
}

TEST(ReadCsv, ReadsWhateverSpreadsheetsWrite) {
  const std::string points = "x_mm,y_mm|0.50,1.50|-2.0,3.00";
  EXPECT_EQ(contents("x_mm,y_mm\n0.5,1.5\n-2,3\n"), points);
  EXPECT_EQ(contents("x_mm;y_mm\n0.5;1.5\n-2;3\n"), points);
  EXPECT_EQ(contents("x_mm;y_mm\r\n0,5;1,5\r\n-2;3\r\n"), points) << "decimal comma";
  EXPECT_EQ(contents("x_mm\ty_mm\n0,5\t1,5\n-2\t3\n"), points);
  EXPECT_EQ(contents("x_mm,y_mm\n\"0,5\",\"1,5\"\n-2,3\n"), points) << "decimal comma in quotes";
  EXPECT_EQ(contents("sep=;\nx_mm;y_mm\n0,5;1,5\n-2;3\n"), points);
  EXPECT_EQ(contents("# measured\n\nx_mm,y_mm\n# first\n0.5,1.5\n  # second\n-2,3\n"), points);
  EXPECT_EQ(contents("x_mm,y_mm,,\n0.5,1.5,,\n-2,3,,\n,,,\n"), points) << "empty columns and rows";
  EXPECT_EQ(contents("X [mm];Y [mm]\n0,5;1,5\n-2;3\n"), points);
  EXPECT_EQ(contents("x (mm),y(mm)\n0.5,1.5\n-2,3\n"), points);
  EXPECT_EQ(contents("x_mm,y_mm\n0.5,1.5\n\xE2\x88\x92"
                     "2,3\n"),
            points)
      << "minus sign";
  EXPECT_EQ(contents("x_mm,y_mm\n0.5,\xC2\xA0"
                     "1.5\n-2,3\n"),
            points)
      << "hard space";
  EXPECT_EQ(contents("Wheel travel [mm],Toe angle [\xC2\xB0],Speed [mm/s]\n1,2,3\n"),
            "wheel_travel_mm,toe_angle_deg,speed_mm_per_s|1.00,2.00,3.00");
  EXPECT_EQ(contents("Toe [\xB0]\n1\n"), "toe_deg|1.00") << "degree sign of Windows-1252";
  EXPECT_EQ(contents("force [N m],note [see below]\n1,2\n"), "force_N_m,note [see below]|1.00,2.00");
}

TEST(ReadCsv, ReadsUtf16) {
  const std::string plain = "x_mm\ty_mm\r\n0,5\t1,5\r\n-2\t3\r\n";
  std::string little = "\xFF\xFE", big = "\xFE\xFF";
  for (const char c : plain) {
    little += c, little += '\0';
    big += '\0', big += c;
  }
  EXPECT_EQ(contents(little), "x_mm,y_mm|0.50,1.50|-2.0,3.00");
  EXPECT_EQ(contents(big), "x_mm,y_mm|0.50,1.50|-2.0,3.00");
  EXPECT_EQ(contents(little.substr(2)), "x_mm,y_mm|0.50,1.50|-2.0,3.00") << "without a mark";
  EXPECT_EQ(contents("\xFE\xFF" + big), "x_mm,y_mm|0.50,1.50|-2.0,3.00") << "with two marks";
  EXPECT_EQ(contents("\xEF\xBB\xBF\xEF\xBB\xBFx_mm\n1\n"), "x_mm|1.00");
  // Joined from several files, or with an empty line before all.
  EXPECT_EQ(contents("\n\xEF\xBB\xBFx_mm\n1\n\xEF\xBB\xBF\n"), "x_mm|1.00");
  EXPECT_THAT(problems(little.substr(0, little.size() - 1)),
              ::testing::HasSubstr("UTF-16 text that breaks off or is damaged"));
}

TEST(ReadCsv, TellsWhatIsNoText) {
  using ::testing::HasSubstr;
  EXPECT_EQ(problems("PK\x03\x04rubbish"),
            "path.csv:1:1: error: this is an Excel workbook or another packed file; save it as CSV or plain "
            "text\n");
  EXPECT_THAT(problems(std::string_view("x_m\n1\0\n", 7)), HasSubstr("zero bytes"));
  EXPECT_EQ(problems("x_mm\n1,000.5\n").find("this"), std::string::npos);
  EXPECT_THAT(problems("x_mm;y_mm\n1,000.5;2\n"),
              HasSubstr("write thousands without a separator, like 1000.5"));
  EXPECT_THAT(problems("x_mm;y_mm\n1,5;2.5\n"),
              HasSubstr("'2.5' has a decimal point, numbers before it have a decimal comma"));
  EXPECT_THAT(
      problems("x_mm,y_mm\n0,5,1,5\n"),
      HasSubstr(
          "4 values, the header has 2 columns; with decimal commas separate the columns by semicolons"));
  EXPECT_THAT(problems("x_mm\n#DIV/0!\n"), HasSubstr("'#DIV/0!' is not a number"));
}

TEST(ReadCsv, GivesTheLinesOfRows) {
  Diagnostics diagnostics;
  std::vector<int> lines;
  ASSERT_TRUE(read_csv("# a\nx_m\n1\n\n# b\n2\n", "p.csv", diagnostics, &lines));
  EXPECT_EQ(lines, (std::vector{3, 6}));
}

TEST(ReadCsv, QuotesWhatReadersWouldPassOver) {
  Table table{.name = "t", .names = {"# first", ""}};
  table.add("#x_m", "x", {1, std::nan("")});
  const Table back = read(to_csv(table));
  EXPECT_EQ(back.names, table.names);
  ASSERT_EQ(back.rows(), 2u);
  EXPECT_EQ(back.columns[0].key, "#x_m");
}

TEST(ReadCsv, StopsTellingAfterTwentyProblems) {
  std::string text = "x_m\n";
  for (int i = 0; i < 1000; ++i) text += "bad\n";
  Diagnostics diagnostics;
  EXPECT_FALSE(read_csv(text, "path.csv", diagnostics));
  EXPECT_EQ(diagnostics.size(), 20u);
}

}  // namespace
}  // namespace linkwright
