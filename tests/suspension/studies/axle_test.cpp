// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/axle.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "suspension/studies.h"

namespace linkwright::suspension {
namespace {

using test::fact;
using test::problems_of;
using test::run_text;
using test::table;
using ::testing::HasSubstr;

std::string study(const std::string& sample, const std::string& rest) {
  return "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"suspension.corner\"\nsample = \"" + sample +
         "\"\n[sweep.travel]\nvalues_mm = [0]\n" + rest;
}
const std::string vehicle =
    "[vehicle]\nwheelbase_m = 2.7\ncentre_height_m = 0.55\nfront_brake_share = 0.65\n";

double at(const Table& t, std::string_view key, std::size_t row) {
  const Column* column = t.find(key);
  EXPECT_TRUE(column) << key;
  return column ? column->values.at(row) : std::nan("");
}

TEST(AxleStudy, TellsTheAntiFeaturesOfFrontAndRear) {
  // Reference figures of the double wishbone at the front and the semi-trailing arm at the rear.
  const study::Result front = run_text(study("2RS-US", vehicle));
  EXPECT_NEAR(at(front.tables[0], "anti_dive_outboard_percent", 0), 22.44960845365772, 1e-7);
  EXPECT_NEAR(at(front.tables[0], "anti_lift_drive_percent", 0), -2.770800471872947, 1e-7);
  const study::Result rear = run_text(study("R", vehicle + "axle = \"rear\"\n"));
  EXPECT_NEAR(at(rear.tables[0], "anti_lift_outboard_percent", 0), 105.73616060410075, 1e-7);
  EXPECT_NEAR(at(rear.tables[0], "anti_squat_percent", 0), -18.31591156279213, 1e-7);
}

TEST(AxleStudy, TellsTheAntiDiveByTheArmPlanesBesideThatOfTheMotion) {
  const study::Result result = run_text(study("2RS-US", vehicle));
  const Table& sweep = result.tables[0];
  // The contact point turns about the side centre of the arms: forward per upward velocity is the slope of
  // the line to it, taken the other way.
  const double slope = (at(sweep, "arm_side_centre_z_m", 0) - at(sweep, "contact_z_m", 0)) /
                       (at(sweep, "arm_side_centre_x_m", 0) - at(sweep, "contact_x_m", 0));
  const double by_arms = at(sweep, "arm_anti_dive_outboard_percent", 0);
  EXPECT_NEAR(by_arms, -100 * 0.65 * 2.7 / 0.55 * slope, 1e-9);
  // The tie rod of this suspension agrees with the arms within a few percent of the load transfer.
  EXPECT_NEAR(by_arms, at(sweep, "anti_dive_outboard_percent", 0), 3);
  std::string facts;
  for (const auto& fact : result.facts) facts += to_string(fact.label + " = " + fact.text) + "\n";
  EXPECT_THAT(facts, HasSubstr("anti-dive, outboard brake = 22.45 %\n"));
  EXPECT_THAT(facts, HasSubstr("caster, kingpin inclination by ball joints = 4.970°, "));
  EXPECT_THAT(facts,
              HasSubstr(fmt::format("anti-dive, outboard brake, by arm planes = {:.2f} %\n", by_arms)));
  // An arm on a hinge turns about it: motion and drawing agree, but for the camber, which puts the contact
  // point some millimetres beside the plane of the side centre (0.2 % here).
  const Table hinged = run_text(study("R", vehicle)).tables[0];
  EXPECT_NEAR(at(hinged, "arm_anti_dive_outboard_percent", 0) / at(hinged, "anti_dive_outboard_percent", 0),
              1, 5e-3);
  // Five rods have no arm planes.
  EXPECT_FALSE(run_text(study("5US", vehicle)).tables[0].find("arm_anti_dive_outboard_percent"));
}

TEST(AxleStudy, RollsASymmetricAxleAlikeBothWays) {
  const study::Result result =
      run_text(study("2RS-US", "[axle.roll]\nfrom_deg = -4\nto_deg = 4\nstep_deg = 2\n"));
  const Table& roll = table(result, "roll");
  ASSERT_EQ(roll.rows(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(at(roll, "left_toe_rad", i), at(roll, "right_toe_rad", 4 - i), 1e-12);
    EXPECT_NEAR(at(roll, "roll_centre_offset_m", i), -at(roll, "roll_centre_offset_m", 4 - i), 1e-9);
    EXPECT_NEAR(at(roll, "left_road_camber_rad", i), at(roll, "right_road_camber_rad", 4 - i), 1e-12);
  }
  // Upright, the roll centre is the one of equal travel.
  EXPECT_NEAR(at(roll, "roll_centre_height_m", 2), at(result.tables[0], "roll_centre_height_m", 0), 1e-9);
  EXPECT_NE(fact(result, "roll steer (mean steer by roll)"), "no fact");
}

TEST(AxleStudy, SteersBothWheelsOnOneRack) {
  const study::Result result = run_text(
      study("2RS-US", vehicle + "[axle]\nrack_per_turn_mm = 50\n[axle.rack]\nvalues_mm = [-40, 0, 40]\n"));
  const Table& steer = table(result, "steer");
  EXPECT_NEAR(at(steer, "left_steer_rad", 0), -at(steer, "right_steer_rad", 2), 1e-12);
  EXPECT_NEAR(at(steer, "ackermann_percent", 0), at(steer, "ackermann_percent", 2), 1e-9);
  EXPECT_TRUE(std::isnan(at(steer, "ackermann_percent", 1)));  // straight ahead there is none
  // One turn moves the rack by 50 mm: a turn over the steer angle that this makes.
  const double mean = at(steer, "left_steer_by_rack_rad_per_m", 1);
  EXPECT_NEAR(at(steer, "steering_ratio", 1), 2 * M_PI / std::abs(0.05 * mean), 1e-9);
}

TEST(AxleStudy, TellsTurningCirclesByTheSteeringAxes) {
  const study::Result result =
      run_text(study("2RS-US", vehicle + "front_overhang_m = 0.8\nwidth_m = 1.8\n[axle.rack]\n" +
                                   "values_mm = [-50, -20, 0, 50]\n"));
  const Table& steer = table(result, "steer");
  double axes = 0;
  for (const std::size_t i : {0U, 1U, 3U}) {
    const double left = at(steer, "left_steer_rad", i) - at(steer, "left_steer_rad", 2),
                 right = at(steer, "right_steer_rad", i) - at(steer, "right_steer_rad", 2);
    const double inner = std::abs(left > 0 ? left : right), outer = std::abs(left > 0 ? right : left);
    EXPECT_NEAR(at(steer, "toe_out_on_turn_rad", i), inner - outer, 1e-14);
    // cot(outer) - cot(ideal inner) = distance / wheelbase gives the distance of the axes back, the same for
    // all angles.
    const double ideal = inner - at(steer, "ackermann_axes_error_rad", i);
    EXPECT_NEAR(100 * (inner - outer) / (ideal - outer), at(steer, "ackermann_axes_percent", i), 1e-9);
    const double distance = 2.7 * (1 / std::tan(outer) - 1 / std::tan(ideal));
    EXPECT_NEAR(axes > 0 ? axes : distance, distance, 1e-9);
    axes = distance;
    EXPECT_NEAR(at(steer, "turning_circle_m", i) / 2 - 2.7 / std::sin(outer), 0, 0.1);  // the scrub
    EXPECT_NEAR(at(steer, "turning_circle_walls_m", i),
                2 * std::hypot(2.7 + 0.8, 2.7 / std::tan(outer) - axes / 2 + 0.9), 1e-9);
  }
  // The axes meet the ground inboard of the contacts by the scrub of both wheels.
  EXPECT_NEAR(axes, 2 * (at(result.tables[0], "contact_y_m", 0) - at(result.tables[0], "scrub_radius_m", 0)),
              1e-9);
  EXPECT_NEAR(at(steer, "turning_circle_m", 0), at(steer, "turning_circle_m", 3), 1e-9);
  EXPECT_TRUE(std::isnan(at(steer, "turning_circle_m", 2)));
  EXPECT_NE(fact(result, "turning circle, kerb to kerb"), "no fact");
  EXPECT_NE(fact(result, "lock angles, turning left (rack 50 mm)") +
                fact(result, "lock angles, turning left (rack -50 mm)"),
            "no factno fact");
  EXPECT_FALSE(
      table(run_text(study("2RS-US", vehicle + "axle = \"rear\"\n[axle.rack]\nvalues_mm = [9]\n")), "steer")
          .find("turning_circle_m"));
}

TEST(AxleStudy, TakesAnotherWheelOnTheOtherSide) {
  const std::string axle =
      "[axle.roll]\nvalues_deg = [-2, 0, 2]\n[axle.single]\nvalues_mm = [-20, 20]\n"
      "[axle.grid.heave]\nvalues_mm = [-30, 30]\n[axle.grid.rack]\nvalues_mm = [10]\n";
  const study::Result mirrored = run_text(study("2RS-US", axle));
  const auto other = [&](const std::string& sample) {
    return run_text(study("2RS-US", axle +
                                        "[other_wheel.mechanism]\ntype = \"suspension.corner\"\nsample = \"" +
                                        sample + "\"\nside = \"right\"\n"));
  };
  const study::Result same = other("2RS-US"), unlike = other("5US");
  for (const char* name : {"roll", "single", "axle_grid"})
    for (const Column& column : table(mirrored, name).columns)
      for (std::size_t i = 0; i < column.values.size(); ++i)
        EXPECT_NEAR(at(table(same, name), column.key, i), column.values[i], 1e-12)
            << name << ' ' << column.key;
  EXPECT_EQ(at(table(unlike, "single"), "left_toe_rad", 0), at(table(mirrored, "single"), "left_toe_rad", 0));
  EXPECT_GT(
      std::abs(at(table(unlike, "roll"), "roll_steer", 1) - at(table(mirrored, "roll"), "roll_steer", 1)),
      1e-3);
}

TEST(AxleStudyRead, NamesWhatIsWrong) {
  EXPECT_THAT(
      problems_of(study("2RS-US", "[other_wheel.mechanism]\ntype = \"suspension.corner\"\nsample = \"R\"\n")),
      HasSubstr(
          "other_wheel.mechanism: both wheels are left ones; write side = \"right\" for the other one"));
  EXPECT_THAT(problems_of(study("2RS-US", "[other_wheel]\n")),
              HasSubstr("other_wheel.file: the other wheel is missing; write file = \"before.toml\""));
  EXPECT_THAT(problems_of(study("R", "[axle.grid.rack]\nvalues_mm = [0]\n")),
              HasSubstr("axle.grid.rack: no link is moved by the rack"));
  EXPECT_THAT(problems_of(study("R", "[axle.rack]\nvalues_mm = [0]\n")),
              HasSubstr("axle.rack: no link is moved by the rack"));
  EXPECT_THAT(problems_of(study("rear_5US", "[axle.roll]\nvalues_deg = [0]\n")),
              HasSubstr("axle.roll: the wheel centre lies in the middle of the vehicle: there is no axle"));
  EXPECT_THAT(problems_of(study("R", "[vehicle]\nwheelbase_m = 2.7\n")),
              HasSubstr("vehicle.centre_height_m: this key is missing"));
  EXPECT_THAT(problems_of(study("2RS-US", "[axle.roll]\nfrom_deg = 1\n")),
              HasSubstr("axle.roll.to: is missing; write from_deg, to_deg and step_deg"));
}

}  // namespace
}  // namespace linkwright::suspension
