// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/robot.h"

#include <gmock/gmock.h>

#include "parallel/studies.h"

namespace linkwright::parallel {
namespace {

using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::HasSubstr;

const std::string head = "schema = 1\nkind = \"analysis\"\n[mechanism]\n";
const std::string delta =
    head +
    "type = \"parallel.delta\"\nbase_radius_mm = 200\nplatform_radius_mm = 45\narm_mm = 350\n"
    "rod_mm = 800\n";
const std::string pose = "[[pose]]\nposition_mm = [200, -100, -850]\n";
const std::string five_bar =
    head +
    "type = \"parallel.five_bar\"\n[[mechanism.leg]]\nbase_mm = [-150, 0]\narm_mm = 250\nrod_mm = 350\n"
    "[[mechanism.leg]]\nbase_mm = [150, 0]\narm_mm = 250\nrod_mm = 350\n";

double arm_angle(const study::Result& result, int leg) {
  return test::column(result, "poses", "arm_angle_" + std::to_string(leg) + "_rad").at(0);
}

TEST(RobotStudy, ReadsADelta) {
  const auto result = run_text(delta + pose);
  EXPECT_NEAR(arm_angle(result, 1), 0.3199224731453132, 1e-12);
  EXPECT_NEAR(arm_angle(result, 2), 0.9352387010280818, 1e-12);
}

TEST(RobotStudy, LegsOneByOneAreTheSameRobot) {
  std::string legs;
  for (const int azimuth : {0, 120, 240})
    legs += "[[mechanism.leg]]\nazimuth_deg = " + std::to_string(azimuth) +
            "\nbase_radius_mm = 200\nplatform_radius_mm = 45\narm_mm = 350\nrod_mm = 800\n";
  const auto result = run_text(head + "type = \"parallel.delta\"\n" + legs + pose);
  EXPECT_NEAR(arm_angle(result, 3), 0.6813143205259129, 1e-12);
  EXPECT_THAT(problems_of(delta + legs + pose), HasSubstr("is given for all legs and for single legs"));
  EXPECT_THAT(problems_of(head + "type = \"parallel.delta\"\n" + legs.substr(0, legs.rfind("[[")) + pose),
              HasSubstr("a DELTA has 3 legs, got 2"));
}

TEST(RobotStudy, WorkingModesMayBeChosen) {
  const auto result = run_text(delta + "working_mode = [-1, 1, 1]\n" + pose);
  EXPECT_NEAR(arm_angle(result, 1), 2.71588658271304, 1e-12);
  EXPECT_THAT(problems_of(delta + "working_mode = [1, 1]\n" + pose),
              HasSubstr("must be 3 signs, each 1 or -1"));
  EXPECT_THAT(problems_of(delta + "working_mode = [1, 0, 1]\n" + pose),
              HasSubstr("must be 3 signs, each 1 or -1"));
}

TEST(RobotStudy, ElbowsOfAFiveBarAreUsuallyOutside) {
  const auto result = run_text(five_bar + "[[pose]]\nposition_mm = [50, 450, 0]\n");
  EXPECT_NEAR(arm_angle(result, 1), 1.8885080842303203, 1e-12);
  EXPECT_NEAR(arm_angle(result, 2), 0.9416699831841404, 1e-12);
}

TEST(RobotStudy, TellsWhatIsWrongWithTheRobot) {
  EXPECT_THAT(
      problems_of(head +
                  "type = \"parallel.delta\"\nbase_radius_mm = 200\nplatform_radius_mm = 45\narm_mm = 350\n" +
                  pose),
      HasSubstr("'rod' is missing"));
  EXPECT_THAT(problems_of(replaced(delta, "rod_mm = 800", "rod_mm = 0") + pose),
              HasSubstr("leg 1: rod = 0 m; lengths must be above 0"));
  EXPECT_THAT(
      problems_of(replaced(five_bar, "rod_mm = 350\n", "rod_mm = 350\nplatform_mm = [1, 0]\n") + pose),
      HasSubstr("the rods of a five-bar meet in the platform point"));
  EXPECT_THAT(problems_of(replaced(five_bar, "parallel.five_bar", "parallel.constant_orientation") + pose),
              HasSubstr("'platform' is missing"));
  EXPECT_THAT(problems_of(head +
                          "type = \"parallel.five_bar\"\n[[mechanism.leg]]\nbase_mm = [-150, 0]\narm_mm = "
                          "250\nrod_mm = 350\n" +
                          pose),
              HasSubstr("a planar robot has 2 legs, got 1"));
  EXPECT_THAT(problems_of(delta), HasSubstr("nothing is requested"));
  EXPECT_THAT(problems_of(delta + "[mechanism.drive]\nlaed_mm = 3\n" + pose),
              HasSubstr("mechanism.drive.laed_mm: unknown key; did you mean 'lead_mm'?"));
}

TEST(RobotStudy, DrivesAreOfOneTypeOrTheOther) {
  const auto drive = [](const std::string& keys) {
    return problems_of(delta + "[mechanism.drive]\n" + keys + pose);
  };
  EXPECT_THAT(drive("lead_mm = 5\n"), HasSubstr("a drive of type revolute has no 'lead'"));
  EXPECT_THAT(drive("type = \"pi_joint\"\ngear_ratio = 5\n"),
              HasSubstr("a drive of type pi_joint has no 'gear_ratio'"));
  EXPECT_THAT(drive("type = \"pi_joint\"\ntravel_deg = [-60, 95]\n"),
              HasSubstr("a Pi-joint turns between -90 and 90 deg"));
  EXPECT_THAT(drive("travel_deg = [60, -60]\n"), HasSubstr("its first angle must be below its second one"));
  EXPECT_THAT(drive("type = \"pi_joint\"\n[mechanism.drive.motor]\ntorque_N_m = 1\n"),
              HasSubstr("a motor drives the Pi-joint by a screw, whose lead is missing"));
  EXPECT_THAT(drive("[mechanism.drive.motor]\nspeeds_rpm = [0, 100]\ntorques_N_m = [1]\n"),
              HasSubstr("2 speeds with 1 torques"));
  EXPECT_THAT(drive("[mechanism.drive.motor]\nspeeds_rpm = [10, 100]\ntorques_N_m = [1, 1]\n"),
              HasSubstr("speeds start at 0 and increase"));
  EXPECT_THAT(problems_of(delta + "[[mechanism.drive]]\n[[mechanism.drive]]\n" + pose),
              HasSubstr("2 drives for 3 legs"));
}

TEST(RobotStudy, EveryLegMayHaveItsOwnDrive) {
  const std::string drives =
      "[[mechanism.drive]]\ntype = \"pi_joint\"\nmounting_deg = 120\n[[mechanism.drive]]\ntype = "
      "\"pi_joint\"\nmounting_deg = 60\nmirrored = true\n";
  const auto result = run_text(five_bar + drives + "[[pose]]\nposition_mm = [50, 450, 0]\n");
  EXPECT_NEAR(test::column(result, "poses", "diagonal_1_m").at(0), 0.24955605336444084, 1e-12);
  EXPECT_NEAR(test::column(result, "poses", "diagonal_2_m").at(0), 0.2788666183575844, 1e-12);
  EXPECT_NEAR(test::column(result, "poses", "pi_angle_2_rad").at(0), 0.105527568012457, 1e-12);
}

}  // namespace
}  // namespace linkwright::parallel
