// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/finite.h"

#include <gtest/gtest.h>

#include <array>

#include "linkwright/core/numbers.h"

namespace linkwright {
namespace {

TEST(AllFinite, RefusesInfinityAndNaNWhereverTheyStand) {
  EXPECT_TRUE(all_finite({}));
  EXPECT_TRUE(all_finite(std::array{0.0, -1e308, 5e-324}));
  EXPECT_FALSE(all_finite(std::array{0.0, infinity}));
  EXPECT_FALSE(all_finite(std::array{-infinity, 0.0}));
  EXPECT_FALSE(all_finite(std::array{0.0, nan, 1.0}));
}

}  // namespace
}  // namespace linkwright
