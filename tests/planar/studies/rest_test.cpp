// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/rest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using testing::HasSubstr;

std::string template_text() { return std::string(rest_kind().example); }

TEST(RestStudy, TellsPositionsWithTheirFrequencies) {
  const study::Result result = run_text(template_text());
  ASSERT_EQ(result.status, Status::done);
  const std::vector<double>& stable = column(result, "rest", "stable");
  ASSERT_EQ(result.statistics.find("stable")->as_number(), 1);
  EXPECT_THAT(to_string(result.headline), HasSubstr("O rests stably at"));
  EXPECT_EQ(stable.size(), column(result, "rest", "frequency_Hz").size());
  EXPECT_THAT(fact(result, "range"), HasSubstr("-80"));
  ASSERT_EQ(result.scenes.size(), 1u);
  EXPECT_EQ(result.scenes[0].input.size(), stable.size());
  EXPECT_FALSE(column(result, "forces", "torque_N_m").empty());
}

// The lamp of the examples: its first arm alone is free.
std::string two_arms() {
  return replaced(
      replaced(template_text(), "[[mechanism.joint]]",
               "[[mechanism.body]]\nname = \"hand\"\npoints_mm = { B = [0, 0], C = [200, 0] }\nmass_kg = "
               "0.3\n[[mechanism.joint]]\nname = \"B\"\nfirst = \"arm.B\"\nsecond = \"hand.B\"\n"
               "[[mechanism.joint]]"),
      "[rest]", "[[drive]]\njoint = \"B\"\nstart_deg = -90.0\n[rest]");
}

// A toggle clamp, 40 and 60 mm, that 800 N press onto a stop 3 degrees past its dead centre.
const std::string clamp = R"(
schema = 1
kind   = "rest"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name      = "frame"
points_mm = { O = [0, 0] }
[[mechanism.body]]
name      = "crank"
points_mm = { O = [0, 0], A = [40, 0] }
mass_kg   = 0.0
[[mechanism.body]]
name      = "rod"
points_mm = { A = [0, 0], B = [60, 0] }
mass_kg   = 0.0
[[mechanism.body]]
name      = "plunger"
points_mm = { B = [0, 0] }
mass_kg   = 0.0
[[mechanism.joint]]
name   = "O"
first  = "frame.O"
second = "crank.O"
[[mechanism.joint]]
name   = "A"
first  = "crank.A"
second = "rod.A"
[[mechanism.joint]]
name   = "B"
first  = "rod.B"
second = "plunger.B"
[[mechanism.joint]]
name   = "guide"
type   = "prismatic"
first  = "frame.O"
second = "plunger.B"
[[mechanism.assembly]]
bodies = ["rod", "plunger"]
mode   = "plus"
[[mechanism.force]]
name    = "work piece"
point   = "plunger.B"
force_N = [-800, 0]
[[mechanism.stop]]
joint        = "O"
at_least_deg = -3.0
at_most_deg  = 90.0
arm_mm       = 30.0
[[drive]]
joint = "O"
free  = true
)";

TEST(RestStudy, AClampRestsOnItsStops) {
  const study::Result result = run_text(clamp);
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  ASSERT_EQ(result.tables[0].rows(), 3u);  // either stop, and the dead centre between them
  EXPECT_NEAR(column(result, "rest", "O_angle_rad")[0], -3 * pi / 180, 1e-12);
  EXPECT_NEAR(column(result, "rest", "stop_torque_N_m")[0], 2.7904001530881977, 1e-10);
  EXPECT_NEAR(column(result, "rest", "stop_force_N")[0], 93.01333843627326, 1e-8);
  EXPECT_TRUE(std::isnan(column(result, "rest", "stop_force_N")[1]));
  EXPECT_EQ(fact(result, "rest position 1"),
            "-3°: pressed with 2.7904 N m, 93.013338 N at its arm, on the stop of O");
}

// The same clamp turned by a drive: the row on the stop has what the stop carries without the drive, and
// beyond it no sweep goes.
TEST(RestStudy, AnAnalysisEndsAtTheStop) {
  std::string text = replaced(clamp, "\"rest\"", "\"analysis\"");
  text = replaced(text, "free  = true", "speed_rpm = 1.0");
  const auto swept = [&](const std::string& from) {
    return text + "[[sweep.input]]\njoint = \"O\"\nfrom_deg = " + from + "\nto_deg = 10.0\nsamples = 14\n";
  };
  const study::Result result = run_text(swept("-3.0"));
  ASSERT_EQ(result.status, Status::done);
  const std::vector<double>& force = column(result, "O_lower_stop_force_N");
  EXPECT_NEAR(force[0], 93.01333843627326, 1e-8);
  EXPECT_EQ(force[1], 0);
  // One that gives way pushes back where the joint is beyond it, and the drive has the less to do.
  const auto drive_at_4 = [&](const std::string& stop) {
    text = replaced(text, "arm_mm       = 30.0", stop);
    return run_text(swept("-4.0"));
  };
  const study::Result soft = drive_at_4("stiffness_N_m_per_rad = 100"), softer = [&] {
    text = replaced(text, "stiffness_N_m_per_rad = 100", "stiffness_N_m_per_rad = 1e-9");
    return run_text(swept("-4.0"));
  }();
  const double push = 100 * pi / 180;
  EXPECT_NEAR(column(soft, "O_lower_stop_torque_N_m")[0], push, 1e-9);
  EXPECT_NEAR(column(softer, "O_drive_torque_N_m")[0] - column(soft, "O_drive_torque_N_m")[0], push, 1e-9);
  text = replaced(text, "stiffness_N_m_per_rad = 1e-9", "");
  EXPECT_THAT(problems_of(swept("-4.0")), HasSubstr("the drive of 'O' presses on its stop at -3"));
}

TEST(RestStudy, OtherJointsAreHeld) {
  const study::Result result = run_text(two_arms());
  ASSERT_EQ(result.status, Status::done);
  EXPECT_GE(result.tables[0].rows(), 1u);
  EXPECT_THAT(problems_of(replaced(two_arms(), "free  = true", "")), HasSubstr("no joint is free to move"));
}

TEST(RestStudy, SeveralFreeJointsAreSearchedFromAGrid) {
  std::string text = replaced(two_arms(), "start_deg = -90.0", "free = true");
  EXPECT_THAT(problems_of(text), HasSubstr("it is for one free joint, and 2 are free"));
  text = replaced(replaced(text, "from_deg = -80.0", "starts = 10"), "to_deg   = 80.0", "");
  const study::Result result = run_text(text);
  ASSERT_EQ(result.status, Status::done);
  EXPECT_THAT(fact(result, "search"), HasSubstr("100 starts"));
  const std::vector<double>& stable = column(result, "rest", "stable");
  ASSERT_GE(stable.size(), 4u);
  EXPECT_EQ(column(result, "rest", "vibration_2_frequency_Hz").size(), stable.size());
  EXPECT_THAT(to_string(result.headline), HasSubstr("rest positions"));
  const std::string stop = "[[mechanism.stop]]\njoint = \"B\"\nat_least_deg = 10\n[rest]";
  const study::Result stopped = run_text(replaced(text, "[rest]", stop));
  ASSERT_EQ(stopped.status, Status::done) << lines_of(stopped.diagnostics);
  EXPECT_THAT(fact(stopped, "rest position 1"), HasSubstr("lower stop pushes with"));
  EXPECT_THAT(problems_of(replaced(text, "starts = 10", "starts = 2000")), HasSubstr("at most 1000"));
  EXPECT_THAT(problems_of(replaced(template_text(), "from_deg = -80.0", "from_deg = -80.0\nstarts = 9")),
              HasSubstr("they are for several free joints"));
}

TEST(RestStudy, TellsBandsOfFrictionAndPathsOfLoads) {
  const study::Result bonnet = run_text(example_text("bonnet-gas-spring.toml")),
                      truss = run_text(example_text("snap-through-truss.toml"));
  EXPECT_THAT(fact(bonnet, "held by friction"), HasSubstr("from 22.709558\xC2\xB0 to 55.120136"));
  EXPECT_EQ(column(bonnet, "bands", "from_rad").size(), 1u);
  const double length = std::cbrt(0.5 * 0.4 * 0.4),
               critical = 2 * 2000 * (0.5 / length - 1) * std::sqrt(length * length - 0.4 * 0.4);
  const std::vector<double>&factor = column(truss, "load_path", "load_factor"),
        &height = column(truss, "load_path", "guide_displacement_m");
  double peak = 0;
  for (std::size_t i = 0; i < height.size(); ++i)
    if (height[i] > 0) peak = std::max(peak, factor[i]);
  EXPECT_NEAR(peak, critical / 120, 1e-5);
  EXPECT_THAT(fact(truss, "as the load grows 2"), HasSubstr("where it snaps with 0.8565"));
  EXPECT_THAT(problems_of(replaced(template_text(), "from_deg = -80.0", "from_deg = -80.0\nload = \"push\"")),
              HasSubstr("push"));
}

TEST(RestStudy, WrongInputIsNamed) {
  const auto wrong = [](const std::string& what, const std::string& by) {
    return problems_of(replaced(template_text(), what, by));
  };
  EXPECT_THAT(wrong("to_deg   = 80.0", ""), HasSubstr("the range has one end alone"));
  EXPECT_THAT(wrong("to_deg   = 80.0", "to_deg = -90"), HasSubstr("the range ends before it begins"));
  EXPECT_THAT(wrong("[rest]",
                    "[[mechanism.torque]]\nname = \"t\"\nbody = \"arm\"\ntorque_N_m = 1.0\nagainst = "
                    "\"time\"\nargument = [0, 1]\nfactor = [0, 1]\n[rest]"),
              HasSubstr("torque 't' goes by time"));
}

TEST(RestStudy, SaysWhereNothingRests) {
  const std::string fallen =
      replaced(template_text(), "stiffness_N_per_mm = 0.22", "stiffness_N_per_mm = 0.0");
  const study::Result pressed = run_text(fallen);
  EXPECT_EQ(to_string(pressed.headline), "O rests at the ends of its range alone, at -80°.");
  const std::string driven =
      replaced(replaced(replaced(fallen, "from_deg = -80.0", ""), "to_deg   = 80.0", ""), "[rest]",
               "[[mechanism.torque]]\nname = \"t\"\nbody = \"arm\"\ntorque_N_m = 20.0\n[rest]");
  const study::Result nothing = run_text(driven);
  EXPECT_THAT(to_string(nothing.headline),
              HasSubstr("Nothing rests from -180 deg to 180 deg: the torque goes from"));
  EXPECT_THAT(lines_of(nothing.diagnostics), HasSubstr("add a stop, or a spring"));
}

}  // namespace
}  // namespace linkwright::planar
