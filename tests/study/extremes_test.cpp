// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/extremes.h"

#include <gtest/gtest.h>

#include <vector>

namespace linkwright::study {
namespace {

TEST(Extremes, TheFirstOfEqualOnesCounts) {
  Extreme greatest, least, large;
  std::size_t row = 0;
  for (const double v : {1.0, -3.0, 2.0, 3.0, -3.0, 3.0}) {
    greatest.greatest(v, row);
    least.least(v, row);
    large.largest(v, row++);
  }
  EXPECT_EQ(greatest.value, 3);
  EXPECT_EQ(greatest.row, 3u);
  EXPECT_EQ(least.value, -3);
  EXPECT_EQ(least.row, 1u);
  EXPECT_EQ(large.value, -3);
  EXPECT_EQ(large.row, 1u);
}

TEST(Extremes, TheFirstOfThoseThatTieByRoundingCounts) {
  // A chain of roundings does not carry the row along.
  Extreme greatest, least, large;
  const double unit = 2.220446049250313e-16;
  for (std::size_t row = 0; row < 10; ++row) {
    greatest.greatest(1 + static_cast<double>(row) * unit, row);
    least.least(-1 - static_cast<double>(row) * unit, row);
    large.largest((row % 2 == 0 ? 1 : -1) * (1 + static_cast<double>(row) * unit), row);
  }
  EXPECT_EQ(greatest.row, 0u);
  EXPECT_EQ(greatest.value, 1 + 9 * unit);
  EXPECT_EQ(least.row, 0u);
  EXPECT_EQ(large.row, 0u);
  EXPECT_GT(large.value, 0);
  EXPECT_TRUE(greatest.greatest(1 + 1e-9, 10));
  EXPECT_EQ(greatest.row, 10u);
}

TEST(Extremes, SayWhetherAValueIsTheExtremeOneSoFar) {
  Extreme out;
  EXPECT_FALSE(out.greatest(nan, 0));
  EXPECT_FALSE(out.any());
  EXPECT_TRUE(out.greatest(-1, 1));
  EXPECT_FALSE(out.greatest(-1, 2));
  EXPECT_FALSE(out.greatest(nan, 3));
  EXPECT_TRUE(out.greatest(0, 4));
  EXPECT_TRUE(out.any());
  EXPECT_EQ(out.row, 4u);
}

TEST(Extremes, RowsWithoutAFiniteValueArePassedOver) {
  const std::vector<double> values{nan, infinity, -3, 2, -infinity};
  EXPECT_EQ(largest(values).value, -3);
  EXPECT_EQ(largest(values).row, 2u);
  EXPECT_EQ(largest_size(values), 3);
  EXPECT_FALSE(largest(std::vector{nan, infinity}).any());
  EXPECT_EQ(largest_size({}), 0);
}

}  // namespace
}  // namespace linkwright::study
