// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/poses.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using test::problems_of;
using test::run_text;
using ::testing::HasSubstr;

std::string pose_study(const std::string& target, const std::string& mechanism = "") {
  return "schema = 1\nkind = \"synthesis\"\ntitle = \"test\"\n[mechanism]\ntype = \"planar.four_bar\"\n" +
         mechanism + "[target]\ntype = \"poses\"\n" + target;
}
std::string one_pose(double x, double y, double angle) {
  return "[[target.pose]]\nx_mm = " + std::to_string(x) + "\ny_mm = " + std::to_string(y) +
         "\nangle_deg = " + std::to_string(angle) + "\n";
}
std::string some_poses(int count) {
  std::string out;
  for (int k = 0; k < count; ++k) out += one_pose(100 * k, 20 * k * k, 10 * k + k * k);
  return out;
}

TEST(PoseStudyRead, SaysWhatIsWrongWithThePoses) {
  EXPECT_THAT(problems_of(pose_study("")), HasSubstr("the target has no poses"));
  EXPECT_THAT(problems_of(pose_study(some_poses(1))), HasSubstr("1 pose, a motion needs at least 2"));
  EXPECT_THAT(problems_of(pose_study(some_poses(4) + one_pose(100, 20, 11))),
              HasSubstr("pose 5 repeats pose 2"));
  EXPECT_THAT(problems_of(pose_study(one_pose(0, 0, 10) + one_pose(1, 0, 10) + one_pose(2, 2, 370))),
              HasSubstr("all poses have the same angle: the body only shifts"));
  EXPECT_THAT(problems_of(pose_study("file = \"poses.csv\"\n" + some_poses(4))),
              HasSubstr("both poses and a file"));
}

TEST(PoseStudyRead, SaysHowManyConditionsADyadMeets) {
  EXPECT_THAT(problems_of(pose_study("fit = \"exact\"\n" + some_poses(6))),
              HasSubstr("6 poses, a linkage of links and slides meets five exactly"));
  EXPECT_THAT(problems_of(pose_study("fit = \"least_squares\"\n" + some_poses(4))),
              HasSubstr("least_squares needs 5 at least"));
  EXPECT_THAT(problems_of(pose_study(some_poses(2))), HasSubstr("2 poses leave 3 numbers of dyad 1 open"));
  const std::string pivot = "[[mechanism.pivot]]\ndyad = 1\nfixed_mm = [0, 0]\n";
  EXPECT_THAT(
      problems_of(pose_study(some_poses(4), pivot)),
      HasSubstr("4 poses and what is given of the pivots of dyad 1 are 6 conditions, a dyad meets 5"));
  EXPECT_THAT(problems_of(pose_study(some_poses(3), pivot + pivot)),
              HasSubstr("the fixed pivot of dyad 1 is given twice"));
  EXPECT_THAT(problems_of(pose_study(some_poses(6), pivot)),
              HasSubstr("pivots are prescribed for poses that are met exactly"));
  EXPECT_THAT(problems_of(pose_study(some_poses(3), "[[mechanism.pivot]]\ndyad = 3\nfixed_mm = [0, 0]\n")),
              HasSubstr("mechanism.pivot[0].dyad"));
}

TEST(PoseStudyRead, SaysWhatIsWrongWithRegions) {
  const auto pivot = [](const std::string& what) { return "[[mechanism.pivot]]\ndyad = 1\n" + what + "\n"; };
  const std::string region = "fixed_in_region = { min_mm = [0, 0], max_mm = [50, 50] }";
  EXPECT_THAT(problems_of(pose_study(some_poses(4),
                                     pivot("fixed_in_region = { min_mm = [0, 60], max_mm = [50, 50] }"))),
              HasSubstr("fixed_in_region: min is not below max in y"));
  EXPECT_THAT(problems_of(pose_study(some_poses(3), pivot(region + "\nfixed_mm = [0, 0]"))),
              HasSubstr("the fixed pivot of dyad 1 is given twice"));
  EXPECT_THAT(problems_of(pose_study(some_poses(3), pivot(region) + pivot(region))),
              HasSubstr("the fixed pivot of dyad 1 is given twice"));
  EXPECT_THAT(problems_of(pose_study(some_poses(2), pivot(region))), HasSubstr("a region is no condition"));
  EXPECT_THAT(problems_of(pose_study("fit = \"least_squares\"\n" + some_poses(6), pivot(region))),
              HasSubstr("pivots are prescribed for poses that are met exactly"));
}

TEST(PoseStudy, KeepsPivotsInTheirRegions) {
  const auto pivot = [](int dyad, const char* place) {
    return "[[mechanism.pivot]]\ndyad = " + std::to_string(dyad) + "\nfixed_in_region = " + place + "\n";
  };
  const study::Result in = run_text(pose_study(
      some_poses(3), "dyads = [\"RR\"]\n" + pivot(1, "{ min_mm = [30, 290], max_mm = [120, 430] }") +
                         pivot(2, "{ min_mm = [-80, 290], max_mm = [0, 430] }")));
  EXPECT_EQ(in.status, Status::done);
  EXPECT_FALSE(in.solutions.empty());
  for (const study::Solution& s : in.solutions) {
    std::vector<double> x;
    for (const study::Parameter& p : s.parameters) {
      if (p.key.ends_with("fixed_x_m")) x.push_back(p.value);
      if (!p.key.ends_with("fixed_y_m")) continue;
      EXPECT_GE(p.value, 0.29);
      EXPECT_LE(p.value, 0.43);
    }
    ASSERT_EQ(x.size(), 2u);
    std::sort(x.begin(), x.end());
    EXPECT_TRUE(x[0] >= -0.08 && x[0] <= 0 && x[1] >= 0.03 && x[1] <= 0.12) << x[0] << ", " << x[1];
  }
  // Two rectangles that are drawn and have a handle at two corners each.
  const study::Scene& scene = in.scenes.at(0);
  EXPECT_EQ(
      std::count_if(scene.bodies.begin(), scene.bodies.end(),
                    [](const study::Scene::Body& b) { return b.name.starts_with("region of the fixed"); }),
      2);
  EXPECT_TRUE(std::any_of(scene.handles.begin(), scene.handles.end(), [&](const study::Scene::Handle& h) {
    return h.key == "mechanism.pivot[1].fixed_in_region.max_m" &&
           scene.points[static_cast<std::size_t>(h.point)].x[0] == 0;
  }));

  const study::Result out =
      run_text(pose_study(some_poses(5), pivot(1, "{ min_mm = [1e6, 1e6], max_mm = [2e6, 2e6] }")));
  EXPECT_EQ(out.status, Status::infeasible);
  EXPECT_THAT(to_string(out.headline),
              HasSubstr("No linkage through the poses has its pivots in the regions"));
  EXPECT_EQ(out.statistics.find("outcome")->as_string(), "outside_regions");
}

// No pivot is left that could be swept along a line through the middle.
TEST(PoseStudy, SweepsTwoPosesWithPivotsOnLines) {
  std::string lines;
  for (const int dyad : {1, 2})
    lines += "[[mechanism.pivot]]\ndyad = " + std::to_string(dyad) +
             "\nfixed_on_line = { point_mm = [0, -50], direction_deg = 0 }\n";
  const study::Result result = run_text(pose_study(some_poses(2), lines));
  EXPECT_EQ(result.status, Status::done);
  EXPECT_FALSE(result.solutions.empty());
}

TEST(PoseStudy, FourPosesHaveTheirCurves) {
  const study::Result result = run_text(pose_study(some_poses(4)));
  EXPECT_EQ(result.status, Status::done);
  ASSERT_TRUE(result.table("curve_points"));
  EXPECT_GT(result.table("curve_points")->columns[0].values.size(), 100u);
  EXPECT_EQ(result.plots.back().name, "burmester");
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_FALSE(result.solutions[0].study.is_null());
}

// By Grashof's rule, from the links alone: the drive turns fully where it, or the ground, is the shortest
// link and the sum of the shortest and the longest is not the greater one.
TEST(PoseStudy, LeavesOutDrivesThatDoNotTurnFully) {
  const study::Result turning =
      run_text(pose_study(one_pose(0, 0, 0) + one_pose(50, 50, 20) + one_pose(100, 0, 40),
                          "dyads = [\"RR\"]\ncrank_rotates_fully = true\n"));
  EXPECT_EQ(turning.status, Status::done);
  ASSERT_TRUE(turning.table("designs"));
  const std::vector<double>& kept = turning.table("designs")->find("drive_turns_fully")->values;
  EXPECT_FALSE(kept.empty());
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 1.0), static_cast<long>(kept.size()));
  EXPECT_GT(test::value_of_fact(turning, "left out, the crank does not rotate fully"), 0);
  ASSERT_FALSE(turning.solutions.empty());
  for (const study::Solution& s : turning.solutions) {
    // The body lies at the origin at the first pose.
    const auto pivot = [&](const std::string& name) {
      std::complex<double> out;
      for (const study::Parameter& p : s.parameters) {
        if (p.key == name + "_x_m") out.real(p.value);
        if (p.key == name + "_y_m") out.imag(p.value);
      }
      return out;
    };
    const double crank = std::abs(pivot("drive_fixed") - pivot("drive_moving")),
                 rocker = std::abs(pivot("guide_fixed") - pivot("guide_moving")),
                 ground = std::abs(pivot("drive_fixed") - pivot("guide_fixed")),
                 coupler = std::abs(pivot("drive_moving") - pivot("guide_moving"));
    const auto [least, most] = std::minmax({crank, coupler, rocker, ground});
    EXPECT_LE(least + most, (crank + coupler + rocker + ground) / 2 * (1 + 1e-9));
    EXPECT_TRUE(least == crank || least == ground);
  }
}

TEST(PoseStudy, DrawsThePosesBehindTheLinkage) {
  const study::Result result = run_text(pose_study(some_poses(4)));
  ASSERT_FALSE(result.scenes.empty());
  const study::Scene& scene = result.scenes[0];
  ASSERT_EQ(scene.targets.size(), 1u);
  EXPECT_EQ(scene.targets[0].x.size(), 4u);
  int ghosts = 0;
  for (const auto& body : scene.bodies) ghosts += body.run == 1;
  EXPECT_EQ(ghosts, 4);
}

TEST(PoseStudy, KeepsDefectiveLinkagesAndSaysWhatToRelax) {
  // Scattered poses: every linkage through them has a defect.
  const std::string scattered = one_pose(12, 80, 170) + one_pose(-160, 30, -40) + one_pose(90, -120, 75) +
                                one_pose(-20, -60, -130) + one_pose(140, 100, 20);
  const study::Result result = run_text(pose_study(scattered));
  EXPECT_EQ(result.status, Status::infeasible);
  ASSERT_FALSE(result.diagnostics.empty());
  EXPECT_THAT(to_string(result.diagnostics[0].message), HasSubstr("five poses leave at most four dyads"));
  if (!result.solutions.empty()) {
    EXPECT_EQ(result.statistics.find("outcome")->as_string(), "all_defective");
    EXPECT_THAT(to_string(result.headline), HasSubstr("passes them in one motion"));
    EXPECT_FALSE(result.solutions[0].defects.empty());
    EXPECT_FALSE(result.solutions[0].scene.empty());
  }
}

TEST(PoseStudy, SaysWhenTheBodyOnlyTurns) {
  std::string turning;
  for (const double angle : {0.0, 40.0, 90.0, 120.0, 170.0}) turning += one_pose(30, 10, angle);
  const study::Result result = run_text(pose_study(turning));
  EXPECT_EQ(result.status, Status::infeasible);
  EXPECT_EQ(result.statistics.find("outcome")->as_string(), "dependent_poses");
  EXPECT_THAT(to_string(result.headline), HasSubstr("infinitely many dyads"));
}

TEST(PoseStudy, ManyPosesByLeastSquares) {
  const study::Result result = run_text(pose_study(some_poses(8)));
  EXPECT_TRUE(result.status == Status::done || result.status == Status::infeasible);
  EXPECT_THAT(to_string(result.facts[0].text), HasSubstr("by least squares"));
  ASSERT_FALSE(result.solutions.empty());
}

std::string one_point(double x, double y) {
  return "[[target.pose]]\nx_mm = " + std::to_string(x) + "\ny_mm = " + std::to_string(y) + "\n";
}

TEST(PoseStudyRead, SaysWhatMayBeMixed) {
  const std::string exact = "exact = true\n";
  const std::string fit = "fit = \"exact\"\n";
  EXPECT_THAT(
      problems_of(pose_study(fit + some_poses(3) + one_point(300, 300))),
      HasSubstr("3 poses and 1 point are met exactly by infinitely many linkages; four-bars take 4 poses and "
                "2 points, 3 and 4, or 2 and 6; slider-cranks 4 and 1, 3 and 3, or 2 and 5"));
  EXPECT_THAT(problems_of(pose_study(fit + some_poses(4) + one_point(310, 300) + one_point(420, 410) +
                                     one_point(520, 590))),
              HasSubstr("4 poses and 3 points are met exactly by no linkage of two dyads"));
  EXPECT_THAT(problems_of(pose_study(fit + some_poses(4) + one_point(400, 330) + "weight = 2\n")),
              HasSubstr("weights and poses that are marked exact are for least_squares"));
  EXPECT_THAT(problems_of(pose_study(some_poses(1) + one_point(100, 30) + one_point(200, 90) +
                                     one_point(300, 200) + one_point(350, 250))),
              HasSubstr("1 of 5 poses have an angle, a motion needs 2 at least; points alone are a path"));
  EXPECT_THAT(problems_of(pose_study(some_poses(4) + one_point(400, 330) + exact)),
              HasSubstr("pose 5 is to be met exactly, but has no angle"));
  EXPECT_THAT(problems_of(pose_study(some_poses(4) + one_point(100, 20))),
              HasSubstr("pose 5 repeats pose 2"));
  std::string five;
  for (int k = 0; k < 5; ++k) five += one_pose(100 * k, 20 * k * k, 10 * k + k * k) + exact;
  EXPECT_THAT(problems_of(pose_study(five + one_pose(500, 520, 80))),
              HasSubstr("5 poses are to be met exactly beside others, at most 4 can be"));
}

// Poses and points of a four-bar with ground 1, crank 0.4, coupler 0.9, rocker 0.8 m, by a program of a few
// lines.
TEST(PoseStudy, PosesAndPointsThatLeaveNothingToChooseHaveAllFourBars) {
  std::string target;
  target += one_pose(88.510355310, 617.804564991, 72.112861104);
  target += one_point(109.662008130, 803.766243012);
  target += one_point(35.582357299, 865.774056794);
  target += one_pose(-87.259118650, 829.171001292, 47.371120820);
  target += one_point(-211.667728704, 715.069645317);
  target += one_point(-308.071889076, 548.622886238);
  target += one_pose(-365.798102710, 358.001142644, 53.060665722);
  const study::Result result = run_text(pose_study("fit = \"exact\"\n" + target));
  EXPECT_EQ(result.status, Status::done);
  EXPECT_EQ(result.statistics.find("solutions")->as_number(), 201);
  EXPECT_THAT(to_string(result.facts[0].text), HasSubstr("3 poses and 4 points, met exactly"));
  EXPECT_THAT(to_string(result.facts[1].text), HasSubstr("real of 201"));
  const auto has = [](const study::Solution& s, const char* key, double value) {
    return std::any_of(s.parameters.begin(), s.parameters.end(), [&](const study::Parameter& p) {
      return p.key == key && std::abs(p.value - value) < 1e-6;
    });
  };
  EXPECT_TRUE(std::any_of(result.solutions.begin(), result.solutions.end(), [&](const study::Solution& s) {
    return has(s, "drive_length_m", 0.4) && has(s, "guide_length_m", 0.8);
  }));
  const Table* poses = result.table("poses");
  ASSERT_TRUE(poses);
  for (const double distance : poses->find("distance_m")->values) EXPECT_EQ(distance, 0);
}

TEST(PoseStudy, MixesExactPosesOthersAndPoints) {
  const std::string exact = "exact = true\n";
  const study::Result result = run_text(pose_study(one_pose(0, 0, 0) + exact + one_pose(95, 25, 12) +
                                                   "weight = 4\n" + one_point(200, 70) + one_point(300, 170) +
                                                   one_pose(400, 310, 50) + exact + one_point(450, 430)));
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_THAT(to_string(result.facts[0].text),
              HasSubstr("6, 2 of them exactly, 3 at any rotation, by least squares"));
  const Table* poses = result.table("poses");
  ASSERT_TRUE(poses);
  EXPECT_LT(poses->find("distance_m")->values[0], 1e-10);
  EXPECT_LT(std::abs(poses->find("rotation_error_rad")->values[4]), 1e-10);
  EXPECT_TRUE(std::isnan(poses->find("rotation_error_rad")->values[2]));
  int ghosts = 0;
  for (const auto& body : result.scenes[0].bodies) ghosts += body.run == 1;
  EXPECT_EQ(ghosts, 3);
  EXPECT_EQ(result.scenes[0].targets[0].x.size(), 6u);
}

}  // namespace
}  // namespace linkwright::planar
