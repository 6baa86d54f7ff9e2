// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/run_context.h"

#include <gtest/gtest.h>

#include <vector>

#include "linkwright/core/check.h"

namespace linkwright {
namespace {

TEST(RunContext, CancelAndDeadlineInterrupt) {
  RunContext free_run;
  EXPECT_EQ(free_run.interruption(), Status::done);
  free_run.cancel();
  EXPECT_EQ(free_run.interruption(), Status::cancelled);

  RunContext timed;
  timed.set_time_limit(std::chrono::seconds(0));
  EXPECT_EQ(timed.interruption(), Status::deadline);
  EXPECT_THROW(timed.set_time_limit(std::chrono::seconds(-1)), ContractError);
}

TEST(RunContext, EndsWithTheRunThatItIsAPartOf) {
  RunContext whole, part;
  part.set_part_of(whole);
  EXPECT_EQ(part.interruption(), Status::done);
  whole.set_time_limit(std::chrono::seconds(0));
  EXPECT_EQ(part.interruption(), Status::deadline);
  whole.cancel();
  EXPECT_EQ(part.interruption(), Status::cancelled);

  RunContext free_run, cancelled;
  cancelled.set_part_of(free_run);
  cancelled.cancel();
  EXPECT_EQ(cancelled.interruption(), Status::cancelled);
  EXPECT_EQ(free_run.interruption(), Status::done);
}

TEST(RunContext, PassesProgressOn) {
  RunContext context;
  std::vector<double> seen;
  context.set_progress([&](const Progress& p) { seen.push_back(p.fraction); });
  context.report({.stage = "search", .fraction = 0.25});
  context.report({.stage = "search", .fraction = 0.5});
  EXPECT_EQ(seen, (std::vector<double>{0.25, 0.5}));
}

}  // namespace
}  // namespace linkwright
