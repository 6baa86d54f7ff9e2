// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/step_pace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace linkwright::clearance {
namespace {

TEST(StepPace, SeesEarlyThatTheEndIsOutOfReach) {
  // 1e-9 s a step over 1 s are 1e9 steps; 1e7 are allowed, and 20 times as many are not hopeless.
  StepPace hopeless(2, 3, 10'000'000);
  double t = 2;
  int steps = 0;
  while (hopeless.step(t += 1e-9)) ASSERT_LT(++steps, 20'000);
  EXPECT_EQ(steps, 19'999);
  EXPECT_NEAR(hopeless.expected(), 1e9, 1e3);
  EXPECT_EQ(
      hopeless.message(t),
      "ended at 2.00002 s after 20000 steps: at this pace 3 s would take about 1e+09 steps, and max_steps "
      "allows 10000000; a shorter time, a larger clearance, a softer contact or a coarser rtol needs "
      "fewer");
}

TEST(StepPace, LetsASlowStartPass) {
  StepPace pace(0, 1, 1'000'000);
  // 1e7 steps at the pace of the start are ten times those that are allowed.
  for (int i = 1; i <= 40'000; ++i) ASSERT_TRUE(pace.step(1e-7 * i));
  EXPECT_NEAR(pace.expected(), 1e7, 1e2);
  for (int i = 1; i <= 40'000; ++i) ASSERT_TRUE(pace.step(0.004 + 1e-5 * i));
  EXPECT_LT(pace.expected(), 3e5);
}

}  // namespace
}  // namespace linkwright::clearance
