// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/cam.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using testing::HasSubstr;

std::string cam_text() { return std::string(cam_kind().example); }

TEST(CamStudy, TellsProfileLimitsAndForces) {
  const study::Result result = run_text(cam_text());
  ASSERT_EQ(result.status, Status::done);
  EXPECT_THAT(fact(result, "largest pressure angle of the rise"), HasSubstr("10.661°"));
  EXPECT_THAT(fact(result, "undercut"), HasSubstr("none"));
  EXPECT_THAT(fact(result, "lift-off speed"), HasSubstr("rpm"));
  const std::vector<double>&x = column(result, "cam", "profile_x_m"),
        &y = column(result, "cam", "profile_y_m");
  ASSERT_EQ(x.size(), 361u);
  // The published place of the profile at 45 degrees.
  EXPECT_NEAR(x[45], 0.03834053316695953, 1e-15);
  EXPECT_NEAR(y[45], 0.02490120470151435, 1e-15);
  // The cutter is 20 mm off the profile.
  EXPECT_NEAR(std::hypot(column(result, "cam", "cutter_x_m")[45] - x[45],
                         column(result, "cam", "cutter_y_m")[45] - y[45]),
              0.02, 1e-15);
  ASSERT_EQ(result.scenes.size(), 2u);
  EXPECT_EQ(result.scenes[0].name, "motion");
  EXPECT_EQ(result.scenes[1].name, "profile");
  EXPECT_EQ(result.scenes[1].traces.size(), 3u) << "profile, pitch curve and cutter";
}

// The points of the polygon that turns lie on the profile of the table, and the roller touches it.
TEST(CamStudy, DrawsTheRollerOnTheCam) {
  for (const char* sense : {"counterclockwise", "clockwise"}) {
    const study::Result result =
        run_text(replaced(cam_text(), "\"counterclockwise\"", fmt::format("\"{}\"", sense)));
    const study::Scene& scene = result.scenes[0];
    const auto& roller = scene.circles[1];
    const study::Scene::Point &centre = scene.points[at(roller.centre)], &rim = scene.points[at(roller.rim)];
    for (std::size_t k = 0; k < scene.input.size(); k += 10) {
      EXPECT_NEAR(centre.x[k], 0.008, 1e-15);
      EXPECT_NEAR(std::hypot(rim.x[k] - centre.x[k], rim.y[k] - centre.y[k]), 0.01, 1e-15);
      double least = infinity;
      for (const int p : scene.bodies[0].points)
        least = std::min(least, std::hypot(scene.points[at(p)].x[k] - centre.x[k],
                                           scene.points[at(p)].y[k] - centre.y[k]));
      EXPECT_GT(least, 0.01 - 1e-12) << sense << k;
      EXPECT_LT(least, 0.0106) << sense << k;
    }
  }
}

TEST(CamStudy, TellsUndercutAndLostContact) {
  // A rise within half the angle, and a larger roller on a smaller cam.
  std::string text =
      replaced(cam_text(), "law      = \"dwell\"\nover_deg = 60.0", "law = \"dwell\"\nover_deg = 120");
  text = replaced(text, "over_deg = 120.0\nto_mm    = 20.0", "over_deg = 60\nto_mm = 20");
  text = replaced(text, "base_radius_mm   = 40.0", "base_radius_mm = 10");
  const study::Result result = run_text(replaced(text, "roller_radius_mm = 10.0", "roller_radius_mm = 30"));
  std::string warnings;
  for (const Diagnostic& d : result.diagnostics) warnings += to_string(d) + "\n";
  EXPECT_THAT(warnings, HasSubstr("the profile is undercut from"));
  EXPECT_THAT(warnings, HasSubstr("or a base circle above"));
  const study::Result fast = run_text(replaced(cam_text(), "speed_rpm       = 400.0", "speed_rpm = 2000"));
  warnings.clear();
  for (const Diagnostic& d : fast.diagnostics) warnings += to_string(d) + "\n";
  EXPECT_THAT(warnings, HasSubstr("the follower lifts off at"));
  EXPECT_THAT(warnings, HasSubstr("would hold it"));
  const std::vector<double>& lost = column(fast, "cam", "contact_lost");
  EXPECT_GT(std::count(lost.begin(), lost.end(), 1.0), 10);
}

TEST(CamStudy, SaysWhetherTwoFacesEncloseTheCam) {
  // A flat follower on an eccentric, whose rise of 50 mm is harmonic, on a base circle of 25 mm.
  const std::string text = R"(
schema = 1
kind = "analysis"
[mechanism]
type = "planar.cam"
follower = "flat"
base_radius_mm = 25
[[mechanism.segment]]
law = "harmonic"
over_deg = 180
to_mm = 50
[[mechanism.segment]]
law = "harmonic"
over_deg = 180
to_mm = 0
)";
  EXPECT_EQ(fact(run_text(text), "breadth between parallel faces"),
            "100 mm, constant: two faces enclose the cam");
  const std::string unlike =
      replaced(replaced(text, "over_deg = 180\nto_mm = 50", "over_deg = 120\nto_mm = 50"),
               "over_deg = 180\nto_mm = 0", "over_deg = 240\nto_mm = 0");
  EXPECT_THAT(fact(run_text(unlike), "breadth between parallel faces"),
              testing::MatchesRegex("90.77.* mm to 109.22.* mm: two faces cannot enclose the cam"));
}

TEST(CamStudy, SaysWhatIsWrong) {
  const std::string text = cam_text();
  EXPECT_THAT(problems_of(replaced(text, "law      = \"polynomial_345\"\nover_deg = 120.0",
                                   "law = \"polynomial_345\"\nover_deg = 110.0")),
              HasSubstr("the programme covers 350° of the turn of 360°; add 10°, or write sector = true"));
  EXPECT_THAT(problems_of(replaced(text, "to_mm    = 0.0", "to_mm = 12.0")),
              HasSubstr("the programme ends 12 mm above its start"));
  EXPECT_THAT(problems_of(replaced(text, "\"cycloidal\"", "\"constant_speed\"")),
              HasSubstr("the speed of the follower would jump by 9.5493 mm per radian of the cam at 0°"));
  EXPECT_THAT(problems_of(replaced(text, "offset_mm        = 8.0", "offset_mm = 60")),
              HasSubstr("the offset of 60 mm reaches beyond the prime circle of 50 mm"));
  EXPECT_THAT(problems_of(replaced(text, "roller_radius_mm = 10.0", "")), HasSubstr("roller_radius"));
  EXPECT_THAT(problems_of(replaced(text, "roller_radius_mm = 10.0", "roller_radius_mm = 10.0\narm_mm = 65")),
              HasSubstr("a translating roller follower has no arm"));
  EXPECT_THAT(problems_of(replaced(text, "law      = \"dwell\"", "law = \"dwell\"\nto_mm = 20")),
              HasSubstr("a dwell stays where the segment before it ends"));
  EXPECT_THAT(problems_of(replaced(text, "over_deg = 120.0\nto_mm    = 20.0", "over_deg = 120.0")),
              HasSubstr("the segment has no end value"));
}

TEST(CamStudy, OscillatingFollowersHaveTheirOwnKeys) {
  const std::string text =
      "schema = 1\nkind = \"analysis\"\ntitle = \"t\"\n[mechanism]\ntype = \"planar.cam\"\nmotion = "
      "\"oscillating\"\nroller_radius_mm = 8\nbase_radius_mm = 32\npivot_mm = 80\narm_mm = 65\n"
      "[[mechanism.segment]]\nlaw = \"polynomial_345\"\nover_deg = 110\nto_deg = 20\n"
      "[[mechanism.segment]]\nlaw = \"dwell\"\nover_deg = 50\n"
      "[[mechanism.segment]]\nlaw = \"modified_sine\"\nover_deg = 120\nto_deg = 0\n"
      "[[mechanism.segment]]\nlaw = \"dwell\"\nover_deg = 80\n"
      "[forces]\nspeed_rpm = 100\ninertia_kg_m2 = 0.001\npreload_N_m = 2\n";
  const study::Result result = run_text(text);
  ASSERT_EQ(result.status, Status::done);
  EXPECT_THAT(fact(result, "largest pressure angle of the rise"), HasSubstr("26.887°"));
  EXPECT_EQ(column(result, "cam", "swing_rad").size(), 361u);
  EXPECT_THAT(problems_of(replaced(text, "arm_mm = 65", "arm_mm = 200")),
              HasSubstr("arm 200 mm, pivot 80 mm and prime circle 40 mm make no triangle"));
  EXPECT_THAT(problems_of(replaced(text, "arm_mm = 65", "arm_mm = 65\noffset_mm = 3")),
              HasSubstr("an oscillating follower has no offset"));
  EXPECT_NE(problems_of(replaced(text, "to_deg = 20", "to_mm = 20")), "");
}

TEST(CamSynthesisStudy, FindsTheSmallestCam) {
  const std::string text = std::string(cam_synthesis_kind().example);
  const study::Result result = run_text(text);
  ASSERT_EQ(result.status, Status::done);
  ASSERT_EQ(result.solutions.size(), 1u);
  EXPECT_THAT(to_string(result.headline), HasSubstr("The smallest cam has a base circle of"));
  EXPECT_THAT(problems_of(replaced(replaced(replaced(text, "pressure_angle_deg        = 30.0", ""),
                                            "pressure_angle_return_deg = 40.0", ""),
                                   "radius_of_curvature_mm    = 2.0", "")),
              HasSubstr("there is no limit"));
}

}  // namespace
}  // namespace linkwright::planar
