// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/aspects.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "linkwright/core/looks.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

WorkspaceTask delta_task() {
  return {.conditions = {.robot = reference_delta(),
                         .drives = reference_drives(),
                         .assembly = -1,
                         .min_transmission = 0.5},
          .grid = {{-0.7, -0.7, -1.2}, {0.7, 0.7, -0.3}, 0.04}};
}

TEST(WorkspaceAspects, TheReferenceDeltaIsInOnePiece) {
  const WorkspaceTask task = delta_task();
  const WorkspaceMap map = workspace(task, RunContext());
  for (const Neighbours n : {Neighbours::along_axes, Neighbours::diagonal_too}) {
    const WorkspaceAspects found = workspace_aspects(
        map, passing(map), {.conditions = task.conditions, .home = {0, 0, -0.8}, .neighbours = n},
        RunContext());
    EXPECT_EQ(found.status, Status::done);
    EXPECT_EQ(found.closed, 0u);
    // Single nodes at corners of the set touch it across a diagonal only.
    const std::size_t corners = found.size.size() - 1;
    EXPECT_LE(corners, n == Neighbours::along_axes ? 6u : 0u);
    EXPECT_EQ(found.reachable() + corners, totals(map).passing);
    EXPECT_EQ(found.all(), totals(map).passing);
    // In the inside every node has half of 6 or 26 edges of its own.
    const double edges = n == Neighbours::along_axes ? 3 : 13;
    EXPECT_LT(static_cast<double>(found.edges), edges * static_cast<double>(found.all()));
    EXPECT_GT(static_cast<double>(found.edges), 0.7 * edges * static_cast<double>(found.all()));
  }
}

TEST(WorkspaceAspects, WhatTheConstraintLeavesIsJoinedToHome) {
  for (const char* name : {"mean", "clear"})
    for (const auto& [key, least] : {std::pair{"chi_min=0", 1e-3}, {"chi_min=0.2", 0.2}}) {
      const Value& row = test::at(computed("delta-constraint-workspace"), std::string("workspaces.") + name);
      const Value& counts = *row.find(key);
      WorkspaceTask task = constraint_task(name);
      task.conditions.constraint = 1;
      task.conditions.least_constraint = least;
      const WorkspaceMap map = workspace(task, RunContext());
      const WorkspaceAspects found = workspace_aspects(
          map, passing(map), {.conditions = task.conditions, .home = constraint_home(name).position},
          RunContext());
      EXPECT_NEAR(static_cast<double>(found.reachable()), test::number_at(counts, "joined_to_home"), 3)
          << name;
      EXPECT_EQ(static_cast<double>(found.size.size()), test::number_at(counts, "parts")) << name << key;
    }
}

// Without conditions of the constraint nodes beyond it pass, but nothing joins them to home.
TEST(WorkspaceAspects, NothingJoinsTheTwoSidesOfAConstraintSingularity) {
  const WorkspaceTask task = constraint_task("clear");
  const WorkspaceMap map = workspace(task, RunContext());
  const WorkspaceAspects found = workspace_aspects(
      map, passing(map), {.conditions = task.conditions, .home = {0, 0, -0.6}}, RunContext());
  EXPECT_GT(found.closed, 0u);
  EXPECT_EQ(found.all(), totals(map).passing);
  EXPECT_NEAR(static_cast<double>(found.reachable()), 13650, 30);
  for (std::size_t n = 0; n < map.count(); ++n)
    if (found.aspect[n] >= 0 && found.aspect[n] == found.home) {
      EXPECT_EQ(marks_at(task.conditions.robot, {map.position(n)}), (Marks{-1, 1}));
    }
}

// Mode (+, -) of the five-bar crosses its singularity of type 2: rods aligned.
WorkspaceTask crossing() {
  return {.conditions = {.robot = reference_five_bar(), .mode = {1, -1}},
          .grid = {{-0.6, -0.6, 0}, {0.6, 0.6, 0}, 0.01}};
}

TEST(WorkspaceAspects, NothingJoinsTheTwoSidesOfASingularity) {
  const WorkspaceTask task = crossing();
  const WorkspaceMap map = workspace(task, RunContext());
  const NodeSet all = passing(map);
  const WorkspaceAspects found =
      workspace_aspects(map, all, {.conditions = task.conditions, .home = {0.05, 0.45, 0}}, RunContext());
  EXPECT_GT(found.closed, 0u);
  EXPECT_GT(found.size.size(), 1u);
  EXPECT_LT(found.reachable(), found.all());
  EXPECT_EQ(found.all(), totals(map).passing);
  // Each aspect has one sign of det Jx, and the aspect of home that of home.
  const int home = assembly_at(task.conditions.robot, {{0.05, 0.45, 0}}, task.conditions.mode);
  std::vector<int> sign(found.size.size());
  for (std::size_t n = 0; n < map.count(); ++n) {
    if (found.aspect[n] < 0) continue;
    const int here = assembly_at(task.conditions.robot, {map.position(n)}, task.conditions.mode);
    int& of_aspect = sign[static_cast<std::size_t>(found.aspect[n])];
    if (of_aspect == 0) of_aspect = here;
    EXPECT_EQ(of_aspect, here);
  }
  EXPECT_EQ(sign[static_cast<std::size_t>(found.home)], home);
  EXPECT_NE(std::count(sign.begin(), sign.end(), -home), 0);
  std::size_t nodes = 0;
  for (const auto in : nodes_of(found, found.home)) nodes += in;
  EXPECT_EQ(nodes, found.reachable());
}

TEST(WorkspaceAspects, AStepAcrossTwoSingularitiesIsSeen) {
  // Two nodes 0.6 m apart on both sides of the base line have the same sign of det Jx in mode (-, +), yet
  // between them the rods are aligned twice or a leg does not reach: a look at the ends is not enough.
  PoseConditions c{.robot = reference_five_bar(), .mode = {-1, 1}};
  const Vec3 home{0, 0.3, 0};
  const WorkspaceTask task{.conditions = c, .grid = {{0, -0.3, 0}, {0, 0.3, 0}, 0.6}};
  const WorkspaceMap map = workspace(task, RunContext());
  ASSERT_EQ(totals(map).passing, 2u);
  ASSERT_EQ(assembly_at(c.robot, {{0, -0.3, 0}}, c.mode), assembly_at(c.robot, {home}, c.mode));
  // On the way: the sign of det Jx changes, or there is no pose.
  bool regular = true;
  for (int i = -100; i <= 100; ++i)
    regular =
        regular && assembly_at(c.robot, {{0, 0.003 * i, 0}}, c.mode) == assembly_at(c.robot, {home}, c.mode);
  ASSERT_FALSE(regular);
  const WorkspaceAspects found =
      workspace_aspects(map, passing(map), {.conditions = c, .home = home}, RunContext());
  EXPECT_EQ(found.edges, 1u);
  EXPECT_EQ(found.closed, 1u);
  EXPECT_EQ(found.size, (std::vector<std::size_t>{1, 1}));
  EXPECT_EQ(found.home, 1);
}

TEST(WorkspaceAspects, OpenEdgesAreRegularAllAlong) {
  // The bound against a dense look: no edge that it calls open has another sign or a gap on its way.
  const WorkspaceTask task{.conditions = {.robot = reference_hexa(), .characteristic_length = 0.09},
                           .grid = {{-0.3, -0.3, -0.7}, {0.3, 0.3, -0.2}, 0.1},
                           .rotation = math::turn_x(0.4)};
  const WorkspaceMap map = workspace(task, RunContext());
  const WorkspaceAspects found = workspace_aspects(
      map, passing(map), {.conditions = task.conditions, .rotation = task.rotation, .home = {0, 0, -0.5}},
      RunContext());
  std::size_t looked = 0, apart = 0;
  for (std::size_t n = 0; n + 1 < map.count(); ++n) {
    if ((n + 1) % map.nodes[0] == 0 || found.aspect[n] < 0 || found.aspect[n + 1] < 0) continue;
    if (found.aspect[n] != found.aspect[n + 1]) {
      ++apart;
      continue;
    }
    ++looked;
    const Vec3 a = map.position(n), b = map.position(n + 1);
    const int sign = assembly_at(task.conditions.robot, {a, task.rotation});
    int same = 0;
    for (int i = 0; i <= 50; ++i)
      same += assembly_at(task.conditions.robot, {a + i / 50.0 * (b - a), task.rotation}) == sign;
    // Nodes of one aspect may have a closed edge between them; there are few.
    if (same != 51) ++apart;
  }
  EXPECT_GT(looked, 50u);
  EXPECT_LE(apart, found.closed);
}

TEST(WorkspaceAspects, DoesNotDependOnThreadsAndStops) {
  const WorkspaceTask task = crossing();
  const WorkspaceMap map = workspace(task, RunContext());
  RunContext one, two, none;
  one.set_threads(1);
  two.set_threads(2);
  const WorkspaceAspectsTask aspects{.conditions = task.conditions, .home = {0.05, 0.45, 0}};
  const WorkspaceAspects first = workspace_aspects(map, passing(map), aspects, one),
                         second = workspace_aspects(map, passing(map), aspects, two);
  EXPECT_EQ(first.aspect, second.aspect);
  EXPECT_EQ(first.closed, second.closed);
  none.cancel();
  EXPECT_EQ(workspace_aspects(map, passing(map), aspects, none).status, Status::cancelled);
}

// Wherever it is interrupted it says so and gives no aspect; a look at each row of nodes at least.
TEST(WorkspaceAspects, IsInterruptedAnywhere) {
  const WorkspaceTask task = crossing();
  const WorkspaceMap map = workspace(task, RunContext());
  RunContext context;
  context.set_threads(1);
  const WorkspaceAspectsTask aspects{.conditions = task.conditions, .home = {0.05, 0.45, 0}};
  std::int64_t all = 0;
  {
    const LooksAllowed looks(std::int64_t{1} << 40);
    EXPECT_EQ(workspace_aspects(map, passing(map), aspects, context).status, Status::done);
    all = looks.made();
  }
  EXPECT_GE(all, static_cast<std::int64_t>(2 * map.nodes[1] * map.nodes[2]));
  for (const std::int64_t allowed : {std::int64_t{0}, std::int64_t{1}, all / 2, all - 1}) {
    const LooksAllowed looks(allowed);
    const WorkspaceAspects found = workspace_aspects(map, passing(map), aspects, context);
    EXPECT_EQ(found.status, Status::cancelled) << allowed;
    EXPECT_TRUE(found.size.empty());
    EXPECT_LE(looks.made(), all + 2);
  }
}

TEST(WorkspaceAspects, HomeMayBeOutsideTheSet) {
  const WorkspaceTask task = delta_task();
  const WorkspaceMap map = workspace(task, RunContext());
  const WorkspaceAspects found = workspace_aspects(
      map, passing(map), {.conditions = task.conditions, .home = {0.7, 0.7, -1.2}}, RunContext());
  EXPECT_EQ(found.home, -1);
  EXPECT_EQ(found.reachable(), 0u);
  EXPECT_GT(found.all(), 0u);
}

}  // namespace
}  // namespace linkwright::parallel
