#include "linkwright/study/read_csv.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace linkwright::study {
namespace {
using testing::HasSubstr;

std::string messages(std::string_view text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_csv_text(text, "p.csv", diagnostics).has_value());
  std::string all;
  for (const Diagnostic& d : diagnostics) all += to_string(d) + "\n";
  return all;
}

TEST(ReadCsv, NumbersTextsAndMissingValues) {
  Diagnostics diagnostics;
  const auto table = read_csv_text(
      "\xEF\xBB\xBF# measured\nx_mm, \"y_m\" ,status\r\n500,1.5e-1,done\r\n\r\n +2 ,,\"no \"\"x\"\", y\"",
      "p.csv", diagnostics);
  ASSERT_TRUE(table) << to_string(diagnostics[0]);
  EXPECT_EQ(table->find("x_mm")->values, (std::vector<double>{500, 2}));
  EXPECT_EQ(table->find("y_m")->values[0], 0.15);
  EXPECT_TRUE(std::isnan(table->find("y_m")->values[1]));
  EXPECT_EQ(table->status, (std::vector<std::string>{"done", "no \"x\", y"}));
}

TEST(ReadCsv, ReadsBackWhatIsWritten) {
  Table table;
  table.add("a_m", "a", {0.1, 1e-300, -0.0});
  table.add("odd, \"key\"", "b", {1, std::nan(""), 3});
  table.status = {"done", "no_assembly", "done"};
  Diagnostics diagnostics;
  const auto again = read_csv_text(to_csv(table), "t", diagnostics);
  ASSERT_TRUE(again);
  EXPECT_EQ(to_csv(*again), to_csv(table));
}

TEST(ReadCsv, Problems) {
  EXPECT_EQ(messages("x_m,y_m\n1,2\n1\n1,two\n"),
            "p.csv:3:1: error: has 1 cells, must have 2\n"
            "p.csv:4:3: error: 'two' in the column 'y_m' is not a finite number\n");
  EXPECT_THAT(messages("x_m\n1;2\n"), HasSubstr("p.csv:2:1: error: '1;2' in the column 'x_m' is not a finite "
                                                "number; cells are separated by commas"));
  EXPECT_THAT(messages("x_m\ninf\n"), HasSubstr("'inf' in the column 'x_m' is not a finite number"));
  EXPECT_THAT(messages("x_m,x_m\n1,2\n"), HasSubstr("p.csv:1:5: error: the column 'x_m' is given twice"));
  EXPECT_THAT(messages("x_m,\n1,2\n"), HasSubstr("this column has no key"));
  EXPECT_THAT(messages("x_m\n\"1\n"), HasSubstr("a cell in quotes must end in a quote on its line"));
  EXPECT_THAT(messages("x_m\n\"1\"2\n"), HasSubstr("a cell in quotes must end in a quote on its line"));
  EXPECT_THAT(messages("\n# nothing\n"), HasSubstr("the file is empty"));
  EXPECT_THAT(messages("x_m\n"), HasSubstr("has no rows"));
  std::string many = "x_m\n";
  for (int i = 0; i < 1000; ++i) many += "x\n";
  const std::string all = messages(many);
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 50);
}

TEST(SiColumn, AnyUnitOfTheDimension) {
  Table table;
  table.add("x_mm", "x", {500, 2});
  table.add("y_m", "y", {1, std::nan("")});
  table.add("z_m", "z", {1, 2});
  table.add("z_mm", "z", {1, 2});
  table.add("n", "n", {1, 2});
  Diagnostics diagnostics;
  const auto column = [&](std::string_view base, Dimension dimension) {
    return si_column(table, base, dimension, "p.csv", diagnostics);
  };
  EXPECT_EQ(column("x", Dimension::length), (std::vector<double>{0.5, 0.002}));
  EXPECT_EQ(column("n", Dimension::none), (std::vector<double>{1, 2}));
  EXPECT_TRUE(diagnostics.empty());
  EXPECT_FALSE(column("y", Dimension::length));
  EXPECT_EQ(to_string(diagnostics.back()), "p.csv: error: has no value in row 2 of the column 'y_m'");
  EXPECT_FALSE(column("z", Dimension::length));
  EXPECT_EQ(to_string(diagnostics.back()), "p.csv: error: has the columns z_m and z_mm; keep one of them");
  EXPECT_FALSE(column("w", Dimension::angle));
  EXPECT_EQ(to_string(diagnostics.back()),
            "p.csv: error: has no column for 'w', expected one of: w_rad, w_deg");
}

}  // namespace
}  // namespace linkwright::study
