// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/damper_law.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/message.h"

namespace linkwright::suspension {
namespace {

TEST(DamperCurve, PassesThroughItsPointsAndRest) {
  const DamperCurve curve = with_rest({{-0.5, -0.1, 0.1, 0.5}, {-900, -400, 150, 350}});
  ASSERT_EQ(curve.speed, (std::vector<double>{-0.5, -0.1, 0, 0.1, 0.5}));
  ASSERT_EQ(curve.force, (std::vector<double>{-900, -400, 0, 150, 350}));
  EXPECT_EQ(with_rest(curve).speed, curve.speed);
  for (std::size_t i = 0; i < curve.speed.size(); ++i)
    EXPECT_NEAR(force_of(curve, curve.speed[i]).force, curve.force[i], 1e-12);
  double before = -1e9;
  for (double v = -0.7; v <= 0.7; v += 1e-3) {
    const DamperForce at = force_of(curve, v);
    EXPECT_GE(at.force, before);
    before = at.force;
    const double step = 1e-7;
    EXPECT_NEAR(at.damping, (force_of(curve, v + step).force - force_of(curve, v - step).force) / (2 * step),
                0.05);
  }
  // Straight beyond its ends.
  EXPECT_NEAR(force_of(curve, 0.9).force, 350 + 0.4 * 200 / 0.4, 1e-9);
}

TEST(DamperCurve, Problems) {
  EXPECT_EQ(problem(DamperCurve{{-1, 1}, {-1, 1}}), "");
  EXPECT_EQ(problem(DamperCurve{{-1, 1}, {-1}}), "2 speeds and 1 forces");
  EXPECT_EQ(problem(DamperCurve{{-1, 1, 1}, {-1, 1, 2}}), "the speeds do not ascend at point 3");
  EXPECT_EQ(problem(DamperCurve{{0, 1}, {0, 1}}),
            "speeds of extension (< 0) and of compression (> 0) are both needed");
  EXPECT_EQ(problem(DamperCurve{{-1, 1}, {100, 200}}),
            "the force at point 1 has another sign than the speed: it would drive the motion");
  EXPECT_EQ(problem(DamperCurve{{-1, 0, 1}, {-1, 50, 100}}),
            "the force at rest is 50 N, but a damper has none: a gas force is a spring's");
  EXPECT_THAT(test::message([] {
                force_of(DamperCurve{{0}, {0}}, 0);
              }),
              ::testing::StartsWith("force_of: a characteristic needs"));
}

}  // namespace
}  // namespace linkwright::suspension
