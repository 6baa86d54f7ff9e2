// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/linkage_cams.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/study/write.h"
#include "planar/simulations.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using testing::HasSubstr;

constexpr double one_degree = pi / 180;

// A tappet of 1.8 kg under a spring of 15 N/mm with 37.5 N, on a roller, with 1000 rpm; the guide in line.
std::string tappet_study(const std::string& form = "outside", double gravity = 0) {
  return R"(
schema = 1
kind   = "analysis"

[mechanism]
type = "planar.linkage"

[[mechanism.body]]
name      = "frame"
points_mm = { O = [0, 0], S = [0, 100] }

[[mechanism.body]]
name          = "cam"
points_mm     = { O = [0, 0] }
mass_kg       = 0
inertia_kg_m2 = 0
centre_mm     = [0, 0]

[[mechanism.body]]
name          = "tappet"
points_mm     = { R = [0, 0] }
mass_kg       = 1.8
inertia_kg_m2 = 0
centre_mm     = [0, 0]

[[mechanism.joint]]
name   = "shaft"
first  = "frame.O"
second = "cam.O"

[[mechanism.joint]]
name          = "guide"
type          = "prismatic"
first         = "frame.O"
second        = "tappet.R"
direction_deg = 90

[[mechanism.cam]]
name             = "lift"
turns            = "shaft"
moves            = "guide"
contact          = "tappet.R"
roller_radius_mm = 10
base_radius_mm   = 40
form             = ")" +
         form + R"("

[[mechanism.cam.segment]]
law      = "cycloidal"
over_deg = 120
to_mm    = 10

[[mechanism.cam.segment]]
law      = "dwell"
over_deg = 60

[[mechanism.cam.segment]]
law      = "cycloidal"
over_deg = 120
to_mm    = 0

[[mechanism.cam.segment]]
law      = "dwell"
over_deg = 60

[environment]
gravity_m_per_s2 = )" +
         std::to_string(gravity) + R"(

[drive]
joint     = "shaft"
speed_rpm = 1000

[sweep]
type = "grid"

[[sweep.input]]
from_deg = 0
to_deg   = 360
samples  = 721
)";
}
// The spring pulls the tappet down: 150 mm above it is free at 2.5 mm above the base circle.
const std::string tappet_spring = R"(
[[mechanism.strut]]
name        = "spring"
first       = "frame.S"
second      = "tappet.R"
against     = "length"
argument_mm = [0, 100]
force_table_N = [787.5, -712.5]
)";

TEST(LinkageCams, ClassicExerciseHasThePublishedFigures) {
  const study::Result r = run_text(tappet_study() + tappet_spring);
  ASSERT_EQ(r.status, Status::done);
  const Table& sweep = r.tables[0];
  EXPECT_NEAR(sweep.find("shaft_drive_torque_N_m")->values[200], -0.1472694443441289, 1e-12);
  const double contact = sweep.find("lift_contact_N")->values[200],
               pressure = sweep.find("lift_pressure_angle_rad")->values[200];
  EXPECT_NEAR(contact * std::cos(pressure), -61.688080593302175, 1e-9);
  EXPECT_EQ(fact(r, "lift-off speed of lift"), "779.826 rpm, first at 213.093°");
  EXPECT_EQ(fact(r, "base circle of lift"), "40 mm");
  EXPECT_THAT(to_string(r.diagnostics[0].message),
              HasSubstr("the follower of 'lift' lifts off at 213.093° above 779.826 rpm, and the "
                        "drive has 1000 rpm"));
  ASSERT_TRUE(r.table("cam_lift"));
  EXPECT_NEAR(r.table("cam_lift")->find("lift_m")->values[60], 0.005, 1e-15);
}

// The tappet with a second roller across the shaft, on a disc of its own.
std::string conjugate_study() {
  return replaced(replaced(tappet_study("conjugate", 9.81), "points_mm     = { R = [0, 0] }",
                           "points_mm     = { R = [0, 0], L = [-100, 0] }"),
                  "roller_radius_mm = 10",
                  "roller_radius_mm = 10\nsecond_contact = \"tappet.L\"\nsecond_roller_radius_mm = 12");
}

TEST(LinkageCams, ConjugateDiscsShareTheEffortOfAGroove) {
  const study::Result both = run_text(conjugate_study()), groove = run_text(tappet_study("groove", 9.81));
  ASSERT_EQ(both.status, Status::done);
  const auto column = [](const study::Result& r, const char* key) { return r.tables[0].find(key)->values; };
  int on_second = 0;
  for (std::size_t i = 0; i < both.tables[0].rows(); ++i) {
    const double force = column(both, "lift_contact_N")[i], one = column(groove, "lift_contact_N")[i];
    EXPECT_NEAR(force * std::cos(column(both, "lift_pressure_angle_rad")[i]),
                one * std::cos(column(groove, "lift_pressure_angle_rad")[i]), 1e-9 * (1 + std::abs(one)));
    on_second += force < 0;
    EXPECT_NEAR(column(both, "shaft_drive_torque_N_m")[i], column(groove, "shaft_drive_torque_N_m")[i],
                1e-12);
  }
  EXPECT_GT(on_second, 50);
  EXPECT_NE(fact(both, "changes of the carrying disc of lift"), "");
}

TEST(LinkageCams, SecondDiscTouchesTheSecondRoller) {
  const study::Result r = run_text(conjugate_study());
  const Table& disc = *r.table("cam_lift_second_disc");
  const auto &angle = disc.find("cam_angle_rad")->values, &lift = disc.find("lift_m")->values,
             &x = disc.find("profile_x_m")->values, &y = disc.find("profile_y_m")->values;
  for (std::size_t i = 0; i < disc.rows(); ++i) {
    // The centre lies 100 mm below the first one, which is 50 mm above the shaft; the disc is turned back.
    const double below = 0.05 + lift[i] - 0.1;
    const double cx = below * std::sin(angle[i]), cy = below * std::cos(angle[i]);
    EXPECT_NEAR(std::hypot(x[i] - cx, y[i] - cy), 0.012, 1e-14);
    for (std::size_t k = 0; k < disc.rows(); k += 5)
      EXPECT_GT(std::hypot(x[k] - cx, y[k] - cy), 0.012 - 1e-12);
  }
  EXPECT_EQ(fact(r, "base circle of lift second disc"), "38 mm");
}

// Weight holds the lower flank in the dwells; signs of the acceleration and of the weight decide elsewhere.
TEST(LinkageCams, FlanksOfAGrooveChangeWherePublished) {
  const study::Result r = run_text(tappet_study("groove", 9.81));
  EXPECT_EQ(fact(r, "changes of the flank of lift"), "61.1935°, 118.806°, 181.194°, 238.806°");
}

// Segments with conditions, a table, a flat face, a lever that turns.
TEST(LinkageCams, AStudyReadsBackAsItIsWritten) {
  const std::string lever = replaced(
      replaced(replaced(replaced(tappet_study(), "points_mm = { O = [0, 0], S = [0, 100] }",
                                 "points_mm = { O = [0, 0], P = [90, 0] }"),
                        "points_mm     = { R = [0, 0] }", "points_mm     = { P = [0, 0], R = [60, 0] }"),
               "type          = \"prismatic\"\nfirst         = \"frame.O\"\nsecond        = \"tappet.R\"\n"
               "direction_deg = 90",
               "first = \"frame.P\"\nsecond = \"tappet.P\""),
      "to_mm    = 10", "to_deg   = 10");
  const std::string turning = replaced(lever, "to_mm    = 0", "to_deg   = 0");
  const std::string table =
      R"(table = { angles_deg = [0, 90, 180, 270, 360], values_mm = [0, 4, 10, 3, 0] })";
  std::string tabled = tappet_study();
  tabled.erase(tabled.find("[[mechanism.cam.segment]]"),
               tabled.find("[environment]") - tabled.find("[[mechanism.cam.segment]]"));
  tabled = replaced(tabled, "form             = \"outside\"", table);
  const std::string flat = replaced(
      replaced(tappet_study(), "roller_radius_mm = 10", "follower = \"flat\"\nsense = \"clockwise\""),
      "base_radius_mm   = 40", "base_radius_mm   = 40\nface_direction_deg = 90\nphase_deg = 15");
  for (const std::string& text :
       {tappet_study() + tappet_spring, tappet_study("groove"), conjugate_study(), turning, tabled, flat}) {
    std::string messages;
    const auto first = prepare(text, messages);
    ASSERT_TRUE(first) << messages << text;
    const auto second = prepare(study::to_toml(first->canonical), messages);
    ASSERT_TRUE(second) << messages;
    EXPECT_EQ(messages, "");
    EXPECT_EQ(first->canonical, second->canonical);
    const study::Result r = run_text(text);
    EXPECT_EQ(r.status, Status::done);
    ASSERT_TRUE(r.table("cam_lift"));
    EXPECT_GT(r.scenes.at(0).bodies.size(), 2u);
  }
}

// The law of the shaft is over time, and the cam follows it.
TEST(LinkageCams, FollowsADriveOverTime) {
  std::string text = tappet_study();
  text.erase(text.find("[drive]"));
  text += R"([drive]
joint = "shaft"
law = "constant_speed"
speed_rpm = 60

[sweep]
type = "time"

[sweep.time]
to_s = 1
samples = 13
)";
  const study::Result r = run_text(text);
  ASSERT_EQ(r.status, Status::done);
  // 40 and 10 mm of base circle and roller, and half of the rise after a sixth of the turn.
  EXPECT_NEAR(r.tables[0].find("tappet_y_m")->values[2], 0.055, 1e-14);
}

TEST(LinkageCams, MessagesSayWhatToMend) {
  const std::string all = tappet_study();
  const auto problem = [&](const std::string& from, const std::string& to) {
    return problems_of(replaced(all, from, to));
  };
  EXPECT_THAT(problem("moves            = \"guide\"", "moves            = \"gide\""),
              HasSubstr("there is no joint 'gide'"));
  EXPECT_THAT(problem("over_deg = 60", "over_deg = 50"), HasSubstr("the programme covers 350° of the turn"));
  EXPECT_THAT(problem("to_mm    = 10", "to_deg   = 10"),
              HasSubstr("the follower of cam 'lift' slides, and has to in deg; write to_mm"));
  EXPECT_THAT(problem("roller_radius_mm = 10\n", ""), HasSubstr("the roller of cam 'lift' has no radius"));
  EXPECT_THAT(problem("form             = \"outside\"", "form             = \"conjugate\""),
              HasSubstr("conjugate cam 'lift' has one roller"));
  EXPECT_THAT(problem("roller_radius_mm = 10", "roller_radius_mm = 10\nsecond_contact = \"tappet.R\""),
              HasSubstr("cam 'lift' is not conjugate, and has a second roller"));
  EXPECT_THAT(problem("contact          = \"tappet.R\"", "contact          = \"cam.O\""),
              HasSubstr("the contact of cam 'lift' is on 'cam', which is the cam"));
  EXPECT_THAT(problem("base_radius_mm   = 40\n", ""),
              HasSubstr("the base circle of cam 'lift' is not known"));
  EXPECT_THAT(problem("law      = \"cycloidal\"\nover_deg = 120\nto_mm    = 10",
                      "law      = \"constant_speed\"\nover_deg = 120\nto_mm    = 10"),
              HasSubstr("the speed of the follower would jump by"));
  EXPECT_THAT(problem("turns            = \"shaft\"", "turns            = \"guide\""),
              HasSubstr("joint 'guide', on which the cam turns, is not a pin"));
}

// A shaft that nothing drives: its energy gives its speed at every angle.
TEST(LinkageCams, ShaftRunsFreely) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "cam", {{"O", {0, 0}}});
  add_body(l, "follower", {{"R", {0, 0}}});
  add_pin(l, "shaft", "ground.O", "cam.O");
  add_slide(l, "guide", "ground.O", "follower.R", pi / 2, pi / 2);
  l.bodies[1].mass = BodyMass{0, 0.02, 0};
  l.bodies[2].mass = BodyMass{0.8, 0, 0};
  l.gravity = 0;
  const double base = 0.05, stiffness = 6000, preload = 0.004;
  l.cams.push_back({.name = "lift",
                    .turns = 0,
                    .moves = 1,
                    .contact = {2, 0},
                    .roller_radius = 0.01,
                    .base_radius = base - 0.01,
                    .programme = {.segments = {{CamLaw::cycloidal, 120 * one_degree, 0.012, {}},
                                               {CamLaw::dwell, 60 * one_degree, 0, {}},
                                               {CamLaw::polynomial_345, 120 * one_degree, 0, {}},
                                               {CamLaw::dwell, 60 * one_degree, 0, {}}}}});
  // A spring from the axis, which is drawn longer by its preload.
  l.springs.push_back({"spring", {0, 0}, {2, 0}, stiffness, base - preload, 0});
  add_drive(l, "shaft");
  const LinkagePlan plan = planned(l);
  InputDrive drive;
  drive.value = 0, drive.rate = 30;
  constexpr double turn = 0.21361996851374337;
  SimulationOptions options;
  options.relative_tolerance = 1e-12, options.absolute_tolerance = 1e-12;
  const SimulationRun run = simulated(l, plan, {drive}, evenly(0, turn, 201), options);
  ASSERT_EQ(run.report.status, Status::done);
  const ProgrammeCurve lift(l.cams[0].programme);
  const auto speed = [&](double angle) {
    const math::Motion m = lift(angle);
    const double stored = stiffness / 2 * (std::pow(m.value + preload, 2) - preload * preload);
    return std::sqrt((0.02 * 900 - 2 * stored) / (0.02 + 0.8 * m.rate * m.rate));
  };
  EXPECT_NEAR(speed(60 * one_degree), 29.499646270038756, 1e-12);
  EXPECT_NEAR(speed(150 * one_degree), 28.774989139876315, 1e-12);
  EXPECT_NEAR(speed(240 * one_degree), 29.508983214621214, 1e-12);
  LinkageMotion motion(plan);
  LinkageForces forces;
  double least = infinity;
  for (const auto& row : run.rows) {
    EXPECT_NEAR(row.inputs[0].rate, speed(row.inputs[0].value), 1e-8);
    solve_motion(plan, row.inputs, motion);
    solve_forces(l, plan, motion, row.time, row.inputs[0].value, forces);
    least = std::min(least, forces.cams[0].force);
    EXPECT_NEAR(forces.drives[0], 0, 1e-8);
  }
  EXPECT_NEAR(run.rows.back().inputs[0].value, full_turn, 3e-8);  // 1e-9 s of its speed
  EXPECT_NEAR(least, 24, 1e-4);
}

}  // namespace
}  // namespace linkwright::planar
