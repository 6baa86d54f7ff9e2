// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/indirect.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <regex>
#include <string>

#include "linkwright/suspension/corner/suspension.h"
#include "support/message.h"
#include "support/resumed.h"
#include "suspension/studies.h"

namespace linkwright::suspension {
namespace {

using test::fact;
using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::HasSubstr;

const std::string& poses_example() { return test::example("carrier_poses"); }

TEST(IndirectStudy, FindsTheRodsThatThePositionsComeFrom) {
  const study::Result result = run_text(poses_example());
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  EXPECT_EQ(result.statistics.find("success_rate")->as_number(), 1);
  const study::Solution& best = result.solutions.at(0);
  EXPECT_LT(best.objectives.find("max_constraint_error_m")->as_number(), 1e-9);
  EXPECT_EQ(best.label, "5US");
  // Poznanovic 2016, example 1; the positions are given with 10 digits, and link 1 is determined to about
  // 1e-4 of their errors.
  const auto value = [&](std::string_view key) {
    for (const study::Parameter& p : best.parameters)
      if (p.key == key) return p.value;
    ADD_FAILURE() << key;
    return 0.0;
  };
  EXPECT_NEAR(value("lower_front_rod_body_x_m"), 0.2115, 1e-5);
  EXPECT_NEAR(value("lower_front_rod_carrier_z_m"), -0.134, 1e-5);
  EXPECT_NEAR(value("tie_rod_body_y_m"), 0.366, 1e-5);
  EXPECT_EQ(value("upper_rear_rod_body_x_m"), -0.303);
  const Table& poses = result.tables.at(0);
  ASSERT_EQ(poses.name, "poses");
  for (double deviation : poses.find("deviation_toe_rad")->values) EXPECT_LT(std::abs(deviation), 1e-8);
}

TEST(IndirectStudy, ListsEveryRodThroughSevenPositions) {
  const study::Result result = run_text(poses_example());
  const Table& rods = test::table(result, "seven_pose_rods");
  ASSERT_EQ(rods.names.size(), rods.rows());
  int solutions[2] = {}, found = 0;
  for (std::size_t i = 0; i < rods.rows(); ++i) {
    const auto at = [&](const char* key) { return rods.find(key)->values.at(i); };
    ++solutions[at("moved_by_rack") > 0];
    const bool real = at("is_real") > 0;
    EXPECT_EQ(std::isfinite(at("structural_error_rms_m")), real);
    EXPECT_EQ(at("body_x_imaginary_m") == 0 && at("carrier_z_imaginary_m") == 0, real);
    // The rods that the search takes stand in the list under the names of their boxes.
    if (rods.names[i] == "lower front rod") {
      ++found;
      EXPECT_NEAR(at("body_x_m"), 0.2115, 1e-5);
      EXPECT_NEAR(at("carrier_z_m"), -0.134, 1e-5);
      EXPECT_LT(at("structural_error_max_m"), 1e-8);
    }
  }
  EXPECT_EQ(solutions[0], 20);
  EXPECT_EQ(solutions[1], 20);
  EXPECT_EQ(found, 1);
  EXPECT_THAT(fact(result, "rods through seven positions"), HasSubstr("20 solutions, "));
  EXPECT_THAT(fact(result, "rods through seven positions, on the rack"), HasSubstr("1 fit all positions"));
}

TEST(IndirectStudy, ReportsFamiliesOfRodsAsHingedArms) {
  // Positions of a suspension with a wishbone (RS), and rods that are asked for.
  const Suspension& suspension = corner_sample("RS-3US").suspension;
  const CornerPlan plan = prepare_suspension(suspension);
  std::string text = "schema = 1\nkind = \"synthesis\"\n[mechanism]\ntype = \"suspension.corner\"\n";
  text +=
      fmt::format("[mechanism.wheel]\ncentre_m = {}\ntoe_rad = {}\ncamber_rad = {}\ntyre_diameter_m = {}\n",
                  test::written(suspension.wheel.centre), suspension.wheel.toe, suspension.wheel.camber,
                  suspension.wheel.tyre_diameter);
  int open = 0;
  for (const CornerLink& l : suspension.links) {
    const bool rod = l.type == LinkType::US;
    const std::string ends =
        rod && open++ == 0 ? fmt::format("body_m = {{ near = {}, box_m = 0.1 }}\ncarrier_m = {}\n",
                                         test::written(l.body[0]), test::written(l.carrier[0]))
        : rod              ? fmt::format("body_m = {}\ncarrier_m = {}\n", test::written(l.body[0]),
                                         test::written(l.carrier[0]))
                           : fmt::format("body_m = [{}, {}]\ncarrier_m = {}\n", test::written(l.body[0]),
                                         test::written(l.body[1]), test::written(l.carrier[0]));
    text +=
        fmt::format("[[mechanism.link]]\nname = \"{}\"\ntype = \"{}\"\n{}", l.name, name_of(l.type), ends);
  }
  text += "[target]\ntype = \"carrier_poses\"\n";
  for (double travel = -0.08; travel < 0.085; travel += 0.02) {
    const CornerPosition p =
        solve_position(plan, Driver::wheel_centre_z, {travel, 0}, reference_position(plan));
    const WheelAngles a = wheel_angles(Side::left, suspension.wheel, p.place.carrier.rotation);
    text +=
        fmt::format("[[target.pose]]\ncentre_m = {}\ntoe_rad = {}\ncamber_rad = {}\ncarrier_pitch_rad = {}\n",
                    test::written(p.place.carrier.centre), a.toe, a.camber, a.carrier_pitch);
  }
  const study::Result result = run_text(text);
  const Table& arms = test::table(result, "seven_pose_arms");
  ASSERT_EQ(arms.names, std::vector<std::string>{"RS"});
  const CornerLink& arm = suspension.links[0];
  EXPECT_NEAR(arms.find("ball_x_m")->values.at(0), arm.carrier[0].x, 1e-5);
  EXPECT_NEAR(arms.find("ball_y_m")->values.at(0), arm.carrier[0].y, 1e-5);
  // Its axis is the hinge of the wishbone.
  for (const char* end : {"hinge_1", "hinge_2"}) {
    const auto c = [&](const char* axis) {
      return arms.find(fmt::format("{}_{}_m", end, axis))->values.at(0);
    };
    const Vec3 p{c("x"), c("y"), c("z")};
    EXPECT_LT(norm(cross(p - arm.body[0], math::unit(arm.body[1] - arm.body[0]))), 1e-5);
  }
  EXPECT_THAT(fact(result, "rods through seven positions"), HasSubstr("1 hinged arms (RS, SR)"));
}

TEST(IndirectStudy, GoesOnFromACheckpointWithTheSameBits) {
  ::linkwright::test::expect_resumed_alike(test::kinds(),
                                           replaced(poses_example(), "count = 10 }", "count = 3 }"), 3);
  // Positions that no exact suspension takes: the links keep what they miss.
  ::linkwright::test::expect_resumed_alike(
      test::kinds(),
      replaced(replaced(poses_example(), "toe_deg = -6.688676046", "toe_deg = -5.5"), "count = 10 }",
               "count = 2 }"),
      2);
}

TEST(IndirectStudyRead, SlipsOfUnitsAreTold) {
  EXPECT_THAT(problems_of(replaced(poses_example(), "0.6826680943, -0.2]", "0.6826680943, -200.0]")),
              HasSubstr("target.pose: position 1: the wheel centre lies 200 m from its reference"));
}

TEST(IndirectStudy, FindsTheSameCornerOnTheRight) {
  // The mirror image: y changes its sign in every [x, y, z], and so does the rack's direction.
  std::string mirrored = std::regex_replace(
      poses_example(), std::regex(R"(\[([^\[\],]+),\s*(-?)([0-9.]+),([^\[\],]+)\])"), "[$1, @$2$3,$4]");
  mirrored = std::regex_replace(mirrored, std::regex("@-"), "");
  mirrored = std::regex_replace(mirrored, std::regex("@"), "-");
  mirrored = replaced(mirrored, "side = \"left\"", "side = \"right\"\nrack = { direction = [0, -1, 0] }");
  const study::Result right = run_text(mirrored), left = run_text(poses_example());
  ASSERT_EQ(right.status, Status::done) << to_string(right.headline);
  for (std::size_t i = 0; i < left.solutions.at(0).parameters.size(); ++i) {
    const study::Parameter &l = left.solutions[0].parameters[i], &r = right.solutions.at(0).parameters.at(i);
    EXPECT_NEAR(r.value, l.key.ends_with("_y_m") ? -l.value : l.value, 1e-6) << l.key;
  }
}

TEST(IndirectStudy, SaysWhatItLacksWhenPositionsCannotBeTaken) {
  // A wheel that rises straight but turns about itself by a degree: no rods in these boxes do that.
  const study::Result result =
      run_text(replaced(poses_example(), "toe_deg = -6.688676046", "toe_deg = -5.5"));
  EXPECT_NE(result.status, Status::done);
  EXPECT_THAT(to_string(result.headline),
              HasSubstr("The best 5US wheel suspension within the boxes misses the"));
  const std::string remarks = test::lines_of(result.diagnostics);
  EXPECT_THAT(remarks, HasSubstr("the links are the best in the sense of least squares"));
  EXPECT_THAT(remarks, HasSubstr("measured positions have errors of their own: tolerance_mm = "));
  EXPECT_EQ(result.statistics.find("success_rate")->as_number(), 0);
  // The tolerance of the warning accepts the links in a second run.
  std::smatch tolerance;
  ASSERT_TRUE(std::regex_search(remarks, tolerance, std::regex("tolerance_mm = [0-9.e-]+")));
  const study::Result accepted =
      run_text(replaced(replaced(poses_example(), "toe_deg = -6.688676046", "toe_deg = -5.5"),
                        "method = \"recommended\"", "method = \"recommended\"\n" + tolerance.str()));
  EXPECT_EQ(accepted.status, Status::done) << tolerance.str();
  EXPECT_EQ(accepted.statistics.find("success_rate")->as_number(), 1);
}

TEST(IndirectStudy, TellsOfGivenLinksThatDoNotFit) {
  const study::Result result = run_text(
      replaced(poses_example(), "body_mm    = [-303.0, 432.0, 295.0]", "body_mm = [-303.0, 432.0, 299.0]"));
  EXPECT_EQ(result.status, Status::not_converged);
  const Table& links = result.tables.at(2);
  ASSERT_EQ(links.name, "conditioning");
  EXPECT_LT(links.find("structural_error_max_m")->values.at(0), 1e-8);
  EXPECT_GT(links.find("structural_error_max_m")->values.at(3), 1e-6);
}

TEST(IndirectStudyRead, NamesWhatIsWrongWithTheTarget) {
  const std::string good = poses_example();
  const auto target = good.find("[target]"), optimiser = good.find("[optimiser]");
  const std::string before = good.substr(0, target), after = good.substr(optimiser);
  const auto told = [&](const std::string& text) {
    return problems_of(before + "[target]\ntype = \"carrier_poses\"\n" + text + after);
  };
  EXPECT_THAT(told(""), HasSubstr("target.pose: the target has no positions; write file = \"poses.csv\""));
  EXPECT_THAT(told("file = \"nowhere.csv\"\n"), HasSubstr("target.file: cannot read './nowhere.csv'"));
  EXPECT_THAT(told("pose = [ { centre_m = [0, 0.7, 0.1], camber_deg = 0 } ]\n"),
              HasSubstr("target.pose[0].toe_rad: this key is missing"));
  EXPECT_THAT(
      told("pose = [ { centre_mm = [0, 768, 0], toe_deg = 0, camber_deg = -0.7, carrier_pitch_deg = 0 } ]\n"),
      HasSubstr("target.pose: no position besides the reference"));
}

TEST(IndirectStudyRead, NamesWhatIsWrongWithTheMechanism) {
  std::string all_given = poses_example();
  for (const char* text :
       {"near = [220.0, 380.0,  -90.0], box_mm = 150.0", "near = [ 10.0, 730.0, -140.0], box_mm = 150.0"})
    EXPECT_THAT(all_given, HasSubstr(text));
  EXPECT_THAT(problems_of(replaced(poses_example(), "near = [220.0, 380.0,  -90.0], box_mm = 150.0",
                                   "near = [220.0, 380.0,  -90.0], box_mm = -1.0")),
              HasSubstr("mechanism.link[0].body_mm.box_mm: is -1 mm"));
  EXPECT_THAT(
      problems_of(replaced(poses_example(), "body_mm    = { near = [220.0, 380.0,  -90.0], box_mm = 150.0 }",
                           "body_mm = [220, { min = 400, max = 300 }, -90]")),
      HasSubstr("mechanism.link[0].body_mm[1]: min 400 mm is larger than max 300 mm"));
}

}  // namespace
}  // namespace linkwright::suspension
