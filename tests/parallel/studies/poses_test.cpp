// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/poses.h"

#include <gmock/gmock.h>

#include "linkwright/core/looks.h"
#include "parallel/robots.h"
#include "parallel/studies.h"

namespace linkwright::parallel {
namespace {

using test::column;
using test::problems_of;
using test::run_text;
using ::testing::HasSubstr;

const std::string delta =
    "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"parallel.delta\"\nbase_radius_mm = "
    "200\nplatform_radius_mm = 45\n"
    "arm_mm = 350\nrod_mm = 800\n[mechanism.drive]\ntype = \"pi_joint\"\nmounting_deg = 30\ntravel_deg = "
    "[-60, 60]\n"
    "step_mm = 0.0127\nstiffness_N_per_m = 1.1e7\n";
const std::string hexa =
    "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"parallel.hexa\"\nbase_radius_mm = "
    "250\nbase_offset_mm = 60\n"
    "platform_radius_mm = 90\nplatform_angle_deg = 45\narm_mm = 250\nrod_mm = 550\n";

TEST(PosesStudy, TellsEverythingOfAPose) {
  const auto result = run_text(delta + "[[pose]]\nposition_mm = [200, -100, -850]\nforce_N = [10, 5, -30]\n");
  const Value &pose = computed("delta-pose-0.2_-0.1_-0.85"), &statics = computed("delta-statics");
  EXPECT_NEAR(column(result, "poses", "diagonal_2_m").at(0),
              linkwright::test::numbers(linkwright::test::at(pose, "d_m"))[1], 1e-12);
  EXPECT_NEAR(column(result, "poses", "condition_number").at(0),
              linkwright::test::number_at(pose, "condition_number"), 1e-10);
  EXPECT_NEAR(column(result, "poses", "transmission").at(0), linkwright::test::number_at(pose, "lti"), 1e-11);
  EXPECT_NEAR(column(result, "poses", "resolution_worst_m").at(0),
              linkwright::test::number_at(pose, "resolution_worst_m"), 1e-14);
  EXPECT_NEAR(column(result, "poses", "static_screw_force_3_N").at(0),
              linkwright::test::numbers(linkwright::test::at(statics, "screw_force_N"))[2], 1e-9);
  EXPECT_NEAR(column(result, "poses", "least_stiffness_N_per_m").at(0),
              linkwright::test::numbers(linkwright::test::at(statics, "stiffness_eigenvalues_N_m"))[0], 1e-3);
  EXPECT_EQ(test::fact(result, "poses reached"), "1 of 1");
}

TEST(PosesStudy, ArmAnglesGiveThePoseBack) {
  const auto result =
      run_text(delta +
               "[home]\nposition_mm = [0, 0, -800]\n[[pose]]\narm_angles_rad = [0.3199224731453132, "
               "0.9352387010280818, 0.6813143205259129]\n");
  EXPECT_NEAR(column(result, "poses", "x_m").at(0), 0.2, 1e-12);
  EXPECT_NEAR(column(result, "poses", "z_m").at(0), -0.85, 1e-12);
  EXPECT_THAT(problems_of(delta + "[[pose]]\narm_angles_deg = [1, 2]\n"), HasSubstr("2 angles for 3 legs"));
}

TEST(PosesStudy, ListsModes) {
  const auto result =
      run_text(delta + "[[pose]]\nname = \"corner\"\nposition_mm = [200, -100, -850]\n[modes]\n");
  EXPECT_EQ(test::table(result, "working_modes").rows(), 8u);
  EXPECT_EQ(test::table(result, "assembly_modes").rows(), 2u);
  // The other assembly is in the table.
  const Vec3 other = point(linkwright::test::at(computed("delta-pose-0.2_-0.1_-0.85"), "other_assembly_p_m"));
  EXPECT_THAT(column(result, "assembly_modes", "x_m"),
              ::testing::Contains(::testing::DoubleNear(other.x, 1e-12)));
  const auto all = run_text(hexa +
                            "[[pose]]\nposition_mm = [50, -30, -500]\nrotation_rad = [0.15, -0.2, "
                            "0.25]\n[modes]\nworking = false\n");
  EXPECT_EQ(test::table(all, "assembly_modes").rows(), 12u);
  EXPECT_THAT(
      problems_of(delta + "[modes]\n[workspace]\nlower_mm=[0,0,-800]\nupper_mm=[0,0,-700]\nstep_mm=50\n"),
      HasSubstr("there is no pose whose modes could be listed"));
}

// The table of assemblies looks before each pose but the first; what it has stays.
TEST(PosesStudy, AnInterruptedListOfAssembliesKeepsItsPoses) {
  std::string text = delta;
  for (int i = 0; i < 5; ++i)
    text += "[[pose]]\nname = \"pose " + std::to_string(i) + "\"\nposition_mm = [" + std::to_string(40 * i) +
            ", -100, -850]\n";
  text += "[modes]\n";
  std::int64_t all = 0;
  {
    const LooksAllowed looks(std::int64_t{1} << 40);
    const auto whole = run_text(text);
    EXPECT_EQ(whole.status, Status::done);
    EXPECT_EQ(test::table(whole, "assembly_modes").rows(), 10u);
    all = looks.made();
  }
  ASSERT_GE(all, 4);
  std::size_t before = 0;
  for (std::int64_t allowed = 0; allowed <= all; ++allowed) {
    const LooksAllowed looks(allowed);
    const auto some = run_text(text);
    EXPECT_EQ(some.status, allowed < all ? Status::cancelled : Status::done) << allowed;
    const std::size_t rows = test::table(some, "assembly_modes").rows();
    EXPECT_GE(rows, 2u);  // the first pose always
    EXPECT_GE(rows, before);
    before = rows;
    EXPECT_EQ(test::table(some, "poses").rows(), 5u);
  }
  EXPECT_EQ(before, 10u);
}

TEST(PosesStudy, SaysWhyAPoseIsNoUse) {
  const auto far =
      run_text(delta + "[home]\nposition_mm = [0, 0, -800]\n[[pose]]\nposition_mm = [0, 0, -1500]\n");
  EXPECT_EQ(far.status, Status::no_assembly);
  ASSERT_EQ(far.diagnostics.size(), 1u);
  EXPECT_THAT(to_string(far.diagnostics[0]), HasSubstr("pose 1: no_assembly: leg 1 is 358 mm too short"));
  EXPECT_TRUE(std::isnan(column(far, "poses", "arm_angle_1_rad").at(0)));
  const auto beyond =
      run_text(test::replaced(delta, "[-60, 60]", "[-20, 20]") + "[[pose]]\nposition_mm = [550, 0, -700]\n");
  EXPECT_EQ(beyond.status, Status::limit_reached);
  EXPECT_THAT(to_string(beyond.diagnostics.at(0)), HasSubstr("beyond its travel"));
  // A platform that has turned by the angle where its rods hold it no longer.
  const auto singular = run_text(hexa +
                                 "[home]\nposition_mm = [0, 0, -500]\n[[pose]]\nposition_mm = [0, 0, "
                                 "-500]\nrotation_rad = [0, 0, 1.6147137688767497]\n");
  EXPECT_EQ(singular.status, Status::singular);
  EXPECT_THAT(to_string(singular.diagnostics.at(0)),
              HasSubstr("singular (type_2): the rods do not hold the platform"));
}

const std::string clear =
    "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"parallel.delta\"\nbase_radius_mm = 145\n"
    "platform_radius_mm = 45\narm_mm = 500\nrod_mm = 500\n[home]\nposition_mm = [0, 0, -600]\n";

TEST(PosesStudy, APoseBeyondTheConstraintIsNoUse) {
  const auto result =
      run_text(clear +
               "[[pose]]\nposition_mm = [0, 0, -600]\n[[pose]]\nposition_mm = [300, 0, -440]\n"
               "[[pose]]\nposition_mm = [270.8689700253, 0, -455.5365493198]\n"
               "[[pose]]\narm_angles_rad = [0.069, 1.1843, 1.1843]\n");
  const Value& path = linkwright::test::at(computed("delta-constraint-path"), "paths.clear");
  const auto& index = column(result, "poses", "constraint_index");
  EXPECT_NEAR(index.at(0), linkwright::test::number_at(path, "start.index"), 1e-9);
  EXPECT_NEAR(index.at(1), linkwright::test::number_at(path, "end.index"), 1e-9);
  EXPECT_NEAR(column(result, "poses", "constraint_determinant").at(1),
              linkwright::test::number_at(path, "end.det_of_unit_rows"), 1e-9);
  const Table& poses = test::table(result, "poses");
  EXPECT_THAT(poses.status, ::testing::ElementsAre("done", "branch_lost", "singular", "branch_lost"));
  EXPECT_THAT(column(result, "poses", "joined_to_home"), ::testing::ElementsAre(1, -1, ::testing::_, -1));
  EXPECT_GT(column(result, "poses", "clear_radius_m").at(0), 0.01);
  EXPECT_EQ(column(result, "poses", "clear_radius_m").at(2), 0);
  ASSERT_EQ(result.diagnostics.size(), 3u);
  EXPECT_THAT(to_string(result.diagnostics[0]), HasSubstr("of another assembly of the platform than home"));
  EXPECT_THAT(to_string(result.diagnostics[1]), HasSubstr("the rods of legs 2 and 3 lie level"));
  EXPECT_EQ(test::fact(result, "poses reached"), "1 of 4");
}

// Beyond the level rods on both sides of a leg: the same marks, yet the straight way is blocked.
TEST(PosesStudy, EqualMarksProveNothingYet) {
  const auto result = run_text(test::replaced(clear, "[0, 0, -600]", "[258.4, -150, -450]") +
                               "[[pose]]\nposition_mm = [258.4, 150, -450]\n");
  EXPECT_EQ(result.status, Status::done);
  EXPECT_EQ(column(result, "poses", "joined_to_home").at(0), 0);
  EXPECT_THAT(test::fact(result, "pose 1: path from home"),
              HasSubstr("the straight path is blocked at 38.94 %"));
}

TEST(PosesStudy, AHexaTellsOfThreeWays) {
  const std::string at_home = hexa + "[home]\nposition_mm = [0, 0, -500]\n";
  const auto result =
      run_text(at_home +
               "[[pose]]\nname = \"turned\"\nposition_mm = [0, 0, -500]\nrotation_deg = [0, 0, 60]\n"
               "[[pose]]\nname = \"beyond\"\nposition_mm = [0, 0, -500]\nrotation_deg = [0, 0, 170]\n");
  EXPECT_THAT(test::fact(result, "turned: path from home"), HasSubstr("the straight path is free"));
  EXPECT_THAT(test::fact(result, "beyond: path from home"), HasSubstr("of another assembly than home"));
  EXPECT_THAT(test::table(result, "poses").status, ::testing::ElementsAre("done", "branch_lost"));
  EXPECT_THAT(column(result, "poses", "joined_to_home"), ::testing::ElementsAre(1, -1));
}

TEST(PosesStudy, ArmsOfAHexaAreLedFromHome) {
  const Pose to{{0.05, -0.03, -0.5}, math::turn_about(Vec3{0.15, -0.2, 0.25})};
  const ArmAngles arms = inverse(reference_hexa(), to);
  std::string angles;
  for (const double a : arms.angle) angles += (angles.empty() ? "" : ", ") + std::to_string(a);
  const auto result =
      run_text(hexa + "[home]\nposition_mm = [0, 0, -500]\n[[pose]]\narm_angles_rad = [" + angles + "]\n");
  EXPECT_EQ(result.status, Status::done);
  EXPECT_NEAR(column(result, "poses", "x_m").at(0), 0.05, 1e-5);
  EXPECT_NEAR(column(result, "poses", "rotation_z_rad").at(0), 0.25, 1e-4);
  EXPECT_THAT(test::fact(result, "pose 1: path from home"), HasSubstr("the arms lead there"));
}

TEST(PosesStudy, TellsWhatDoesNotFitTogether) {
  EXPECT_THAT(problems_of(delta + "[[pose]]\nname = \"a\"\n"), HasSubstr("position: is missing"));
  EXPECT_THAT(problems_of(delta + "[[pose]]\nposition_mm = [0, 0, -800]\nrotation_deg = [0, 0, 5]\n"),
              HasSubstr("the platform of this robot does not turn"));
  EXPECT_THAT(problems_of(delta + "[[pose]]\nposition_mm = [0, 0, -800]\nmoment_N_m = [0, 0, 5]\n"),
              HasSubstr("no drive feels it"));
}

}  // namespace
}  // namespace linkwright::parallel
