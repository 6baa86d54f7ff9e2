// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/swing.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using test::problems_of;
using test::run_text;
using ::testing::HasSubstr;

constexpr double degree_of_swing = pi / 180;

std::string swing_study(const std::string& target, const std::string& mechanism = "ground_mm = 100\n") {
  return "schema = 1\nkind = \"synthesis\"\ntitle = \"test\"\n[mechanism]\ntype = \"planar.four_bar\"\n" +
         mechanism + "[target]\ntype = \"swing\"\n" + target;
}
std::string stroke_study(const std::string& target, const std::string& mechanism = "") {
  return "schema = 1\nkind = \"synthesis\"\ntitle = \"test\"\n[mechanism]\ntype = \"planar.slider_crank\"\n" +
         mechanism + "[target]\ntype = \"stroke\"\n" + target;
}
double objective(const study::Result& result, std::size_t solution, const char* key) {
  return result.solutions.at(solution).objectives.find(key)->as_number();
}
double parameter(const study::Result& result, std::size_t solution, const std::string& key) {
  for (const study::Parameter& p : result.solutions.at(solution).parameters)
    if (p.key == key) return p.value;
  return nan;
}

TEST(SwingStudyRead, SaysWhatIsMissingOrTwice) {
  EXPECT_THAT(problems_of(swing_study("swing_angle_deg = 40\n")), HasSubstr("the target has no time ratio"));
  EXPECT_THAT(problems_of(swing_study("swing_angle_deg = 40\ntime_ratio = 1.2\nimbalance_angle_deg = 10\n")),
              HasSubstr("the target has both a time ratio and an imbalance angle"));
  EXPECT_THAT(problems_of(swing_study("swing_angle_deg = 40\ntime_ratio = 0.8\n")), HasSubstr("time_ratio"));
  EXPECT_THAT(problems_of(swing_study("swing_angle_deg = 40\ntime_ratio = 1.2\n", "")),
              HasSubstr("the linkage has no length"));
  EXPECT_THAT(problems_of(swing_study("swing_angle_deg = 40\ntime_ratio = 1.2\n",
                                      "ground_mm = 100\ncrank_mm = 20\nrocker_mm = 50\n")),
              HasSubstr("3 lengths are given, two settle the linkage"));
  EXPECT_THAT(problems_of(stroke_study("stroke_mm = 40\ntime_ratio = 1.2\n", "crank_mm = 20\nrod_mm = 90\n")),
              HasSubstr("crank and rod are both given"));
}

TEST(SwingStudyRead, SaysWhatIsPossible) {
  // 90 + 40 / 2 = 110 degrees with the crank, 70 against it.
  EXPECT_THAT(problems_of(swing_study("swing_angle_deg = 40\ntime_ratio = 5\n")),
              HasSubstr("no crank-rocker swings by 40° with a time ratio of 5: less than 4.143 with the slow "
                        "stroke in the sense of the crank, less than 2.273 against it is possible"));
  EXPECT_THAT(problems_of(swing_study(
                  "swing_angle_deg = 40\nimbalance_angle_deg = 80\nslow_stroke = \"against_crank\"\n")),
              HasSubstr("write slow_stroke = \"with_crank\""));
  EXPECT_THAT(problems_of(stroke_study("stroke_mm = 40\ntime_ratio = 3\n")),
              HasSubstr("no slider-crank has a time ratio of 3 (an imbalance angle of 90°)"));
  EXPECT_THAT(problems_of(stroke_study("stroke_mm = 40\ntime_ratio = 1\n", "crank_mm = 25\n")),
              HasSubstr("with a time ratio of 1 the crank is half the stroke"));
  EXPECT_THAT(problems_of(stroke_study("stroke_mm = 40\ntime_ratio = 1.2\n", "crank_mm = 25\n")),
              HasSubstr("no slider-crank of these strokes with a stroke of 40 mm has a crank of 25 mm"));
  EXPECT_THAT(problems_of(swing_study("swing_angle_deg = 40\ntime_ratio = 1.2\n",
                                      "ground_mm = 100\ncrank_mm = 60\n")),
              HasSubstr("no crank-rocker of these strokes with a ground of 100 mm has a crank of 60 mm"));
  // Possible in one sense of the slow stroke.
  EXPECT_EQ(run_text(swing_study("swing_angle_deg = 40\ntime_ratio = 3\n")).solutions.size(), 1u);
}

TEST(SwingStudy, FindsBothSensesBestFirst) {
  const study::Result result = run_text(swing_study("swing_angle_deg = 45\ntime_ratio = 1.25\n"));
  EXPECT_EQ(result.status, Status::done);
  ASSERT_EQ(result.solutions.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(objective(result, i, "swing_angle_rad"), 45 * degree_of_swing, 1e-9);
    EXPECT_NEAR(objective(result, i, "time_ratio"), 1.25, 1e-9);
    EXPECT_NEAR(parameter(result, i, "ground_m"), 0.1, 1e-15);
    EXPECT_FALSE(result.solutions[i].scene.empty());
    EXPECT_FALSE(result.solutions[i].study.is_null());
  }
  EXPECT_NEAR(objective(result, 0, "least_transmission_angle_rad") / degree_of_swing, 41.813, 1e-3);
  EXPECT_NEAR(objective(result, 1, "least_transmission_angle_rad") / degree_of_swing, 30.184, 1e-3);
  EXPECT_THAT(to_string(result.solutions[0].label), HasSubstr("slow stroke with the crank"));
  EXPECT_THAT(to_string(result.headline), HasSubstr("swings by 45° with a time ratio of 1.25"));
}

// The table of the motion begins with the slow stroke, whatever the rotation and the side of the rocker.
TEST(SwingStudy, RotationAndSidesKeepTheSlowStroke) {
  for (const char* slow : {"with_crank", "against_crank"})
    for (const char* branch : {"open", "crossed"})
      for (const char* rotation : {"counterclockwise", "clockwise"}) {
        const study::Result result = run_text(swing_study(
            "swing_angle_deg = 45\ntime_ratio = 1.25\nslow_stroke = \"" + std::string(slow) + "\"\n",
            "ground_mm = 100\nbranch = \"" + std::string(branch) + "\"\nrotation = \"" + rotation + "\"\n"));
        ASSERT_EQ(result.solutions.size(), 1u);
        const Table& motion = *result.table("motion");
        const auto &crank = motion.find("crank_angle_rad")->values,
                   &rocker = motion.find("rocker_angle_rad")->values;
        // 200 degrees of 360: row 200 of 361.
        const double swing = rocker[200] - rocker[0], sense = crank[1] > crank[0] ? 1 : -1;
        EXPECT_EQ(sense > 0, std::string(rotation) == "counterclockwise");
        EXPECT_NEAR(std::abs(swing), 45 * degree_of_swing, 1e-9);
        EXPECT_EQ(swing * sense > 0, std::string(slow) == "with_crank") << slow << branch << rotation;
        EXPECT_EQ(rocker[0] > 0, std::string(branch) == "open");
      }
}

TEST(SwingStudy, SliderCranksKeepTheSlowStroke) {
  for (const char* slow : {"outward", "inward"})
    for (const char* rotation : {"counterclockwise", "clockwise"}) {
      const study::Result result = run_text(
          stroke_study("stroke_mm = 80\ntime_ratio = 1.25\nslow_stroke = \"" + std::string(slow) + "\"\n",
                       "rotation = \"" + std::string(rotation) + "\"\n"));
      ASSERT_EQ(result.solutions.size(), 1u);
      EXPECT_NEAR(objective(result, 0, "stroke_m"), 0.08, 1e-12);
      EXPECT_NEAR(objective(result, 0, "time_ratio"), 1.25, 1e-9);
      const auto& slider = result.table("motion")->find("slider_m")->values;
      EXPECT_NEAR(slider[200] - slider[0], std::string(slow) == "outward" ? 0.08 : -0.08, 1e-9);
    }
}

TEST(SwingStudy, TwoLengthsSettleTheLinkage) {
  const study::Result result =
      run_text(swing_study("swing_angle_deg = 45\ntime_ratio = 1.25\n", "ground_mm = 100\nrocker_mm = 90\n"));
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_NEAR(parameter(result, 0, "rocker_m"), 0.09, 1e-12);
  EXPECT_NEAR(objective(result, 0, "swing_angle_rad"), 45 * degree_of_swing, 1e-9);
  EXPECT_LT(objective(result, 0, "least_transmission_angle_rad"), 41.8 * degree_of_swing);
  const study::Result rod = run_text(stroke_study("stroke_mm = 80\ntime_ratio = 1\n", "rod_mm = 120\n"));
  EXPECT_NEAR(parameter(rod, 0, "crank_m"), 0.04, 1e-12);
  EXPECT_NEAR(parameter(rod, 0, "offset_m"), 0, 1e-12);
}

TEST(SwingStudy, WithoutImbalanceTheCouplerIsAsLongAsAllowed) {
  const study::Result result = run_text(
      swing_study("swing_angle_deg = 45\ntime_ratio = 1\n", "crank_mm = 20\nlargest_coupler_ratio = 5\n"));
  ASSERT_EQ(result.solutions.size(), 1u);
  EXPECT_NEAR(parameter(result, 0, "coupler_m"), 0.1, 1e-12);
  EXPECT_NEAR(objective(result, 0, "time_ratio"), 1, 1e-9);
  EXPECT_THAT(test::fact(result, "coupler over crank"), HasSubstr("the most allowed"));
}

TEST(SwingStudy, WarnsOfSmallTransmissionAngles) {
  const study::Result result = run_text(swing_study("swing_angle_deg = 40\ntime_ratio = 2\n"));
  ASSERT_FALSE(result.diagnostics.empty());
  EXPECT_THAT(to_string(result.diagnostics[0].message), HasSubstr("is below 40°, the largest possible"));
  // The diagram of the choice has its best where the design is.
  const Table& choice = *result.table("choice");
  const auto& angle = choice.find("least_transmission_angle_rad")->values;
  EXPECT_NEAR(*std::max_element(angle.begin(), angle.end()),
              objective(result, 0, "least_transmission_angle_rad"), 1e-3);
}

}  // namespace
}  // namespace linkwright::planar
