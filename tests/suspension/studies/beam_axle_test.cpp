// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/beam_axle.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "suspension/studies.h"

namespace linkwright::suspension {
namespace {

using test::fact;
using test::problems_of;
using test::replaced;
using test::run_text;
using test::table;
using ::testing::HasSubstr;

const std::string rigid_head =
    "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"suspension.beam_axle\"\n"
    "[mechanism.wheel]\ncentre_mm = [0, 750, 320]\ntyre_diameter_mm = 640\n";
const std::string lower =
    "[[mechanism.rod]]\nname = \"lower link\"\nbody_mm = [500, 520, 310]\nbeam_mm = [0, 520, 240]\n"
    "both_sides = true\n";
const std::string upper =
    "[[mechanism.rod]]\nname = \"upper link\"\nbody_mm = [340, 0, 420]\nbeam_mm = [-10, 0, 460]\n";
const std::string panhard =
    "[[mechanism.rod]]\nname = \"Panhard rod\"\nbody_mm = [-150, 480, 300]\nbeam_mm = [-150, -480, 300]\n";
const std::string axle_sweep =
    "[sweep.heave]\nvalues_mm = [-60, 0, 60]\n[sweep.roll]\nvalues_deg = [-4, 0, 4]\n";
const std::string axle_vehicle =
    "[vehicle]\nwheelbase_m = 2.6\ncentre_height_m = 0.55\nfront_brake_share = 0.65\n";
const std::string whole_axle = rigid_head + lower + upper + panhard + axle_sweep;

double cell(const Table& t, std::string_view key, std::size_t row) {
  const Column* column = t.find(key);
  EXPECT_TRUE(column) << key;
  return column ? column->values.at(row) : std::nan("");
}

TEST(BeamAxleStudy, ReportsTheGridOfHeaveAndRoll) {
  const study::Result result = run_text(whole_axle + axle_vehicle);
  EXPECT_EQ(result.status, Status::done);
  EXPECT_THAT(to_string(result.headline), HasSubstr("Rigid axle on 4 rods: all 9 positions reached"));
  const Table& sweep = table(result, "sweep");
  ASSERT_EQ(sweep.rows(), 9U);
  EXPECT_NEAR(cell(sweep, "heave_m", 3), -0.06, 1e-12);
  EXPECT_NEAR(cell(sweep, "roll_rad", 3), 0, 1e-12);
  EXPECT_NEAR(cell(sweep, "roll_rad", 8), 4 * M_PI / 180, 1e-12);
  // The roll axis passes through the rod's middle with the slope of the lower links.
  const double slope = 0.07 / 0.5;
  EXPECT_NEAR(cell(sweep, "roll_centre_height_m", 4), 0.30 + 0.15 * slope, 1e-12);
  EXPECT_NEAR(cell(sweep, "roll_steer", 4), slope, 1e-12);
  // Side views of the links meet in the instant centre.
  const double lower_slope = 0.07 / 0.5, upper_slope = -0.04 / 0.35;
  const double x = (0.46 + upper_slope * 0.01 - 0.24) / (lower_slope - upper_slope),
               z = 0.24 + lower_slope * x;
  EXPECT_NEAR(cell(sweep, "side_centre_x_m", 4), x, 1e-12);
  EXPECT_NEAR(cell(sweep, "side_centre_z_m", 4), z, 1e-12);
  EXPECT_NEAR(cell(sweep, "anti_squat_percent", 4), 100 * 2.6 / 0.55 * z / x, 1e-9);
  EXPECT_NEAR(cell(sweep, "anti_lift_percent", 4), 35 * 2.6 / 0.55 * z / x, 1e-9);
  EXPECT_EQ(fact(result, "roll-centre height"), "321.00 mm");
  EXPECT_EQ(fact(result, "axle"), "Rigid axle on 4 rods");
  EXPECT_EQ(fact(result, "anti-squat, differential on the beam"),
            fmt::format("{:.2f} %", 100 * 2.6 / 0.55 * z / x));
  EXPECT_EQ(table(result, "hard_points").rows(), 10U);
  ASSERT_EQ(result.scenes.size(), 1U);
  EXPECT_EQ(result.scenes[0].samples(), 9U);
  EXPECT_EQ(result.scenes[0].discs.size(), 2U);
}

TEST(BeamAxleStudy, TheTorqueOfADeDionAxleActsOnTheBody) {
  const Table beam = run_text(whole_axle + axle_vehicle).tables[0];
  const Table body =
      run_text(whole_axle + axle_vehicle + "differential = \"body\"\nbrakes = \"body\"\n").tables[0];
  const double x = cell(beam, "side_centre_x_m", 4), z = cell(beam, "side_centre_z_m", 4);
  EXPECT_NEAR(cell(body, "anti_squat_percent", 4), 100 * 2.6 / 0.55 * (z - 0.32) / x, 1e-9);
  EXPECT_NEAR(cell(body, "anti_lift_percent", 4), 35 * 2.6 / 0.55 * (z - 0.32) / x, 1e-9);
  const study::Result front = run_text(whole_axle + axle_vehicle + "axle = \"front\"\n");
  EXPECT_NEAR(cell(front.tables[0], "anti_dive_percent", 4), -65 * 2.6 / 0.55 * z / x, 1e-9);
  EXPECT_NE(fact(front, "anti-lift under drive, differential on the beam"), "no fact");
}

TEST(BeamAxleStudy, JoinsTheOtherAxleOfTheVehicle) {
  const study::Result result =
      run_text(whole_axle + axle_vehicle +
               "[vehicle.other_axle]\nroll_centre_height_mm = 60\nsupport_angle_deg = 5\n");
  const Table& sweep = result.tables[0];
  const double front = std::tan(5 * M_PI / 180),
               rear = cell(sweep, "side_centre_z_m", 4) / cell(sweep, "side_centre_x_m", 4);
  EXPECT_NEAR(cell(sweep, "vehicle_roll_axis_inclination_rad", 4), std::atan((0.06 - 0.321) / 2.6), 1e-9);
  const double behind = cell(sweep, "pitch_centre_behind_m", 4),
               height = cell(sweep, "pitch_centre_height_m", 4);
  EXPECT_NEAR(height, front * behind, 1e-12);  // on the line of the front axle, and on that of the rear one
  EXPECT_NEAR(height, rear * (2.6 - behind), 1e-9);
  EXPECT_NE(fact(result, "pitch centre in braking"), "no fact");
  EXPECT_THAT(problems_of(whole_axle + axle_vehicle + "[vehicle.other_axle]\nroll_centre_height_mm = 60\n"),
              HasSubstr("vehicle.other_axle.support_angle: is missing"));
}

TEST(BeamAxleStudy, RollsASymmetricAxleAlikeBothWays) {
  // The lower links alone are not symmetric with a Panhard rod: an A-arm makes it so.
  const std::string arm =
      "[[mechanism.arm]]\nname = \"A-arm\"\nhinge_mm = [[300, 350, 460], [300, -350, 460]]\n"
      "ball_mm = [-40, 0, 480]\n";
  const Table sweep = run_text(rigid_head + lower + arm + axle_sweep).tables[0];
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(cell(sweep, "steer_rad", i), -cell(sweep, "steer_rad", i + 6), 1e-12);
    EXPECT_NEAR(cell(sweep, "left_toe_rad", i), cell(sweep, "right_toe_rad", i + 6), 1e-12);
    EXPECT_NEAR(cell(sweep, "roll_centre_height_m", i), cell(sweep, "roll_centre_height_m", i + 6), 1e-11);
    EXPECT_NEAR(cell(sweep, "left_travel_m", i), cell(sweep, "right_travel_m", i + 6), 1e-12);
    EXPECT_NEAR(cell(sweep, "lateral_shift_m", i + 3), 0, 1e-12);
  }
}

TEST(BeamAxleStudy, LiftsTheLeftWheelAlone) {
  const study::Result result = run_text(whole_axle + "[sweep.single]\nvalues_mm = [-40, 0, 50]\n");
  const Table& single = table(result, "single");
  ASSERT_EQ(single.rows(), 3U);
  EXPECT_NEAR(cell(single, "left_travel_m", 2), 0.05, 1e-12);
  EXPECT_NEAR(cell(single, "right_travel_m", 2), 0, 1e-12);
  EXPECT_NEAR(std::sin(cell(single, "roll_rad", 2)), 0.05 / 1.5, 1e-5);  // its wheel centres are 1.5 m apart
  EXPECT_NEAR(cell(single, "left_camber_rad", 2), -cell(single, "roll_rad", 2), 1e-4);
  EXPECT_NEAR(cell(single, "left_road_camber_rad", 2), 0, 1e-4);
}

const std::string knuckles =
    "[mechanism.steering]\nkingpin_mm = [[10, 690, 220], [-5, 660, 430]]\npitman_axis_mm = [[750, 450, 600], "
    "[750, 550, 600]]\ndrag_link_mm = [[740, 560, 360], [20, 550, 440]]\ntrack_rod_mm = [-190, 600, 270]\n";

TEST(BeamAxleStudy, SteersByADragLinkAndATrackRod) {
  const std::string text = rigid_head + lower + upper + panhard + knuckles + axle_sweep +
                           "[sweep.pitman]\nvalues_deg = [-6, 0, 6]\n" + axle_vehicle + "axle = \"front\"\n";
  const study::Result result = run_text(text);
  ASSERT_EQ(result.status, Status::done);
  // At the reference the wheels point ahead; a rise of the axle pulls the drag link and steers.
  const Table& sweep = result.tables[0];
  EXPECT_NEAR(cell(sweep, "left_steer_rad", 4), 0, 1e-14);
  EXPECT_GT(std::abs(cell(sweep, "left_steer_rad", 3)), 1e-3);
  const Table& steer = table(result, "steer");
  EXPECT_NEAR(cell(steer, "toe_out_on_turn_rad", 1), 0, 1e-14);
  EXPECT_GT(cell(steer, "toe_out_on_turn_rad", 0), 1e-3);
  EXPECT_GT(cell(steer, "ackermann_axes_percent", 2), 10);
  EXPECT_LT(cell(steer, "left_steer_rad", 0) * cell(steer, "left_steer_rad", 2), 0);
  std::string messages;
  const auto prepared = test::prepare(text, messages);
  ASSERT_TRUE(prepared) << messages;
  Diagnostics problems;
  const Value again = prepared->canonical;
  const auto second = study::prepare(again, "canonical", ".", test::kinds(), problems);
  ASSERT_TRUE(second) << test::lines_of(problems);
  EXPECT_EQ(second->canonical, prepared->canonical);
  EXPECT_THAT(problems_of(replaced(text, "[20, 550, 440]", "[10, 690, 220]")),
              HasSubstr("mechanism.steering.drag_link_mm: the drag link points at the kingpin"));
  EXPECT_THAT(problems_of(replaced(text, knuckles, "")), HasSubstr("the axle is not steered"));
}

TEST(BeamAxleStudy, TurnsThePinionWithTheBeam) {
  const std::string shaft =
      "[[mechanism.shaft]]\nname = \"propeller shaft\"\nbody_mm = [1450, 0, 340]\nbeam_mm = [250, 0, 330]\n";
  const study::Result result = run_text(replaced(whole_axle, "type = \"suspension.beam_axle\"\n",
                                                 "type = \"suspension.beam_axle\"\npinion_angle_deg = 2\n") +
                                        shaft);
  const Table& sweep = result.tables[0];
  EXPECT_NEAR(cell(sweep, "pinion_angle_rad", 4), 2 * M_PI / 180, 1e-12);
  // The centre of turning in side view lies ahead: as the axle rises, the pinion points down.
  EXPECT_LT(cell(sweep, "pinion_angle_rad", 5), cell(sweep, "pinion_angle_rad", 4));
  EXPECT_NEAR(1 / cell(sweep, "pitch_by_heave_rad_per_m", 4), cell(sweep, "side_centre_x_m", 4), 1e-9);
  EXPECT_NEAR(cell(sweep, "propeller_shaft_body_angle_rad", 4), 0, 1e-9);
  EXPECT_NEAR(cell(sweep, "propeller_shaft_plunge_m", 4), 0, 1e-12);
  EXPECT_GT(cell(sweep, "propeller_shaft_beam_angle_rad", 5), 0.01);
}

TEST(BeamAxleStudy, PositionsOutOfReachHaveTheirPlaceAndReason) {
  const study::Result result =
      run_text(replaced(replaced(whole_axle, "body_mm = [-150, 480, 300]", "body_mm = [-150, 30, 300]"),
                        "beam_mm = [-150, -480, 300]", "beam_mm = [-150, -40, 300]"));
  EXPECT_EQ(result.status, Status::no_assembly);
  EXPECT_THAT(to_string(result.headline), HasSubstr("Rigid axle on 4 rods:"));
  EXPECT_THAT(to_string(result.headline), HasSubstr("of 9 positions are not reached."));
  const Table& sweep = result.tables[0];
  ASSERT_EQ(sweep.status.size(), 9U);
  EXPECT_EQ(sweep.status[4], "done");
  std::string messages;
  for (const Diagnostic& d : result.diagnostics) messages += to_string(d.message) + "\n";
  EXPECT_THAT(messages, HasSubstr("no_assembly: the motion to heave"));
  EXPECT_THAT(messages, HasSubstr("'Panhard rod'"));
}

TEST(BeamAxleStudy, TheCanonicalStudyGivesTheSameAxle) {
  std::string messages;
  const auto first = test::prepare(whole_axle + axle_vehicle, messages);
  ASSERT_TRUE(first) << messages;
  Diagnostics diagnostics;
  const auto second = study::prepare(first->canonical, "again.json", ".", test::kinds(), diagnostics);
  ASSERT_TRUE(second) << test::lines_of(diagnostics);
  RunContext context;
  const study::Result a = study::run_study(*first, context), b = study::run_study(*second, context);
  EXPECT_EQ(to_csv(a.tables[0]), to_csv(b.tables[0]));
}

const std::string twist_beam =
    "[mechanism.twist_beam]\npivot_mm = [420, 520, 360]\nshear_centre_mm = [250, 0, 380]\n";

TEST(BeamAxleStudy, TakesATwistBeam) {
  const study::Result result = run_text(rigid_head + twist_beam + axle_sweep + axle_vehicle);
  EXPECT_THAT(to_string(result.headline), HasSubstr("Twist-beam axle: all 9 positions reached"));
  const Table& sweep = result.tables[0];
  EXPECT_FALSE(sweep.find("roll_axis_inclination_rad"));
  EXPECT_FALSE(sweep.find("pinion_angle_rad"));
  EXPECT_NEAR(cell(sweep, "twist_rad", 1), -cell(sweep, "twist_rad", 7), 1e-12);
  EXPECT_NEAR(cell(sweep, "twist_rad", 4), 0, 1e-12);
  EXPECT_NEAR(cell(sweep, "anti_lift_percent", 4), 35 * 2.6 / 0.55 * 0.36 / 0.42, 1e-9);
  EXPECT_NE(fact(result, "twist of the beam by roll"), "no fact");
}

TEST(BeamAxleStudy, ReportsWhatATwistBeamCannotHave) {
  EXPECT_THAT(problems_of(rigid_head + twist_beam + panhard + axle_sweep),
              HasSubstr("mechanism.rod: a twist beam is held by its bushings alone"));
  EXPECT_THAT(problems_of(rigid_head + replaced(twist_beam, "420, 520", "420, -520") + axle_sweep),
              HasSubstr("mechanism.twist_beam.pivot_mm: y is -520 mm, but this is that of the left arm"));
  EXPECT_THAT(problems_of(rigid_head + replaced(twist_beam, "250, 0,", "250, 30,") + axle_sweep),
              HasSubstr("mechanism.twist_beam.shear_centre_mm: y is 30 mm, but it is that of the middle"));
}

TEST(BeamAxleStudy, CountsConstraintsInItsMessages) {
  EXPECT_THAT(
      problems_of(rigid_head + lower + upper + axle_sweep),
      HasSubstr("the links take 3 of the six freedoms of the axle (3 rods: 3); four leave heave and roll: "
                "the axle is not located"));
  EXPECT_THAT(
      problems_of(whole_axle + replaced(upper, "upper link", "fifth link")),
      HasSubstr("the links take 5 of the six freedoms of the axle (5 rods: 5); four leave heave and roll: "
                "the axle is overconstrained"));
  EXPECT_THAT(problems_of(rigid_head + lower + replaced(lower, "lower link", "upper link") + axle_sweep),
              HasSubstr("constrain it alike"));
}

TEST(BeamAxleStudy, ReportsLeftAndRightMixedUp) {
  EXPECT_THAT(
      problems_of(replaced(whole_axle, "body_mm = [500, 520, 310]", "body_mm = [500, -520, 310]")),
      HasSubstr("mechanism.rod[0].body_mm: has y = -520 mm, but with both_sides the points are those of the "
                "left side"));
  EXPECT_THAT(problems_of(replaced(whole_axle, "centre_mm = [0, 750, 320]", "centre_mm = [0, -750, 320]")),
              HasSubstr("mechanism.wheel.centre_mm: y is -750 mm, but this is the left wheel"));
  const std::string one =
      "[[mechanism.rod]]\nname = \"left lower link\"\nbody_mm = [500, -520, 310]\nbeam_mm = [0, -520, 240]\n";
  EXPECT_THAT(
      problems_of(rigid_head + one + upper + panhard + axle_sweep),
      HasSubstr("'left lower link' has y = -520 mm on the body and y = -520 mm on the beam: it is on the "
                "right of the vehicle"));
}

TEST(BeamAxleStudy, ReportsWrongNumbers) {
  EXPECT_THAT(
      problems_of(replaced(whole_axle, "body_mm = [340, 0, 420]", "body_m = [340, 0, 420]")),
      HasSubstr(
          "mechanism.rod[1].body_m: is 540.1 m away from the middle of the axle, whose track is 1.5 m"));
  EXPECT_THAT(problems_of(whole_axle + replaced(panhard, "-150, -480", "-150, -470")),
              HasSubstr("'Panhard rod' is also the name of another part"));
  EXPECT_THAT(problems_of(rigid_head + lower +
                          "[[mechanism.arm]]\nname = \"A\"\nhinge_mm = [[300, 350, 460]]\n"
                          "ball_mm = [-40, 0, 480]\n" +
                          axle_sweep),
              HasSubstr("mechanism.arm[0].hinge_mm: has 1 point, needs 2"));
  EXPECT_THAT(problems_of(rigid_head + lower + upper +
                          "[[mechanism.watt_linkage]]\npivot_mm = [-120, 0, 300]\n"
                          "crank_mm = [[-120, 0, 370], [-120, 0, 230]]\nends_mm = [[-120, 500, 370]]\n" +
                          axle_sweep),
              HasSubstr("mechanism.watt_linkage[0].ends_mm: has 1 point, needs 2"));
  EXPECT_THAT(problems_of(replaced(whole_axle, "beam_mm = [-150, -480, 300]", "beam_mm = [-150, 480, 300]")),
              HasSubstr("both joints of 'Panhard rod' are in one place"));
  EXPECT_THAT(problems_of(rigid_head + lower + upper + panhard), HasSubstr("sweep: this key is missing"));
}

}  // namespace
}  // namespace linkwright::suspension
