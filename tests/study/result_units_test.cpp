// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/result_units.h"

#include <gtest/gtest.h>

#include "linkwright/core/numbers.h"
#include "linkwright/study/write.h"

namespace linkwright::study {
namespace {

DisplayUnits of_keys(std::initializer_list<const char*> keys) {
  DisplayUnits out;
  for (const char* key : keys) out.choose(*split_unit(key));
  out.follow();
  return out;
}

TEST(ResultUnits, TablesAndTheirDiagramsGoTogether) {
  Result result;
  result.tables = {{.name = "motion"}};
  result.tables[0].add("crank_angle_rad", "crank angle (rad)", {pi});
  result.tables[0].add("P_x_m", "P x (m)", {0.25});
  Plot plot;
  plot.x = "crank_angle_rad";
  plot.y = {"P_x_m", "share"};
  plot.group = "rack_m";
  plot.bands = {{"low_m", "high_m", "target"}};
  result.plots = {plot};
  result.solutions.resize(1);
  result.solutions[0].parameters = {{"crank_m", "crank", 0.1, 0.05, infinity}};
  result.solutions[0].objectives["error_m"] = 0.002;
  result.changes = {{"shaking_force_N", "", "rms", 2, 1}, {"way_m", "", "max", 0.5, 0.25}};
  result.troubles = {{"short", {{"crank_angle_rad", pi / 2}}, nan, ""}};
  result.statistics["best_m"] = 0.001;
  const Result shown = in_units(result, of_keys({"crank_mm", "start_deg"}));
  const auto& columns = shown.tables[0].columns;
  EXPECT_EQ(columns[0].key, "crank_angle_deg");
  EXPECT_EQ(columns[0].values[0], 180);
  EXPECT_EQ(columns[1].key, "P_x_mm");
  EXPECT_EQ(columns[1].values[0], 250);
  EXPECT_EQ(shown.plots[0].x, "crank_angle_deg");
  EXPECT_EQ(shown.plots[0].y, (std::vector<std::string>{"P_x_mm", "share"}));
  EXPECT_EQ(shown.plots[0].group, "rack_mm");
  EXPECT_EQ(shown.plots[0].bands[0].lower, "low_mm");
  EXPECT_EQ(shown.plots[0].bands[0].upper, "high_mm");
  EXPECT_EQ(shown.solutions[0].parameters[0].key, "crank_mm");
  EXPECT_EQ(shown.solutions[0].parameters[0].lower, 50);
  EXPECT_EQ(shown.solutions[0].parameters[0].upper, infinity);
  EXPECT_EQ(to_json(shown.solutions[0].objectives), R"({"error_mm":2.0})");
  EXPECT_EQ(shown.changes[0].before, 2);
  EXPECT_EQ(shown.changes[1].quantity, "way_mm");
  EXPECT_EQ(shown.changes[1].before, 500);
  EXPECT_EQ(shown.troubles[0].where[0].key, "crank_angle_deg");
  EXPECT_EQ(shown.troubles[0].where[0].value, 90);
  EXPECT_EQ(to_json(shown.statistics), R"({"best_mm":1.0})");
}

TEST(ResultUnits, PeopleAreShownTheUnitsOfTheStudy) {
  const DisplayUnits study = of_keys({"crank_mm", "start_deg", "speed_rpm"});
  EXPECT_EQ(shown_units({}, study).of(Dimension::length).suffix, "mm");
  EXPECT_EQ(shown_units({}, study).of(Dimension::speed_angular).suffix, "rpm");
  EXPECT_EQ(shown_units({}, study).of(Dimension::angle_by_length).suffix, "deg_per_100mm");
  EXPECT_EQ(shown_units({}, study).of(Dimension::stiffness).suffix, "N_per_mm");
  EXPECT_EQ(shown_units({OutputUnits::Choice::list, {"cm"}}, study).of(Dimension::length).suffix, "cm");
  EXPECT_FALSE(shown_units({}, DisplayUnits()).chosen(Dimension::length));
  // A gap is given in micrometres, a crank is not.
  EXPECT_EQ(shown_units({}, of_keys({"clearance_um"})).of(Dimension::length).suffix, "mm");
}

}  // namespace
}  // namespace linkwright::study
