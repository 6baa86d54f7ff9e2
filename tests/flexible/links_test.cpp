// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/links.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flexible/beams.h"
#include "linkwright/flexible/modes.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/flexible/statics.h"
#include "linkwright/math/ode.h"
#include "support/message.h"

namespace linkwright::flexible {
namespace {

Beam half_of(Beam beam) {
  beam.length /= 2;
  return beam;
}
Beam outer_half(Beam beam) {
  beam.length /= 2;
  beam.hub_radius = beam.hub_inertia = 0;
  return beam;
}

TEST(Links, HalvesWeldedAreTheWhole) {
  const Beam beam = torque_beam();
  Beam inner = half_of(beam);
  inner.tip_mass = 0;
  const Chain whole = discretise(beam, 4), welded = weld(discretise(inner, 2), outer_half(beam), 2);
  ASSERT_EQ(welded.cells.size(), whole.cells.size());
  for (std::size_t s = 0; s < whole.cells.size(); ++s) {
    EXPECT_DOUBLE_EQ(welded.cells[s].mass, whole.cells[s].mass);
    EXPECT_DOUBLE_EQ(welded.cells[s].bending, whole.cells[s].bending);
  }
  EXPECT_NEAR(modes(welded, 2)[1].frequency / modes(whole, 2)[1].frequency, 1, 1e-9);
  // A hinge that a stiff spring holds is nearly a weld.
  const Chain held = hinge(discretise(inner, 2), {.stiffness = 1e9}, outer_half(beam), 2);
  EXPECT_EQ(hinges(held), std::vector<std::size_t>{4});
  EXPECT_NEAR(modes(held, 2)[1].frequency / modes(whole, 2)[1].frequency, 1, 1e-6);
}

TEST(Links, SteppedLinkBendsAsItsParts) {
  // Inner half twice as thick: tip deflection by the unit load, exact for every number of cells.
  Beam inner = half_of(torque_beam());
  inner.tip_mass = 0;
  inner.second_moment *= 8;
  const double a = 0.9, ei = inner.bending_stiffness(), thin = ei / 8;
  const double expected = (8 * a * a * a - a * a * a) / (3 * ei) + a * a * a / (3 * thin);
  const Chain chain = weld(discretise(inner, 2), outer_half(torque_beam()), 1);
  EXPECT_NEAR(linear_deflection(chain, {.force = {0, 1}}).eta.back(), expected, 1e-13);
}

TEST(Links, FreeHingesHaveAModeOfTheirOwn) {
  Beam inner = half_of(torque_beam());
  inner.tip_mass = 0;
  const Chain chain = hinge(discretise(inner, 2), {}, outer_half(torque_beam()), 2);
  const auto free = modes(chain, 3);
  EXPECT_EQ(free[0].frequency, 0);
  EXPECT_EQ(free[0].growth, 0);
  EXPECT_GT(free[1].frequency, 1);
  const auto both = modes(chain, 3, {.hub = Hub::free});
  EXPECT_EQ(both[0].frequency, 0);
  EXPECT_EQ(both[1].frequency, 0);
  EXPECT_GT(both[2].frequency, 1);
  // On a turning hub a stiff outer link swings like a pendulum: w^2 = speed^2 (arm) S / J about the hinge.
  Beam stiff_inner = inner, stiff_outer = outer_half(torque_beam());
  stiff_inner.elastic_modulus *= 1e6;
  stiff_outer.elastic_modulus *= 1e6;
  const Chain stiff = hinge(discretise(stiff_inner, 1), {}, stiff_outer, 1);
  const double m = stiff_outer.mass(), mp = stiff_outer.tip_mass, l = 0.9, arm = 0.05 + 0.9;
  const double first = m * l / 2 + mp * l, second = m * l * l / 3 + mp * l * l;
  EXPECT_NEAR(modes(stiff, 1, {.speed = 3})[0].frequency, 3 * std::sqrt(arm * first / second), 1e-4);
}

// Two stiff links, hub and hinge free, under gravity: a double pendulum of two rigid bodies.
TEST(Links, StiffLinksAreADoublePendulum) {
  Beam inner{.length = 0.6,
             .density = 2700,
             .area = 1e-3,
             .second_moment = 1e-5,
             .elastic_modulus = 2e13,
             .hub_inertia = 0.02,
             .gravity = 9.81};
  Beam outer = inner;
  outer.length = 0.4;
  outer.hub_inertia = outer.gravity = 0;
  outer.tip_mass = 0.3;
  const Hinge joint{.mass = 0.2};
  const Chain chain = hinge(discretise(inner, 1), joint, outer, 1);
  const Simulation run = simulate_torque(
      chain, [](double) { return 0.0; },
      {.end = 1, .output_interval = 0.25, .step = 2e-3, .extrapolate = true, .keep_states = true});
  ASSERT_EQ(run.status, Status::done) << run.message;
  for (const Sample& s : run.samples) EXPECT_NEAR(s.energy_balance(), run.samples[0].energy_balance(), 1e-6);

  const double m1 = 2700 * 1e-3 * 0.6, m2 = 2700 * 1e-3 * 0.4, l1 = 0.6, l2 = 0.4, g = 9.81,
               rotary = 2700 * 1e-5;
  const double J1 = m1 * l1 * l1 / 3 + rotary * l1 + 0.02 + (m2 + 0.3 + 0.2) * l1 * l1;
  const double J2 = m2 * l2 * l2 / 3 + rotary * l2 + 0.3 * l2 * l2;
  const double S1 = m1 * l1 / 2 + (m2 + 0.3 + 0.2) * l1, S2 = m2 * l2 / 2 + 0.3 * l2;
  std::vector<double> y = {0, 0, 0, 0};  // absolute angles and rates
  math::OdeWorkspace workspace;
  const auto f = [&](double, std::span<const double> x, std::span<double> rate) {
    const double d = x[0] - x[1], c = l1 * S2 * std::cos(d), s = l1 * S2 * std::sin(d);
    const double r1 = -s * x[3] * x[3] - g * S1 * std::cos(x[0]),
                 r2 = s * x[2] * x[2] - g * S2 * std::cos(x[1]);
    const double det = J1 * J2 - c * c;
    rate[0] = x[2];
    rate[1] = x[3];
    rate[2] = (J2 * r1 - c * r2) / det;
    rate[3] = (J1 * r2 - c * r1) / det;
    return true;
  };
  math::integrate(f, y, 0, 1, {.relative_tolerance = 1e-11}, workspace);
  const double relative = run.states.back().q[coordinates_per_cell * hinges(chain)[0] + turn];
  EXPECT_NEAR(run.samples.back().angle, y[0], 1e-7);
  EXPECT_NEAR(run.samples.back().angle + relative, y[1], 2e-5);
}

TEST(Links, DrivenHingesTellTheirTorque) {
  // A turn of the hinge as given needs a torque; that torque, given, turns it alike.
  Beam inner = half_of(torque_beam());
  inner.tip_mass = 0;
  const Chain chain = hinge(discretise(inner, 1), {.damping = 0.01, .mass = 0.1, .outer_inertia = 0.01},
                            outer_half(torque_beam()), 1);
  const double step = 1e-3;
  const SpinUp turn_by{1, 2};
  const HingeDrive motion[] = {{.hinge = 0, .motion = AngleLaw(turn_by)}};
  const auto still = [](double) { return HubMotion{}; };
  const Simulation given = simulate_motion(
      chain, still, {.end = 1, .output_interval = step, .step = step, .hinges = motion, .keep_states = true});
  ASSERT_EQ(given.status, Status::done) << given.message;
  const std::size_t at = coordinates_per_cell * hinges(chain)[0] + turn;
  EXPECT_NEAR(given.states.back().q[at], turn_by(1).angle, 1e-12);
  EXPECT_NEAR(given.samples.back().energy_balance(), 0, 1e-6);
  EXPECT_GT(given.samples.back().work, 0.01);

  const auto law = [&](double t) { return given.hinge_torques[std::size_t(std::lround(t / step))][0]; };
  const HingeDrive torque[] = {{.hinge = 0, .torque = TorqueLaw(law)}};
  const Simulation back = simulate_motion(
      chain, still, {.end = 1, .output_interval = step, .step = step, .hinges = torque, .keep_states = true});
  ASSERT_EQ(back.status, Status::done);
  EXPECT_NEAR(back.states.back().q[at], turn_by(1).angle, 1e-6);
  EXPECT_NEAR(back.samples.back().tip_eta, given.samples.back().tip_eta, 1e-6);
}

TEST(Links, RefuseWhatDoesNotFit) {
  const Chain chain = discretise(torque_beam(), 2);
  EXPECT_NE(
      test::message([&] { weld(chain, torque_beam(), 2); }).find("hub and gravity belong to the first link"),
      std::string::npos);
  Beam damped = outer_half(torque_beam());
  damped.mass_damping = 1;
  EXPECT_NE(test::message([&] { weld(chain, damped, 2); }).find("links in a row share damping"),
            std::string::npos);
  EXPECT_NE(test::message([&] {
              hinge(chain, {.stiffness = -1}, outer_half(torque_beam()), 2);
            }).find("-1 at a hinge: it must not be negative"),
            std::string::npos);
  const SpinUp law{1, 1};
  const HingeDrive drive[] = {{.hinge = 0, .motion = AngleLaw(law)}};
  EXPECT_NE(test::message([&] {
              simulate_motion(chain, law, {.end = 1, .output_interval = 1, .step = 0.1, .hinges = drive});
            }).find("a drive of hinge 0 of 0 with 1 laws"),
            std::string::npos);
}

}  // namespace
}  // namespace linkwright::flexible
