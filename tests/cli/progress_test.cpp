// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/progress.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkwright::cli {
namespace {

TEST(ProgressLine, StageShareTimesAndBest) {
  EXPECT_EQ(progress_line({"grey_wolf", 0.5, 0.0090288}, {12, 75}, 100),
            "grey_wolf  [#####.....]   50%  0:12, 1:15 left  best 0.0090288  Ctrl-C keeps the best");
  EXPECT_EQ(progress_line({"sweep", 0.999, nan}, {3605.9, nan}, 100), "sweep  [#########.]   99%  1:00:05");
  EXPECT_EQ(progress_line({"x", 7, nan}, {}, 100), "x  [##########]  100%  0:00");
  EXPECT_EQ(progress_line({"x", nan, nan}, {}, 100), "x  [..........]    0%  0:00");
}

TEST(ProgressLine, WhatDoesNotFitGoesTheBarFirst) {
  const Progress progress{"grey_wolf", 0.5, 0.0090288};
  EXPECT_EQ(progress_line(progress, {12, 75}, 79),
            "grey_wolf   50%  0:12, 1:15 left  best 0.0090288  Ctrl-C keeps the best");
  EXPECT_EQ(progress_line(progress, {12, 75}, 60), "grey_wolf   50%  0:12, 1:15 left  best 0.0090288");
  EXPECT_EQ(progress_line(progress, {12, 75}, 16), "grey_wolf   50%");
  EXPECT_EQ(progress_line(progress, {12, 75}, 4), "grey");
}

TEST(TimeLeft, OnceThereIsSomethingToGoBy) {
  EXPECT_DOUBLE_EQ(time_left(0.25, 10), 30);
  EXPECT_DOUBLE_EQ(time_left(1, 10), 0);
  EXPECT_TRUE(std::isnan(time_left(0.25, 0.5)));
  EXPECT_TRUE(std::isnan(time_left(0.001, 100)));
}

}  // namespace
}  // namespace linkwright::cli
