// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "linkwright/planar/balancing/four_bar.h"
#include "planar/reactions_cases.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using test::between;
using ::testing::HasSubstr;

// Reference B4: the shaking force is the weight, whatever the linkage weighs before, at any motion.
RC_GTEST_PROP(ForceBalanceProperty, LeavesTheWeightAlone, ()) {
  const FourBar l = *test::any_four_bar();
  const FourBarMasses before = *test::any_masses();
  const double r1 = *between(0.05, 2), r3 = *between(0.05, 2);
  const Counterweights weights = balancing_counterweights(l, before, r1, r3);
  const FourBarMasses after = with_counterweights(before, weights);
  const double mass =
      before.crank.mass + before.coupler.mass + before.rocker.mass + weights.crank.mass + weights.rocker.mass;
  const FourBarRates r = rates(l, *test::any_angle(), *between(-40, 40), *between(-300, 300));
  RC_PRE(r.status == Status::done && std::abs(r.transmission_sine) > 0.1);
  const FourBarReactions f = reactions(l, after, r, 9.81);
  // Rounding of the joint forces that cancel.
  const double tolerance = 1e-12 * (1 + mass + test::largest_force(f));
  RC_ASSERT(std::abs(f.shaking_force - std::complex<double>(0, -9.81 * mass)) < tolerance);
}

TEST(ForceBalance, HoldsToTheLastDigitForTheOriginalMachine) {
  const test::Machine m = test::machine(*test::dynamics_case("fourbar-initial-samples").find("inputs"));
  const Counterweights weights = balancing_counterweights(m.linkage, m.masses, 0.05, 0.1);
  const FourBarMasses after = with_counterweights(m.masses, weights);
  const double mass = after.crank.mass + after.coupler.mass + after.rocker.mass;
  for (int i = 0; i < 24; ++i) {
    const FourBarReactions f = reactions(m.linkage, after, rates(m.linkage, 0.3 * i, 31.4, 100), 9.81);
    EXPECT_NEAR(f.shaking_force.real(), 0, 1e-10);
    EXPECT_NEAR(f.shaking_force.imag(), -9.81 * mass, 1e-10);
  }
  // Mass centre of the coupler half-way: half its mass goes to each end. Crank: 0.648 kg at 0.1 m and 0.36 kg
  // at 0.05 m; rocker: 0.648 kg at 0.32 m and 1.046 kg at 0.16 m.
  EXPECT_NEAR(weights.crank.mass, (0.0648 + 0.018) / 0.05, 1e-12);
  EXPECT_NEAR(weights.rocker.mass, (0.20736 + 0.16736) / 0.1, 1e-12);
  EXPECT_NEAR(std::abs(weights.crank.angle), M_PI, 1e-12);
  EXPECT_EQ(weights.crank.distance, 0.05);
}

TEST(ForceBalance, NeedsNoWeightWhereNothingIsToBeChanged) {
  const PointMass none = counterweight(0, 0.3);
  EXPECT_EQ(none.mass, 0);
  EXPECT_EQ(none.angle, 0);
  const PointMass m = counterweight({0, -0.6}, 0.3);
  EXPECT_NEAR(m.mass, 2, 1e-15);
  EXPECT_NEAR(m.angle, -M_PI / 2, 1e-15);
}

TEST(ForceBalance, RejectsBadRadii) {
  EXPECT_THAT(test::message([] { counterweight(1, 0); }), HasSubstr("radius must be more than 0, got 0"));
  EXPECT_THAT(test::message([] { counterweight({NAN, 0}, 1); }), HasSubstr("must be finite"));
  EXPECT_THAT(test::message([] { force_balance({.coupler = -1}, {}); }),
              HasSubstr("got ground 1, crank 1, coupler -1, rocker 1"));
}

}  // namespace
}  // namespace linkwright::planar
