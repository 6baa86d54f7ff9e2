// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/detail/slot_track.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

TEST(SlotTracks, ArcRunsFromItsBeginning) {
  CurvedSlot slot{.points = {}, .centre = {1, 2}, .radius = 0.5, .from = pi / 2, .to = 0};
  const SlotTrack track(slot);
  EXPECT_DOUBLE_EQ(track.length(), pi / 4);
  const SlotPlace place = track.nearest({1 + std::cos(pi / 4), 2 + std::sin(pi / 4)});
  EXPECT_NEAR(place.way, pi / 8, 1e-15);
  EXPECT_NEAR(place.curvature, -2, 1e-15);  // clockwise
  EXPECT_NEAR(place.tangent.x, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(place.tangent.y, -std::sqrt(0.5), 1e-15);
  EXPECT_EQ(place.beyond, 0);
  const SlotPlace outside = track.nearest({1.5, 1.9});
  EXPECT_NEAR(outside.beyond, 0.1, 1e-15);
  EXPECT_NEAR(outside.way, pi / 4 + 0.1, 1e-15);
}

TEST(SlotTracks, SplineThroughACircleHasItsLengthAndCurvature) {
  CurvedSlot slot{.points = {}, .closed = true};
  for (int i = 0; i < 48; ++i) slot.points.push_back(std::polar(2.0, i * full_turn / 48));
  const SlotTrack track(slot);
  EXPECT_NEAR(track.length(), 4 * pi, 1e-8);
  for (double angle = 0.01; angle < full_turn; angle += 0.1) {
    const SlotPlace place = track.nearest(1.7 * math::unit(angle));
    EXPECT_NEAR(place.way, 2 * angle, 1e-7);
    EXPECT_NEAR(place.curvature, 0.5, 1e-5);
    EXPECT_NEAR(cross(place.at, math::unit(angle)), 0, 1e-8);
  }
}

/// A crank A0-A of 30 mm and a coupler A-B of 90 mm whose end B is guided by `guide`: bodies and joints.
std::string guided(const std::string& guide) {
  return R"(
schema = 1
kind = "analysis"
[mechanism]
type = "planar.linkage"
drawn = true
[[mechanism.body]]
name = "frame"
points_mm = { A0 = [0, 0], B0 = [100, 10] }
[[mechanism.body]]
name = "crank"
points_mm = { A0 = [0, 0], A = [0, 30] }
mass_kg = 0.4
[[mechanism.body]]
name = "coupler"
points_mm = { A = [0, 30], B = [72.7368493, 83.0003218] }
mass_kg = 0.7
[[mechanism.joint]]
name = "A0"
first = "frame.A0"
second = "crank.A0"
[[mechanism.joint]]
name = "A"
first = "crank.A"
second = "coupler.A"
[[drive]]
joint = "A0"
speed_rpm = 60
[[sweep.input]]
joint = "A0"
from_deg = 0
to_deg = 350
samples = 36
[[trace]]
point = "coupler.B"
[[mechanism.force]]
name = "load"
point = "coupler.B"
force_N = [-40, 15]
)" + guide;
}
const std::string link = R"(
[[mechanism.body]]
name = "rocker"
points_mm = { B0 = [100, 10], B = [72.7368493, 83.0003218] }
mass_kg = 0
inertia_kg_m2 = 0
[[mechanism.joint]]
name = "B0"
first = "frame.B0"
second = "rocker.B0"
[[mechanism.joint]]
name = "B"
first = "rocker.B"
second = "coupler.B"
)";
std::string slot_with(const std::string& curve) {
  return "[[mechanism.joint]]\nname = \"B\"\ntype = \"pin_in_slot\"\nfirst = \"frame\"\nsecond = "
         "\"coupler.B\"\ncurve = { " +
         curve + " }\n";
}

TEST(CurvedSlots, AnArcActsAsALinkOfItsRadius) {
  const double radius = std::hypot(72.7368493 - 100, 83.0003218 - 10);
  const study::Result by_link = test::run_text(guided(link)),
                      by_slot = test::run_text(guided(
                          slot_with("centre_mm = [100, 10], radius_mm = " + fmt::format("{:.17g}", radius))));
  ASSERT_EQ(by_link.status, Status::done);
  ASSERT_EQ(by_slot.status, Status::done);
  for (const char* key : {"coupler_B_x_m", "coupler_B_y_m", "coupler_angle_rad", "coupler_speed_rad_per_s",
                          "coupler_acceleration_rad_per_s2", "coupler_B_acceleration_x_m_per_s2", "B_x_N",
                          "B_y_N", "A_x_N", "A_y_N", "A0_x_N", "A0_drive_torque_N_m"}) {
    const auto &a = test::column(by_link, "sweep", key), &b = test::column(by_slot, "sweep", key);
    const double size = test::largest(a);
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_NEAR(a[i], b[i], 1e-12 * size) << key << " in row " << i;
  }
}

TEST(CurvedSlots, CoordinateIsTheLengthAlongTheCurve) {
  const study::Result result = test::run_text(
      guided(slot_with("points_mm = [[40, 90], [60, 88], [80, 80], [100, 66], [120, 60], [140, 66]]")));
  const auto &way = test::column(result, "sweep", "B_displacement_m"),
             &speed = test::column(result, "sweep", "B_speed_m_per_s"),
             &vx = test::column(result, "sweep", "coupler_B_speed_x_m_per_s"),
             &vy = test::column(result, "sweep", "coupler_B_speed_y_m_per_s"),
             &power = test::column(result, "sweep", "drive_power_W"),
             &load = test::column(result, "sweep", "load_power_W"),
             &weight = test::column(result, "sweep", "weight_power_W"),
             &kinetic = test::column(result, "sweep", "kinetic_power_W");
  int rows = 0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (std::isnan(speed[i])) continue;
    ++rows;
    EXPECT_NEAR(std::abs(speed[i]), std::hypot(vx[i], vy[i]), 1e-12);
    EXPECT_NEAR(power[i] + load[i] + weight[i], kinetic[i], 1e-10);
    EXPECT_GE(way[i], 0);
  }
  EXPECT_GT(rows, 10);
}

TEST(CurvedSlots, RatesAreDerivativesOfThePlaces) {
  // Over a small range, differences of the fourth order.
  std::string text =
      guided(slot_with("points_mm = [[40, 90], [60, 88], [80, 80], [100, 66], [120, 60], [140, 66]]"));
  text = test::replaced(
      test::replaced(test::replaced(text, "from_deg = 0", "from_deg = 10"), "to_deg = 350", "to_deg = 10.4"),
      "samples = 36", "samples = 5");
  const study::Result result = test::run_text(text);
  ASSERT_EQ(result.status, Status::done);
  const double step = 0.1 * pi / 180 / (2 * pi);  // s between rows, at a turn a second
  const auto derivative = [&](const std::vector<double>& y) {
    return (y[0] - 8 * y[1] + 8 * y[3] - y[4]) / (12 * step);
  };
  for (const auto& [place, rate] :
       {std::pair("B_displacement_m", "B_speed_m_per_s"),
        std::pair("B_speed_m_per_s", "B_acceleration_m_per_s2"),
        std::pair("coupler_angle_rad", "coupler_speed_rad_per_s"),
        std::pair("coupler_speed_rad_per_s", "coupler_acceleration_rad_per_s2")}) {
    const double expected = test::column(result, "sweep", rate).at(2);
    EXPECT_NEAR(derivative(test::column(result, "sweep", place)), expected, 1e-7 * (1 + std::abs(expected)))
        << rate;
  }
}

TEST(CurvedSlots, EndWhereTheirCurveEnds) {
  const study::Result result =
      test::run_text(guided(slot_with("points_mm = [[60, 88], [72.7368493, 83.0003218], [80, 80]]")));
  EXPECT_EQ(result.status, Status::no_assembly);
  const Table& sweep = test::table(result, "sweep");
  for (std::size_t i = 0; i < sweep.rows(); ++i) {
    const double way = test::column(result, "sweep", "B_displacement_m").at(i);
    if (sweep.status[i] != "done") continue;
    EXPECT_GE(way, -1e-9);
    EXPECT_LE(way, 0.0217);
  }
}

TEST(CurvedSlots, SayWhatIsWrong) {
  const auto problem = [](const std::string& curve) { return test::problems_of(guided(slot_with(curve))); };
  EXPECT_THAT(problem("points_mm = [[0, 0], [1, 0]]"), HasSubstr("the curve of its slot has 2 points"));
  EXPECT_THAT(problem("points_mm = [[0, 0], [1, 0], [1, 1]]"),
              HasSubstr("its slot turns by 90 deg at point 2: a corner"));
  EXPECT_THAT(problem("points_mm = [[0, 0], [1, 0], [1, 0], [2, 0]]"), HasSubstr("point 2 of its slot"));
  EXPECT_THAT(problem("centre_mm = [0, 0]"), HasSubstr("has no radius"));
  EXPECT_THAT(problem("centre_mm = [0, 0], radius_mm = 3, from_deg = 0"), HasSubstr("has one end"));
  EXPECT_THAT(problem("centre_mm = [0, 0], radius_mm = 3, points_mm = [[0, 0]]"),
              HasSubstr("has points and an arc"));
  EXPECT_THAT(test::problems_of(guided(slot_with("centre_mm = [0, 0], radius_mm = 3") + "friction = 0.1\n")),
              HasSubstr("friction in a curved slot is not computed"));
  EXPECT_THAT(test::problems_of(
                  guided(test::replaced(link, "name = \"B\"", "name = \"B\"\ncurve = { radius_mm = 3 }"))),
              HasSubstr("is not a pin_in_slot, and has a curve"));
}

}  // namespace
}  // namespace linkwright::planar
