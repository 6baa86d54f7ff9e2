// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/reproductions_paths.h"

#include <gmock/gmock.h>

#include <map>

#include "support/reproduced.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

std::map<std::string, study::Comparison> rows(std::string_view id) {
  std::map<std::string, study::Comparison> out;
  for (study::Comparison& row : test::rows_of(path_reproductions(), id)) out[row.item] = row;
  return out;
}

TEST(PathReproductions, HaveIdsTitlesSourcesAndNotes) { test::expect_complete(path_reproductions()); }

TEST(PathReproductions, FourBarsOfTable41) {
  const auto table = rows("boskovic-2018-table-4.1");
  EXPECT_NEAR(table.at("Boskovic 2018: path error, m2").ours, 0.009098261, 1e-8);
  EXPECT_EQ(table.at("Kunjur and Krishnamurty 1997: path error, m2").verdict, "not reproduced");
  EXPECT_EQ(table.at("Cabrera et al. 2007, columns corrected: path error, m2").verdict, "corrected");
  const study::Comparison best = table.at("least path error, recommended method, seed 1, m2");
  EXPECT_EQ(best.verdict, "improved");
  EXPECT_NEAR(best.ours, 0.009028884631, 1e-9);
}

// 0 of 200 seeds of an independent implementation, best 0.203, median 2.77: what is printed cannot come from
// the printed setting.
TEST(PathReproductions, TheGreyWolfDoesNotReachWhatIsPrintedForIt) {
  for (const char* id : {"boskovic-2018-table-4.1", "boskovic-2018-table-4.2"}) {
    int wolves = 0;
    for (const auto& [item, row] : rows(id)) {
      if (item.find("grey wolf") == std::string::npos) continue;
      ++wolves;
      EXPECT_EQ(row.verdict, "not reproduced") << item;
      EXPECT_GT(row.ours, 1.01 * row.published) << item;
      EXPECT_THAT(row.note, HasSubstr("0 of 60 seeds come within 1 % of the printed error"));
    }
    EXPECT_EQ(wolves, 2);
  }
}

TEST(PathReproductions, TheSliderCrankOfTable42) {
  const auto table = rows("boskovic-2018-table-4.2");
  EXPECT_NEAR(table.at("path error, m2").ours, 0.009892982121, 1e-10);
  EXPECT_EQ(table.at("path error, m2").verdict, "not reproduced");
  EXPECT_NEAR(table.at("abscissa of the tracing point at the first crank angle, m").ours, 0.52426, 1e-5);
  EXPECT_NEAR(table.at("stroke over a full turn, m").ours, 0.727250646594, 1e-8);
  EXPECT_NEAR(table.at("least path error, recommended method, seed 1, m2").ours, 0.009869199827, 1e-9);
}

TEST(PathReproductions, TheSliderCranksOfTable43AreDominated) {
  const auto table = rows("boskovic-2018-table-4.3");
  const double errors[] = {0.033024439617, 0.038057674495, 0.033155137765, 0.036153179906};
  const double strokes[] = {0.937401743150, 0.844629306766, 0.939602471320, 0.771522391749};
  for (int i = 0; i < 4; ++i) {
    const std::string of = "example " + std::to_string(i + 1) + ": ";
    EXPECT_NEAR(table.at(of + "path error, m2").ours, errors[i], 1e-10);
    EXPECT_NEAR(table.at(of + "stroke over a full turn, m").ours, strokes[i], 1e-8);
    EXPECT_EQ(table.at(of + "the design of the path alone is better in error and stroke (1 = yes)").ours, 1);
    EXPECT_LT(table.at(of + "least path error at its true stroke, m2").ours, 0.0099);
  }
  // At the error printed, half the stroke will do.
  EXPECT_NEAR(table.at("least path error at a stroke of 0.47 m, m2").ours, 0.0335, 0.0008);
}

TEST(PathReproductions, ExactSynthesis) {
  const auto nine = rows("wampler-morgan-sommese-1992-problem-3"),
             five = rows("morgan-wampler-1990-problem-7"), certified = rows("hauenstein-sottile-2012"),
             poses = rows("burmester-1888-five-poses");
  EXPECT_EQ(nine.at("classes of six four-bars with the same coupler curve").ours, 1442);
  EXPECT_EQ(nine.at("real classes").ours, 64);
  EXPECT_EQ(nine.at("real four-bars with their driver").ours, 384);
  EXPECT_THAT(nine.at("real four-bars with their driver").note, HasSubstr("2 of them"));
  EXPECT_EQ(five.at("finite solutions").ours, 33);
  EXPECT_EQ(five.at("real solutions").ours, 15);
  EXPECT_EQ(certified.at("certified distinct solutions").ours, 8652);
  EXPECT_EQ(poses.at("links of the four-bar that the poses are taken from, among them").ours, 2);
  for (const auto* table : {&nine, &five, &certified, &poses})
    for (const auto& [item, row] : *table) EXPECT_EQ(row.verdict, "reproduced") << item;
}

// The same tables, printed twice.
TEST(PathReproductions, ThePaperPrintsTheTablesOfTheThesis) {
  const auto thesis = rows("boskovic-2018-table-4.3"), paper = rows("boskovic-gwo-table-3");
  ASSERT_EQ(thesis.size(), paper.size());
  for (const auto& [item, row] : thesis) {
    EXPECT_EQ(paper.at(item).ours, row.ours) << item;
    EXPECT_THAT(paper.at(item).source, HasSubstr("grey wolf for closed paths, Table 3"));
  }
}

}  // namespace
}  // namespace linkwright::planar
