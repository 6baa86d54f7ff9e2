// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/loop_gap.h"

#include <gtest/gtest.h>

namespace linkwright::planar {
namespace {

TEST(LoopGap, IsWhatTheTwoLinksLack) {
  EXPECT_EQ(loop_gap(2.5, 1, 2), 0);
  EXPECT_DOUBLE_EQ(loop_gap(3.25, 1, 2), 0.25);  // too far for both
  EXPECT_DOUBLE_EQ(loop_gap(0.75, 1, 2), 0.25);  // too near for their difference
}

TEST(LoopGap, StretchedAndFoldedLinksCloseWithinRounding) {
  EXPECT_EQ(loop_gap(3 * (1 + 1e-15), 1, 2), 0);
  EXPECT_EQ(loop_gap(1 - 1e-15, 1, 2), 0);
  EXPECT_GT(loop_gap(3 * (1 + 1e-9), 1, 2), 0);
}

}  // namespace
}  // namespace linkwright::planar
