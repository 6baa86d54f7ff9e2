// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/link_mass.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

constexpr double half_turn = pi;

TEST(LinkMass, BaseParametersOfARodWithCounterweight) {
  // Rod 3 kg, 2 m; 4 kg behind the joint, once as negative distance and once as half a turn.
  const LinkMass rod{3, 1, 1, 0};
  for (const PointMass& behind : {PointMass{4, -0.5, 0}, PointMass{4, 0.5, half_turn}}) {
    const std::vector<PointMass> attached = {behind, {2, 0.25, half_turn / 2}};
    const BaseParameters b = base_parameters(rod, attached);
    EXPECT_EQ(b.mass, 9);
    EXPECT_NEAR(b.moment.real(), 3 - 2, 1e-15);
    EXPECT_NEAR(b.moment.imag(), 0.5, 1e-15);
    EXPECT_NEAR(b.inertia, 1 + 3 + 1 + 0.125, 1e-15);
  }
}

TEST(LinkMass, WithAttachedMassesHasTheSameBaseParameters) {
  const LinkMass rod{3, 1, 1, 0.4};
  const std::vector<PointMass> attached = {{4, -0.5, 0}, {2, 0.25, 2}};
  const BaseParameters parts = base_parameters(rod, attached),
                       one = base_parameters(with_attached(rod, attached));
  EXPECT_EQ(one.mass, 9);
  EXPECT_NEAR(std::abs(one.moment - parts.moment), 0, 1e-15);
  EXPECT_NEAR(one.inertia, parts.inertia, 1e-15);
  const LinkMass nothing = with_attached({0, 0.5, 0.25, 1}, {});
  EXPECT_EQ(nothing.inertia, 0.5);
  EXPECT_EQ(nothing.centre_distance, 0.25);
}

TEST(LinkMass, RejectsWhatIsNoMass) {
  EXPECT_THAT(test::message([] { base_parameters({.mass = 1, .inertia = -2}); }),
              HasSubstr("mass 1, inertia -2 and centre distance 0 must be finite and not negative"));
  EXPECT_THAT(test::message([] { base_parameters({.mass = 1, .centre_angle = NAN}); }),
              HasSubstr("centre angle nan must be finite"));
  const std::vector<PointMass> attached = {{-1, 2, 0}};
  EXPECT_THAT(test::message([&] { base_parameters({}, attached); }),
              HasSubstr("attached mass -1 at distance 2 and angle 0"));
}

}  // namespace
}  // namespace linkwright::planar
