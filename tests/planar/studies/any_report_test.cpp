// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/any_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// Studies of one four-bar family: a stroke, poses, a function and a quick return.
std::vector<std::string> reported_studies() {
  const std::string head =
      "schema = 1\nkind = \"synthesis\"\n[mechanism]\ntype = \"planar.any\"\n"
      "families = [\"four_bar\"]\n[optimiser]\nevaluations = 6000\n";
  const std::string limits = "[limits]\nlongest_link = 2.5\n";
  return {
      head + limits +
          "[target]\ntype = \"path_points\"\nclosed = true\npoints_mm = [[0, 0], [40, 5], [60, 30], [40, "
          "50], "
          "[0, 40], [-10, 20]]\n",
      head + limits +
          "[target]\ntype = \"poses\"\npose = [{ x_mm = 0, y_mm = 0, angle_deg = 0 }, { x_mm = 30, y_mm = 5, "
          "angle_deg = 5 }, { x_mm = 62, y_mm = 24, angle_deg = 20 }, { x_mm = 80, y_mm = 50, angle_deg = 45 "
          "}]\n",
      head + limits +
          "[target]\ntype = \"function\"\nfunction = \"power\"\nexponent = 2\nx = { from = 0, to = 1 }\n"
          "input_range_deg = 80\noutput_range_deg = 60\n",
      head + limits +
          "[target]\ntype = \"function\"\ntime_ratio = 1.2\ninput_range_deg = 360\noutput_range_deg = 50\n"};
}

// Whatever the target is, a list has the same measures, and a study of every machine.
TEST(AnyReports, HaveTheSameMeasuresForEveryTarget) {
  for (const std::string& text : reported_studies()) {
    const study::Result result = test::run_text(text);
    ASSERT_FALSE(result.solutions.empty()) << text;
    const Table* machines = result.table("machines");
    ASSERT_TRUE(machines);
    const std::vector<std::string> keys = test::keys(*machines);
    EXPECT_EQ(keys[0], "links");
    for (const char* key : {"least_pair_angle_rad", "size_m", "shortest_link_m", "longest_link_m"})
      EXPECT_THAT(keys, Contains(key)) << text;
    ASSERT_EQ(machines->rows(), result.solutions.size());
    ASSERT_EQ(result.scenes.size(), result.solutions.size());
    for (std::size_t i = 0; i < result.solutions.size(); ++i) {
      const study::Solution& solution = result.solutions[i];
      EXPECT_EQ(solution.objectives.find("longest_link_m")->as_number(),
                machines->find("longest_link_m")->values[i]);
      EXPECT_EQ(solution.classification.find("program")->as_string(), machines->names[i]);
      EXPECT_EQ(solution.scene, result.scenes[i].name);
      EXPECT_FALSE(solution.study.is_null());
    }
    for (const char* label : {"best machine", "curves computed"})
      EXPECT_TRUE(std::any_of(result.facts.begin(), result.facts.end(), [&](const study::Fact& f) {
        return f.label == label;
      })) << label;
    EXPECT_EQ(result.log.as_array().size(), 1U);
  }
}

// The limit that a machine has come to is told of functions, too.
TEST(AnyReports, TellWhatLimitsAMachine) {
  const study::Result result = test::run_text(
      test::replaced(reported_studies()[2], "longest_link = 2.5", "longest_link = 1.1\nshortest_link = 0.6"));
  ASSERT_FALSE(result.solutions.empty());
  const Table* machines = result.table("machines");
  bool limited = false;
  for (std::size_t i = 0; i < result.solutions.size(); ++i) {
    EXPECT_LE(machines->find("longest_link_m")->values[i], 0.11 * 1.0011);
    EXPECT_GE(machines->find("shortest_link_m")->values[i], 0.06 * 0.9989);
    const Value* by = result.solutions[i].classification.find("limited_by");
    limited = limited || (by && by->as_string().find("_link") != std::string::npos);
  }
  EXPECT_TRUE(limited);
}

}  // namespace
}  // namespace linkwright::planar
