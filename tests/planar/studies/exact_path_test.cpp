// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "linkwright/planar/studies/four_bar_path.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using test::prepare;
using test::problems_of;
using test::run_text;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* nine =
    "points_m = [[0.25, 0.0], [0.52, 0.1], [0.8, 0.7], [1.2, 1.0], [1.4, 1.3], [1.1, 1.48], [0.7, 1.4], "
    "[0.2, "
    "1.0], [0.02, 0.4]]\n";
constexpr const char* five =
    "points_m = [[0.5, 1.06], [-0.83, -0.27], [-0.34, 0.22], [-0.13, 0.43], [0.22, 0.78]]\n";
constexpr const char* pivots =
    "[mechanism.parameters]\npivot_x_m = 0\npivot_y_m = 0\nrocker_pivot_x_m = 1\nrocker_pivot_y_m = 0\n";

constexpr const char* one_pivot = "[mechanism.parameters]\npivot_x_m = 0.2\npivot_y_m = -0.3\n";
// Of a four-bar with this pivot: ground 1, crank 0.4, coupler 0.9, rocker 0.8 m, coupler point (0.5, 0.6) m,
// turned by 0.4 rad, at the crank angles 0.3, 0.9, 1.4, 2.1, 3, 4.2, 5.3 rad.
constexpr const char* seven =
    "points_m = [[0.0885103553, 0.6178045650], [0.0937456162, 0.8367705758], [-0.0161357470, 0.8604548764], "
    "[-0.2116677287, 0.7150696453], [-0.3657981027, 0.3580011426], [-0.3384034613, -0.0921534715], "
    "[-0.1471737104, -0.1379669089]]\n";

std::string exact(const std::string& parameters, const std::string& target) {
  return "schema = 1\nkind = \"synthesis\"\ntitle = \"test\"\n[mechanism]\ntype = \"planar.four_bar\"\n" +
         parameters + "[target]\ntype = \"path_points\"\nfit = \"exact\"\n" + target;
}

double count(const study::Result& result, const char* key) {
  const Table* table = result.table("counts");
  return table ? table->find(key)->values.at(0) : nan;
}

TEST(ExactPathRead, SaysHowManyPointsThereMayBe) {
  EXPECT_THAT(
      problems_of(exact("", five)),
      HasSubstr(
          "target.points_m: 5 points with free pivots are passed by infinitely many four-bars, fit = "
          "\"exact\" takes 9; give 9; or 7 and a fixed pivot as numbers, [mechanism.parameters] pivot_x, "
          "pivot_y, or 5 and rocker_pivot_x, rocker_pivot_y as well; or use what searches"));
  EXPECT_THAT(
      problems_of(exact(one_pivot, five)),
      HasSubstr("5 points with a given pivot are passed by infinitely many four-bars, fit = \"exact\" "
                "takes 7; give 7; or use what searches"));
  EXPECT_THAT(
      problems_of(exact(pivots, nine)),
      HasSubstr(
          "9 points with both pivots given are more than a four-bar passes exactly, which are 5; give 5; "
          "or use what searches: fit = \"least_squares\""));
  EXPECT_THAT(problems_of(exact(pivots, "points_m = [[0, 0], [1, 0], [1, 1], [0, 3]]\n")),
              HasSubstr("4 points with both pivots given are passed by infinitely many"));
}

TEST(ExactPathRead, PivotsAreNumbersAndNothingElseIsGiven) {
  EXPECT_THAT(
      problems_of(exact("[mechanism.parameters]\ncrank_m = 0.3\n", nine)),
      HasSubstr("mechanism.parameters: crank is given, fit = \"exact\" leaves no number of the four-bar to "
                "choose but the fixed pivots"));
  EXPECT_THAT(problems_of(exact("[mechanism.parameters]\npivot_x_m = 0.3\n", nine)),
              HasSubstr("fit = \"exact\" takes a fixed pivot as two numbers; give both coordinates"));
  EXPECT_THAT(
      problems_of(exact("[mechanism.parameters]\npivot_x_m = 0\npivot_y_m = { min = 0, max = 1 }\n", seven)),
      HasSubstr("takes ranges of pivots for both pivots of five points without crank angles"));
  EXPECT_THAT(problems_of(exact("[mechanism.parameters]\npivot_x_m = 1\npivot_y_m = 0\nrocker_pivot_x_m = 1\n"
                                "rocker_pivot_y_m = 0\n",
                                five)),
              HasSubstr("the two fixed pivots coincide"));
}

TEST(ExactPathRead, PointsAreDifferentAndHaveNeitherAnglesNorTolerances) {
  std::string again = nine;
  again.replace(again.find("[0.2, 1.0]"), 10, "[0.8, 0.7]");
  EXPECT_THAT(problems_of(exact("", again)), HasSubstr("point 8 repeats point 3; give different points"));
  EXPECT_THAT(
      problems_of(exact("", std::string(nine) + "timing = { mode = \"equal_steps\", step_deg = 10 }\n")),
      HasSubstr(
          "target.points_m: 9 points with crank angles are more than a four-bar passes exactly, which are "
          "5; leave some out, or use what searches"));
  EXPECT_THAT(problems_of(exact("", std::string(nine) + "tolerance_mm = 1\n")),
              HasSubstr("fit = \"exact\" passes its points without tolerance"));
  EXPECT_THAT(
      problems_of(exact("",
                        "gates_m = [{ from = [0, 0], to = [1, 0] }, { from = [2, 0], to = [2, 1] }, { from "
                        "= [3, 0], to = [4, 1] }]\n")),
      HasSubstr("fit = \"exact\" passes points, not gates"));
  EXPECT_THAT(problems_of(exact("", std::string(nine) + "[optimiser]\nmethod = \"grey_wolf\"\n")),
              HasSubstr("fit = \"exact\" finds all solutions, there is nothing to search"));
  EXPECT_THAT(problems_of(exact("", std::string(nine) + "fit_ = 1\n")), HasSubstr("did you mean 'fit'?"));
}

TEST(ExactPathRead, WarnsWhereThePointsAreFarFromTheOrigin) {
  std::string points = "points_m = [", messages;
  for (int i = 0; i < 9; ++i)
    points += (i ? ", [" : "[") + std::to_string(1e8 + 1e-4 * i) + ", " + std::to_string(1e-4 * i * i) + "]";
  EXPECT_TRUE(prepare(exact("", points + "]\n"), messages));
  EXPECT_THAT(messages,
              HasSubstr("warning: target.points_m: the points lie within 6.4e-11 of their distance"));
}

TEST(ExactPathRead, TheResolvedStudyReadsAgain) {
  std::string messages;
  const auto study = prepare(exact(pivots, five), messages);
  ASSERT_TRUE(study) << messages;
  const Value& parameters = *study->canonical.find("mechanism")->find("parameters");
  EXPECT_EQ(parameters.find("crank_m"), nullptr);
  EXPECT_EQ(parameters.find("rocker_pivot_x_m")->as_number(), 1);
  EXPECT_EQ(study->canonical.find("target")->find("fit")->as_string(), "exact");
}

TEST(ExactPathRun, AllFourBarsThroughSevenPointsWithAPivot) {
  const study::Result result = run_text(exact(one_pivot, seven));
  EXPECT_EQ(result.status, Status::done);
  EXPECT_EQ(count(result, "classes"), 486);
  EXPECT_THAT(to_string(result.headline),
              HasSubstr("All 486 complex solutions for seven points and a pivot"));
  const auto near = [](const study::Solution& s, const char* key, double value) {
    for (const study::Parameter& parameter : s.parameters)
      if (parameter.key == key) return std::abs(parameter.value - value) < 1e-6;
    return false;
  };
  EXPECT_TRUE(std::any_of(result.solutions.begin(), result.solutions.end(), [&](const study::Solution& s) {
    return s.defects.size() == 0 && near(s, "ground_m", 1) && near(s, "crank_m", 0.4) &&
           near(s, "coupler_m", 0.9) && near(s, "rocker_m", 0.8);
  }));
  // The pivot of the rocker instead: the same linkages driven from the other side.
  const study::Result other =
      run_text(exact("[mechanism.parameters]\nrocker_pivot_x_m = 0.2\nrocker_pivot_y_m = -0.3\n", seven));
  EXPECT_EQ(count(other, "real_classes"), count(result, "real_classes"));
  for (const study::Solution& s : other.solutions) {
    double ground = 0, angle = 0, x = 0, y = 0;
    for (const study::Parameter& parameter : s.parameters) {
      if (parameter.key == "ground_m") ground = parameter.value;
      if (parameter.key == "frame_angle_rad") angle = parameter.value;
      if (parameter.key == "pivot_x_m") x = parameter.value;
      if (parameter.key == "pivot_y_m") y = parameter.value;
    }
    EXPECT_NEAR(x + ground * std::cos(angle), 0.2, 1e-9);
    EXPECT_NEAR(y + ground * std::sin(angle), -0.3, 1e-9);
  }
}

// Pivots that may choose: the table of places, and the map of those that have an answer.
TEST(ExactPathRun, FivePointsWithPivotsInARegion) {
  const std::string region =
      "[mechanism.parameters]\npivot_x_m = 0.2\npivot_y_m = -0.3\nrocker_pivot_x_m = { min = 0.6, max = 1.6 "
      "}\n"
      "rocker_pivot_y_m = { min = -0.4, max = 0.6 }\n";
  // The first, third, fourth, fifth and seventh of the seven points above.
  const std::string points =
      "points_m = [[0.0885103553, 0.6178045650], [-0.0161357470, 0.8604548764], [-0.2116677287, "
      "0.7150696453], "
      "[-0.3657981027, 0.3580011426], [-0.1471737104, -0.1379669089]]\n";
  const study::Result result = run_text(exact(region, points));
  EXPECT_EQ(result.status, Status::done);
  EXPECT_EQ(count(result, "places"), 441);
  EXPECT_GT(count(result, "places_with_answers"), 0);
  EXPECT_THAT(to_string(result.headline),
              HasSubstr("of 441 places of the pivots four-bars pass the 5 points in one motion"));
  const Table* pivots_table = result.table("pivots");
  ASSERT_TRUE(pivots_table);
  EXPECT_EQ(pivots_table->rows(), 441U);
  EXPECT_EQ(result.statistics.find("completeness")->as_string(), "sample");
  EXPECT_TRUE(std::any_of(result.plots.begin(), result.plots.end(), [](const study::Plot& plot) {
    return plot.name == "pivots-transmission" && plot.style == study::Plot::Style::map;
  }));
  for (const study::Solution& s : result.solutions)
    EXPECT_LT(s.objectives.find("path_error_max_m")->as_number(), 1e-7);
}

// Wampler, Morgan and Sommese 1992, problem 3.
TEST(ExactPathRun, AllFourBarsThroughNinePoints) {
  const study::Result result = run_text(exact("", std::string(nine) + "closed = false\n"));
  EXPECT_EQ(result.status, Status::done);
  EXPECT_EQ(count(result, "classes"), 1442);
  EXPECT_EQ(count(result, "certified"), 1442);
  EXPECT_EQ(count(result, "real_classes"), 64);
  EXPECT_EQ(count(result, "designs"), 384);
  EXPECT_EQ(count(result, "defect_free"), 2);
  EXPECT_EQ(count(result, "branch_defects"), 382);
  EXPECT_EQ(count(result, "infinite") + count(result, "singular") + count(result, "lost"), 0);
  EXPECT_EQ(
      to_string(result.headline),
      "All 1442 coupler curves through the nine points, each certified; 64 of them are real. 2 of their 384 "
      "four-bars pass the points in one motion and in their order; the best is a crank-rocker (open "
      "branch).");
  EXPECT_EQ(result.statistics.find("outcome")->as_string(), "complete");
  ASSERT_EQ(result.solutions.size(), 2U);
  EXPECT_EQ(result.scenes.size(), 2U);
  EXPECT_EQ(result.table("classes")->rows(), 1442U);
  EXPECT_EQ(result.table("designs")->rows(), 384U);
  EXPECT_EQ(result.table("points")->rows(), 9U);
  EXPECT_NE(result.table("motion-2"), nullptr);
  for (const study::Solution& solution : result.solutions) {
    EXPECT_TRUE(solution.defects.empty());
    EXPECT_LT(solution.objectives.find("path_error_sum_sq_m2")->as_number(), 1e-26);
    EXPECT_TRUE(std::isinf(solution.parameters[0].upper));  // nothing bounds them
    EXPECT_FALSE(solution.study.is_null());
  }
}

TEST(ExactPathRun, LimitsOfTheStudyChooseAmongTheAnswers) {
  const study::Result result = run_text(exact(
      "",
      std::string(nine) + "closed = false\n[[constraint]]\ntype = \"transmission_angle\"\nmin_deg = 30\n"));
  EXPECT_EQ(result.status, Status::infeasible);
  EXPECT_EQ(count(result, "defect_free"), 2);
  EXPECT_THAT(to_string(result.headline),
              HasSubstr("None of the 2 four-bars that pass the points in one motion and in their order "
                        "keeps the limits of the study."));
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_THAT(to_string(result.solutions[0].defects[0]), HasSubstr("violates transmission_angle"));
}

// Morgan and Wampler 1990, problem 7: collinear points.
TEST(ExactPathRun, AllFourBarsOnTwoPivotsThroughFivePoints) {
  const study::Result result = run_text(exact(pivots, std::string(five) + "closed = false\n"));
  EXPECT_EQ(count(result, "classes"), 33);
  EXPECT_EQ(count(result, "real_classes"), 15);
  EXPECT_EQ(count(result, "designs"), 15);
  EXPECT_EQ(count(result, "infinite"), 3);
  EXPECT_EQ(result.table("counts")->find("certified"), nullptr);
  EXPECT_EQ(result.status, Status::infeasible);
  EXPECT_EQ(result.statistics.find("outcome")->as_string(), "all_defective");
  EXPECT_EQ(result.statistics.find("completeness")->as_string(), "special_target");
  EXPECT_THAT(to_string(result.headline),
              HasSubstr("13 change branch on the way, 1 circuit, 1 meet them in another order"));
  EXPECT_EQ(result.solutions.size(), 6U);
  EXPECT_THAT(to_string(result.solutions[0].defects[0]), HasSubstr("order: "));
}

// Points of a four-bar with the rotation of its crank at each.
constexpr const char* timed =
    "points_m = [[0.534076456244, 0.672591579218], [0.390551283247, 0.876273394174], [0.000445718794234, "
    "0.709594706752], [-0.177196865593, 0.324818175336], [-0.015446106806, 0.122331046183]]\n"
    "closed = false\n"
    "timing = { mode = \"given\", angles_deg = [20, 75, 140, 205, 290] }\n";

TEST(ExactPathRead, CountsTimedPointsAndPivots) {
  EXPECT_THAT(
      problems_of(exact(pivots, timed)),
      HasSubstr("5 points with crank angles and a given pivot are more than a four-bar passes exactly, "
                "which are 3; leave the pivots free, leave some out"));
  EXPECT_THAT(problems_of(exact("[mechanism.parameters]\npivot_x_m = 0\n", timed)),
              HasSubstr("fit = \"exact\" takes a fixed pivot as two numbers"));
  std::string same = timed;
  same.replace(same.find("[20, 75"), 7, "[75, 75");
  EXPECT_THAT(problems_of(exact("", same)), HasSubstr("the crank angles of points 1 and 2 are the same"));
}

TEST(ExactPathRun, TwelveFourBarsThroughFiveTimedPoints) {
  const study::Result result = run_text(exact("", timed));
  EXPECT_EQ(result.status, Status::done) << to_string(result.headline);
  EXPECT_EQ(count(result, "cranks"), 4);
  EXPECT_EQ(count(result, "real_cranks"), 4);
  EXPECT_EQ(count(result, "real_classes"), 6);
  EXPECT_EQ(count(result, "designs"), 12);
  EXPECT_EQ(result.statistics.find("completeness")->as_string(), "complete_uncertified");
  EXPECT_THAT(to_string(result.headline),
              HasSubstr("4 of 4 cranks that hold the 5 points at their angles are real; 12 "
                        "four-bars on 6 coupler curves have them."));
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_TRUE(result.solutions[0].defects.empty());
  EXPECT_LT(result.solutions[0].objectives.find("path_error_sum_sq_m2")->as_number(), 1e-18);
  // Rotations of the crank from point to point, by the solver of the four-bar.
  const Column* angle = result.table("points")->find("crank_angle_rad");
  EXPECT_NEAR(angle->values[4] - angle->values[0], 270 * pi / 180, 1e-12);
}

TEST(ExactPathRun, OppositeRotationsAreAnotherProblem) {
  const study::Result result = run_text(exact("sense = \"any\"\n", timed));
  EXPECT_EQ(count(result, "cranks"), 8);
  EXPECT_GE(count(result, "designs"), 12);
}

TEST(ExactPathRun, FourTimedPointsAreSwept) {
  const study::Result result = run_text(
      exact("",
            "points_m = [[0, 0], [0.4, 0.1], [0.7, 0.3], [0.9, 0.6]]\nclosed = false\ntiming = { mode = "
            "\"equal_steps\", step_deg = 20 }\n"));
  EXPECT_EQ(result.status, Status::done) << to_string(result.headline);
  EXPECT_THAT(to_string(result.headline),
              HasSubstr("Infinitely many four-bars pass the 4 points at their crank angles"));
  EXPECT_EQ(result.statistics.find("completeness")->as_string(), "sample");
  EXPECT_GT(count(result, "defect_free"), 3);
  EXPECT_LT(result.solutions[0].objectives.find("path_error_sum_sq_m2")->as_number(), 1e-12);
}

TEST(ExactPathRun, SevenPointsOnALineHaveNoSolution) {
  const study::Result result = run_text(exact(
      "", "points_m = [[0, 0], [1, 0.5], [2, 1], [3, 1.5], [4, 2], [5, 2.5], [6, 3], [7, 2], [8, -1]]\n"));
  EXPECT_EQ(result.status, Status::infeasible);
  EXPECT_EQ(result.statistics.find("outcome")->as_string(), "no_solution");
  EXPECT_EQ(to_string(result.headline),
            "No four-bar passes the points: 7 of them (1, 2, 3, 4, 5, 6, 7) lie on a line, which no coupler "
            "curve meets "
            "in more than six points.");
  EXPECT_EQ(count(result, "classes"), 0);
}

TEST(ExactPathRun, WhatIsInterruptedIsNotComplete) {
  std::string messages;
  const auto study = prepare(exact("", nine), messages);
  ASSERT_TRUE(study) << messages;
  RunContext context;
  context.cancel();
  const study::Result result = study->run(context);
  EXPECT_EQ(result.status, Status::cancelled);
  EXPECT_EQ(result.statistics.find("outcome")->as_string(), "cancelled");
  EXPECT_EQ(result.statistics.find("completeness")->as_string(), "incomplete");
  EXPECT_THAT(to_string(result.headline), HasSubstr("others may be missing"));
}

}  // namespace
}  // namespace linkwright::planar
