// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/unfilled_array.h"

#include <gtest/gtest.h>

namespace linkwright {
namespace {

TEST(UnfilledArray, KeepsItsMemoryWhileItIsLargeEnough) {
  UnfilledArray<double> numbers;
  EXPECT_EQ(nullptr, numbers.data());
  double* const first = numbers.make_room(4);
  first[0] = 1.5;
  EXPECT_EQ(first, numbers.make_room(3));
  EXPECT_EQ(first, numbers.make_room(4));
  EXPECT_EQ(1.5, numbers.data()[0]);
  numbers.make_room(1000)[999] = 2.5;
  EXPECT_EQ(2.5, numbers.data()[999]);
}

}  // namespace
}  // namespace linkwright
