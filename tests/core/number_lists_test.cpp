// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/number_lists.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"

namespace linkwright {
namespace {

TEST(NumberLists, LongListsStandApart) {
  std::vector<double> numbers{1};
  const NumberLists lists(numbers);
  EXPECT_TRUE(lists.apart());
  const std::vector<double> few{1.5, 2.5}, many{1, 2, 3, 4, 5, 6, 7, nan};
  EXPECT_EQ(lists(few), Value(few));
  const Value place = lists(many);
  ASSERT_NE(place.find(""), nullptr);
  EXPECT_EQ(*place.find(""), Value(Value::Array{Value(1), Value(8)}));
  ASSERT_EQ(numbers.size(), 9u);
  EXPECT_EQ(numbers[7], 7);
  EXPECT_TRUE(std::isnan(numbers[8]));
}

TEST(NumberLists, OtherwiseTheyAreInTheDocument) {
  const NumberLists lists;
  EXPECT_FALSE(lists.apart());
  const std::vector<double> many(20, 0.5);
  EXPECT_EQ(lists(many), Value(many));
}

}  // namespace
}  // namespace linkwright
