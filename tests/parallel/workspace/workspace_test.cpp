// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/workspace.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

using test::number_at;

// The reference counts let a node on the boundary go either way.
constexpr double nodes = 3;

double count_before(const WorkspaceMap& map, Criterion first) {
  std::size_t out = 0;
  for (const auto in : nodes_before(map, first)) out += in;
  return static_cast<double>(out);
}

WorkspaceTask delta_task() {
  return {.conditions = {.robot = reference_delta(),
                         .drives = reference_drives(),
                         .assembly = assembly_at(reference_delta(), {{0, 0, -0.8}}),
                         .min_transmission = 0.5},
          .grid = {{-1, -1, -1.2}, {1, 1, 0}, 0.02}};
}

TEST(Workspace, OfTheReferenceDelta) {
  const Value& expected = computed("delta-workspace");
  WorkspaceTask task = delta_task();
  task.wanted[slot(PoseIndex::conditioning)] = true;
  const WorkspaceMap map = workspace(task, RunContext());
  EXPECT_EQ(map.status, Status::done);
  EXPECT_EQ(map.nodes, (std::array<std::size_t, 3>{101, 101, 61}));
  EXPECT_NEAR(count_before(map, Criterion::travel), number_at(expected, "counts.reachable"), nodes);
  EXPECT_NEAR(count_before(map, Criterion::transmission), number_at(expected, "counts.pi_range"), nodes);
  const WorkspaceTotals total = totals(map);
  EXPECT_EQ(static_cast<double>(total.passing), count_before(map, Criterion::open));
  EXPECT_NEAR(count_before(map, Criterion::open), number_at(expected, "counts.pi_range_lti"), nodes);
  EXPECT_NEAR(total.measure, number_at(expected, "volumes_m3.pi_range_lti"), nodes * map.cell);
  EXPECT_NEAR(map.cell, 8e-6, 1e-18);
  // Three nodes of 44273 move the mean by no more than their share.
  EXPECT_NEAR(total.index[slot(PoseIndex::conditioning)].mean, number_at(expected, "gci"), nodes / 44273);
}

// The same grid, with what keeps the platform from turning.
TEST(Workspace, OfTheReferenceDeltaWithItsConstraint) {
  const Value& expected = test::at(computed("delta-workspace"), "constraint");
  WorkspaceTask task = delta_task();
  task.conditions.constraint = 1;
  WorkspaceMap map = workspace(task, RunContext());
  EXPECT_NEAR(count_before(map, Criterion::travel), number_at(expected, "reachable_same_sign"), nodes);
  EXPECT_NEAR(count_before(map, Criterion::open), number_at(expected, "pi_range_lti_same_sign"), nodes);
  task.conditions.least_constraint = 0.2;
  task.wanted[slot(PoseIndex::constraint_index)] = true;
  map = workspace(task, RunContext());
  EXPECT_NEAR(count_before(map, Criterion::travel), number_at(expected, "reachable_chi_at_least_02"), nodes);
  EXPECT_NEAR(totals(map).index[slot(PoseIndex::constraint_index)].least,
              number_at(expected, "pi_range_lti_least_chi"), 1e-9);
}

// Two robots whose workspaces the constraint cuts, by sign, by the floor, and by a limit.
TEST(Workspace, TheConstraintCutsWhatIsOfUse) {
  for (const char* name : {"mean", "clear"}) {
    const Value& row = test::at(computed("delta-constraint-workspace"), std::string("workspaces.") + name);
    WorkspaceTask task = constraint_task(name);
    const auto passing_with = [&](int sign, double least) {
      task.conditions.constraint = sign;
      task.conditions.least_constraint = least;
      return static_cast<double>(totals(workspace(task, RunContext())).passing);
    };
    for (const auto& [key, least] : {std::pair{"chi_min=0", 1e-3}, {"chi_min=0.2", 0.2}}) {
      const Value& counts = *row.find(key);
      EXPECT_NEAR(passing_with(0, 0), number_at(counts, "passing_without_constraint"), nodes) << name;
      EXPECT_NEAR(passing_with(1, 0), number_at(counts, "same_sign"), nodes) << name;
      EXPECT_NEAR(passing_with(1, least), number_at(counts, "chi_at_least"), nodes) << name;
    }
  }
}

TEST(Workspace, OfTheReferenceDeltaOnAFineGrid) {
  WorkspaceTask task = delta_task();
  task.grid.step = 0.01;
  const WorkspaceMap map = workspace(task, RunContext());
  const Value& expected = computed("delta-workspace");
  EXPECT_NEAR(count_before(map, Criterion::travel) * map.cell,
              number_at(expected, "volumes_h001_m3.reachable"), nodes * map.cell);
  EXPECT_NEAR(totals(map).measure, number_at(expected, "volumes_h001_m3.pi_range_lti"), nodes * map.cell);
}

TEST(Workspace, OfTheReferenceHexa) {
  for (const int yaw : {0, 25}) {
    SCOPED_TRACE(yaw);
    const WorkspaceTask task{.conditions = {.robot = reference_hexa(),
                                            .drives = reference_drives(),
                                            .assembly = assembly_at(reference_hexa(), {{0, 0, -0.5}}),
                                            .min_transmission = 0.4},
                             .grid = {{-0.42, -0.42, -0.75}, {0.42, 0.42, -0.15}, 0.03},
                             .rotation = math::turn_z(yaw * pi / 180)};
    const WorkspaceMap map = workspace(task, RunContext());
    const std::string key = yaw == 0 ? "yaw_deg=0" : "yaw_deg=25";
    EXPECT_NEAR(count_before(map, Criterion::transmission),
                number_at(test::at(computed("hexa-workspace"), key), "pi_range"), nodes);
    EXPECT_NEAR(count_before(map, Criterion::open),
                number_at(test::at(computed("hexa-workspace"), key), "pi_range_lti"), nodes);
  }
}

TEST(Workspace, OfAFiveBarConvergesToItsArea) {
  const WorkspaceTask task{.conditions = {.robot = reference_five_bar()},
                           .grid = {{-0.7, -0.7, 0}, {0.7, 0.7, 0}, 0.002}};
  const WorkspaceMap map = workspace(task, RunContext());
  EXPECT_EQ(map.axes, 2);
  // Cells that the boundary cuts, some 5 m / 2 mm, count whole or not at all: their errors cancel like random
  // ones.
  EXPECT_NEAR(totals(map).measure, number_at(computed("five-bar-singular-area"), "area_m2"),
              3 * std::sqrt(2500.0) * map.cell);
}

TEST(Workspace, DoesNotDependOnThreads) {
  WorkspaceTask task = delta_task();
  task.wanted = all_indices;
  task.grid.step = 0.05;
  RunContext one, two;
  one.set_threads(1);
  two.set_threads(2);
  const WorkspaceMap first = workspace(task, one), second = workspace(task, two);
  EXPECT_EQ(first.criterion, second.criterion);
  for (std::size_t k = 0; k < pose_index_count; ++k)
    for (std::size_t n = 0; n < first.count(); ++n)
      EXPECT_TRUE(first.index[k][n] == second.index[k][n] ||
                  (std::isnan(first.index[k][n]) && std::isnan(second.index[k][n])));
}

TEST(Workspace, SummariesStateTheirSet) {
  WorkspaceTask task = delta_task();
  task.grid.step = 0.1;
  task.wanted[slot(PoseIndex::transmission)] = true;
  const WorkspaceMap map = workspace(task, RunContext());
  const IndexSummary usable = summary(map, PoseIndex::transmission, passing(map));
  const IndexSummary reachable = summary(map, PoseIndex::transmission, nodes_before(map, Criterion::travel));
  EXPECT_GE(usable.least, 0.5);
  EXPECT_LT(reachable.least, 0.5);
  EXPECT_GT(reachable.count, usable.count);
  EXPECT_EQ(map.index[slot(PoseIndex::transmission)][usable.least_at], usable.least);
  EXPECT_EQ(check_pose(task.conditions, {map.position(usable.greatest_at)}), Criterion::none);
  EXPECT_TRUE(std::isnan(summary(map, PoseIndex::transmission, NodeSet(map.count())).mean));
  EXPECT_THROW(summary(map, PoseIndex::rods, passing(map)), ContractError);
}

TEST(Workspace, StopsWhenAsked) {
  RunContext context;
  context.cancel();
  const WorkspaceMap map = workspace(delta_task(), context);
  EXPECT_EQ(map.status, Status::cancelled);
  EXPECT_EQ(totals(map).count[static_cast<std::size_t>(Criterion::open)], map.count());
  EXPECT_EQ(totals(map).passing, 0u);
}

TEST(Workspace, TellsHowFarItIs) {
  RunContext context;
  double last = 0;
  context.set_progress([&](const Progress& p) {
    EXPECT_EQ(p.stage, "workspace");
    last = p.fraction;
  });
  context.set_threads(1);
  workspace(delta_task(), context);
  EXPECT_EQ(last, 1);
}

TEST(Workspace, RefusesGridsWithoutSense) {
  const auto refused = [](const WorkspaceTask& task) {
    try {
      workspace(task, RunContext());
    } catch (const ContractError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  WorkspaceTask task = delta_task();
  task.grid.step = 0;
  EXPECT_NE(refused(task).find("grid step 0 m must be positive"), std::string::npos);
  task.grid.step = 1e-5;
  EXPECT_NE(refused(task).find("nodes_of: grid of 4800088000520001 nodes"), std::string::npos);
  task.grid = {{0, 0, 0}, {0, 0, -1}, 0.1};
  EXPECT_NE(refused(task).find("grid from 0 to -1 m"), std::string::npos);
  task = delta_task();
  task.rotation = math::turn_z(0.1);
  EXPECT_NE(refused(task).find("does not turn"), std::string::npos);
  task = {.conditions = {.robot = reference_five_bar()}, .grid = {{0, 0, 0}, {1, 1, 1}, 0.5}};
  EXPECT_NE(refused(task).find("a planar robot lies in the plane z = 0, got nodes from 0 to 1 m"),
            std::string::npos);
}

}  // namespace
}  // namespace linkwright::parallel
