// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/statics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flexible/beams.h"
#include "linkwright/core/numbers.h"
#include "linkwright/flexible/continuum.h"
#include "support/message.h"

namespace linkwright::flexible {
namespace {

using enum Kinematics;

TEST(Statics, TipDeflectionIsExactForEveryChain) {
  struct {
    const char* id;
    Beam beam;
  } cases[] = {{"static-T31", spin_up_beam()}, {"static-T32", torque_beam()}};
  for (auto& c : cases)
    for (const Theory theory : {Theory::timoshenko, Theory::euler_bernoulli})
      for (const int n : {1, 2, 3, 8, 50})
        for (const Kinematics kinematics : {chord_consistent, hub_axis, source_linearised}) {
          c.beam.theory = theory;
          const double expected = test::number_at(computed(c.id), theory == Theory::timoshenko
                                                                      ? "tip_deflection_timoshenko_m"
                                                                      : "tip_deflection_euler_bernoulli_m");
          EXPECT_NEAR(tip_deflection(c.beam, 1), expected, 1e-12);
          const Deflection found = linear_deflection(discretise(c.beam, n, kinematics), {.force = {0, 1}});
          EXPECT_NEAR(found.eta.back(), expected, 1e-12) << c.id << " n=" << n;
        }
}

TEST(Statics, InnerNodesLieOnTheBeamsLine) {
  const Beam beam = stub();
  const double force = 3e3, couple = -2e3, bending = beam.bending_stiffness();
  const Deflection found = linear_deflection(discretise(beam, 3), {.force = {0, force}, .couple = couple});
  for (int j = 0; j <= 6; ++j) {
    const double x = j / 6.0;
    EXPECT_NEAR(found.eta[j],
                force * (x * x / 2 - x * x * x / 6) / bending + force * x / beam.shear_stiffness() +
                    couple * x * x / 2 / bending,
                1e-15);
    EXPECT_NEAR(found.angle[j], (force * (x - x * x / 2) + couple * x) / bending, 1e-15);
  }
}

TEST(Statics, LargeDeflectionsOfThePublishedChains) {
  Beam beam = spin_up_beam();
  for (const int load : {1, 2, 5, 10})
    for (const auto& [key, kinematics, n] :
         {std::tuple{"CC_n2", chord_consistent, 2}, std::tuple{"CC_n4", chord_consistent, 4},
          std::tuple{"HX_n2", hub_axis, 2}, std::tuple{"HX_n4", hub_axis, 4}}) {
      const Chain chain = discretise(beam, n, kinematics);
      const Equilibrium found = equilibrium(chain, {.force = {0, load * beam.bending_stiffness() / 64}});
      ASSERT_EQ(found.status, Status::done);
      EXPECT_EQ(found.share, 1);
      EXPECT_EQ(found.unstable, 0);
      const ChainShape line = shape(chain, found.state.q);
      const auto expected = figures("static-elastica", "PL2_EI_" + std::to_string(load) + "." + key);
      EXPECT_NEAR(line.angle.back(), expected[0], 1e-8) << key << " " << load;
      EXPECT_NEAR(1 - line.node.back().x / 8, expected[1], 1e-8) << key << " " << load;
      EXPECT_NEAR(line.node.back().y / 8, expected[2], 1e-8) << key << " " << load;
      // The hub holds against the load, and its moment is that of the load about the weld.
      EXPECT_NEAR(found.forces.reaction.y, -load * beam.bending_stiffness() / 64, 1e-9);
      EXPECT_NEAR(found.forces.moment, -load * beam.bending_stiffness() / 64 * line.node.back().x, 1e-8);
    }
}

TEST(Statics, ConvergesToTheElastica) {
  const Beam beam = spin_up_beam();
  for (const int load : {1, 10}) {
    const auto expected = figures("static-elastica", "PL2_EI_" + std::to_string(load) + ".elastica");
    double last = 1;
    for (const int n : {4, 8, 16}) {
      const Chain chain = discretise(beam, n);
      const Equilibrium found = equilibrium(chain, {.force = {0, load * beam.bending_stiffness() / 64}});
      const double error = std::abs(shape(chain, found.state.q).node.back().y / 8 - expected[2]);
      EXPECT_LT(error, last / 12);  // fourth order: 16 times
      last = error;
    }
    EXPECT_LT(last, 3e-7);
  }
}

TEST(Statics, ACoupleBendsToACircle) {
  const Beam beam = torque_beam();
  const Chain chain = discretise(beam, 8);
  const double couple = beam.bending_stiffness() / beam.length * pi;
  const Equilibrium found = equilibrium(chain, {.couple = couple});
  ASSERT_EQ(found.status, Status::done);
  const ChainShape line = shape(chain, found.state.q);
  EXPECT_NEAR(line.angle.back(), pi, 1e-9);
  // Half a circle of radius L / pi; 16 cells of 0.2 rad are off it by 0.2^4 / 720 or so of their length.
  EXPECT_NEAR(line.node.back().y, 2 * beam.length / pi, 2e-5);
  EXPECT_NEAR(line.node.back().x, 0.05, 1e-5);
}

TEST(Statics, BucklingUnderADeadPush) {
  // Euler's load pi^2 E I / (4 L^2): stable below, not above.
  const Beam beam = spin_up_beam();
  const double euler = pi * pi * beam.bending_stiffness() / (4 * 64);
  const Chain chain = discretise(beam, 8);
  EXPECT_EQ(equilibrium(chain, {.force = {-0.999 * euler, 0}}).unstable, 0);
  EXPECT_EQ(equilibrium(chain, {.force = {-1.001 * euler, 0}}).unstable, 1);
}

TEST(Statics, StretchOfALinkThatTurns) {
  // rho A w^2 L^3 / (3 E A) of a uniform bar, but for what the stretch itself adds (order w^2 rho L^2 / E).
  const Beam beam = kane_beam();
  const Chain chain = discretise(beam, 16);
  const Equilibrium found = equilibrium(chain, {}, {.speed = 6});
  const double expected = 1.2 * 36 * 1000 / (3 * 2.8e7);
  EXPECT_NEAR(expected, 5.14e-4, 5e-7);  // published
  EXPECT_NEAR(shape(chain, found.state.q).node.back().x - 10, expected, 1e-3 * expected);
}

TEST(Statics, HangsUnderGravity) {
  Beam beam = torque_beam();
  beam.gravity = 9.81;
  const Chain chain = discretise(beam, 4);
  const Equilibrium found = equilibrium(chain, {}, {.angle = -pi / 2});
  ASSERT_EQ(found.status, Status::done);
  const double weight = (beam.mass() + beam.tip_mass) * 9.81;
  EXPECT_NEAR(found.forces.reaction.x, -weight, 1e-9);  // pulls the link back along xi
  EXPECT_NEAR(found.forces.reaction.y, 0, 1e-9);
  const Equilibrium level = equilibrium(chain, {});
  EXPECT_NEAR(level.forces.reaction.y, weight, 1e-9);
  EXPECT_LT(shape(chain, level.state.q).node.back().y, -0.5);
}

TEST(Statics, KeepsTheGoodPartWhereNewtonGivesUp) {
  const Beam beam = spin_up_beam();
  const Chain chain = discretise(beam, 1);
  const Equilibrium found = equilibrium(chain, {.force = {0, 1e5}});
  EXPECT_NE(found.status, Status::done);
  EXPECT_GT(found.share, 0);
  EXPECT_LT(found.share, 1);
  EXPECT_NE(test::message([&] {
              equilibrium(discretise(beam, 1, source_linearised), {});
            }).find("no equilibrium of large deflections"),
            std::string::npos);
}

}  // namespace
}  // namespace linkwright::flexible
