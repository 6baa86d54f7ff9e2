// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/serial_pi_arm_poses.h"

#include <gmock/gmock.h>

#include <cmath>

#include "parallel/robots.h"
#include "parallel/serial_arms.h"
#include "parallel/studies.h"

namespace linkwright::parallel {
namespace {

using test::column;
using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::HasSubstr;

const std::string arm = serial_mechanism + serial_drives;
const std::string pose = "[[pose]]\nposition_mm = [400, 220, 0]\nforce_N = [7, -20, 0]\n";

TEST(SerialPosesStudy, IsThatOfTheReference) {
  for (const int mode : {1, -1}) {
    const auto result =
        run_text(replaced(arm, "mode = -1", "mode = " + std::to_string(mode)) + pose + "[modes]\n");
    EXPECT_EQ(result.status, Status::done);
    EXPECT_EQ(to_string(result.headline), "1 of 1 poses are usable.");
    const Value& expected = linkwright::test::at(computed("serial-pi-pi"), mode == 1 ? "+1" : "-1");
    const auto numbers = [&](const char* key) {
      return linkwright::test::numbers(linkwright::test::at(expected, key));
    };
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string number = std::to_string(k + 1);
      EXPECT_NEAR(column(result, "poses", "arm_angle_" + number + "_rad").at(0), numbers("q_rad")[k], 1e-14);
      EXPECT_NEAR(column(result, "poses", "pi_angle_" + number + "_rad").at(0), numbers("theta_rad")[k],
                  1e-14);
      EXPECT_NEAR(column(result, "poses", "diagonal_" + number + "_m").at(0), numbers("d_m")[k], 1e-15);
      // tau = -J^T W.
      const Value::Array& rows = linkwright::test::at(expected, "J").as_array();
      const double torque =
          -7 * linkwright::test::numbers(rows[0])[k] + 20 * linkwright::test::numbers(rows[1])[k];
      EXPECT_NEAR(column(result, "poses", "static_torque_" + number + "_N_m").at(0), torque, 1e-12);
    }
    EXPECT_NEAR(column(result, "poses", "determinant_m2").at(0),
                linkwright::test::number_at(expected, "det_J"), 1e-15);
    // Both modes are listed in either.
    EXPECT_THAT(column(result, "working_modes", "mode"), ::testing::ElementsAre(1, -1));
    EXPECT_NEAR(column(result, "working_modes", "diagonal_1_m").at(0), 0.25884878174273523, 1e-15);
    EXPECT_NEAR(column(result, "working_modes", "diagonal_1_m").at(1), 0.39028520819052137, 1e-15);
  }
}

TEST(SerialPosesStudy, ArmAnglesGiveThePoseBack) {
  const auto result =
      run_text(arm + "[[pose]]\narm_angles_rad = [1.2518840494062884, -0.1804704686034535]\n");
  EXPECT_NEAR(column(result, "poses", "x_m").at(0), 0.4, 1e-14);
  EXPECT_NEAR(column(result, "poses", "y_m").at(0), 0.22, 1e-14);
  EXPECT_THAT(problems_of(arm + "[[pose]]\narm_angles_deg = [1, 2, 3]\n"),
              HasSubstr("3 angles for 2 joints"));
}

TEST(SerialPosesStudy, TellsStepsAndStiffness) {
  const auto rigid = run_text(arm + pose);
  EXPECT_EQ(test::table(rigid, "poses").find("displacement_m"), nullptr);
  EXPECT_EQ(test::table(rigid, "poses").find("resolution_worst_m"), nullptr);
  std::string text = arm;
  for (int k = 0; k < 2; ++k)
    text = replaced(text, "lead_mm = 10\nforce",
                    "lead_mm = 10.0\nstep_mm = 0.01\nstiffness_N_per_m = 1e6\nforce");
  const auto result = run_text(text + pose);
  // For equal drives, work = force^2 / (2 k) of each screw.
  const double first = column(result, "poses", "static_screw_force_1_N").at(0),
               second = column(result, "poses", "static_screw_force_2_N").at(0);
  const double work = (first * first + second * second) / 1e6;
  EXPECT_GE(column(result, "poses", "displacement_m").at(0) * std::hypot(7, 20), work);
  EXPECT_GE(column(result, "poses", "resolution_worst_m").at(0),
            column(result, "poses", "resolution_x_m").at(0));
}

TEST(SerialPosesStudy, SaysWhyAPoseIsNoUse) {
  const auto say = [](const std::string& mechanism, const std::string& place) {
    const auto result = run_text(mechanism + "[[pose]]\nposition_mm = " + place + "\n");
    EXPECT_NE(result.status, Status::done);
    EXPECT_EQ(test::fact(result, "poses reached"), "0 of 1");
    return result.diagnostics.empty() ? "" : to_string(result.diagnostics[0]);
  };
  EXPECT_THAT(say(arm, "[660, -20, 0]"), HasSubstr("pose 1: no_assembly: the arms are 50 mm too short"));
  EXPECT_THAT(say(arm, "[90, -20, 0]"),
              HasSubstr("the place is 20 mm too near for arms that differ so in length"));
  EXPECT_THAT(say(replaced(arm, "mirrored = true", "mirrored = true\ntravel_deg = [-5, 5]"), "[400, 220, 0]"),
              HasSubstr("limit_reached: drive 2 is at 10.34 deg, beyond its travel"));
  EXPECT_THAT(say(arm, "[-400, 0, 0]"), HasSubstr("drive 1 is at"));
  EXPECT_THAT(say(serial_mechanism, "[610, -20, 0]"), HasSubstr("singular: the arms are in line"));
  EXPECT_THAT(say(replaced(serial_mechanism, "[300, 250]", "[300, 300]"), "[60, -20, 0]"),
              HasSubstr("the tool is over the pivot of arms of equal length, whose first angle is open"));
}

TEST(SerialPosesStudy, TellsWhatDoesNotFitTogether) {
  EXPECT_THAT(problems_of(arm + "[[pose]]\nposition_mm = [400, 220, 5]\n"),
              HasSubstr("must have z = 0: the robot is planar"));
  EXPECT_THAT(problems_of(arm + "[[pose]]\nposition_mm = [400, 220, 0]\nmoment_N_m = [0, 0, 1]\n"),
              HasSubstr("no drive feels it"));
  EXPECT_THAT(problems_of(arm + "[modes]\n[workspace]\nstep_mm = 50\n"),
              HasSubstr("there is no pose whose modes could be listed"));
}

}  // namespace
}  // namespace linkwright::parallel
