// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/survey.h"

#include <gtest/gtest.h>

#include "linkwright/core/check.h"
#include "parallel/robots.h"
#include "support/memory_checkpoint.h"

namespace linkwright::parallel {
namespace {

WorkspaceTask delta_task() {
  WorkspaceTask task{.conditions = {.robot = reference_delta(),
                                    .drives = reference_drives(),
                                    .assembly = assembly_at(reference_delta(), {{0, 0, -0.8}}),
                                    .min_transmission = 0.5},
                     .grid = {{-1, -0.9, -1.2}, {1, 1, 0}, 0.05}};
  task.wanted[slot(PoseIndex::conditioning)] = true;
  return task;
}

void expect_same(const WorkspaceSurvey& survey, const WorkspaceMap& map) {
  const WorkspaceTotals whole = totals(map);
  EXPECT_EQ(survey.status, Status::done);
  EXPECT_EQ(survey.nodes, map.nodes);
  EXPECT_EQ(survey.count, map.count());
  EXPECT_EQ(survey.cell, map.cell);
  EXPECT_EQ(survey.totals.count, whole.count);
  EXPECT_EQ(survey.totals.passing, whole.passing);
  EXPECT_GT(whole.passing, 50u);
  EXPECT_EQ(survey.totals.measure, whole.measure);
  for (std::size_t k = 0; k < pose_index_count; ++k) {
    const IndexSummary &a = survey.totals.index[k], &b = whole.index[k];
    EXPECT_EQ(a.count, b.count);
    EXPECT_EQ(a.least, b.least);
    EXPECT_EQ(a.greatest, b.greatest);
    EXPECT_EQ(a.least_at, b.least_at);
    EXPECT_EQ(a.greatest_at, b.greatest_at);
    EXPECT_NEAR(a.mean, b.mean, 1e-13);
  }
}

TEST(WorkspaceSurvey, HasTheTotalsOfTheMap) {
  WorkspaceTask task = delta_task();
  RunContext context;
  const WorkspaceSurvey survey = survey_workspace(task, context);
  const WorkspaceMap map = workspace(task, context);
  expect_same(survey, map);
  ASSERT_EQ(survey.passing.size(), map.nodes[2]);
  const NodeSet set = passing(map);
  for (std::size_t k = 0; k < map.nodes[2]; ++k) {
    std::size_t count = 0;
    for (std::size_t n = 0; n < map.nodes[0] * map.nodes[1]; ++n) count += set[map.number(0, 0, k) + n];
    EXPECT_EQ(survey.passing[k], count) << k;
  }
  // One level: its layers are rows along x.
  task.grid.low.z = task.grid.high.z = -0.8;
  task.grid.step = 0.02;
  expect_same(survey_workspace(task, context), workspace(task, context));
}

TEST(WorkspaceSurvey, IsTheSameForAnyThreadsAndFromACheckpoint) {
  const WorkspaceTask task = delta_task();
  RunContext one;
  one.set_threads(1);
  const WorkspaceSurvey alone = survey_workspace(task, one);
  test::MemoryCheckpoint kept;
  RunContext first, second;
  first.set_checkpoint(&kept);
  survey_workspace(task, first);
  EXPECT_EQ(kept.entries.size(), alone.nodes[2]);
  for (int k = 1; k < 20; k += 3) kept.entries.erase("layer " + std::to_string(k));
  second.set_checkpoint(&kept);
  const WorkspaceSurvey again = survey_workspace(task, second);
  EXPECT_EQ(again.totals.count, alone.totals.count);
  EXPECT_EQ(again.passing, alone.passing);
  for (std::size_t k = 0; k < pose_index_count; ++k)
    EXPECT_EQ(again.totals.index[k].mean, alone.totals.index[k].mean);
  kept.keep("layer 3", Value(5.0));
  EXPECT_THROW(survey_workspace(task, second), CheckpointError);
  kept.keep("layer 3", kept.find("layer 4"));
  WorkspaceTask other = task;
  other.grid.high.x = 0.5;
  EXPECT_THROW(survey_workspace(other, second), CheckpointError);
}

TEST(WorkspaceSurvey, CountsWhatItHasSeenWhenItIsInterrupted) {
  RunContext context;
  context.cancel();
  const WorkspaceSurvey survey = survey_workspace(delta_task(), context);
  EXPECT_EQ(survey.status, Status::cancelled);
  EXPECT_EQ(survey.count, 0u);
  WorkspaceTask wrong = delta_task();
  wrong.grid.step = 1e-5;
  EXPECT_THROW(survey_workspace(wrong, context), ContractError);
}

}  // namespace
}  // namespace linkwright::parallel
