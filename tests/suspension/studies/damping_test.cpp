// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/damping.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "suspension/pushrod_study.h"

namespace linkwright::suspension {
namespace {

using test::column;
using test::problems_of;
using test::pushrod_study;
using test::replaced;
using test::run_text;
using ::testing::HasSubstr;

const std::string one_damping = "damping_N_s_per_m = 3000";
const std::string damper_curve =
    "curve = { speed_m_per_s = [-0.4, -0.1, 0.1, 0.4], force_N = [-1300, -500, 180, 390] }";

// The power at the wheel is that of the damper, and the force is that of the curve at the damper's speed.
TEST(Damping, DamperWithACurveAtSpeedsOfTheWheel) {
  const study::Result result = run_text(replaced(pushrod_study, one_damping, damper_curve) +
                                        "wheel_speeds_m_per_s = [-0.25, -0.1, 0.1, 0.5]\n");
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  const Table& table = *result.table("damping");
  ASSERT_EQ(table.rows(), 20U);
  const auto at = [&](std::string_view key, std::size_t row) { return table.find(key)->values.at(row); };
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_NEAR(at("damper_force_N", i) * at("damper_speed_m_per_s", i),
                at("wheel_damper_force_N", i) * at("wheel_speed_m_per_s", i), 1e-9);
    EXPECT_NEAR(at("damper_speed_m_per_s", i),
                -column(result, "spring_length_by_travel").at(i / 4) * at("wheel_speed_m_per_s", i), 1e-12);
    EXPECT_NEAR(at("wheel_damping_N_s_per_m", i) * at("wheel_speed_m_per_s", i),
                at("wheel_damper_force_N", i), 1e-9);
    EXPECT_NEAR(at("damping_ratio", i),
                at("wheel_damping_N_s_per_m", i) /
                    (2 * std::sqrt(70 * column(result, "total_wheel_rate_N_per_m").at(i / 4))),
                1e-12);
  }
  // At design 0.5 m/s of the wheel are 0.398 m/s of the damper. Its cubic from (0.1, 180) to (0.4, 390) has
  // the weighted harmonic mean of 1800 and 700 N s/m as its first slope, the last secant as the other one.
  const double v = 0.5 * 0.79637970, t = (v - 0.1) / 0.3, share = (0.1 + 0.6) / (3 * 0.4),
               first = 1800.0 * 700 / (share * 700 + (1 - share) * 1800);
  const double cubic = 180 * (1 + 2 * t) * (1 - t) * (1 - t) + 390 * t * t * (3 - 2 * t) +
                       0.3 * (first * t * (1 - t) * (1 - t) - 700 * t * t * (1 - t));
  EXPECT_NEAR(at("damper_force_N", 11), cubic, 1e-4);
  EXPECT_NEAR(at("wheel_damping_N_s_per_m", 11), cubic * 0.79637970 / 0.5, 1e-4);
  EXPECT_EQ(result.tables.at(0).find("wheel_damping_N_s_per_m"), nullptr);  // one number does not describe it
  EXPECT_NE(test::fact(result, "damping ratio at 0.1 m/s of the wheel, rising"), "no fact");
}

TEST(Damping, SpeedsOfTheWheelAreByDefaultThoseOfTheCurve) {
  const study::Result result = run_text(replaced(pushrod_study, one_damping, damper_curve));
  const Table& table = *result.table("damping");
  ASSERT_EQ(table.rows(), 20U);
  for (std::size_t i = 0; i < 4; ++i) {  // at design
    const double force = std::array{-1300.0, -500.0, 180.0, 390.0}.at(i);
    EXPECT_NEAR(table.find("damper_force_N")->values.at(8 + i), force, 1e-9);
    EXPECT_NEAR(table.find("wheel_damper_force_N")->values.at(8 + i), force * 0.79637970, 1e-4);
  }
  // With one damping number the secant and the slope are the same.
  const study::Result linear = run_text(pushrod_study + "wheel_speeds_m_per_s = [-1, 2]\n");
  for (const char* key : {"wheel_damping_N_s_per_m", "wheel_damping_slope_N_s_per_m"})
    for (std::size_t i = 0; i < 10; ++i)
      EXPECT_NEAR(linear.table("damping")->find(key)->values.at(i),
                  column(linear, "wheel_damping_N_s_per_m").at(i / 2), 1e-9);
  EXPECT_EQ(run_text(pushrod_study).table("damping"), nullptr);
}

TEST(Damping, WheelSpeedsThatMakeNoSense) {
  EXPECT_THAT(problems_of(replaced(pushrod_study, one_damping, "") + "wheel_speeds_m_per_s = [0.1]\n"),
              HasSubstr("ride.wheel_speeds_m_per_s: there is no damper whose force is known; write "
                        "damping_N_s_per_m or a curve in [mechanism.damper]"));
  EXPECT_THAT(problems_of(pushrod_study + "wheel_speeds_m_per_s = [0.1, 0.0]\n"),
              HasSubstr("ride.wheel_speeds_m_per_s: has 0, at which nothing is damped"));
}

}  // namespace
}  // namespace linkwright::suspension
