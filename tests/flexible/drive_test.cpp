// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/flexible/simulation.h"
#include "support/message.h"

namespace linkwright::flexible {
namespace {

TEST(Drive, SpinUpIsItsOwnDerivative) {
  const SpinUp law{-4, 15};
  const double h = 1e-3;
  for (const double t : {0.5, 3.0, 7.5, 14.0, 17.0}) {
    EXPECT_NEAR((law(t + h).angle - law(t - h).angle) / (2 * h), law(t).rate, 1e-7);
    EXPECT_NEAR((law(t + h).rate - law(t - h).rate) / (2 * h), law(t).acceleration, 1e-7);
  }
  EXPECT_EQ(law(0).angle, 0);
  EXPECT_EQ(law(-1).rate, 0);
  // Continuous at T, then steady: theta = omega_0 (t - T / 2).
  EXPECT_NEAR(law(15 - 1e-9).angle, law(15).angle, 1e-7);
  EXPECT_NEAR(law(15 - 1e-9).rate, -4, 1e-9);
  EXPECT_EQ(law(20).angle, -50);
  EXPECT_EQ(law(20).acceleration, 0);
  EXPECT_NEAR(law(7.5).acceleration, -8.0 / 15, 1e-15);
}

TEST(Drive, SinePulse) {
  const SinePulse law{3, 2};
  EXPECT_DOUBLE_EQ(law(0.5), 3);
  EXPECT_DOUBLE_EQ(law(1.5), -3);
  EXPECT_EQ(law(2.5), 0);
  EXPECT_EQ(law(-0.5), 0);
  EXPECT_NE(test::message([] { SinePulse{1, 0}(0); }).find("a pulse of 0 s"), std::string::npos);
  EXPECT_NE(test::message([] { SpinUp{1, 0}(0); }).find("a spin-up of 0 s"), std::string::npos);
}

TEST(Drive, TorqueTableIsStraightBetweenRows) {
  const TorqueTable law{{0.5, 1, 2}, {2, 4, -4}};
  EXPECT_EQ(law(0.499), 0);
  EXPECT_EQ(law(0.5), 2);
  EXPECT_DOUBLE_EQ(law(0.75), 3);
  EXPECT_DOUBLE_EQ(law(1.5), 0);
  EXPECT_EQ(law(2), -4);
  EXPECT_EQ(law(2.001), 0);
  EXPECT_NE(test::message([] { TorqueTable{{0, 1}, {1}}(0); }).find("2 times, 1 torques"), std::string::npos);
}

}  // namespace
}  // namespace linkwright::flexible
