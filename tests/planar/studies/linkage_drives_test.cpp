// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/linkage_drives.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "linkwright/core/numbers.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using testing::HasSubstr;

// A balanced wheel that runs up, stays and runs down: the torque is its inertia times the acceleration.
std::string wheel(const std::map<std::string, std::string>& changed) {
  return text_of(
      {{"1", R"(
schema = 1
kind   = "analysis"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name      = "frame"
points_mm = { O = [0, 0] }
[[mechanism.body]]
name          = "wheel"
points_mm     = { O = [0, 0] }
mass_kg       = 3
centre_mm     = [0, 0]
inertia_kg_m2 = 0.5
[[mechanism.joint]]
name   = "O"
first  = "frame.O"
second = "wheel.O"
)"},
       {"2",
        "[drive]\njoint = \"O\"\nlaw = \"polynomial_345\"\nfrom_deg = 0\nto_deg = 180\nduration_s = 1\n"},
       {"3", "[sweep]\ntype = \"time\"\n[sweep.time]\nto_s = 1.25\nsamples = 2501\n"},
       {"4",
        "[[motor]]\nname = \"small\"\nrated_torque_N_m = 0.1\npeak_torque_N_m = 0.4\nmax_speed_rpm = 3000\n"
        "gear_ratio = [10, 20, 100]\n"
        "[[motor]]\nname = \"large\"\nrated_torque_N_m = 0.8\npeak_torque_N_m = 2.0\nmax_speed_rpm = 3000\n"
        "inertia_kg_m2 = 1e-3\ngear_ratio = [10, 20, 100]\n"}},
      changed);
}

TEST(LinkageDrives, MotorsAreJudgedByTorqueAndSpeed) {
  const study::Result result = run_text(wheel({}));
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  const Table& motors = *result.table("motors");
  ASSERT_EQ(motors.rows(), 6u);
  EXPECT_EQ(motors.names[3], "large at O, gear ratio 10");
  // The mean square of the acceleration of 10 x^3 - 15 x^4 + 6 x^5 is 120/7; a fifth of the time is rest.
  const double rms = pi * std::sqrt(120.0 / 7 / 1.25), peak = pi * 10 / std::sqrt(3.0);
  EXPECT_NEAR(motors.find("rms_torque_N_m")->values[0], 0.5 * rms / 10, 1e-6);
  EXPECT_NEAR(motors.find("peak_torque_N_m")->values[0], 0.5 * peak / 10, 1e-5);
  EXPECT_NEAR(motors.find("rms_torque_N_m")->values[4], (0.5 / 20 + 1e-3 * 20) * rms, 1e-6);
  EXPECT_NEAR(motors.find("peak_speed_rad_per_s")->values[4], 20 * pi * 15 / 8, 1e-5);
  EXPECT_NEAR(motors.find("inertia_ratio")->values[4], 0.5 / 400 / 1e-3, 1e-12);
  EXPECT_TRUE(std::isnan(motors.find("inertia_ratio")->values[0]));
  EXPECT_EQ(motors.find("fits")->values, (std::vector<double>{0, 0, 0, 1, 1, 0}));
  EXPECT_THAT(fact(result, "motor of O"),
              HasSubstr("'large' with gear ratio 10: 87.3 % of its rated torque"));
  EXPECT_TRUE(std::any_of(result.plots.begin(), result.plots.end(),
                          [](const study::Plot& p) { return p.name == "motor-O" && p.bands.size() == 2; }));
}

TEST(LinkageDrives, LimitsAreReportedWithTheirPlace) {
  const study::Result result = run_text(
      wheel({{"2",
              "[drive]\njoint = \"O\"\nlaw = \"polynomial_345\"\nfrom_deg = 0\nto_deg = 180\nduration_s = 1\n"
              "highest_deg = 170\nspeed_limit_rad_per_s = 5\ntorque_limit_N_m = 20\n"},
             {"4", ""}}));
  EXPECT_EQ(fact(result, "limits of the drives"),
            "not kept; speed of O reaches 117.8 % of its limit at 0.5 s");
  const Table& limits = *result.table("drive_limits");
  ASSERT_EQ(limits.names, (std::vector<std::string>{"greatest value of O", "speed of O", "torque of O"}));
  EXPECT_NEAR(limits.find("share")->values[1], pi * 15 / 8 / 5, 1e-6);
  EXPECT_EQ(result.troubles.size(), 2u);
}

// A sweep of one drive at a constant speed is a motion in time, one over positions alone is none.
TEST(LinkageDrives, SaysWhatIsWrong) {
  const std::string grid = "[[sweep.input]]\njoint = \"O\"\nfrom_deg = 0\nto_deg = 360\nsamples = 37\n";
  EXPECT_THAT(problems_of(wheel({{"2", "[drive]\njoint = \"O\"\n"}, {"3", grid}})),
              HasSubstr("a motor is chosen for a motion in time; the drive has no constant speed"));
  const study::Result turning =
      run_text(wheel({{"2", "[drive]\njoint = \"O\"\nspeed_rpm = 60\n"}, {"3", grid}}));
  EXPECT_NEAR(turning.table("motors")->find("peak_speed_rad_per_s")->values[1], 20 * full_turn, 1e-12);
  EXPECT_THAT(problems_of(wheel({{"4",
                                  "[[motor]]\nname = \"M\"\nrated_torque_N_m = 2\npeak_torque_N_m = 1\n"
                                  "max_speed_rpm = 3000\n"}})),
              HasSubstr("the peak torque of 'M' is 1 N m, its rated torque 2 N m"));
  EXPECT_THAT(
      problems_of(wheel({{"4", "[[motor]]\nname = \"M\"\nrated_torque_N_m = 2\nmax_speed_rpm = 3000\n"}})),
      HasSubstr("peak_torque"));
}

}  // namespace
}  // namespace linkwright::planar
