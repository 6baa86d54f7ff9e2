// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/dynamics.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "planar/simulations.h"
#include "support/allocations.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using namespace test;

// Published accelerations at the start of Andrews' squeezer, at rest: all its digits.
TEST(LinkageDynamics, StartsAndrewsSqueezerAsPublished) {
  const LinkageSample s = andrews_squeezer_sample();
  const LinkagePlan p = planned(s.linkage);
  LinkageDynamics dynamics(s.linkage, p, {true});
  InputMotion crank{s.from[0], 0, 0};
  ASSERT_EQ(dynamics.solve(0, std::span(&crank, 1)), Status::done);
  // The start angles are given to 30 digits; the small crank magnifies their rounding.
  EXPECT_NEAR(crank.acceleration, 14222.4439199541138705911625887, 1e-11 * 14222);
  solve_acceleration(p, std::span(&crank, 1), dynamics.motion);
  const double relative =
      body_state(p, dynamics.motion, body_index(s.linkage, "K2")).angular_acceleration - crank.acceleration;
  EXPECT_NEAR(relative, -10666.8329399655854029433719415, 1e-11 * 10667);
}

// The drives that solve_forces finds for the accelerations must be nothing at free joints: an independent
// route through joint forces, for every sample with one freedom or more.
TEST(LinkageDynamics, NeedsNoDriveAtFreeJoints) {
  for (const LinkageSample& s : linkage_samples()) {
    SCOPED_TRACE(s.name);
    const LinkagePlan p = planned(s.linkage);
    LinkageDynamics dynamics(s.linkage, p, std::vector<bool>(p.inputs(), true));
    std::vector<InputMotion> inputs = inputs_at(s, 0.3, s.speed);
    const std::vector<InputMotion> from = inputs_at(s, 0, s.speed);
    std::vector<double> a, b;
    for (std::size_t k = 0; k < inputs.size(); ++k) a.push_back(from[k].value), b.push_back(inputs[k].value);
    ASSERT_TRUE(follow(p, a, b, dynamics.motion).arrived);
    ASSERT_EQ(dynamics.solve(0.1, inputs), Status::done);
    solve_acceleration(p, inputs, dynamics.motion);
    LinkageForces forces;
    solve_forces(s.linkage, p, dynamics.motion, 0.1, inputs[0].value, forces);
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      double scale = 0;  // the scale of the largest joint force times the size of the linkage
      for (const JointReaction& j : forces.joints) scale = std::max(scale, norm(j.force));
      EXPECT_NEAR(forces.drives[k], 0, 1e-10 * scale * (p.rotary[k] ? p.size : 1)) << k;
    }
    // Energy: the power of what stays is the rate of kinetic energy less that of weight and springs.
    EXPECT_NEAR(dynamics.power, lasting_power(s.linkage, p, dynamics.motion, forces.loads),
                1e-12 * (1 + std::abs(dynamics.power)));
  }
}

// One input prescribed, one free: the drive's power closes the balance of powers.
TEST(LinkageDynamics, CountsThePowerOfPrescribedDrives) {
  const Linkage l = pendulum(2);
  const LinkagePlan p = planned(l);
  LinkageDynamics dynamics(l, p, {false, true});
  std::vector<InputMotion> inputs{{0.4, 2.0, -3.0}, {1.1, -1.5, 0}};
  ASSERT_EQ(dynamics.solve(0, inputs), Status::done);
  EXPECT_EQ(inputs[0].acceleration, -3.0);
  solve_acceleration(p, inputs, dynamics.motion);
  LinkageForces forces;
  solve_forces(l, p, dynamics.motion, 0, inputs[0].value, forces);
  EXPECT_NEAR(forces.drives[1], 0, 1e-13);
  EXPECT_NEAR(dynamics.power, forces.drives[0] * inputs[0].rate, 1e-13 * std::abs(dynamics.power));
  EXPECT_GT(std::abs(dynamics.power), 1);
}

// By hand: bars of 1 m and 1 kg at angle q, T = I w^2 / 2 with I = 1/3, V = g sin(q) / 2.
TEST(LinkageDynamics, MeasuresEnergies) {
  Linkage l = pendulum(1);
  l.springs.push_back({"s", point_named(l, "bar 1.to"), point_named(l, "ground.base"), 100, 0.8, 0});
  l.torsion_springs.push_back({"t", 0, 1, 5, 0.1, 0});
  const LinkagePlan p = planned(l);
  LinkageMotion motion(p);
  const InputMotion input{0.6, 3, 0};
  solve_motion(p, std::span(&input, 1), motion);
  EXPECT_NEAR(kinetic_energy(p, motion), 0.5 / 3 * 9, 1e-15);
  EXPECT_NEAR(potential_energy(l, p, motion), 9.81 * std::sin(0.6) / 2 + 50 * 0.04 + 2.5 * 0.25, 1e-14);
}

// A block of 2 kg pushed by 10 N over a slide with friction 0.3: a = (10 - 0.3 * 2 g) / 2 while it slides
// forward. Along the slide nothing presses harder, so the iteration ends at once.
TEST(LinkageDynamics, SettlesFriction) {
  Linkage l = slider();
  l.joints[0].friction = 0.3;
  l.forces.push_back({"push", point_named(l, "block.B"), {10, 0}, false, {}});
  const LinkagePlan p = planned(l);
  LinkageDynamics dynamics(l, p, {true});
  InputMotion way{0.2, 1.5, 0};
  ASSERT_EQ(dynamics.solve(0, std::span(&way, 1)), Status::done);
  EXPECT_NEAR(way.acceleration, (10 - 0.3 * 2 * 9.81) / 2, 1e-14);
  EXPECT_NEAR(dynamics.power, (10 - 0.3 * 2 * 9.81) * 1.5, 1e-13);
}

TEST(LinkageDynamics, TellsWhatHasNoMotion) {
  Linkage l = pendulum(1);
  l.bodies[1].mass = BodyMass{0, 0, 0};
  const LinkagePlan p = planned(l);
  LinkageDynamics dynamics(l, p, {true});
  InputMotion input{0.1, 0, 0};
  EXPECT_EQ(dynamics.solve(0, std::span(&input, 1)), Status::singular);
  EXPECT_TRUE(std::isnan(input.acceleration));
  EXPECT_THAT(test::message([&] {
                LinkageDynamics(l, p, {true, false});
              }),
              ::testing::HasSubstr("the linkage has 1 inputs, got 2"));
  l.bodies[1].mass.reset();
  const LinkagePlan without = planned(l);
  EXPECT_THAT(test::message([&] { LinkageDynamics(l, without, {true}); }),
              ::testing::HasSubstr("motion under forces needs the mass of every body: 'bar 1' has none"));
}

TEST(LinkageDynamics, AllocatesNothingAfterTheFirstTime) {
  const LinkageSample s = andrews_squeezer_sample();
  const LinkagePlan p = planned(s.linkage);
  LinkageDynamics dynamics(s.linkage, p, {true});
  InputMotion crank{s.from[0], 1, 0};
  dynamics.solve(0, std::span(&crank, 1));
  const auto before = test::allocations();
  for (int i = 0; i < 100; ++i) crank.value += 0.01, dynamics.solve(0, std::span(&crank, 1));
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace linkwright::planar
