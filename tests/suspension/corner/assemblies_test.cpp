// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/assemblies.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {
namespace {

TEST(Assemblies, AHingedCarrierStandsAtAHeightInTwoWays) {
  // The wheel centre goes round the hinge on a circle, which passes each height twice.
  const CornerPlan plan = prepare_suspension(corner_sample("R").suspension);
  const std::vector<Assembly> found = assemblies(plan, Driver::wheel_centre_z, {0, 0});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_LT(norm(found[0].place.carrier.centre - plan.wheel.centre), 1e-9);
  const Vec3 a{0.34, 0.22, -0.055}, b{0.43, 0.57, -0.03};
  const auto off_axis = [&](const Vec3& p) { return norm(cross(p - a, unit(b - a))); };
  EXPECT_NEAR(off_axis(found[1].place.carrier.centre), off_axis(plan.wheel.centre), 1e-9);
  EXPECT_NEAR(found[1].place.carrier.centre.z, plan.wheel.centre.z, 1e-9);
}

TEST(Assemblies, OfAllSamplesFulfilTheEquationsAndBeginWithTheReference) {
  for (const CornerSample& sample : corner_samples()) {
    const CornerPlan plan = prepare_suspension(sample.suspension);
    const std::vector<Assembly> found = assemblies(plan, Driver::wheel_centre_z, {0.02, 0}, 2, 100);
    const CornerPosition followed =
        solve_position(plan, Driver::wheel_centre_z, {0.02, 0}, reference_position(plan));
    ASSERT_FALSE(found.empty()) << sample.name;
    EXPECT_LT(norm(found[0].place.carrier.centre - followed.place.carrier.centre), 1e-9) << sample.name;
    for (const Assembly& a : found) {
      CornerEquations equations;
      evaluate(plan, a.place, 0, Driver::wheel_centre_z, 0.02, equations);
      for (int i = 0; i < plan.unknowns; ++i) EXPECT_NEAR(equations.residual[i], 0, 1e-11) << sample.name;
    }
  }
}

TEST(Assemblies, ASeedDecidesEverything) {
  const CornerPlan plan = prepare_suspension(corner_sample("5US").suspension);
  const auto first = assemblies(plan, Driver::wheel_centre_z, {0, 0}, 7, 60);
  const auto second = assemblies(plan, Driver::wheel_centre_z, {0, 0}, 7, 60);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].place.carrier, second[i].place.carrier);
  EXPECT_THAT(
      [&] {
        assemblies(plan, Driver::wheel_centre_z, {0, 0}, 7, 0);
      },
      ::testing::ThrowsMessage<ContractError>(::testing::HasSubstr("assemblies: 0 starts")));
}

}  // namespace
}  // namespace linkwright::suspension
