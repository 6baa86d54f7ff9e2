// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/any_machine.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "planar/studies.h"
#include "support/memory_checkpoint.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

/// A study with some of its parts replaced.
std::string any_path(const std::map<std::string, std::string>& changed = {}) {
  return test::text_of({{"0", "schema = 1\nkind = \"synthesis\"\n"},
                        {"1", "[mechanism]\ntype = \"planar.any\"\n"},
                        {"2",
                         "[target]\ntype = \"path_points\"\npoints_mm = [[0, 0], [40, 5], [60, 30], [40, "
                         "50], [0, 40], [-10, 20]]\nclosed = true\n"},
                        {"3", ""},
                        {"4", "[optimiser]\nevaluations = 60000\n"}},
                       changed);
}

TEST(AnyPathStudies, ListMachinesBestFirst) {
  const study::Result result = test::run_text(any_path());
  EXPECT_EQ(result.status, Status::done);
  ASSERT_GE(result.solutions.size(), 2U);
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  const auto& error = machines->find("path_error_rms_m")->values;
  EXPECT_TRUE(std::is_sorted(error.begin(), error.end()));
  EXPECT_EQ(error.size(), result.solutions.size());
  for (const double angle : machines->find("least_pair_angle_rad")->values) EXPECT_GE(angle, 20 * pi / 180);
  ASSERT_TRUE(result.table("families"));
  EXPECT_EQ(result.scenes.size(), result.solutions.size());
  EXPECT_THAT(to_string(result.headline), HasSubstr("follows the stroke"));
}

TEST(AnyPathStudies, KeepToTheFamiliesAndLinksThatAreAskedFor) {
  const study::Result result = test::run_text(
      any_path({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"four_bar\", \"slider_crank\"]\n"},
                {"4", "[optimiser]\nevaluations = 20000\nmax_solutions = 3\n"}}));
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_LE(result.solutions.size(), 3U);
  for (const study::Solution& solution : result.solutions)
    EXPECT_EQ(solution.classification.find("links")->as_number(), 4);
}

// Cognates of the four-bars of the list, with the lengths of their own.
TEST(AnyPathStudies, OfferTheCognatesOfFourBarsAsLayouts) {
  const study::Result result =
      test::run_text(any_path({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"four_bar\"]\n"},
                               {"4", "[optimiser]\nevaluations = 40000\n"}}));
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_THAT(to_string(result.solutions[0].label),
              HasSubstr("Four-bar linkage, traced point on the coupler, rms"));
  EXPECT_EQ(result.solutions[0].classification.find("program")->as_string(), "four_bar");
  const Table* layouts = result.table("layouts");
  ASSERT_TRUE(layouts);
  EXPECT_EQ(layouts->rows(), 2 * result.solutions.size());
  const Table* machines = result.table("machines");
  for (std::size_t i = 0; i < layouts->rows(); ++i) {
    EXPECT_LT(layouts->find("largest_deviation_m")->values[i], 1e-9 * layouts->find("size_m")->values[i]);
    const auto machine = static_cast<std::size_t>(layouts->find("machine")->values[i]) - 1;
    if (layouts->find("same_timing")->values[i] == 1) {
      EXPECT_NEAR(layouts->find("least_pair_angle_rad")->values[i],
                  machines->find("least_pair_angle_rad")->values[machine], 1e-3);
    }
    EXPECT_GT(layouts->find("crank_m")->values[i], 0);
  }
}

// A stroke that is sampled three times as finely along one side is the same stroke. Searches of many links
// follow its roundings, which differ.
TEST(AnyPathStudies, DoNotDependOnTheSpacingOfThePoints) {
  const auto run = [](const char* points) {
    return test::run_text(any_path(
        {{"1", "[mechanism]\ntype = \"planar.any\"\nmost_links = 4\n"},
         {"2", std::string("[target]\ntype = \"path_points\"\nclosed = true\npoints_mm = ") + points + "\n"},
         {"4", "[optimiser]\nevaluations = 20000\n"}}));
  };
  const study::Result coarse = run("[[0, 0], [40, 0], [40, 30], [0, 30], [0, 15]]");
  const study::Result fine =
      run("[[0, 0], [10, 0], [20, 0], [20, 0], [40, 0], [40, 30], [0, 30], [0, 15], [0, 0]]");
  ASSERT_FALSE(coarse.solutions.empty());
  ASSERT_EQ(coarse.solutions.size(), fine.solutions.size());
  EXPECT_NEAR(coarse.solutions[0].objectives.find("path_error_rms_m")->as_number(),
              fine.solutions[0].objectives.find("path_error_rms_m")->as_number(), 1e-9);
}

TEST(AnyPathStudies, SayWhatIsWrong) {
  const auto problems = [](const std::map<std::string, std::string>& changed) {
    return test::problems_of(any_path(changed));
  };
  EXPECT_THAT(
      problems({{"2", "[target]\ntype = \"path_points\"\npoints_mm = [[0, 0], [40, 5], [60, 30]]\n"}}),
      HasSubstr("3 points make no path, at least 5 are needed"));
  EXPECT_THAT(
      problems(
          {{"2",
            "[target]\ntype = \"path_points\"\npoints_mm = [[1, 1], [1, 1], [1, 1], [1, 1], [1, 1]]\n"}}),
      HasSubstr("at least 5 are needed"));
  EXPECT_THAT(problems({{"2", "[target]\ntype = \"path_points\"\n"}}), HasSubstr("the target has no points"));
  EXPECT_THAT(problems({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = []\n"}}),
              HasSubstr("the list of families is empty"));
  EXPECT_THAT(problems({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"wat_1\"]\n"}}),
              HasSubstr("watt_1"));
  EXPECT_THAT(problems({{"1", "[mechanism]\ntype = \"planar.any\"\nmost_links = 12\n"}}),
              HasSubstr("most_links"));
  EXPECT_THAT(problems({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"ten_bar\"]\n"}}),
              HasSubstr("ten_bar has 10 links, most_links allows 8"));
  EXPECT_THAT(problems({{"3", "[limits]\nleast_pair_angle_deg = 80\n"}}), HasSubstr("least_pair_angle_deg"));
  EXPECT_THAT(problems({{"21", "orientation_length_mm = 4\n"}}), HasSubstr("a point has no rotation"));
  EXPECT_THAT(problems({{"21", "dwell = [{ from_deg = 0, to_deg = 40 }]\n"}}),
              HasSubstr("write type = \"function\""));
  EXPECT_THAT(problems({{"4", "[optimiser]\nevaluations = 20000\nseconds = 1\n"}}),
              HasSubstr("both seconds and evaluations"));
}

TEST(AnyPathStudies, SayWhatIsWrongWithLimits) {
  const auto problems = [](const char* limits) {
    return test::problems_of(any_path({{"3", std::string("[limits]\n") + limits + "\n"}}));
  };
  EXPECT_THAT(problems("shortest_link = 0.1\nshortest_length_mm = 3"), HasSubstr("keep one of them"));
  EXPECT_THAT(problems("longest_link = 4\nlongest_length_mm = 90"), HasSubstr("keep one of them"));
  EXPECT_THAT(problems("shortest_length_mm = 30\nlongest_length_mm = 20"),
              HasSubstr("not below the longest"));
  EXPECT_THAT(problems("ground_box_mm = { x = [10, 0], y = [0, 10] }"), HasSubstr("the box has no inside"));
  EXPECT_THAT(problems("ground_pivots_mm = []"), HasSubstr("1 to 4 can be given"));
  EXPECT_THAT(problems("ground_box_mm = { x = [0, 9], y = [0, 9] }\nground_pivots_mm = [[5, 10]]"),
              HasSubstr("outside the box"));
}

TEST(AnyPathStudies, TakeLimitsAsLengths) {
  const study::Result result =
      test::run_text(any_path({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"four_bar\"]\n"},
                               {"3",
                                "[limits]\nshortest_length_mm = 9\nlongest_length_mm = 90\n"
                                "ground_box_mm = { x = [-20, 80], y = [60, 100] }\n"},
                               {"4", "[optimiser]\nevaluations = 40000\n"}}));
  ASSERT_FALSE(result.solutions.empty());
  const Table* machines = result.table("machines");
  EXPECT_GE(machines->find("shortest_link_m")->values[0], 0.009 * 0.998);
  EXPECT_LE(machines->find("longest_link_m")->values[0], 0.09 * 1.002);
  const Value* limit = result.solutions[0].classification.find("limited_by");
  ASSERT_TRUE(limit);
  EXPECT_THAT(limit->as_string(), HasSubstr("ground_box"));
}

TEST(AnyPathStudies, AskForWhatTenBarsGrowFrom) {
  const auto mechanism =
      std::string("[mechanism]\ntype = \"planar.any\"\nmost_links = 10\nfamilies = [\"ten_bar\"]\n");
  EXPECT_THAT(test::problems_of(any_path({{"1", mechanism}})), HasSubstr("ten_bar is grown from eight_bar"));
}

// A stroke that a slide draws by itself is searched all the same.
TEST(AnyPathStudies, WarnOfAStraightStroke) {
  std::string messages;
  const auto changed =
      std::string("[target]\ntype = \"path_points\"\npoints_mm = [[0, 0], [1, 0], [2, 0], [3, 0], [4, 0]]\n");
  EXPECT_TRUE(test::prepare(any_path({{"2", changed}}), messages));
  EXPECT_THAT(messages, HasSubstr("straight line"));
}

TEST(AnyPathStudies, WarnOfACircle) {
  std::string messages;
  const auto changed = std::string(
      "[target]\ntype = \"path_points\"\npoints_mm = [[5, 0], [4, 3], [3, 4], [0, 5], [-3, 4], [-4, 3], [-5, "
      "0], "
      "[-4, -3], [-3, -4], [0, -5], [3, -4], [4, -3], [5, 0]]\n");
  EXPECT_TRUE(test::prepare(any_path({{"2", changed}}), messages)) << messages;
  EXPECT_THAT(messages, ::testing::Not(HasSubstr("circle")));  // a polygon of twelve sides
  std::string round = "[target]\ntype = \"path_points\"\nclosed = true\npoints_mm = [";
  for (int k = 0; k < 90; ++k)
    round += fmt::format("[{:.6f}, {:.6f}],", 20 * std::cos(pi * k / 45), 20 * std::sin(pi * k / 45));
  EXPECT_TRUE(test::prepare(any_path({{"2", round + "]\n"}}), messages)) << messages;
  EXPECT_THAT(messages, HasSubstr("the stroke is a circle with a radius of 19.99 mm"));
}

// The way back takes two thirds of the turn.
TEST(AnyPathStudies, MeetPointsAtGivenCrankAngles) {
  const std::string points =
      "[target]\ntype = \"path_points\"\npoints_mm = [[0, 0], [40, 5], [60, 30], [40, 50], [0, 40], [-10, "
      "20]]\nclosed = true\n";
  const study::Result result = test::run_text(
      any_path({{"1", "[mechanism]\ntype = \"planar.any\"\nmost_links = 5\n"},
                {"2", points + "timing = { mode = \"given\", angles_deg = [0, 40, 80, 120, 200, 280] }\n"}}));
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_LT(result.solutions[0].objectives.find("path_error_share")->as_number(), 0.2);
  EXPECT_THAT(
      test::problems_of(any_path(
          {{"2", points + "timing = { mode = \"given\", angles_deg = [0, 40, 30, 120, 200, 280] }\n"}})),
      HasSubstr("does not turn on from point 2 to point 3"));
  EXPECT_THAT(
      test::problems_of(any_path(
          {{"2", points + "timing = { mode = \"given\", angles_deg = [0, 40, 80, 120, 200, 380] }\n"}})),
      HasSubstr("the crank turns"));
}

TEST(AnyPathStudies, TellWhoStaysWithinTheTolerance) {
  const study::Result result = test::run_text(
      any_path({{"2",
                 "[target]\ntype = \"path_points\"\npoints_mm = [[0, 0], [40, 5], [60, 30], [40, 50], [0, "
                 "40], [-10, 20]]\nclosed = true\ntolerance_mm = 3\n"}}));
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  const auto& inside = machines->find("within_tolerance")->values;
  const auto& largest = machines->find("largest_deviation_m")->values;
  ASSERT_FALSE(inside.empty());
  EXPECT_EQ(inside[0], 1);
  for (std::size_t i = 0; i < inside.size(); ++i) EXPECT_EQ(inside[i] == 1, largest[i] <= 0.003 * (1 + 1e-9));
}

TEST(AnyPathStudies, TellWhichBandsAreKept) {
  const std::string points =
                        "[target]\ntype = \"path_points\"\npoints_mm = [[0, 0], [40, 5], [60, 30], [40, 50], "
                        "[0, 40], [-10, "
                        "20]]\nclosed = true\n",
                    wide = "[[target.band]]\nfrom_point = 6\nto_point = 2\ntolerance_mm = 20\n",
                    narrow = "[[target.band]]\nfrom_share = 0.5\nto_share = 0.7\ntolerance_mm = 1e-6\n";
  const study::Result result =
      test::run_text(any_path({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"four_bar\"]\n"},
                               {"2", points + wide + narrow},
                               {"4", "[optimiser]\nevaluations = 20000\n"}}));
  const Table *machines = result.table("machines"), *bands = result.table("bands");
  ASSERT_TRUE(machines && bands);
  ASSERT_EQ(bands->rows(), 2 * machines->rows());
  const auto of = [&](const char* column) { return bands->find(column)->values; };
  EXPECT_NEAR(of("tolerance_m")[0], 0.02, 1e-12);
  EXPECT_GT(of("from_share")[0], of("to_share")[0]);
  EXPECT_EQ(of("kept")[0], 1);
  EXPECT_LE(of("largest_deviation_m")[0], 0.02 * (1 + 1e-9));
  EXPECT_EQ(of("beyond_tolerance_m")[0], 0);
  EXPECT_EQ(of("kept")[1], 0);
  EXPECT_NEAR(of("beyond_tolerance_m")[1], of("largest_deviation_m")[1] - 1e-9, 1e-15);
  EXPECT_GE(of("at_share")[1], 0.5 - 1e-9);
  EXPECT_LE(of("at_share")[1], 0.7 + 1e-9);
  EXPECT_EQ(machines->find("within_tolerance")->values[0], 0);
  EXPECT_NEAR(machines->find("beyond_tolerance_m")->values[0], of("beyond_tolerance_m")[1], 1e-9);
  EXPECT_THAT(test::fact(result, "band 1"), HasSubstr("kept"));
  EXPECT_THAT(test::fact(result, "band 2"), HasSubstr("exceeded by"));
}

TEST(AnyPathStudies, CheckBandsAndWeights) {
  const std::string points =
      "[target]\ntype = \"path_points\"\npoints_mm = [[0, 0], [40, 5], [60, 30], [40, 50], [0, 40], [-10, "
      "20]]\n";
  const auto problems = [&](const std::string& more) {
    return test::problems_of(any_path({{"2", points + more}}));
  };
  EXPECT_THAT(problems("[[target.band]]\nfrom_point = 7\ntolerance_mm = 1\n"),
              HasSubstr("band 1 names point 7, the stroke has 6"));
  EXPECT_THAT(problems("[[target.band]]\nfrom_point = 4\nto_point = 2\ntolerance_mm = 1\n"),
              HasSubstr("band 1 ends before it begins"));
  EXPECT_THAT(problems("[[target.band]]\nfrom_point = 1\nto_share = 0.5\ntolerance_mm = 1\n"),
              HasSubstr("band 1 is given by points and by shares of the length"));
  EXPECT_THAT(problems("[[target.band]]\nfrom_point = 1\n"), HasSubstr("tolerance"));
  EXPECT_THAT(problems("weights = [1, 2, 3]\n"), HasSubstr("3 weights for 6 points"));
  EXPECT_THAT(problems("weights = [0, 0, 0, 0, 0, 0]\n"), HasSubstr("all weights are 0"));
  EXPECT_THAT(problems("weights = [1, 1, -1, 1, 1, 1]\n"), HasSubstr("weight 3 is -1"));
  const auto warnings = [&](const std::string& more) {
    std::string messages;
    EXPECT_TRUE(test::prepare(any_path({{"2", points + more}}), messages));
    return messages;
  };
  EXPECT_EQ(warnings("weights = []\nband = []\n"), "");
  EXPECT_EQ(warnings("closed = true\nweights = [1, 1, 5, 1, 1, 1]\n[[target.band]]\nfrom_point = 4\n"
                     "to_point = 2\ntolerance_mm = 1\n"),
            "");
}

// A crank and a rod of nearly one length turn with no such pair angle.
TEST(AnyPathStudies, NameTheLimitThatTheNearestMachineBreaks) {
  const study::Result result = test::run_text(
      any_path({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"slider_crank\"]\n"},
                {"3", "[limits]\nleast_pair_angle_deg = 70\nshortest_link = 0.5\nlongest_link = 1\n"},
                {"4", "[optimiser]\nevaluations = 20000\n"}}));
  EXPECT_EQ(result.status, Status::infeasible);
  EXPECT_THAT(to_string(result.headline), HasSubstr("No machine within the limits"));
}

/// Poses of a body that is lifted and tipped.
std::string any_poses(const std::map<std::string, std::string>& changed = {}) {
  return test::text_of(
      {{"0", "schema = 1\nkind = \"synthesis\"\n"},
       {"1", "[mechanism]\ntype = \"planar.any\"\nmost_links = 6\n"},
       {"2",
        "[target]\ntype = \"poses\"\npose = [{ x_mm = 0, y_mm = 0, angle_deg = 0 }, { x_mm = "
        "30, y_mm = 5, angle_deg = 0 }, { x_mm = 62, y_mm = 24, angle_deg = 8 }, { x_mm = 88, "
        "y_mm = 52, angle_deg = 25 }, { x_mm = 104, y_mm = 88, angle_deg = 52 }, { x_mm = 110, "
        "y_mm = 126, angle_deg = 90 }]\n"},
       {"3", ""},
       {"4", "[optimiser]\nevaluations = 80000\n"}},
      changed);
}

TEST(AnyPosesStudies, ListMachinesThatLeadTheBody) {
  const study::Result result = test::run_text(any_poses(
      {{"1",
        "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"four_bar\", \"slider_crank\", \"watt_1\"]\n"}}));
  ASSERT_GE(result.solutions.size(), 2U);
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  const auto& error = machines->find("pose_error_rms_m")->values;
  EXPECT_TRUE(std::is_sorted(error.begin(), error.end()));
  EXPECT_LT(error[0], 0.003);
  // The table of the poses adds up to what the list says.
  const Table* poses = result.table("poses");
  ASSERT_TRUE(poses);
  double places = 0, rotations = 0;
  for (const double e : poses->find("place_error_m")->values) places += e * e / 6;
  for (const double e : poses->find("rotation_error_rad")->values) rotations += e * e / 6;
  EXPECT_NEAR(std::sqrt(places), machines->find("path_error_rms_m")->values[0], 1e-9);
  EXPECT_NEAR(std::sqrt(rotations), machines->find("rotation_error_rms_rad")->values[0], 1e-9);
  EXPECT_THAT(to_string(result.headline), HasSubstr("leads the body through the poses"));
}

// The crank turns from pose to pose by what is given, in either sense.
TEST(AnyPosesStudies, MeetPosesAtGivenCrankRotations) {
  const std::vector<double> given{0, 20, 45, 70, 100, 130};
  const study::Result result = test::run_text(
      any_poses({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"four_bar\", \"stephenson_1\"]\n"},
                 {"21", "timing = { mode = \"given\", angles_deg = [10, 30, 55, 80, 110, 140] }\n"}}));
  ASSERT_FALSE(result.solutions.empty());
  for (std::size_t i = 0; i < result.solutions.size(); ++i) {
    const Table* poses = result.table(i == 0 ? "poses" : "poses-" + std::to_string(i + 1));
    ASSERT_TRUE(poses);
    const auto& crank = poses->find("crank_angle_rad")->values;
    for (std::size_t k = 0; k < given.size(); ++k)
      EXPECT_NEAR(std::abs(crank[k] - crank[0]), given[k] * pi / 180, 1e-9) << i << k;
  }
  EXPECT_LT(result.table("machines")->find("pose_error_rms_m")->values[0], 0.03);
  const auto problems = [](const std::string& angles) {
    return test::problems_of(
        any_poses({{"21", "timing = { mode = \"given\", angles_deg = [" + angles + "] }\n"}}));
  };
  EXPECT_THAT(problems("0, 20, 10, 70, 100, 130"), HasSubstr("does not turn on from pose 2 to pose 3"));
  EXPECT_THAT(problems("0, 20, 45, 70, 100, 430"), HasSubstr("more than the stroke leaves"));
}

// A rotation counts as much as its length: a longer one brings the rotations nearer.
TEST(AnyPosesStudies, WeighRotationsByTheirLength) {
  const auto rotation_with = [](const char* length) {
    const study::Result result =
        test::run_text(any_poses({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"four_bar\"]\n"},
                                  {"21", std::string("orientation_length_mm = ") + length + "\n"},
                                  {"4", "[optimiser]\nevaluations = 40000\n"}}));
    return result.table("machines")->find("rotation_error_rms_rad")->values[0];
  };
  EXPECT_LT(rotation_with("600"), rotation_with("6"));
}

TEST(AnyPosesStudies, SayWhatIsWrong) {
  const auto problems = [](const char* target) {
    return test::problems_of(any_poses({{"2", std::string("[target]\ntype = \"poses\"\n") + target + "\n"}}));
  };
  EXPECT_THAT(problems(""), HasSubstr("the target has no poses"));
  EXPECT_THAT(
      problems("pose = [{ x_mm = 0, y_mm = 0, angle_deg = 0 }, { x_mm = 1, y_mm = 0, angle_deg = 5 }]"),
      HasSubstr("2 poses, 3 to 96 can be given"));
  EXPECT_THAT(
      problems("pose = [{ x_mm = 1, y_mm = 0, angle_deg = 0 }, { x_mm = 1, y_mm = 0, angle_deg = 5 }, "
               "{ x_mm = 1, y_mm = 0, angle_deg = 9 }]"),
      HasSubstr("the body only turns"));
  EXPECT_THAT(
      problems("pose = [{ x_mm = 1, y_mm = 0, angle_deg = 0 }, { x_mm = 1, y_mm = 0, angle_deg = 0 }, "
               "{ x_mm = 2, y_mm = 0, angle_deg = 9 }]"),
      HasSubstr("poses 1 and 2 are the same"));
  EXPECT_THAT(problems("file = \"none.csv\""), HasSubstr("none.csv"));
  EXPECT_THAT(problems("points_mm = [[0, 0], [1, 0], [2, 1]]"),
              HasSubstr("not for poses: write [[target.pose]]"));
}

/// An open stroke, and a drive that rocks.
std::map<std::string, std::string> rocking(const char* stroke_end = "closed = false\n") {
  return {{"1", "[mechanism]\ntype = \"planar.any\"\nmost_links = 4\n"},
          {"2", std::string("[target]\ntype = \"path_points\"\npoints_mm = [[0, 0], [20, 3], [40, 5], [60, "
                            "30], [40, 50], [0, 40]]\n") +
                    stroke_end},
          {"3", "[limits]\ncrank_turns = false\n"}};
}

TEST(AnyPathStudies, LetTheDriveRock) {
  const study::Result result = test::run_text(any_path(rocking()));
  ASSERT_FALSE(result.solutions.empty());
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  const auto &range = machines->find("crank_range_rad")->values,
             &from = machines->find("drive_from_rad")->values, &to = machines->find("drive_to_rad")->values;
  for (std::size_t i = 0; i < range.size(); ++i) {
    EXPECT_NEAR(std::abs(to[i] - from[i]), range[i], 1e-12);
    EXPECT_LE(std::abs(from[i]), pi + 1e-12);
  }
  EXPECT_THAT(to_string(result.solutions[0].label), HasSubstr("drive over"));
  const auto fact = std::find_if(result.facts.begin(), result.facts.end(),
                                 [](const study::Fact& f) { return f.label == "range of the drive"; });
  ASSERT_NE(fact, result.facts.end());
  EXPECT_THAT(to_string(fact->text), HasSubstr("from"));
  // The design is a linkage whose drive goes over that range and no further, and runs again.
  const Value& input = result.solutions[0].study.find("sweep")->find("input")->as_array()[0];
  EXPECT_NEAR(input.find("from_rad")->as_number(), from[0], 1e-12);
  EXPECT_NEAR(input.find("to_rad")->as_number(), to[0], 1e-12);
  const Table* curve = result.table("curve");
  ASSERT_TRUE(curve);
  EXPECT_NEAR(curve->find("crank_angle_rad")->values.front(), from[0], 1e-12);
  EXPECT_NEAR(curve->find("crank_angle_rad")->values.back(), to[0], 1e-12);
}

TEST(AnyPathStudies, RefineMachinesWhoseDriveRocks) {
  auto changed = rocking();
  changed["4"] =
      "[optimiser]\nevaluations = 30000\nmax_solutions = 3\n[[objective]]\nquantity = \"size\"\n"
      "[[objective]]\nquantity = \"peak_acceleration\"\n[[objective]]\nquantity = \"drive_torque\"\n";
  const study::Result result = test::run_text(any_path(changed));
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  const auto &refined = machines->find("refined_for")->values, &size = machines->find("size_m")->values,
             &before = machines->find("size_before_m")->values;
  EXPECT_GT(*std::max_element(refined.begin(), refined.end()), 0);
  for (std::size_t i = 0; i < refined.size(); ++i)
    if (refined[i] == 1) {
      EXPECT_LT(size[i], before[i]);
    }
  for (const double angle : machines->find("least_pair_angle_rad")->values) EXPECT_GE(angle, 20 * pi / 180);
}

TEST(AnyPathStudies, SayThatADriveThatRocksTurnsBack) {
  EXPECT_THAT(test::problems_of(any_path(rocking("closed = true\n"))),
              ::testing::AllOf(HasSubstr("limits.crank_turns"), HasSubstr("the stroke is closed"),
                               HasSubstr("write closed = false in [target]")));
  EXPECT_THAT(
      test::problems_of(any_poses({{"21", "closed = true\n"}, {"3", "[limits]\ncrank_turns = false\n"}})),
      HasSubstr("the poses are closed"));
}

/// A function with some of its parts replaced.
std::string any_function(const std::map<std::string, std::string>& changed = {}) {
  return test::text_of({{"0", "schema = 1\nkind = \"synthesis\"\n"},
                        {"1", "[mechanism]\ntype = \"planar.any\"\nmost_links = 6\n"},
                        {"2", "[target]\ntype = \"function\"\n"},
                        {"21", "function = \"sin\"\nx = { from = 0, to = 90 }\n"},
                        {"22", "input_range_deg = 90\n"},
                        {"23", "output_range_deg = 90\n"},
                        {"3", "[limits]\nleast_pair_angle_deg = 30\n"},
                        {"4", "[optimiser]\nevaluations = 60000\n"}},
                       changed);
}

TEST(AnyFunctionStudies, ListMachinesThatGenerateIt) {
  const study::Result result = test::run_text(any_function());
  ASSERT_GE(result.solutions.size(), 2U);
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  const auto& greatest = machines->find("structural_error_rad")->values;
  EXPECT_TRUE(std::is_sorted(greatest.begin(), greatest.end()));
  EXPECT_LT(greatest[0], 0.01 * pi / 180);
  for (const double angle : machines->find("least_pair_angle_rad")->values) EXPECT_GE(angle, 30 * pi / 180);
  // The solver of any linkage finds the same errors.
  const auto& errors = result.table("structural_error")->find("error_rad")->values;
  double most = 0;
  for (const double e : errors) most = std::max(most, std::abs(e));
  EXPECT_LE(most, greatest[0] + 1e-9);
  EXPECT_GT(most, 0.9 * greatest[0]);
  EXPECT_THAT(to_string(result.headline), HasSubstr("generates the function within"));
}

TEST(AnyFunctionStudies, MoveASliderThroughATurnAndLetItRest) {
  const study::Result result = test::run_text(any_function(
      {{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"slider_crank\", \"stephenson_3\"]\n"},
       {"21", "table = [[0, 0], [90, 0.5], [180, 1], [270, 0.5], [360, 0]]\n"},
       {"22", "input_range_deg = 360\n"},
       {"23", "output_range_mm = 40\ndwell = [{ from_deg = 160, to_deg = 200 }]\n"}}));
  ASSERT_GE(result.solutions.size(), 2U);
  const Table* machines = result.table("machines");
  EXPECT_LT(machines->find("structural_error_m")->values[0], 2e-3);
  const Table* first = result.table("structural_error");
  const auto &input = first->find("input_rad")->values, &travel = first->find("output_m")->values;
  double least = infinity, most = -infinity;
  for (std::size_t k = 0; k < input.size(); ++k)
    if (input[k] > 160 * pi / 180 && input[k] < 200 * pi / 180)
      least = std::min(least, travel[k]), most = std::max(most, travel[k]);
  EXPECT_LE(most - least, 2 * machines->find("rest_error_m")->values[0] + 1e-9);
  EXPECT_NEAR(travel.front(), travel.back(), 1e-9) << "the turn ends where it began";
}

std::vector<std::uint64_t> bits_of(const std::vector<double>& values) {
  std::vector<std::uint64_t> out;
  for (const double v : values) out.push_back(std::bit_cast<std::uint64_t>(v));
  return out;
}

// Two threads, and a run that was stopped between two saves, end with the bits of one thread without a stop.
TEST(AnyFunctionStudies, WithSeveralSeedsHaveTheSameBitsHoweverTheyAreRun) {
  const std::string text =
      any_function({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"four_bar\"]\n"},
                    {"4", "[optimiser]\nevaluations = 3000\nseeds = { first = 4, count = 2 }\n"}});
  std::string messages;
  const auto prepared = test::prepare(text, messages);
  ASSERT_TRUE(prepared) << messages;
  const auto run = [&](int threads, Checkpoint* kept) {
    RunContext context;
    context.set_threads(threads);
    context.set_checkpoint(kept);
    return study::run_study(*prepared, context);
  };
  const study::Result one = run(1, nullptr), two = run(2, nullptr);
  EXPECT_EQ(one.log.as_array().size(), 2U);
  const auto same = [&](const study::Result& other) {
    ASSERT_EQ(other.tables.size(), one.tables.size());
    for (std::size_t i = 0; i < one.tables.size(); ++i)
      for (std::size_t c = 0; c < one.tables[i].columns.size(); ++c)
        EXPECT_EQ(bits_of(other.tables[i].columns[c].values), bits_of(one.tables[i].columns[c].values))
            << one.tables[i].name << ' ' << one.tables[i].columns[c].key;
  };
  same(two);
  test::MemoryCheckpoint kept;
  {
    RunContext stopped;
    stopped.set_threads(1);
    stopped.set_checkpoint(&kept);
    int saves = 0;
    kept.kept = [&](std::string_view) {
      if (++saves == 3) stopped.cancel();
    };
    EXPECT_EQ(study::run_study(*prepared, stopped).status, Status::cancelled);
    kept.kept = nullptr;
  }
  EXPECT_FALSE(kept.entries.empty());
  same(run(2, &kept));
}

// Of the ranges that are allowed the search takes those with the least error for the range of the output.
// Here they are not at the middle, and both the ends and the middle are worse.
TEST(AnyFunctionStudies, ChooseRangesThatAreFree) {
  const auto run = [](const std::string& input, const std::string& output) {
    return test::run_text(
        any_function({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"four_bar\"]\n"},
                      {"22", "input_range_deg = " + input + "\n"},
                      {"23", "output_range_deg = " + output + "\n"},
                      {"4", "[optimiser]\nevaluations = 3000\n"}}));
  };
  const study::Result free = run("90", "{ min = 40, max = 100 }");
  ASSERT_FALSE(free.solutions.empty());
  const auto of = [](const study::Result& result, const char* name) {
    const Value* value = result.solutions[0].objectives.find(name);
    return value ? value->as_number() : nan;
  };
  const double input = of(free, "input_range_rad") * 180 / pi,
               output = of(free, "output_range_rad") * 180 / pi;
  EXPECT_NEAR(input, 90, 1e-9);
  EXPECT_GE(output, 40 - 1e-9);
  EXPECT_LE(output, 100 + 1e-9);
  EXPECT_NEAR(of(free, "structural_error_share"),
              of(free, "structural_error_rad") / of(free, "output_range_rad"), 1e-15);
  EXPECT_NE(test::fact(free, "range of the output"), "no fact");
  const study::Result middle = run("90", "70");
  ASSERT_FALSE(middle.solutions.empty());
  EXPECT_LT(of(free, "structural_error_share"), of(middle, "structural_error_rad") / (70 * pi / 180));
}

TEST(AnyFunctionStudies, SayWhatIsWrong) {
  const auto problems = [](std::map<std::string, std::string> changed) {
    return test::problems_of(any_function(std::move(changed)));
  };
  EXPECT_THAT(problems({{"23", "output_range_deg = { min = -20, max = 40 }\n"}}),
              HasSubstr("let both of its ends have one sign"));
  EXPECT_THAT(problems({{"22", "input_range_deg = { min = 200, max = 360 }\n"}}),
              HasSubstr("less than a whole turn can be chosen"));
  EXPECT_THAT(problems({{"22", "input_range_deg = { min = 90, max = 60 }\n"}}), HasSubstr("larger than max"));
  EXPECT_THAT(problems({{"23",
                         "output_range_deg = { min = 60, max = 90 }\ndwell = [{ from_deg = 10, to_deg = 20 "
                         "}]\n"}}),
              HasSubstr("free ranges are for functions without dwells"));
  EXPECT_THAT(problems({{"23", ""}}), HasSubstr("how far the output moves is missing"));
  EXPECT_THAT(problems({{"23", "output_range_deg = 90\noutput_range_mm = 5\n"}}),
              HasSubstr("the output is both an angle and a travel"));
  EXPECT_THAT(problems({{"23", "output_range_deg = 0\n"}}), HasSubstr("the output does not move"));
  EXPECT_THAT(problems({{"23", "output_range_mm = 5\nsize_mm = 50\n"}}),
              HasSubstr("the size is for outputs that are angles"));
  EXPECT_THAT(problems({{"23", "output_range_deg = 90\nfit = \"points\"\n"}}),
              HasSubstr("no common number of precision points"));
  EXPECT_THAT(problems({{"22", "input_range_deg = 360\n"}}),
              HasSubstr("after which the output is not where it was"));
  EXPECT_THAT(problems({{"23", "output_range_deg = 90\ndwell = [{ from_deg = 40, to_deg = 20 }]\n"}}),
              HasSubstr("write the smaller rotation first"));
  EXPECT_THAT(problems({{"23", "output_range_deg = 90\ndwell = [{ from_deg = 40, to_deg = 120 }]\n"}}),
              HasSubstr("a dwell ends at 120"));
  EXPECT_THAT(problems({{"23",
                         "output_range_deg = 90\ndwell = [{ from_deg = 10, to_deg = 30 }, "
                         "{ from_deg = 20, to_deg = 40 }]\n"}}),
              HasSubstr("begins before the last one ends"));
  EXPECT_THAT(problems({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"watt_1\"]\n"}}),
              HasSubstr("watt_1 does not generate functions"));
  EXPECT_THAT(problems({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"slider_crank\"]\n"}}),
              ::testing::AllOf(HasSubstr("mechanism.families"),
                               HasSubstr("none of the families has a link that turns"),
                               HasSubstr("write output_range_mm")));
  EXPECT_THAT(problems({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"inverted_slider\"]\n"},
                        {"23", "output_range_mm = 20\n"}}),
              HasSubstr("none of the families has a slider on the ground as its output"));
  EXPECT_THAT(problems({{"3", "[limits]\ncrank_turns = false\n"}}),
              ::testing::AllOf(HasSubstr("limits.crank_turns"), HasSubstr("input_range says how far")));
  EXPECT_THAT(problems({{"24", "tolerance_mm = 0.1\n"}}), HasSubstr("the least greatest error"));
  EXPECT_THAT(problems({{"24", "timing = { mode = \"free\" }\n"}}),
              HasSubstr("over the rotation of the crank"));
  EXPECT_THAT(
      test::problems_of(any_path({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"watt_2\"]\n"}})),
      HasSubstr("a smaller machine traces"));
}

}  // namespace
}  // namespace linkwright::planar
