#include "linkwright/core/csv.h"

#include <gmock/gmock.h>

#include <cmath>

namespace linkwright {
namespace {

std::string problems(std::string_view text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_csv(text, "path.csv", diagnostics));
  std::string out;
  for (const Diagnostic& d : diagnostics) out += to_string(d) + "\n";
  return out;
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
  EXPECT_THAT(problems("0.5,1.1\n"), HasSubstr("the header has '0.5' where a column key is expected"));
  EXPECT_THAT(problems("x_m,y_m\n1,2\n3\n"),
              HasSubstr("path.csv:3:1: error: 1 values, the header has 2 columns"));
  EXPECT_THAT(problems("x_m,y_m\n1,two\n"), HasSubstr("path.csv:2:3: error: y_m: 'two' is not a number"));
  EXPECT_THAT(problems("x_m\ninf\n"), HasSubstr("'inf' is not finite"));
  EXPECT_THAT(problems("x_m,x_m\n"), HasSubstr("this column stands twice"));
  EXPECT_THAT(problems("x_m\n\"1\n"), HasSubstr("a quote is not closed"));
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
