// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/random.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright {
namespace {

TEST(RandomStream, IsAPureFunctionOfItsKey) {
  RandomStream a({.seed = 7, .run = 1, .generation = 2, .individual = 3});
  RandomStream b({.seed = 7, .run = 1, .generation = 2, .individual = 3});
  RandomStream c({.seed = 7, .run = 1, .generation = 2, .individual = 4});
  int same = 0;
  for (int i = 0; i < 100; ++i) {
    const std::uint32_t x = a.bits();
    EXPECT_EQ(x, b.bits());
    same += x == c.bits();
  }
  EXPECT_LE(same, 1);
}

// Salmon et al. 2011, known-answer vectors of Philox4x32-10: zero counter and zero key.
TEST(RandomStream, FirstBlockIsTheKnownAnswer) {
  RandomStream zero({.seed = 0});
  EXPECT_EQ(zero.bits(), 0x6627e8d5u);
  EXPECT_EQ(zero.bits(), 0xe169c58du);
  EXPECT_EQ(zero.bits(), 0xbc57ac4cu);
  EXPECT_EQ(zero.bits(), 0x9b00dbd8u);
}

// Means and variances of n draws, within 5 standard errors.
TEST(RandomStream, TransformsHaveTheirMoments) {
  constexpr int n = 200000;
  RandomStream stream({.seed = 42});
  double sum = 0, normal_sum = 0, normal_square = 0;
  int low_thirds = 0;
  for (int i = 0; i < n; ++i) {
    const double u = stream.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    const double z = stream.normal();
    normal_sum += z;
    normal_square += z * z;
    low_thirds += stream.below(3) == 0;
  }
  EXPECT_NEAR(sum / n, 0.5, 5 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(normal_sum / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(normal_square / n, 1, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(low_thirds / double(n), 1.0 / 3, 5 * std::sqrt(2.0 / 9 / n));
  EXPECT_THROW(stream.below(0), ContractError);
}

}  // namespace
}  // namespace linkwright
