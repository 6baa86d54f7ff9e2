// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/serial_pi_arm.h"

#include <gmock/gmock.h>

#include <cmath>

#include "parallel/serial_arms.h"
#include "parallel/studies.h"

namespace linkwright::parallel {
namespace {

using test::column;
using test::fact;
using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::HasSubstr;

const std::string pose = "[[pose]]\nposition_mm = [400, 220, 0]\n";

TEST(SerialArmStudy, AnswersAllThatIsAskedFor) {
  const auto result = run_text(test::example("analysis/parallel.serial_pi_arm"));
  EXPECT_EQ(result.status, Status::done) << to_string(result.headline);
  EXPECT_THAT(to_string(result.headline), HasSubstr("It works: the path takes"));
  for (const char* name :
       {"motion", "drive_limits", "poses", "working_modes", "workspace", "workspace_totals"})
    EXPECT_GT(test::table(result, name).rows(), 0u) << name;
  EXPECT_EQ(result.scenes.size(), 2u);
}

TEST(SerialArmStudy, WorkspaceIsTheAnnulusOfMotorsAndLessOfPiJoints) {
  const std::string grid = "[workspace]\nstep_mm = 5\n";
  const auto motors = run_text(serial_mechanism + grid);
  // 4 pi a1 a2; nodes at the edges of 3.5 m length count or not at random.
  const double reach = 4 * 3.14159265358979 * 0.3 * 0.25;
  EXPECT_NEAR(column(motors, "workspace_totals", "area_left_m2").back(), reach, 2e-3);
  EXPECT_EQ(fact(motors, "reach of the arms alone"), "0.9425 m2");
  EXPECT_THAT(to_string(motors.headline), HasSubstr("Workspace 0.94"));
  const auto joints = run_text(serial_mechanism + serial_drives + "[limits]\nconditioning = 0.3\n" + grid);
  const auto& left = column(joints, "workspace_totals", "area_left_m2");
  for (std::size_t i = 1; i < left.size(); ++i) EXPECT_LE(left[i], left[i - 1]);
  EXPECT_LT(left.back(), 0.5 * reach);
  const Table& nodes = test::table(joints, "workspace");
  for (std::size_t i = 0; i < nodes.rows(); ++i) {
    const double lci = nodes.find("conditioning")->values[i];
    EXPECT_EQ(nodes.status[i] == "done", lci >= 0.3);
  }
  ASSERT_EQ(joints.plots.size(), 2u);
  EXPECT_EQ(joints.plots[0].style, study::Plot::Style::map);
}

TEST(SerialArmStudy, BothModesHaveTheirOwnWorkspace) {
  const std::string grid =
      serial_drives + "[workspace]\nlower_mm = [390, 210, 0]\nupper_mm = [410, 230, 0]\nstep_mm = 10\n";
  for (const char* mode : {"mode = -1", "mode = 1"}) {
    const auto result = run_text(replaced(serial_mechanism, "mode = -1", mode) + grid);
    EXPECT_EQ(column(result, "workspace_totals", "left").back(), 9);
  }
  const auto narrow = run_text(replaced(serial_mechanism, "mode = -1", "mode = 1") +
                               replaced(grid, "mirrored = true", "mirrored = true\ntravel_deg = [-60, 60]"));
  EXPECT_EQ(column(narrow, "workspace_totals", "left").back(), 0);
}

TEST(SerialArmStudy, TellsWhatIsWrongWithTheArm) {
  EXPECT_THAT(problems_of(replaced(serial_mechanism, "mode = -1", "mode = 0") + pose),
              HasSubstr("must be 1 or -1"));
  EXPECT_THAT(problems_of(replaced(serial_mechanism, "arms_mm = [300, 250]\n", "") + pose),
              HasSubstr("mechanism.arms_m: this key is missing"));
  EXPECT_THAT(problems_of(replaced(serial_mechanism, "[300, 250]", "[300, 0]") + pose),
              HasSubstr("more than 0"));
  EXPECT_THAT(problems_of(serial_mechanism + "[[mechanism.drive]]\n" + pose),
              HasSubstr("1 drives for 2 joints"));
  EXPECT_THAT(problems_of(serial_mechanism + "[mechanism.drive]\nlead_mm = 5\n" + pose),
              HasSubstr("a drive of type revolute has no 'lead'"));
  EXPECT_THAT(problems_of(serial_mechanism), HasSubstr("nothing is requested"));
}

TEST(SerialArmStudy, TellsWhatIsWrongWithMasses) {
  const std::string arm = serial_mechanism + serial_drives;
  EXPECT_THAT(problems_of(arm + pose + "[masses]\n[[masses.joint]]\n"),
              HasSubstr("masses of 1 joints, the arm has 2"));
  EXPECT_THAT(problems_of(arm + pose + "[masses]\npayload_kg = 1\n"),
              HasSubstr("masses.joint: this key is missing"));
  EXPECT_THAT(problems_of(arm + pose + serial_masses + "[masses.joint.pi_joint]\narm_mass_kg = 1\n"),
              HasSubstr("keep [masses.joint.pi_joint], or the masses of arms and coupler"));
  const std::string pi =
      "[masses]\n[[masses.joint]]\n[masses.joint.pi_joint]\narm_mass_kg = 1\nrotor_inertia_kg_m2 = 1e-6\n"
      "[[masses.joint]]\n";
  EXPECT_EQ(run_text(arm + pose + pi).status, Status::done);
  EXPECT_THAT(problems_of(serial_mechanism + pose + pi),
              HasSubstr("joint 1: masses of a Pi-joint, but a motor drives it"));
}

TEST(SerialArmStudy, TellsWhatIsWrongWithTheGrid) {
  const auto grid = [](const std::string& keys) {
    return problems_of(serial_mechanism + "[workspace]\n" + keys);
  };
  EXPECT_THAT(grid("step_mm = 0.5\n"), HasSubstr("at most 5e+05 are allowed"));
  EXPECT_THAT(grid("step_mm = 5\nlower_mm = [0, 0, 0]\n"), HasSubstr("is given alone"));
  EXPECT_THAT(grid("step_mm = 5\nlower_mm = [0, 0, 0]\nupper_mm = [9, -9, 0]\n"),
              HasSubstr("is below lower along y"));
  EXPECT_THAT(grid("step_mm = 5\nlower_mm = [0, 0, 0]\nupper_mm = [9, 9, 9]\n"),
              HasSubstr("must have z = 0"));
  EXPECT_THAT(grid("step_mm = 5\nindices = []\n"), HasSubstr("name at least one"));
  EXPECT_THAT(grid("step_mm = 5\nindices = [\"sine\", \"sine\"]\n"), HasSubstr("one is named twice"));
}

}  // namespace
}  // namespace linkwright::parallel
