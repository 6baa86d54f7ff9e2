// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using testing::HasSubstr;

// Two wheels on the frame, 400 mm apart, with a load of -1.5 N m on the second one.
std::string two_wheels(const std::string& pair) {
  return R"(
schema = 1
kind   = "analysis"

[mechanism]
type = "planar.linkage"

[[mechanism.body]]
name      = "frame"
points_mm = { A = [0, 0], B = [400, 0] }

[[mechanism.body]]
name          = "first"
points_mm     = { A = [0, 0] }
mass_kg       = 1.0
inertia_kg_m2 = 1e-3

[[mechanism.body]]
name          = "second"
points_mm     = { B = [0, 0] }
mass_kg       = 1.0
inertia_kg_m2 = 1e-3

[[mechanism.joint]]
name   = "A"
first  = "frame.A"
second = "first.A"

[[mechanism.joint]]
name   = "B"
first  = "frame.B"
second = "second.B"

)" + pair +
         R"(
[[mechanism.torque]]
name       = "load"
body       = "second"
from       = "frame"
torque_N_m = -1.5

[drive]
joint     = "A"
speed_rpm = 60.0

[[sweep.input]]
joint    = "A"
from_deg = 0.0
to_deg   = 360.0
samples  = 13
)";
}
std::string belt(const std::string& second, const std::string& more) {
  return two_wheels("[[mechanism.belt]]\nname = \"belt\"\nwheels = [{ at = \"first.A\", radius_mm = 100 }, " +
                    second + "]\n" + more + "\n");
}
std::string gear(const std::string& keys) {
  return two_wheels(
      "[[mechanism.joint]]\nname = \"teeth\"\ntype = \"gear\"\nfirst = \"first.A\"\nsecond = \"second.B\"\n" +
      keys + "\n");
}
const std::string small = "{ at = \"second.B\", radius_mm = 50 }",
                  crossed = "{ at = \"second.B\", radius_mm = 50, side = \"outside\" }";

double last(const study::Result& r, const char* key) {
  const Column* column = r.tables[0].find(key);
  return column ? column->values.back() : nan;
}

TEST(LinkagePairs, BeltsAreRead) {
  const study::Result open = run_text(belt(small, "tension_N = 100\nlength_mm = 1277.4970745"));
  EXPECT_NEAR(last(open, "second_angle_rad"), 2 * full_turn, 1e-12);
  EXPECT_NEAR(last(open, "belt_first_second_tension_N"), 85, 1e-10);
  EXPECT_NEAR(last(open, "belt_second_first_tension_N"), 115, 1e-10);
  EXPECT_EQ(open.scenes[0].circles[0].name, "belt on first");
  const study::Result other = run_text(belt(crossed, "tension_N = 10"));
  EXPECT_NEAR(last(other, "second_angle_rad"), -2 * full_turn, 1e-12);
  ASSERT_EQ(other.diagnostics.size(), 1u);
  EXPECT_EQ(to_string(other.diagnostics[0].message),
            "strand second-first of 'belt' becomes slack at 0°: it needs a tension of 15 N, and has 10 N");
}
// A chain moves as many links as its wheels have teeth, so that their numbers give the ratio exactly.
TEST(LinkagePairs, ChainsHaveTheRatioOfTheirTeeth) {
  const study::Result r = run_text(
      two_wheels("[[mechanism.belt]]\nname = \"chain\"\npitch_mm = 12.7\n"
                 "wheels = [{ at = \"first.A\", teeth = 20 }, { at = \"second.B\", teeth = 10 }]\n"));
  EXPECT_NEAR(last(r, "second_angle_rad"), 2 * full_turn, 1e-12);
  const double on_pitch_circles = std::sin(pi / 10) / std::sin(pi / 20);
  EXPECT_GT(std::abs(on_pitch_circles - 2), 0.02);
}
TEST(LinkagePairs, ProblemsOfBeltsAreNamed) {
  EXPECT_THAT(
      problems_of(belt(small, "length_mm = 1300")),
      HasSubstr("belt 'belt' is 1277.497 mm long over its wheels, not 1300 mm; move a wheel, or leave the "
                "length out"));
  EXPECT_THAT(
      problems_of(belt("{ at = \"second.B\", radius_mm = 350, side = \"outside\" }", "")),
      HasSubstr("wheels of belt 'belt' overlap: distance 400 mm, radii 100 and 350 mm; move them apart; "
                "crossed belts need more than the sum"));
  EXPECT_THAT(
      problems_of(belt(small, "closed = false\ntension_N = 3")),
      HasSubstr("the tension of 'belt' follows from its loads; leave it out: only a closed belt on one "
                "carrier has a tension of its own"));
  EXPECT_THAT(problems_of(belt("{ at = \"second.B\", teeth = 20 }", "")),
              HasSubstr("belt 'belt' has teeth but no pitch; give the pitch of the chain, or radii"));
  EXPECT_THAT(problems_of(belt("{ at = \"second.C\", radius_mm = 20 }", "")),
              HasSubstr("body 'second' has no point 'C'"));
}
TEST(LinkagePairs, GearsLosePowerAndTellTheirFlank) {
  // The load drives, and the first wheel gets nine tenths of 1.5 N m over 3.
  const study::Result r = run_text(gear("teeth = [20, 60]\nefficiency = 0.9\nmodule_mm = 10"));
  EXPECT_NEAR(last(r, "A_drive_torque_N_m"), -0.45, 1e-12);
  EXPECT_EQ(last(r, "teeth_flank"), -1);
  std::string messages;
  EXPECT_TRUE(prepare(gear("teeth = [20, 60]\nmodule_mm = 9.4"), messages));
  EXPECT_THAT(messages,
              HasSubstr("the centres of gear 'teeth' are 400 mm apart, 6.38 % off the 376 mm of its teeth, "
                        "which then press at 27.96 deg"));
  EXPECT_THAT(problems_of(gear(
                  "ratio = -1\nratio_curve = { first_deg = [0, 60, 360], second_deg = [0, -80, -360] }")),
              HasSubstr("gear 'teeth' has ratio and a ratio curve; leave one"));
}
TEST(LinkagePairs, RatioCurvesAreRead) {
  const study::Result r =
      run_text(gear("ratio_curve = { first_deg = [0, 60, 120, 180, 240, 300, 360], "
                    "second_deg = [0, -80, -130, -180, -230, -280, -360] }"));
  EXPECT_NEAR(last(r, "second_angle_rad"), -full_turn, 1e-12);
}

std::string screw(const std::string& keys) {
  return R"(
schema = 1
kind   = "analysis"

[mechanism]
type = "planar.linkage"

[[mechanism.body]]
name      = "frame"
points_mm = { A = [0, 0] }

[[mechanism.body]]
name          = "nut"
points_mm     = { A = [0, 0] }
mass_kg       = 1.0
inertia_kg_m2 = 1e-3

[[mechanism.joint]]
name   = "screw"
type   = "screw"
first  = "frame.A"
second = "nut.A"
)" + keys +
         R"(

[[mechanism.force]]
name    = "load"
point   = "nut.A"
force_N = [-10000.0, 0.0]

[drive]
joint         = "screw"
speed_m_per_s = 0.01

[[sweep.input]]
joint   = "screw"
from_mm = 0.0
to_mm   = 100.0
samples = 5
)";
}
TEST(LinkagePairs, ScrewsDriveSlides) {
  const study::Result r = run_text(screw("lead_mm = 2.5\npitch_diameter_mm = 18.376\nfriction = 0.15"));
  EXPECT_NEAR(last(r, "screw_spindle_angle_rad"), 40 * full_turn, 1e-10);
  EXPECT_NEAR(last(r, "screw_spindle_torque_N_m"), 20.04329443848127, 1e-9);
  // The same by turns of the spindle, and back.
  std::string turns = screw("lead_mm = 2.5\npitch_diameter_mm = 18.376\nfriction = 0.15");
  turns = replaced(turns, "speed_m_per_s = 0.01", "speed_rpm = 240");
  turns = replaced(turns, "from_mm = 0.0\nto_mm   = 100.0", "from_deg = 0\nto_deg = 14400");
  const study::Result raised = run_text(turns);
  EXPECT_NEAR(last(raised, "screw_spindle_speed_rad_per_s"), 8 * pi, 1e-12);
  EXPECT_NEAR(last(raised, "screw_displacement_m"), 0.1, 1e-15);
  EXPECT_NEAR(last(raised, "screw_spindle_torque_N_m"), 20.04329443848127, 1e-9);
  const study::Result lowered = run_text(replaced(turns, "speed_rpm = 240", "speed_rpm = -240"));
  EXPECT_NEAR(last(lowered, "screw_spindle_torque_N_m"), -11.846353709539015, 1e-9);
  EXPECT_EQ(fact(r, "efficiency of screw"), "0.1985 against the load; margin of self-locking 4");
  EXPECT_THAT(problems_of(screw("")),
              HasSubstr("screw 'screw' has no lead; give the displacement for one turn of the spindle"));
  EXPECT_THAT(problems_of(screw("lead_mm = 2\nfriction = 0.1")),
              HasSubstr("its screw has friction but no pitch diameter: its torque would be that of none"));
}
// Forces that move a screw would have to overcome its thread and turn its spindle.
TEST(LinkagePairs, ScrewsThatForcesMoveHaveNoThread) {
  const auto simulated = [](const std::string& keys) {
    std::string text = replaced(screw("lead_mm = 2.5\n" + keys), "\"analysis\"", "\"simulation\"");
    text.resize(text.find("[drive]"));
    return text + "[drive]\njoint = \"screw\"\nfree = true\n[simulation]\nto_s = 0.1\n";
  };
  EXPECT_EQ(run_text(simulated("")).status, Status::done);
  EXPECT_THAT(problems_of(simulated("spindle_inertia_kg_m2 = 1e-4")),
              HasSubstr("screw 'screw' has no drive with a law"));
  EXPECT_THAT(problems_of(simulated("pitch_diameter_mm = 18\nfriction = 0.1")),
              HasSubstr("leave out its friction and the inertia of its spindle"));
}

}  // namespace
}  // namespace linkwright::planar
