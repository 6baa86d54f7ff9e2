// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/any_machine_refine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "linkwright/core/value.h"
#include "linkwright/study/design.h"
#include "linkwright/study/study.h"
#include "planar/studies.h"
#include "support/memory_checkpoint.h"
#include "support/resumed.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

/// A study of a closed stroke with some of its parts replaced.
std::string refined_path(const std::map<std::string, std::string>& changed = {}) {
  return test::text_of(
      {{"0", "schema = 1\nkind = \"synthesis\"\n"},
       {"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"four_bar\", \"slider_crank\", \"watt_1\"]\n"},
       {"2",
        "[target]\ntype = \"path_points\"\npoints_mm = [[0, 0], [40, 5], [60, 30], [40, 50], [0, 40], "
        "[-10, 20]]\nclosed = true\n"},
       {"3", "[optimiser]\nevaluations = 30000\n"},
       {"4",
        "[machine]\nmass_per_metre_kg = 2\ncrank_speed_rpm = 120\nforce_N = [0, -15]\n"
        "[environment]\ngravity_m_per_s2 = 0\n"},
       {"5",
        "[[objective]]\nquantity = \"peak_joint_force\"\n[[objective]]\nquantity = \"drive_torque\"\n"
        "[refinement]\nstarts = 1\n"}},
      changed);
}

double largest_ending(const Table& sweep, const std::string& ending) {
  double out = 0;
  for (const Column& column : sweep.columns)
    if (column.key.ends_with(ending))
      for (const double v : column.values) out = std::max(out, std::abs(v));
  return out;
}

TEST(RefinedMachines, SayWhatTheyWereBefore) {
  const study::Result result = test::run_text(refined_path());
  EXPECT_EQ(result.status, Status::done);
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  const auto& aim = machines->find("refined_for")->values;
  for (const std::string key : {"peak_joint_force", "drive_torque"}) {
    const std::string unit = key == "drive_torque" ? "_N_m" : "_N";
    const auto& now = machines->find(key + unit)->values;
    const auto& before = machines->find(key + "_before" + unit)->values;
    ASSERT_EQ(now.size(), aim.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (aim[i] == 0) {
        EXPECT_EQ(now[i], before[i]);
      }
      if (aim[i] == (key == "drive_torque" ? 2 : 1)) {
        EXPECT_LT(now[i], before[i]);
      }
    }
  }
  EXPECT_GT(*std::max_element(aim.begin(), aim.end()), 0);
  EXPECT_THAT(test::fact(result, "peak joint force, lowest of all machines"),
              HasSubstr("before the refinement"));
  EXPECT_THAT(test::fact(result, "masses and speed"), HasSubstr("2 kg"));
  for (const double angle : machines->find("least_pair_angle_rad")->values) EXPECT_GE(angle, 20 * pi / 180);
}

// The study of a machine has its masses, its load and its speed.
TEST(RefinedMachines, AreStudiesWithTheSameForces) {
  const study::Result result = test::run_text(refined_path());
  ASSERT_FALSE(result.solutions.empty());
  for (const study::Solution& solution : result.solutions) {
    const study::Result again = test::run_text(study::design_toml(solution, 1, "a list", "a test"));
    EXPECT_EQ(again.status, Status::done) << to_string(solution.label);
    const Table* sweep = again.table("sweep");
    ASSERT_TRUE(sweep);
    const double torque = solution.objectives.find("drive_torque_N_m")->as_number();
    EXPECT_NEAR(largest_ending(*sweep, "_drive_torque_N_m") / torque, 1, 1e-9);
    double force = 0;
    for (const Column& column : sweep->columns)
      if (column.key.ends_with("_N") && !column.key.ends_with("_x_N") && !column.key.ends_with("_y_N"))
        for (const double v : column.values) force = std::max(force, std::abs(v));
    EXPECT_NEAR(force / solution.objectives.find("peak_joint_force_N")->as_number(), 1, 1e-9);
  }
}

TEST(RefinedMachines, ShowForcesWithoutObjectives) {
  const study::Result result = test::run_text(refined_path({{"5", ""}}));
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  EXPECT_TRUE(machines->find("peak_joint_force_N"));
  EXPECT_FALSE(machines->find("peak_joint_force_before_N"));
}

TEST(RefinedMachines, HaveNoForcesUnlessAsked) {
  const study::Result result = test::run_text(refined_path({{"4", ""}, {"5", ""}}));
  EXPECT_FALSE(result.table("machines")->find("peak_joint_force_N"));
}

TEST(RefinedMachines, AreTheSameForEveryNumberOfThreads) {
  const auto run = [](int threads) {
    std::string messages;
    const auto study = test::prepare(refined_path(), messages);
    RunContext context;
    context.set_threads(threads);
    return study::run_study(*study, context);
  };
  const study::Result one = run(1), two = run(2);
  ASSERT_EQ(one.solutions.size(), two.solutions.size());
  for (std::size_t i = 0; i < one.solutions.size(); ++i)
    EXPECT_EQ(one.solutions[i].objectives, two.solutions[i].objectives);
}

/// Calls something when the first machines have been refined.
void when_refining(RunContext& context, const std::function<void()>& act) {
  context.set_progress([act](const Progress& progress) {
    if (progress.stage == "refinement") act();
  });
}

// The search goes on from what was kept, and the refinement begins again.
TEST(RefinedMachines, ContinueFromACheckpoint) {
  std::string messages;
  const auto study = test::prepare(refined_path(), messages);
  ASSERT_TRUE(study) << messages;
  RunContext plain;
  const study::Result whole = study::run_study(*study, plain);
  linkwright::test::MemoryCheckpoint kept;
  RunContext stopped;
  stopped.set_checkpoint(&kept);
  when_refining(stopped, [&] { stopped.cancel(); });
  const study::Result part = study::run_study(*study, stopped);
  EXPECT_EQ(part.status, Status::cancelled);
  EXPECT_FALSE(part.solutions.empty());
  RunContext resumed;
  resumed.set_checkpoint(&kept);
  EXPECT_EQ(linkwright::test::all_of(study::run_study(*study, resumed)), linkwright::test::all_of(whole));
}

// What a deadline leaves unrefined stays in the list as it was found.
TEST(RefinedMachines, StayAsFoundAtTheDeadline) {
  std::string messages;
  const auto study = test::prepare(refined_path(), messages);
  ASSERT_TRUE(study) << messages;
  RunContext context;
  when_refining(context, [&] { context.set_time_limit(std::chrono::duration<double>(0)); });
  const study::Result result = study::run_study(*study, context);
  EXPECT_EQ(result.status, Status::deadline);
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  const auto& aim = machines->find("refined_for")->values;
  EXPECT_GT(std::count(aim.begin(), aim.end(), 0.0), 0);
  EXPECT_EQ(aim.size(), result.solutions.size());
}

TEST(RefinedMachines, LeadBodiesThroughPoses) {
  const study::Result result = test::run_text(refined_path(
      {{"2",
        "[target]\ntype = \"poses\"\n[[target.pose]]\nx_mm = 0\ny_mm = 0\nangle_deg = 0\n[[target.pose]]\n"
        "x_mm = 30\ny_mm = 10\nangle_deg = 10\n[[target.pose]]\nx_mm = 60\ny_mm = 12\nangle_deg = 30\n"
        "[[target.pose]]\nx_mm = 90\ny_mm = 2\nangle_deg = 45\n"},
       {"5", "[[objective]]\nquantity = \"size\"\n[[objective]]\nquantity = \"tolerance_90\"\n"}}));
  EXPECT_EQ(result.status, Status::done);
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  const auto& aim = machines->find("refined_for")->values;
  const auto &size = machines->find("size_m")->values, &before = machines->find("size_before_m")->values;
  bool smaller = false;
  for (std::size_t i = 0; i < aim.size(); ++i) smaller = smaller || (aim[i] == 1 && size[i] < before[i]);
  EXPECT_TRUE(smaller);
}

TEST(RefinedMachines, SayWhatIsWrong) {
  const auto problems = [](const std::map<std::string, std::string>& changed) {
    return test::problems_of(refined_path(changed));
  };
  EXPECT_THAT(problems({{"5", "[[objective]]\nquantity = \"peak_joint_forces\"\n"}}),
              HasSubstr("peak_joint_force"));
  EXPECT_THAT(problems({{"5", "[[objective]]\nquantity = \"size\"\n[[objective]]\nquantity = \"size\"\n"}}),
              HasSubstr("size is an objective already"));
  EXPECT_THAT(problems({{"5", "[[objective]]\nweight = 2\n"}}), HasSubstr("quantity"));
  EXPECT_THAT(problems({{"4", "[machine]\nmass_per_metre_kg = -1\n"}}), HasSubstr("mass_per_metre_kg"));
  EXPECT_THAT(problems({{"5", "[refinement]\nstarts = 0\n"}}), HasSubstr("starts"));
  EXPECT_THAT(problems({{"5", "[refinement]\nerror_growth = -0.1\n"}}), HasSubstr("error_growth"));
}

TEST(RefinedMachines, WarnOfTablesWithoutUse) {
  std::string messages;
  EXPECT_TRUE(test::prepare(
      refined_path({{"4", "[environment]\ngravity_m_per_s2 = 1\n"}, {"5", "[refinement]\nstarts = 3\n"}}),
      messages));
  EXPECT_THAT(messages, HasSubstr("nothing to refine for"));
  EXPECT_THAT(messages, HasSubstr("gravity does nothing"));
}

/// A study of a function, refined for forces, with some of its parts replaced.
std::string refined_function(const std::map<std::string, std::string>& changed = {}) {
  return test::text_of(
      {{"0", "schema = 1\nkind = \"synthesis\"\n"},
       {"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"four_bar\", \"stephenson_3\"]\n"},
       {"2",
        "[target]\ntype = \"function\"\nfunction = \"sin\"\nx = { from = 0, to = 60 }\ninput_range_deg = "
        "60\n"},
       {"21", "output_range_deg = 60\n"},
       {"22", "fit = \"minimax\"\n"},
       {"3", "[optimiser]\nevaluations = 40000\n"},
       {"4",
        "[machine]\nmass_per_metre_kg = 2\ncrank_speed_rpm = 60\ntorque_N_m = 3\n[environment]\n"
        "gravity_m_per_s2 = 0\n"},
       {"5",
        "[[objective]]\nquantity = \"peak_joint_force\"\n[[objective]]\nquantity = \"drive_torque\"\n"
        "[refinement]\nstarts = 1\n"}},
      changed);
}

/// Greatest error of the machines of a list, of one program.
double greatest_of(const Table& machines, const std::string& program, const std::string& key) {
  double out = 0;
  for (std::size_t i = 0; i < machines.names.size(); ++i)
    if (machines.names[i] == program) out = std::max(out, machines.find(key)->values[i]);
  return out;
}

TEST(RefinedFunctions, KeepTheirErrors) {
  for (const std::string fit : {"minimax", "least_squares"}) {
    const std::map<std::string, std::string> by{{"22", "fit = \"" + fit + "\"\n"}};
    std::map<std::string, std::string> plain = by;
    plain["4"] = plain["5"] = "";
    const study::Result found = test::run_text(refined_function(plain)),
                        refined = test::run_text(refined_function(by));
    EXPECT_EQ(refined.status, Status::done);
    const Table *before = found.table("machines"), *after = refined.table("machines");
    ASSERT_TRUE(before && after);
    const std::string key = fit == "minimax" ? "structural_error_rad" : "structural_error_rms_rad";
    bool lower = false;
    for (std::size_t i = 0; i < after->names.size(); ++i) {
      EXPECT_LE(after->find(key)->values[i], 1.1 * greatest_of(*before, after->names[i], key)) << fit << i;
      EXPECT_GE(after->find("least_pair_angle_rad")->values[i], 20 * pi / 180) << fit << i;
      if (after->find("refined_for")->values[i] != 1) continue;
      lower = true;
      EXPECT_LT(after->find("peak_joint_force_N")->values[i],
                after->find("peak_joint_force_before_N")->values[i]);
    }
    EXPECT_TRUE(lower) << fit;
    EXPECT_TRUE(std::is_sorted(after->find(key)->values.begin(), after->find(key)->values.end()));
  }
}

TEST(RefinedFunctions, AreStudiesWithTheSameForces) {
  for (const bool slider : {false, true}) {
    const std::string whole_turn =
        "[target]\ntype = \"function\"\ntable = [[0, 0], [90, 0.45], [180, 1], [270, 0.55], [360, 0]]\n"
        "input_range_deg = 360\n";
    const study::Result result = test::run_text(
        slider
            ? refined_function({{"2", whole_turn},
                                {"21", "output_range_mm = 40\n"},
                                {"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"slider_crank\"]\n"},
                                {"4", "[machine]\nforce_N = [-50, 0]\n"}})
            : refined_function());
    ASSERT_FALSE(result.solutions.empty());
    for (const study::Solution& solution : result.solutions) {
      const study::Result again = test::run_text(study::design_toml(solution, 1, "a list", "a test"));
      const Table* sweep = again.table("sweep");
      ASSERT_TRUE(sweep) << to_string(solution.label);
      EXPECT_NEAR(largest_ending(*sweep, "_drive_torque_N_m") /
                      solution.objectives.find("drive_torque_N_m")->as_number(),
                  1, 1e-9);
    }
  }
}

// A massless crank carries the torque of the output times the slope of the function, pi/2 at its beginning.
TEST(RefinedFunctions, CarryTheTorqueOnTheirOutput) {
  const study::Result result = test::run_text(
      refined_function({{"2",
                         "[target]\ntype = \"function\"\nfunction = \"sin\"\nx = { from = 0, to = 90 }\n"
                         "input_range_deg = 90\n"},
                        {"21", "output_range_deg = 90\n"},
                        {"4",
                         "[machine]\nmass_per_metre_kg = 1e-6\ncrank_speed_rpm = 0\ntorque_N_m = 3\n"
                         "[environment]\ngravity_m_per_s2 = 0\n"},
                        {"5", ""}}));
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  EXPECT_NEAR(machines->find("drive_torque_N_m")->values[0], 3 * pi / 2, 0.05);
}

TEST(RefinedFunctions, NameTheAccelerationOfTheOutput) {
  const study::Result result = test::run_text(refined_function(
      {{"5", "[[objective]]\nquantity = \"peak_acceleration\"\n[[objective]]\nquantity = \"size\"\n"}}));
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  ASSERT_TRUE(machines->find("peak_acceleration_rad") && machines->find("size_before_m"));
  const Table* first = result.table("structural_error");
  const auto &turned = first->find("input_rad")->values, &output = first->find("output_rad")->values;
  double peak = 0;
  for (std::size_t k = 1; k + 1 < turned.size(); ++k)
    peak = std::max(peak, std::abs(output[k + 1] - 2 * output[k] + output[k - 1]) /
                              ((turned[k + 1] - turned[k]) * (turned[k + 1] - turned[k])));
  EXPECT_NEAR(machines->find("peak_acceleration_rad")->values[0] / peak, 1, 0.01);
  // A machine of the same scale becomes smaller.
  const auto &size = machines->find("size_m")->values, &before = machines->find("size_before_m")->values;
  bool smaller = false;
  for (std::size_t i = 0; i < size.size(); ++i) smaller = smaller || size[i] < 0.98 * before[i];
  EXPECT_TRUE(smaller);
}

TEST(RefinedFunctions, SayWhatIsWrong) {
  EXPECT_THAT(test::problems_of(refined_function({{"21", "output_range_mm = 50\n"}})),
              HasSubstr("a torque acts on the output, which is a slider"));
  EXPECT_THAT(test::problems_of(refined_path({{"4", "[machine]\ntorque_N_m = 2\n"}})),
              HasSubstr("torque_N_m"));
}

}  // namespace
}  // namespace linkwright::planar
