// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/drawn_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkwright::study {
namespace {

TEST(DrawnScale, IsRoundAndNoLargerThanWanted) {
  EXPECT_EQ(drawn_scale(0.005, 0.05), 10);
  EXPECT_EQ(drawn_scale(0.0051, 0.05), 5);
  EXPECT_EQ(drawn_scale(0.011, 0.05), 2);
  EXPECT_EQ(drawn_scale(0.03, 0.05), 1);
  EXPECT_EQ(drawn_scale(1e-5, 0.1), 10000);
  EXPECT_EQ(drawn_scale(1e-7, 0.03), 200000);
}

TEST(DrawnScale, IsOneWhereThereIsNothingToEnlarge) {
  EXPECT_EQ(drawn_scale(1, 0.05), 1);
  EXPECT_EQ(drawn_scale(0, 0.05), 1);
  EXPECT_EQ(drawn_scale(-1, 0.05), 1);
  EXPECT_EQ(drawn_scale(NAN, 0.05), 1);
}

}  // namespace
}  // namespace linkwright::study
