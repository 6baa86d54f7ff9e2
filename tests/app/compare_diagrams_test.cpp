// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/compare_diagrams.h"

#include <gmock/gmock.h>

#include <utility>

#include "linkwright/core/numbers.h"

namespace linkwright::app {
namespace {
using study::Plot;
using ::testing::ElementsAre;

Compared one(std::string name, Table table, Plot plot) {
  Compared out;
  out.name = std::move(name);
  table.name = plot.table = "rows";
  out.result.tables.push_back(std::move(table));
  out.result.plots.push_back(std::move(plot));
  return out;
}

Table grid(std::vector<std::pair<std::string, std::vector<double>>> columns) {
  Table table;
  for (auto& [key, values] : columns)
    table.add(key, key.substr(0, key.rfind('_')) + " (SI)", std::move(values));
  return table;
}

const Table* found(const std::vector<Table>& tables, std::string_view name) {
  for (const Table& table : tables)
    if (table.name == name) return &table;
  return nullptr;
}

TEST(CompareDiagrams, EachColumnHasADiagramInWhichAResultHasItsPlace) {
  const Plot plot{.name = "all", .title = "All", .x = "angle_rad", .y = {"toe_rad", "camber_rad", "none"}};
  std::vector<Compared> all;
  for (const char* name : {"a", "b", "c"})
    all.push_back(
        one(name, grid({{"angle_rad", {0, 1}}, {"toe_rad", {1, 2}}, {"camber_rad", {3, 4}}}), plot));
  const ComparedDiagrams result = compare_diagrams(all, {});
  ASSERT_EQ(result.plots.size(), 2u);
  EXPECT_EQ(result.plots[0].name, "all-toe_rad");
  EXPECT_EQ(result.plots[0].title, "All: toe");
  EXPECT_THAT(result.plots[0].y, ElementsAre("toe_1_rad", "toe_2_rad", "toe_3_rad"));
  EXPECT_THAT(result.plots[1].y, ElementsAre("camber_1_rad", "camber_2_rad", "camber_3_rad"));
}

TEST(CompareDiagrams, DiagramsOfScenesThatAreNotDrawnAreLeftOut) {
  const Plot plot{.name = "toe", .x = "angle_rad", .y = {"toe_rad"}, .scene = "motion"};
  const Table table = grid({{"angle_rad", {0, 1}}, {"toe_rad", {1, 2}}});
  const std::vector<Compared> all = {one("a", table, plot), one("b", table, plot)};
  EXPECT_EQ(compare_diagrams(all, {}).plots.size(), 0u);
  const std::vector<std::string> scenes = {"motion"};
  EXPECT_EQ(compare_diagrams(all, scenes).plots.size(), 1u);
}

/// Toe over travel for three positions of the rack.
Compared sweep(std::string name, std::vector<double> racks, double factor) {
  std::vector<double> travel, rack, toe;
  for (const double r : racks)
    for (const double t : {-0.05, 0.0, 0.05}) {
      travel.push_back(t);
      rack.push_back(r);
      toe.push_back(factor * t + r);
    }
  return one(std::move(name), grid({{"travel_m", travel}, {"rack_m", rack}, {"toe_rad", toe}}),
             {.name = "toe",
              .title = "Toe",
              .x = "travel_m",
              .y = {"toe_rad"},
              .scene = "motion",
              .group = "rack_m"});
}

TEST(CompareDiagrams, OfABundleTheCurveNextToZeroThatAllHaveIsCompared) {
  const std::vector<std::string> scenes = {"motion"};
  std::vector<Compared> all = {sweep("a", {-0.03, 0, 0.03}, 1), sweep("b", {-0.03, 0, 0.03}, 2)};
  all[0].study.common.units.choose(*split_unit("rack_mm"));
  ComparedDiagrams result = compare_diagrams(all, scenes);
  ASSERT_EQ(result.plots.size(), 1u);
  EXPECT_EQ(result.plots[0].title, "Toe, at rack 0 mm");
  EXPECT_EQ(result.plots[0].table, "rows-at-rack");
  EXPECT_EQ(result.plots[0].scene, "motion");
  EXPECT_EQ(result.plots[0].group, "");
  const Table* table = found(result.tables, "rows-at-rack");
  ASSERT_NE(table, nullptr);
  EXPECT_THAT(table->find("travel_m")->values, ElementsAre(-0.05, 0, 0.05));
  EXPECT_THAT(table->find("toe_2_rad")->values, ElementsAre(-0.1, 0, 0.1));
  const Table* difference = found(result.differences, "rows-at-rack-differences");
  ASSERT_NE(difference, nullptr);
  EXPECT_THAT(difference->find("toe_2_minus_1_rad")->values, ElementsAre(-0.05, 0, 0.05));

  // Racks that only one has do not matter.
  all[1] = sweep("b", {-0.03, 0.01, 0.03}, 2);
  result = compare_diagrams(all, scenes);
  ASSERT_EQ(result.plots.size(), 1u);
  EXPECT_EQ(result.plots[0].title, "Toe, at rack -30 mm");
  all[1] = sweep("b", {0.01}, 2);
  EXPECT_EQ(compare_diagrams(all, scenes).plots.size(), 0u);
}

TEST(CompareDiagrams, MapsStandSideBySideWithTheirDifference) {
  const Plot plot{
      .name = "reach", .title = "Reach", .x = "x_m", .y = {"y_m", "index"}, .style = Plot::Style::map};
  const auto map = [&](std::string name, std::vector<double> x, std::vector<double> index) {
    return one(std::move(name),
               grid({{"x_m", std::move(x)}, {"y_m", {0, 0, 1}}, {"index", std::move(index)}}), plot);
  };
  std::vector<Compared> all = {map("a", {0, 1, 0}, {1, 2, 3}), map("b", {0, 1, 0}, {1, 4, nan})};
  ComparedDiagrams result = compare_diagrams(all, {});
  ASSERT_EQ(result.plots.size(), 2u);
  EXPECT_EQ(result.plots[0].table, "rows-of-each");
  EXPECT_EQ(result.plots[0].group, "study");
  EXPECT_THAT(result.plots[0].group_names, ElementsAre("a", "b"));
  EXPECT_THAT(result.plots[0].y, ElementsAre("y_m", "index"));
  EXPECT_THAT(found(result.tables, "rows-of-each")->find("study")->values, ElementsAre(1, 1, 1, 2, 2, 2));
  EXPECT_EQ(result.plots[1].title, "Reach: b minus a");
  EXPECT_EQ(result.plots[1].table, "rows-differences");
  EXPECT_THAT(result.plots[1].y, ElementsAre("y_m", "index_2_minus_1"));
  EXPECT_THAT(found(result.differences, "rows-differences")->find("index_2_minus_1")->values,
              ElementsAre(0, 2, ::testing::IsNan()));
  // Other places have no difference.
  all[1] = map("b", {0, 2, 0}, {1, 4, 5});
  result = compare_diagrams(all, {});
  ASSERT_EQ(result.plots.size(), 1u);
  EXPECT_EQ(result.plots[0].group, "study");
}

TEST(CompareDiagrams, HistogramsLieOverEachOther) {
  const Plot plot{.name = "draws", .y = {"error_m"}, .style = Plot::Style::histogram};
  const std::vector<Compared> all = {one("a", grid({{"error_m", {1, 2}}}), plot),
                                     one("b", grid({{"error_m", {3, 4, 5}}}), plot)};
  const ComparedDiagrams result = compare_diagrams(all, {});
  ASSERT_EQ(result.plots.size(), 1u);
  EXPECT_EQ(result.plots[0].style, Plot::Style::histogram);
  EXPECT_EQ(result.plots[0].group, "study");
  EXPECT_THAT(result.plots[0].group_names, ElementsAre("a", "b"));
  const Table* table = found(result.tables, "rows-of-each");
  ASSERT_NE(table, nullptr);
  EXPECT_THAT(table->find("error_m")->values, ElementsAre(1, 2, 3, 4, 5));
}

TEST(CompareDiagrams, ValuesAreTheSameToNineDigits) {
  EXPECT_TRUE(same_values({1, nan}, {1 + 1e-10, nan}));
  EXPECT_FALSE(same_values({1, 2}, {1, 2 + 1e-8}));
  EXPECT_FALSE(same_values({1}, {1, 1}));
}

}  // namespace
}  // namespace linkwright::app
