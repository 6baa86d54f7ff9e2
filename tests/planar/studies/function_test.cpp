// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/function.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "planar/studies.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using test::problems_of;
using test::run_text;
using ::testing::HasSubstr;

std::string function_study(const std::string& target, const std::string& mechanism = "") {
  return "schema = 1\nkind = \"synthesis\"\ntitle = \"test\"\n[mechanism]\ntype = \"planar.four_bar\"\n" +
         mechanism + "[target]\ntype = \"function\"\ninput_range_deg = 90\noutput_range_deg = 90\n" + target;
}
const std::string exponential = "function = \"exp\"\nx = { from = 0, to = 1 }\n";

TEST(FunctionStudyRead, SaysWhatIsWrongWithTheFunction) {
  EXPECT_THAT(problems_of(function_study("")), HasSubstr("the target has no function"));
  EXPECT_THAT(problems_of(function_study("function = \"log\"\nx = { from = 0, to = 2 }\n")),
              HasSubstr("log has no value at x = 0"));
  EXPECT_THAT(problems_of(function_study("function = \"tan\"\nx = { from = 0, to = 90 }\n")),
              HasSubstr("tan has no value at x = 90"));
  EXPECT_THAT(problems_of(function_study("function = \"exp\"\nx = { from = 2, to = 2 }\n")),
              HasSubstr("the range of x is not more than a point"));
  EXPECT_THAT(problems_of(function_study("function = \"power\"\nx = { from = 1, to = 2 }\n")),
              HasSubstr("power needs its exponent"));
  std::string said;
  EXPECT_TRUE(test::prepare(function_study("function = \"sin\"\nx = { from = 0, to = 1.5 }\n"), said));
  EXPECT_THAT(said,
              HasSubstr("sin takes x in degrees: 0 to 1.5 is a small part of a turn; if radians are meant, "
                        "write from = 0, to = 85.9437"));
  EXPECT_TRUE(test::prepare(function_study("function = \"sin\"\nx = { from = 0, to = 150 }\n"), said));
  EXPECT_THAT(said, HasSubstr("sin both rises and falls over the range"));
  EXPECT_THAT(problems_of(function_study("function = \"sin\"\nx = { from = 0, to = 180 }\n")),
              HasSubstr("sin has the same value at both ends: the output would not move"));
  EXPECT_THAT(problems_of(function_study("function = \"sin\"\nx = { from = 0, to = 170 }\n")),
              HasSubstr("sin turns the output by 518°, more than a turn"));
  EXPECT_THAT(problems_of(function_study("table = [[0, 0], [2, 1], [1, 3]]\n")), HasSubstr("x must rise"));
  EXPECT_THAT(problems_of(function_study("table = [[0, 0], [1, 0.5], [1.0000000001, 30], [2, 31]]\n")),
              HasSubstr("the smooth curve through the points reaches -1.47e+09 at x = 0.01"));
}

TEST(FunctionStudyRead, CountsPointsAndStartAngles) {
  EXPECT_THAT(problems_of(function_study(exponential + "points = 4\n")),
              HasSubstr("4 precision points and 0 start angles are 4 conditions, the linkage meets 5"));
  std::string said;
  EXPECT_TRUE(test::prepare(function_study(exponential + "points = 4\n", "input_start_deg = 30\n"), said));
  EXPECT_EQ(said, "");
  EXPECT_THAT(problems_of(function_study(exponential + "at = [0.1, 0.3, 0.5, 0.7, 1.2]\n")),
              HasSubstr("x = 1.2 is not in the range 0 to 1"));
  EXPECT_THAT(problems_of(function_study(exponential + "fit = \"minimax\"\npoints = 5\n")),
              HasSubstr("points are for fit \"points\""));
  EXPECT_THAT(problems_of(function_study(exponential + "fit = \"minimax\"\n", "input_start_deg = 30\n")),
              HasSubstr("start angles are given for precision points"));
}

TEST(FunctionStudy, GivesTheErrorOverTheRange) {
  const study::Result result = run_text(function_study(exponential + "fit = \"minimax\"\n"));
  EXPECT_EQ(result.status, Status::done);
  ASSERT_TRUE(result.table("structural_error"));
  ASSERT_FALSE(result.solutions.empty());
  const double most = result.solutions[0].objectives.find("structural_error_rad")->as_number();
  EXPECT_NEAR(most * 57.29577951308232, 0.025947, 1e-5);
  double seen = 0;
  for (const double e : result.table("structural_error")->find("error_rad")->values)
    seen = std::max(seen, std::abs(e));
  EXPECT_NEAR(seen, most, 1e-3 * most);
  EXPECT_FALSE(result.solutions[0].scene.empty());
}

TEST(FunctionStudy, WarnsWhereTheFunctionIsNotFollowed) {
  const study::Result result =
      run_text(function_study("function = \"sin\"\nx = { from = 0, to = 300 }\nfit = \"minimax\"\n"));
  ASSERT_EQ(result.status, Status::done);
  const auto fact = std::ranges::find(result.facts, "greatest structural error", &study::Fact::label);
  ASSERT_NE(fact, result.facts.end());
  EXPECT_EQ(fact->verdict, study::Fact::Verdict::bad);
  EXPECT_THAT(test::lines_of(result.diagnostics),
              HasSubstr(" % of what the output moves: the function is not followed"));
}

TEST(FunctionStudy, SaysWhenNoGeneratorCoversTheRange) {
  const study::Result result = run_text(function_study("function = \"log10\"\nx = { from = 1, to = 10 }\n"));
  EXPECT_EQ(result.status, Status::infeasible);
  EXPECT_EQ(result.statistics.find("outcome")->as_string(), "all_defective");
  EXPECT_THAT(to_string(result.headline), HasSubstr("stays on one branch over the whole range"));
}

TEST(FunctionStudy, TheRowsOfATableAreItsPrecisionPoints) {
  const std::string table = "table = [[0, 0], [0.5, 0.3], [1, 0.8], [2, 2.1], [3, 4]]\n";
  const auto points_of = [](const std::string& text) {
    const study::Result result = run_text(function_study(text));
    std::string all;
    for (const study::Fact& fact : result.facts) all += to_string(fact.label + ": " + fact.text) + "\n";
    return all;
  };
  EXPECT_EQ(points_of(table), points_of(table + "at = [0, 0.5, 1, 2, 3]\n"));
  EXPECT_NE(points_of(table), points_of(table + "fit = \"points\"\n"));
  std::string said;
  EXPECT_TRUE(test::prepare(function_study("table = [[0, 0], [1, 0.8], [2, 2.1], [3, 4]]\n"), said));
  EXPECT_THAT(
      said,
      HasSubstr("its 4 rows are not precision points: with 0 start angles the linkage meets 5; the curve "
                "through them is met at 5 places of Chebyshev's; give 5 rows, or write fit"));
}

TEST(FunctionStudy, ATableIsAFunctionToo) {
  const study::Result result =
      run_text(function_study("table = [[0, 0], [1, 0.8], [2, 2.1], [3, 4]]\nfit = \"least_squares\"\n"));
  EXPECT_EQ(result.status, Status::done);
  EXPECT_THAT(to_string(result.facts[0].text), HasSubstr("a table of 4 points, x = 0 to 3"));
}

TEST(SixBarFunctionStudy, ComparesWithTheFourBar) {
  const auto six_bar = [](const std::string& fit) {
    return "schema = 1\nkind = \"synthesis\"\ntitle = \"test\"\n[mechanism]\ntype = \"planar.six_bar\"\n"
           "[target]\ntype = \"function\"\ninput_range_deg = 90\noutput_range_deg = 90\n" +
           exponential + fit;
  };
  EXPECT_THAT(problems_of(six_bar("fit = \"points\"\n")),
              HasSubstr("a six-bar has more numbers than precision points settle"));
  const study::Result result = run_text(six_bar(""));
  EXPECT_EQ(result.status, Status::done);
  ASSERT_FALSE(result.solutions.empty());
  const double most = result.solutions[0].objectives.find("structural_error_rad")->as_number();
  EXPECT_LT(most, 0.2 * result.statistics.find("four_bar_structural_error_rad")->as_number());
  // The table is of the linkage itself.
  double seen = 0;
  for (const double e : result.table("structural_error")->find("error_rad")->values)
    seen = std::max(seen, std::abs(e));
  EXPECT_NEAR(seen, most, 1e-2 * most);
  EXPECT_FALSE(result.solutions[0].study.is_null());
}

TEST(SixBarFunctionStudy, OfStephensonIsTheLinkageItself) {
  const study::Result result = run_text(
      "schema = 1\nkind = \"synthesis\"\ntitle = \"test\"\n[mechanism]\ntype = \"planar.six_bar\"\nstructure "
      "= "
      "\"stephenson_3\"\n[target]\ntype = \"function\"\ninput_range_deg = 90\noutput_range_deg = 90\nfit = "
      "\"least_squares\"\n" +
      exponential);
  EXPECT_EQ(result.status, Status::done);
  ASSERT_FALSE(result.solutions.empty());
  const double most = result.solutions[0].objectives.find("structural_error_rad")->as_number();
  EXPECT_LT(most, 0.3 * result.statistics.find("four_bar_structural_error_rad")->as_number());
  double seen = 0;
  for (const double e : result.table("structural_error")->find("error_rad")->values)
    seen = std::max(seen, std::abs(e));
  EXPECT_NEAR(seen, most, 1e-2 * most);
  EXPECT_FALSE(result.solutions[0].study.is_null());
}

TEST(FunctionStudy, KeepsALeastTransmissionAngle) {
  EXPECT_THAT(problems_of(function_study(exponential, "least_transmission_angle_deg = 30\n")),
              HasSubstr("least_transmission_angle is for fit \"minimax\""));
  const auto minimax = [](const std::string& function, const std::string& angle) {
    return function_study(function + "fit = \"minimax\"\n", "least_transmission_angle_deg = " + angle + "\n");
  };
  const study::Result tangent = run_text(minimax("function = \"tan\"\nx = { from = 0, to = 45 }\n", "30"));
  EXPECT_EQ(tangent.status, Status::done);
  EXPECT_GE(tangent.solutions[0].objectives.find("least_pair_angle_rad")->as_number(), pi / 6);
  const study::Result decade = run_text(minimax("function = \"log10\"\nx = { from = 1, to = 10 }\n", "69"));
  EXPECT_GE(decade.solutions[0].objectives.find("least_pair_angle_rad")->as_number(), 69 * pi / 180);
  EXPECT_TRUE(decade.diagnostics.empty());
}

}  // namespace
}  // namespace linkwright::planar
