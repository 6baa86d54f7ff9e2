// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/spring_law.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/message.h"

namespace linkwright::suspension {
namespace {

TEST(ForceCurve, PassesThroughItsPointsAndIsMonotone) {
  const ForceCurve curve{{0, 0.01, 0.02, 0.05}, {0, 100, 400, 500}};
  double before = -1;
  for (std::size_t i = 0; i < curve.force.size(); ++i)
    EXPECT_NEAR(force_of(curve, curve.compression[i]).force, curve.force[i], 1e-12);
  for (double x = 0; x <= 0.05; x += 1e-4) {
    const SpringForce at = force_of(curve, x);
    EXPECT_GE(at.force, before);
    before = at.force;
    const double step = 1e-7;
    EXPECT_NEAR(at.stiffness,
                (force_of(curve, x + step).force - force_of(curve, x - step).force) / (2 * step), 0.6);
  }
  // Straight beyond its ends.
  EXPECT_NEAR(force_of(curve, -0.01).force, -100, 1e-9);
  EXPECT_NEAR(force_of(curve, 0.08).force, 600, 1e-9);
}

TEST(ForceCurve, CompressionOfAForce) {
  const ForceCurve curve{{0, 0.01, 0.02, 0.05}, {0, 100, 400, 500}};
  for (const double force : {0.0, 50.0, 100.0, 333.0, 500.0})
    EXPECT_NEAR(force_of(curve, compression_of(curve, force).value()).force, force, 1e-9);
  EXPECT_FALSE(compression_of(curve, 501));
  EXPECT_FALSE(compression_of(curve, -1));
  EXPECT_FALSE(compression_of({{0, 1, 2}, {0, 2, 1}}, 1));
}

TEST(ForceCurve, Problems) {
  EXPECT_EQ(problem(ForceCurve{{0, 1}, {0, 1}}), "");
  EXPECT_EQ(problem(ForceCurve{{0}, {0}}), "a characteristic needs at least two points");
  EXPECT_EQ(problem(ForceCurve{{0, 1}, {0}}), "2 compressions and 1 forces");
  EXPECT_EQ(problem(ForceCurve{{0, 1, 1}, {0, 1, 2}}), "the compressions do not ascend at point 3");
  EXPECT_THAT(test::message([] {
                force_of(ForceCurve{{0}, {0}}, 0);
              }),
              ::testing::StartsWith("force_of: a characteristic needs"));
}

TEST(SpringLaw, LinearAndByPoints) {
  const SpringForce linear = force_of(SpringLaw{35e3, 900}, 0.01);
  EXPECT_NEAR(linear.force, 1250, 1e-12);
  EXPECT_EQ(linear.stiffness, 35e3);
  const SpringLaw law{.curve = ForceCurve{{0, 1}, {0, 35e3}}, .start = 0.02};
  EXPECT_NEAR(force_of(law, 0.01).force, 1050, 1e-9);
  EXPECT_NEAR(force_of(law, 0.01).stiffness, 35e3, 1e-9);
}

TEST(StopLaw, EngagesAfterItsClearanceAndBottoms) {
  const StopLaw stop{.clearance = 0.02, .stiffness = 1e5, .solid_at = 0.03};
  EXPECT_EQ(force_of(stop, 0.02).force, 0);
  EXPECT_EQ(force_of(stop, 0.019).stiffness, 0);
  EXPECT_NEAR(force_of(stop, 0.025).force, 500, 1e-9);
  EXPECT_EQ(force_of(stop, 0.025).stiffness, 1e5);
  EXPECT_FALSE(bottoms(stop, 0.049));
  EXPECT_TRUE(bottoms(stop, 0.051));
  EXPECT_FALSE(bottoms(StopLaw{.clearance = 0.02, .stiffness = 1e5}, 1));
}

}  // namespace
}  // namespace linkwright::suspension
