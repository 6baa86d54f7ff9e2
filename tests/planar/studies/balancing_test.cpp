// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/balancing.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "linkwright/core/looks.h"
#include "planar/balancing_studies.h"

namespace linkwright::planar {
namespace {

using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> names_of(const study::Result& r) {
  std::vector<std::string> out;
  for (const Table& t : r.tables) out.push_back(t.name);
  return out;
}

// The spring that carries an arm best: of zero free length it balances the arm everywhere (k a b = m g l); of
// 80 mm a linear programme over 2001 angles has the least largest torque.
TEST(BalancingStudyRead, ASpringCarriesAnArm) {
  const auto balanced = [](const std::string& free_length) {
    const std::string text =
        replaced(replaced(test::example_text("counterbalance-arm.toml"), "= 201", "= 51"),
                 "free_length_mm    = 80", "free_length_mm = " + free_length);
    const study::Result result = run_text(text);
    EXPECT_EQ(result.status, Status::done);
    const std::vector<double>& torque = std::find_if(result.tables.begin(), result.tables.end(),
                                                     [](const Table& t) { return t.name == "balanced"; })
                                            ->find("O_drive_torque_N_m")
                                            ->values;
    double largest = 0;
    for (const double t : torque) largest = std::max(largest, std::abs(t));
    return std::pair{result.solutions.at(0).parameters.at(0).value, largest};
  };
  const auto [stiffness, torque] = balanced("80");
  EXPECT_NEAR(stiffness, 669.3946957784931, 0.5);
  EXPECT_NEAR(torque, 1.6674409570646116, 1e-3);
  const auto [zero_length, nothing] = balanced("0");
  EXPECT_NEAR(zero_length, 441.45, 1e-6);
  EXPECT_NEAR(nothing, 0, 1e-9);
}

TEST(BalancingStudyRead, ProblemsTellWhereAndHow) {
  EXPECT_THAT(problems_of(replaced(test::linkage_weights, "quantity = \"shaking_force_N\"",
                                   "quantity = \"shaking_forc_N\"")),
              HasSubstr("objective[0].quantity: the analysis has no column 'shaking_forc_N'; did you mean "
                        "'shaking_force_N'?"));
  EXPECT_THAT(problems_of(replaced(test::four_bar_masses, "crank_m   = 0.1", "crnk_m = 0.1")),
              HasSubstr("mechanism.parameters.crnk_m"));
  EXPECT_THAT(problems_of(replaced(test::linkage_weights, "initial = 0.1 }", "begin = 0.1 }")),
              HasSubstr("the design variable lacks `initial`"));
  EXPECT_THAT(problems_of(replaced(test::four_bar_masses, "ground_m  = 0.6", "ground_m  = 0.9")),
              HasSubstr("the initial design has no answer everywhere: no_assembly at O1_angle_rad = "));
  EXPECT_THAT(problems_of(test::linkage_weights + "[[constraint]]\nquantity = \"O_N\"\nmeasure = \"rms\"\n"),
              HasSubstr("the constraint has no limit; add at_least or at_most"));
  EXPECT_THAT(problems_of(test::linkage_weights + "[optimiser]\nmethod = \"jade\"\ncombine = \"all\"\n"),
              HasSubstr("jade minimises one objective, combine = \"all\" asks for several"));
  std::string fixed = test::arm_weights;
  for (const char* what :
       {"{ min = 0.0, max = 12.0, initial = 0.0 }", "{ min = 0.0, max = 12.0, initial = 0.0 }",
        "{ min = -0.5, max = 0.0, initial = 0.0 }"})
    fixed = replaced(fixed, what, "-0.1");
  EXPECT_THAT(problems_of(fixed),
              HasSubstr("mechanism.link[0].attached[0].mass_kg: is -0.1 kg, must be at least 0 kg"));
  fixed = replaced(replaced(fixed, "mass_kg    = -0.1", "mass_kg    = 0.1"), "mass_kg    = -0.1",
                   "mass_kg = 0.1");
  EXPECT_THAT(problems_of(fixed), HasSubstr("there is no design variable: every number is fixed"));
  EXPECT_THAT(problems_of(replaced(test::arm_weights, "reference = 1.0", "reference = 0.0")),
              HasSubstr("objective[0].reference: is 0, must be more than 0"));
}

TEST(BalancingStudyRun, CounterweightsOfTheArmUnloadItsFirstJoint) {
  const study::Result r = run_text(test::arm_weights);
  EXPECT_EQ(r.status, Status::done);
  ASSERT_EQ(r.solutions.size(), 1u);
  const auto& p = r.solutions[0].parameters;
  ASSERT_EQ(p.size(), 3u);
  // Boskovic 2018: 11.5 kg m, 7 kg, 0.5 m.
  EXPECT_NEAR(p[0].value, 11.5, 1e-4);
  EXPECT_NEAR(p[1].value, 7, 1e-4);
  EXPECT_NEAR(p[2].value, -0.5, 1e-6);
  EXPECT_THAT(test::fact(r, "proof"), HasSubstr("global optimum"));
  EXPECT_THAT(names_of(r), ::testing::ElementsAre("balanced", "initial", "overlay", "seeds"));
  // Before and after: what was asked for comes first, with its measure.
  ASSERT_GE(r.changes.size(), 2u);
  EXPECT_EQ(r.changes[0].quantity, "O1_N");
  EXPECT_EQ(r.changes[0].measure, "rss_over_n");
  EXPECT_DOUBLE_EQ(test::value_of_fact(r, to_string(r.facts[0].label)), r.changes[0].after);
  EXPECT_TRUE(r.changes[0].wanted);
  EXPECT_NEAR(r.changes[0].percent(), -100, 1e-6);
  const auto torque = std::find_if(r.changes.begin(), r.changes.end(), [](const study::Change& c) {
    return c.quantity == "link1_torque_joint_N_m" && c.measure == "max_abs";
  });
  ASSERT_NE(torque, r.changes.end());
  // The mass is 1 m behind the joint; the published 23 kg at 0.5 m weigh on the torque less.
  EXPECT_GT(torque->percent(), 30);
  // The picture of the answer and that of the initial design.
  ASSERT_EQ(r.scenes.size(), 2u);
  EXPECT_EQ(r.scenes[0].name, "solution-1");
  EXPECT_EQ(r.scenes[1].name, "initial");
  EXPECT_EQ(r.scenes[0].circles.size(),
            r.scenes[1].circles.size() + 2);  // counterweights of 0 kg are not drawn
}

TEST(BalancingStudyRun, OverlaysJoinBothDesigns) {
  const study::Result r = run_text(test::linkage_weights);
  const Table& overlay = r.tables[2];
  const Column *now = overlay.find("shaking_force_N"), *before = overlay.find("initial_shaking_force_N");
  ASSERT_TRUE(now && before);
  // A full turn: its closing row counts once.
  EXPECT_NEAR(r.changes[0].before, rms(std::span(before->values).first(before->values.size() - 1)), 1e-12);
  EXPECT_NEAR(r.changes[0].after, rms(std::span(now->values).first(now->values.size() - 1)), 1e-12);
  std::vector<std::string> plots;
  for (const study::Plot& p : r.plots) plots.push_back(p.name);
  EXPECT_THAT(plots, Contains("overlay-shaking_force_N"));
  EXPECT_THAT(plots, Contains("polar-O"));
  EXPECT_THAT(plots, Contains("polar-shaking_force"));
}

TEST(BalancingStudyRun, AFrontIsATableAPlotAndSolutions) {
  const study::Result r =
      run_text(test::linkage_weights + "[optimiser]\nmethod = \"convex\"\ncombine = \"front\"\nfront = 9\n");
  // Nine questions; some have the same design as their answer.
  const std::size_t n = r.solutions.size();
  ASSERT_GE(n, 3u);
  ASSERT_LE(n, 9u);
  EXPECT_THAT(names_of(r), Contains("front"));
  const Table& front =
      *std::find_if(r.tables.begin(), r.tables.end(), [](const Table& t) { return t.name == "front"; });
  ASSERT_EQ(front.rows(), n);
  EXPECT_EQ(front.columns[0].key, "solution");
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)  // less in one objective is more in the other
      if (front.columns[1].values[i] < front.columns[1].values[j]) {
        EXPECT_GT(front.columns[2].values[i], front.columns[2].values[j]);
      }
  for (std::size_t i = 1; i < n; ++i)  // best mean first
    EXPECT_LE(r.solutions[i - 1].objectives.find("cost")->as_number(),
              r.solutions[i].objectives.find("cost")->as_number());
  EXPECT_EQ(r.solutions[0].parameters[0].label, "crank crank counterweight mass (initially 0.1)");
  EXPECT_EQ(r.plots[0].table, "front");
  EXPECT_EQ(r.scenes.size(), n + 1);
}

TEST(BalancingStudyRun, WhatIsNotConvexIsRefusedByConvex) {
  const study::Result r = run_text(test::engine + "[optimiser]\nmethod = \"convex\"\n");
  EXPECT_EQ(r.status, Status::infeasible);
  EXPECT_EQ(
      to_string(r.headline),
      "This is not a convex problem: the angle of 'crank mass 1' is limited; only a fixed one or a full turn "
      "is convex.");
}

TEST(BalancingStudyRun, LengthsOfAFourBarGoThroughTheFastAndTheGeneralWay) {
  // The general way is taken because of a constraint that never binds.
  const std::string text = replaced(replaced(test::four_bar_masses, "crank_m   = 0.1",
                                             "crank_m   = { min = 0.08, max = 0.12, initial = 0.1 }"),
                                    "mass_kg            = { min = 0.8, max = 1.6, initial = 1.296 }",
                                    "mass_kg            = 1.296");
  const std::string optimiser =
      "[optimiser]\nmethod = \"gradient\"\ncandidates = 64\nstarts = 2\nconfirmations = 0\n";
  const study::Result fast = run_text(text + optimiser);
  const study::Result general = run_text(
      text + "[[constraint]]\nquantity = \"O1_drive_torque_N_m\"\nmeasure = \"max_abs\"\nat_most = 1e6\n" +
      optimiser);
  const double a = fast.solutions[0].objectives.find("cost")->as_number(),
               b = general.solutions[0].objectives.find("cost")->as_number();
  EXPECT_NEAR(a / b, 1, 1e-4);
  EXPECT_LT(a, 0.6);
}

// The first candidates of a search with many rows: one look before each, not one before 256 of them.
TEST(BalancingStudyRun, LooksBetweenCandidates) {
  const std::string text = replaced(test::four_bar_masses, "crank_m   = 0.1",
                                    "crank_m   = { min = 0.08, max = 0.12, initial = 0.1 }"),
                    // A constraint that never binds makes the general method be taken.
      general = "[[constraint]]\nquantity = \"O1_drive_torque_N_m\"\nmeasure = \"max_abs\"\nat_most = 1e6\n";
  for (const std::string& way : {std::string(), general}) {
    const LooksAllowed looks(20);
    const study::Result r = run_text(text + way + "[optimiser]\nmethod = \"gradient\"\n");
    EXPECT_EQ(r.status, Status::cancelled);
    ASSERT_FALSE(r.solutions.empty());
    EXPECT_TRUE(std::isfinite(r.solutions[0].objectives.find("cost")->as_number()));
    EXPECT_LT(r.statistics.find("evaluations")->as_integer(), 60);
  }
}

TEST(BalancingStudyRun, AConstraintKeepsTheFunction) {
  // The rocker must swing as it does, whatever the crank.
  const std::string text =
      replaced(test::four_bar_masses, "crank_m   = 0.1",
               "crank_m   = { min = 0.08, max = 0.12, initial = 0.1 }") +
      "[[constraint]]\nquantity = \"rocker_angle_rad\"\nmeasure = \"max_abs\"\nchange = true\nat_most = "
      "0.002\n"
      "[optimiser]\nmethod = \"gradient\"\ncandidates = 64\nstarts = 2\nconfirmations = 0\n";
  const study::Result r = run_text(text);
  EXPECT_EQ(r.status, Status::done);
  const auto column = [&](std::size_t table) { return r.tables[table].find("rocker_angle_rad")->values; };
  const auto now = column(0), before = column(1);
  for (std::size_t i = 0; i < now.size(); ++i) EXPECT_NEAR(now[i], before[i], 0.002 * (1 + 1e-6));
}

TEST(BalancingStudyRun, InertiasAreKeptPhysical) {
  // Free inertia, mass and centre of the crank; its material is at most 60 mm from O1.
  const study::Result r = run_text(
      test::four_bar_masses +
      "[[constraint]]\nquantity = \"crank_gyration_radius_m\"\nmeasure = \"maximum\"\nat_most = 0.06\n"
      "[optimiser]\nmethod = \"gradient\"\ncandidates = 64\nstarts = 2\nconfirmations = 0\n");
  EXPECT_EQ(r.status, Status::done);
  const auto value = [&](std::string_view key) {
    for (const study::Parameter& p : r.solutions[0].parameters)
      if (p.key == key) return p.value;
    ADD_FAILURE() << key;
    return 0.0;
  };
  const double m = value("mass.crank.mass_kg"), j = value("mass.crank.inertia_kg_m2"),
               d = value("mass.crank.centre_distance_mm") / 1e3;
  EXPECT_LE(std::sqrt(j / m + d * d), 0.06 * (1 + 1e-6));
  EXPECT_GT(std::sqrt(j / m + d * d), 0.059);  // it would like to be larger
}

TEST(BalancingStudyRun, ExamplesPassTheirChecks) {
  // The longer ones are run by hand.
  for (const char* name :
       {"balance-arm-counterweights", "balance-four-bar-case-3-masses", "balance-engine"}) {
    const auto prepared = test::prepare_example(test::kinds(), std::string(name) + ".toml");
    ASSERT_TRUE(prepared) << name;
    RunContext context;
    const study::Result r = study::run_study(*prepared, context);
    EXPECT_EQ(r.status, Status::done) << name;
    for (const study::Check& c : r.checks)
      EXPECT_TRUE(c.passed) << name << ": " << c.quantity << " = " << c.value;
  }
}

}  // namespace
}  // namespace linkwright::planar
