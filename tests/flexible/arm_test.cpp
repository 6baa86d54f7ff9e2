// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/arm.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/flexible/modes.h"
#include "linkwright/flexible/samples.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/flexible/statics.h"
#include "support/message.h"

namespace linkwright::flexible {
namespace {

Beam inner_half() {
  Beam beam = torque_beam();
  beam.length /= 2;
  beam.tip_mass = 0;
  return beam;
}
Beam outer_half() {
  Beam beam = torque_beam();
  beam.length /= 2;
  beam.hub_radius = beam.hub_inertia = 0;
  return beam;
}

TEST(Arm, KnowsTheNodesOfItsLinks) {
  const ArmLink links[] = {{inner_half(), 2, {}}, {outer_half(), 1, Hinge{}}, {outer_half(), 3, {}}};
  const ArmChain arm = arm_chain(links);
  ASSERT_EQ(arm.links.size(), 3u);
  EXPECT_EQ(arm.chain.cells.size(), 4u + 1 + 2 + 6);
  EXPECT_EQ(arm.links[0].tip, 4u);
  EXPECT_EQ(arm.links[1].hinge, 4u);
  EXPECT_EQ(arm.links[1].root, 5u);
  EXPECT_EQ(arm.links[1].tip, 7u);
  EXPECT_FALSE(arm.links[2].hinge);
  EXPECT_EQ(arm.links[2].root, 7u);
  EXPECT_EQ(arm.links[2].tip, 13u);
  EXPECT_NE(test::message([] { arm_chain({}); }).find("an arm without links"), std::string::npos);
  const ArmLink hinged[] = {{inner_half(), 2, Hinge{}}};
  EXPECT_NE(test::message([&] { arm_chain(hinged); }).find("a hinge at the first link"), std::string::npos);
}

TEST(Arm, CutsOfWeldedPartsAreThoseOfTheWhole) {
  // Under its weight a level beam has M = -w x^2 / 2 - m_p g x at the distance x from the tip. Stiff, so that
  // it stays level.
  Beam inner = inner_half(), outer = outer_half();
  inner.gravity = 9.81;
  inner.elastic_modulus *= 1e6;
  outer.elastic_modulus *= 1e6;
  const ArmLink links[] = {{inner, 2, {}}, {outer, 2, {}}};
  const ArmChain arm = arm_chain(links);
  const Equilibrium rest = equilibrium(arm.chain, {});
  ASSERT_EQ(rest.status, Status::done);
  ChainEquations equations(arm.chain);
  equations.evaluate(rest.state);
  const double weight = 9.81 * outer.mass() / 0.9, mass = 9.81 * outer.tip_mass;
  for (std::size_t link : {0u, 1u}) {
    const auto cuts = link_sections(arm, link, equations, rest.state);
    ASSERT_EQ(cuts.size(), 6u);
    EXPECT_EQ(cuts.front().position, 0);
    EXPECT_NEAR(cuts.back().position, 0.9, 1e-12);
    // At its ends; in between, the masses at the nodes stand for the weight.
    for (const SectionForce& cut : {cuts.front(), cuts.back()}) {
      const double x = 1.8 - 0.9 * double(link) - cut.position;
      EXPECT_NEAR(cut.moment, -weight * x * x / 2 - mass * x, 1e-6) << link << " " << cut.position;
    }
  }
  const auto outer_cuts = link_sections(arm, 1, equations, rest.state);
  // The mass at the end of the inner link, in line with the weld, is the inner link's.
  EXPECT_NEAR(outer_cuts.back().shear, -mass - 9.81 * outer.mass() / 12, 1e-6);
  EXPECT_NEAR(link_sections(arm, 0, equations, rest.state).front().shear, -mass - 1.8 * weight, 1e-6);
}

TEST(Arm, StiffSpringInAHingeIsAWeld) {
  const ArmLink welded[] = {{inner_half(), 2, {}}, {outer_half(), 2, {}}};
  const ArmLink hinged[] = {{inner_half(), 2, {}}, {outer_half(), 2, Hinge{.stiffness = 1e7}}};
  const ArmChain a = arm_chain(welded), b = arm_chain(hinged);
  const SinePulse pulse{1, 0.5};
  const SimulationOptions options{
      .end = 0.4, .output_interval = 0.1, .step = 1e-3, .extrapolate = true, .keep_states = true};
  const Simulation one = simulate_torque(a.chain, pulse, options),
                   two = simulate_torque(b.chain, pulse, options);
  ASSERT_EQ(two.status, Status::done) << two.message;
  ChainEquations of_one(a.chain), of_two(b.chain);
  for (std::size_t i = 1; i < one.states.size(); ++i) {
    // The spring gives by M / k = 1e-7 rad; the rest is the error of both integrations.
    EXPECT_NEAR(two.samples[i].tip_eta, one.samples[i].tip_eta, 2e-6);
    EXPECT_NEAR(two.samples[i].angle, one.samples[i].angle, 2e-6);
    of_one.evaluate(one.states[i]);
    of_two.evaluate(two.states[i]);
    const SectionForce weld = link_sections(a, 1, of_one, one.states[i]).front(),
                       root = link_sections(b, 1, of_two, two.states[i]).front();
    EXPECT_NEAR(root.moment, weld.moment, 1e-3);
    const math::Vec2 force = hinge_forces(b, of_two, two.states[i]).at(0);
    EXPECT_NEAR(std::hypot(force.x, force.y), std::hypot(root.axial, root.shear), 0.3);
  }
}

TEST(Arm, VibratesAboutTurnedHinges) {
  // Stiff links of 0.6 m and 0.4 m; J2 of the outer one about the hinge.
  const Beam inner{.length = 0.6,
                   .density = 2700,
                   .area = 1e-3,
                   .second_moment = 1e-7,
                   .elastic_modulus = 2e17,
                   .hub_inertia = 0.02,
                   .theory = Theory::euler_bernoulli,
                   .hub_stiffness = 50};
  Beam outer = inner;
  outer.length = 0.4;
  outer.hub_inertia = outer.hub_stiffness = 0;
  const double mass = 2700 * 1e-3 * 0.4, second = mass * 0.16 / 3;
  const ArmLink links[] = {{inner, 1, {}}, {outer, 1, Hinge{.stiffness = 30}}};
  const ArmChain arm = arm_chain(links);
  for (const double angle : {0.0, 1.0, -2.0}) {
    const double turns[] = {angle};
    EXPECT_NEAR(modes(arm.chain, 1, {.turns = turns})[0].frequency, std::sqrt(30 / second), 1e-5);
    // The hinge held, both turn about O on the spring of the hub.
    const std::size_t locked[] = {0};
    const double whole =
        0.02 + 2700 * 1e-3 * 0.216 / 3 + second + mass * 0.36 + 2 * mass * 0.6 * 0.2 * std::cos(angle);
    EXPECT_NEAR(modes(arm.chain, 1, {.hub = Hub::free, .turns = turns, .locked = locked})[0].frequency,
                std::sqrt(50 / whole), 1e-5);
  }
  // Nothing of the locked hinge is counted.
  const std::size_t locked[] = {0};
  EXPECT_EQ(mode_count(arm.chain, {.locked = locked}), mode_count(arm.chain) - 1);
  const double bent_by[] = {1.0};
  EXPECT_NE(test::message([&] {
              modes(arm.chain, 1, {.speed = 2, .turns = bent_by});
            }).find("bent hinges on a hub that turns at 2 rad/s"),
            std::string::npos);
}

TEST(Arm, HangsAtRestWithItsHingesHeld) {
  Beam inner = inner_half();
  inner.gravity = 9.81;
  const ArmLink links[] = {{inner, 2, {}}, {outer_half(), 2, Hinge{}}};
  const ArmChain arm = arm_chain(links);
  const double turns[] = {-1.2};
  const Equilibrium rest = equilibrium(arm.chain, {}, {.angle = 0.3, .turns = turns});
  ASSERT_EQ(rest.status, Status::done);
  EXPECT_EQ(rest.state.q[coordinates_per_cell * *arm.links[1].hinge + turn], -1.2);
  // Held as it is, the arm stays: nothing moves but by rounding.
  const auto hub = [](double) { return HubMotion{.angle = 0.3}; };
  const auto held = [](double) { return HubMotion{.angle = -1.2}; };
  const HingeDrive motor[] = {{.hinge = 0, .motion = AngleLaw(held)}};
  const Simulation run = simulate_motion(
      arm.chain, hub,
      {.end = 0.2, .output_interval = 0.1, .step = 0.01, .hinges = motor, .keep_states = true},
      {.angle = 0.3, .q = rest.state.q});
  ASSERT_EQ(run.status, Status::done);
  for (std::size_t i = 0; i < rest.state.q.size(); ++i)
    EXPECT_NEAR(run.states.back().q[i], rest.state.q[i], 1e-9);
  // And it hangs below the rigid arm.
  EXPECT_LT(tip_displacement(arm.chain, rest.state.q).across, -0.01);
  const auto straight = bent(arm.chain, rest.state.q, 0);
  EXPECT_NEAR(shape(arm.chain, straight).node.back().x, 0.05 + 0.9 + 0.9 * std::cos(1.2), 1e-12);
}

}  // namespace
}  // namespace linkwright::flexible
