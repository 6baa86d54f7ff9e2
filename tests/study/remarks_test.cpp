// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/remarks.h"

#include <gtest/gtest.h>

namespace linkwright::study {
namespace {

TEST(Remarks, GoToTheResult) {
  Result result;
  const AddFact fact{result.facts};
  const AddWarning warn{result.diagnostics};
  fact("circuits", "2");
  fact("energy balance", "1e-3", Fact::Verdict::bad);
  warn("the linkage is near a dead point");
  warn("drive", "is weak", "take a stronger one");
  warn(say("the gap is {}", millimetres(0.0125)));
  ASSERT_EQ(result.facts.size(), 2u);
  EXPECT_EQ(result.facts[0].label, "circuits");
  EXPECT_EQ(result.facts[0].verdict, Fact::Verdict::plain);
  EXPECT_EQ(result.facts[1].verdict, Fact::Verdict::bad);
  ASSERT_EQ(result.diagnostics.size(), 3u);
  EXPECT_EQ(to_string(result.diagnostics[0]), "warning: the linkage is near a dead point");
  EXPECT_EQ(result.diagnostics[1].severity, Diagnostic::Severity::warning);
  EXPECT_EQ(result.diagnostics[1].key, "drive");
  EXPECT_EQ(result.diagnostics[1].hint, "take a stronger one");
  EXPECT_EQ(result.diagnostics[2].message, "the gap is 12.5 mm");
}

TEST(Remarks, DiagramsShowTheColumnsThatTheirTableHas) {
  Result result;
  result.tables = {{.name = "motion"}};
  result.tables[0].add("time_s", "time (s)");
  result.tables[0].add("torque_N_m", "torque (N m)");
  const AddPlot plot{result, {.table = "motion", .x = "time_s", .scene = "turn", .baseline = "before"}};
  plot("torque", "Torque", {"force_N", "torque_N_m"});
  plot("force", "Force", {"force_N"});
  plot("paths", "Paths", {"torque_N_m"}, Plot::Style::polar);
  AddPlot{result, {.table = "steady", .x = "time_s"}}("torque", "Torque", {"torque_N_m"});
  ASSERT_EQ(result.plots.size(), 2u);
  const Plot& first = result.plots[0];
  EXPECT_EQ(first.name, "torque");
  EXPECT_EQ(first.title, "Torque");
  EXPECT_EQ(first.table, "motion");
  EXPECT_EQ(first.x, "time_s");
  EXPECT_EQ(first.y, std::vector<std::string>{"torque_N_m"});
  EXPECT_EQ(first.style, Plot::Style::line);
  EXPECT_EQ(first.scene, "turn");
  EXPECT_EQ(first.baseline, "before");
  EXPECT_EQ(result.plots[1].style, Plot::Style::polar);
}

TEST(Remarks, JointsGiveAnglesOrLengths) {
  EXPECT_EQ(to_string(angle_or_length(0.0123456, false, 3)), "12.3 mm");
  EXPECT_EQ(to_string(angle_or_length(0.5, true, 4)), "28.65°");
}

TEST(Remarks, DrivesGiveTorquesOrForces) {
  EXPECT_EQ(to_string(torque_or_force(5.5671, true, 4)), "5.567 N m");
  EXPECT_EQ(to_string(torque_or_force(-12.5, false, 4)), "-12.5 N");
}

TEST(Remarks, EnergiesBalanceOrDoNot) {
  const EnergyBalance good{1e-6, 20}, poor{0.003, 20};
  EXPECT_FALSE(good.poor());
  EXPECT_TRUE(poor.poor());
  EXPECT_EQ(to_string(poor.text()), "within 0.003 J (0.00015 of the peak energy 20 J)");
  EXPECT_EQ(to_string(EnergyBalance{}.text()), "within 0 J (0 of the peak energy 0 J)");
}

}  // namespace
}  // namespace linkwright::study
