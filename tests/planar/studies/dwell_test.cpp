// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/dwell.h"

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

constexpr double degree_of_dwell = pi / 180;

std::string dwell_study(const std::string& target) {
  return "schema = 1\nkind = \"synthesis\"\ntitle = \"test\"\n[mechanism]\ntype = \"planar.six_bar\"\n"
         "[target]\ntype = \"dwell\"\n" +
         target;
}

TEST(DwellStudyRead, SaysWhatIsMissingOrOutOfRange) {
  EXPECT_THAT(problems_of(dwell_study("dwell_angle_deg = 60\ntolerance_deg = 0.1\n")),
              HasSubstr("target.swing_angle"));
  EXPECT_THAT(problems_of(dwell_study("dwell_angle_deg = 350\ntolerance_deg = 0.1\nswing_angle_deg = 30\n")),
              HasSubstr("is 350 deg, must be at most 300 deg"));
}

TEST(DwellStudy, ReportsTheRestOfTheLinkageItself) {
  const study::Result result =
      run_text(dwell_study("dwell_angle_deg = 60\ntolerance_deg = 0.01\nswing_angle_deg = 30\n"));
  EXPECT_EQ(result.status, Status::done);
  ASSERT_FALSE(result.solutions.empty());
  const Value& found = result.solutions[0].objectives;
  const double deviation = found.find("dwell_deviation_rad")->as_number();
  EXPECT_LT(deviation, 0.01 * degree_of_dwell);
  const auto& off = result.table("dwell")->find("departure_rad")->values;
  EXPECT_NEAR(*std::max_element(off.begin(), off.end()), deviation, 1e-3 * deviation);
  EXPECT_NEAR(*std::min_element(off.begin(), off.end()), -deviation, 1e-3 * deviation);
  const auto& angle = result.table("motion")->find("output_angle_rad")->values;
  const auto [low, high] = std::minmax_element(angle.begin(), angle.end());
  EXPECT_NEAR(*high - *low, found.find("swing_angle_rad")->as_number(), 1e-3);
  const Table& motion = *result.table("motion");
  double least = 1e9;
  for (const char* key : {"four_bar_transmission_angle_rad", "dyad_transmission_angle_rad"})
    for (const double mu : motion.find(key)->values) least = std::min(least, mu);
  EXPECT_NEAR(least, found.find("least_transmission_angle_rad")->as_number(), 1e-3);
  EXPECT_FALSE(result.solutions[0].study.is_null());
  EXPECT_FALSE(result.solutions[0].scene.empty());
}

TEST(DwellStudy, SaysThatTheToleranceIsNotMet) {
  const study::Result result =
      run_text(dwell_study("dwell_angle_deg = 200\ntolerance_deg = 1e-6\nswing_angle_deg = 30\n"));
  EXPECT_EQ(result.status, Status::infeasible);
  ASSERT_FALSE(result.diagnostics.empty());
}

}  // namespace
}  // namespace linkwright::planar
