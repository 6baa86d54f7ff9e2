// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/crank_turns.h"

#include <gtest/gtest.h>

namespace linkwright::planar {
namespace {

TEST(CrankTurns, StepsGoForwardInEitherSense) {
  EXPECT_NEAR(forward_step(1, 0.2, 0.5), 0.3, 1e-15);
  EXPECT_NEAR(forward_step(-1, 0.2, 0.5), 2 * pi - 0.3, 1e-15);
  EXPECT_NEAR(turned_in_all({0, 1, 0.5}, 1), 2 * pi + 0.5, 1e-14);
  EXPECT_NEAR(turned_in_all({0, 1, 0.5}, -1), 2 * pi - 0.5, 1e-14);
}

TEST(CrankTurns, TheOrderKeepsTheFirstBeforeTheLast) {
  EXPECT_EQ(order_of_turning({0, 2, 1, 3}, 0), (std::vector<int>{0, 2, 1, 3}));
  EXPECT_EQ(order_of_turning({3, 2, 0.5, 0.1}, 0), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(order_of_turning({0.1, 5, 1}, 4), (std::vector<int>{1, 0, 2}));
}

}  // namespace
}  // namespace linkwright::planar
