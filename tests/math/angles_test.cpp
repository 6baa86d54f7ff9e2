// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"

namespace linkwright::math {
namespace {

TEST(Angles, WrapIsHalfOpenAtMinusPi) {
  EXPECT_EQ(wrap_angle(pi), pi);
  EXPECT_EQ(wrap_angle(-pi), pi);
  EXPECT_EQ(wrap_angle(3 * pi), pi);
  EXPECT_EQ(wrap_angle(-3 * pi), pi);
  EXPECT_EQ(wrap_angle(0), 0);
  EXPECT_EQ(wrap_angle(2 * pi), 0);
  EXPECT_LT(wrap_angle(std::nextafter(pi, 4)), 0);
  EXPECT_TRUE(std::isnan(wrap_angle(nan)));
}

TEST(Angles, WrapAgreesWithTheExactRemainderAndIsIdempotent) {
  RandomStream random({.seed = 1});
  for (int i = 0; i < 10000; ++i) {
    const double angle = random.uniform(-30, 30);
    const double wrapped = wrap_angle(angle);
    EXPECT_GT(wrapped, -pi);
    EXPECT_LE(wrapped, pi);
    EXPECT_EQ(wrapped, std::remainder(angle, 2 * pi)) << angle;
    EXPECT_EQ(wrap_angle(wrapped), wrapped);
  }
}

TEST(Angles, IntoARangeByWholeTurns) {
  EXPECT_NEAR(into_range(-0.5, 0, 2 * pi), 2 * pi - 0.5, 1e-15);
  EXPECT_NEAR(into_range(7.5, 1, 2), 7.5 - 2 * pi, 1e-15);
  EXPECT_EQ(into_range(3.0, 1, 2), 3.0);
}

TEST(Angles, DifferenceTakesTheShortWay) {
  EXPECT_NEAR(angle_difference(radians(-170), radians(170)), radians(20), 1e-15);
  EXPECT_NEAR(angle_difference(radians(170), radians(-170)), radians(-20), 1e-15);
  EXPECT_EQ(angle_difference(0, pi), pi);  // -pi is written pi
}

TEST(Angles, UnwrapRecoversALongRotation) {
  for (const double step : {3.1, -3.1, 0.7}) {
    std::vector<double> truth, angles;
    for (int i = 0; i < 10000; ++i) {
      truth.push_back(0.3 + step * i);
      angles.push_back(wrap_angle(truth.back()));
    }
    unwrap_angles(angles);
    // Roundings of numbers up to 31000, half a unit in the last place of 2e-12 each; three of them.
    for (std::size_t i = 0; i < truth.size(); ++i) ASSERT_NEAR(angles[i], truth[i], 1.2e-11) << i;
  }
}

TEST(Angles, UnwrapPassesOverMissingAngles) {
  const double missing = nan;
  std::vector<double> angles = {missing, 2, missing, 3.1, -3.1, missing, -2};
  unwrap_angles(angles);
  EXPECT_TRUE(std::isnan(angles[0]) && std::isnan(angles[2]) && std::isnan(angles[5]));
  EXPECT_EQ(angles[1], 2);
  EXPECT_EQ(angles[3], 3.1);
  EXPECT_EQ(angles[4], -3.1 + 2 * pi);
  EXPECT_EQ(angles[6], -2 + 2 * pi);
}

TEST(Angles, UnwrapOfNothingIsNothing) {
  std::vector<double> none;
  unwrap_angles(none);
  std::vector<double> two = {pi, -3};
  unwrap_angles(two);
  EXPECT_EQ(two[0], pi);
  EXPECT_NEAR(two[1], 2 * pi - 3, 1e-15);
}

TEST(Angles, DegreesAndBack) {
  EXPECT_EQ(degrees(pi), 180);
  EXPECT_EQ(radians(180), pi);
}

}  // namespace
}  // namespace linkwright::math
