// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/wide_number.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkwright::planar {
namespace {

using WideComplex = math::Complex<WideNumber>;
using WideBall = math::Ball<WideNumber>;

// (1/3 + i/7) (3 - i/5) = 36/35 + 38/105 i: both sides are rounded, and the ball of their difference holds
// zero.
TEST(WideNumber, BallsHoldWhatRoundingDoesInTheSixtyFourthDigit) {
  const WideNumber one = 1;
  const WideBall product = WideBall(WideComplex(one / 3, one / 7)) * WideBall(WideComplex(3 * one, -one / 5));
  const WideBall known(WideComplex(36 * one / 35, 38 * one / 105));
  const WideBall difference = product - known;
  EXPECT_LE(std::abs(static_cast<double>(difference.middle.re)) +
                std::abs(static_cast<double>(difference.middle.im)),
            difference.radius);
  EXPECT_LT(difference.size(), 1e-61);
  EXPECT_GT(difference.radius, 1e-65);
}

TEST(WideNumber, TakesEveryDoubleAsItIs) {
  for (const double value : {0.1, -3.0e-300, 7.0e300})
    EXPECT_EQ(static_cast<double>(WideNumber(value)), value);
}

}  // namespace
}  // namespace linkwright::planar
