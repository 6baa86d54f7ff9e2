// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/any_search_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace linkwright::planar {
namespace {

TEST(SearchTables, AreInTheUnitOfTheError) {
  TypeSearchAnswer answer;
  answer.families = {{.family = MachineFamily::four_bar, .error = 0.5, .polished = 3, .hops = 4},
                     {.family = MachineFamily::watt_2, .polished = 2, .grown = 5}};
  answer.progress = {{.curves = 10, .family = MachineFamily::four_bar, .error = 0.5}};
  answer.curves = 40;
  FoundMachine outside;
  outside.machine.shape.program = program_named("watt_2:angle");
  outside.measures.error = 0.25;
  answer.outside = {outside};
  study::Result result;
  add_search_tables(answer, {"structural_error_rms_m", "m", 0.2}, result);
  const Table* families = result.table("families");
  ASSERT_TRUE(families);
  EXPECT_DOUBLE_EQ(families->find("structural_error_rms_m")->values[0], 0.1);
  EXPECT_TRUE(std::isnan(families->find("structural_error_rms_m")->values[1]));
  EXPECT_DOUBLE_EQ(families->find("outside_limits_error_rms_m")->values[1], 0.05);
  ASSERT_TRUE(result.table("progress"));
  EXPECT_DOUBLE_EQ(result.table("progress")->find("structural_error_rms_m")->values[0], 0.1);
  EXPECT_EQ(result.statistics["polished"].as_number(), 5);
  EXPECT_EQ(result.statistics["grown"].as_number(), 5);
  EXPECT_EQ(result.statistics["evaluations"].as_number(), 40);
}

TEST(SearchTables, SayWhyTheNearestMachineIsNoAnswer) {
  TypeSearchAnswer answer;
  EXPECT_EQ(nearest_outside(answer), nullptr);
  for (const double error : {0.4, 0.25, 0.3}) {
    FoundMachine& found = answer.outside.emplace_back();
    found.machine.shape.program = program_named("watt_2:angle");
    found.measures.error = error;
    found.measures.defect = MachineDefect::pair_angle;
  }
  ASSERT_EQ(nearest_outside(answer), &answer.outside[1]);
  study::Result result;
  report_none_found(answer, plain_number(0.25), result);
  EXPECT_EQ(to_string(result.headline), "No machine within the limits was found.");
  ASSERT_EQ(result.diagnostics.size(), 1u);
  EXPECT_THAT(to_string(result.diagnostics[0]),
              ::testing::HasSubstr("the least pair angle is below its limit"));
}

}  // namespace
}  // namespace linkwright::planar
