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
