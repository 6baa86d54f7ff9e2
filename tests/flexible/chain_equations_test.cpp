// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/chain_equations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flexible/beams.h"
#include "support/allocations.h"
#include "support/message.h"

namespace linkwright::flexible {
namespace {

using enum Kinematics;
constexpr std::size_t per = coordinates_per_cell;

// A state of some size, without any symmetry.
ChainState some_state(const Chain& chain, double size = 1) {
  ChainState s = state_at_rest(chain);
  s.angle = 0.7;
  s.rate = 1.3 * size;
  s.acceleration = -0.9 * size;
  for (std::size_t i = 0; i < s.q.size(); ++i) {
    if (i % per == extension && !chain.extensible) continue;
    const double unit = i % per == turn ? 0.2 : 0.02;
    s.q[i] = unit * std::sin(1.0 + 2.1 * double(i)) * size;
    s.v[i] = unit * std::cos(0.3 + 1.7 * double(i)) * size;
    s.a[i] = unit * std::sin(2.0 + 0.9 * double(i)) * size;
  }
  return s;
}

ChainState after(const ChainState& s, double t) {
  ChainState out = s;
  out.angle += s.rate * t + s.acceleration * t * t / 2;
  out.rate += s.acceleration * t;
  for (std::size_t i = 0; i < s.q.size(); ++i) {
    out.q[i] += s.v[i] * t + s.a[i] * t * t / 2;
    out.v[i] += s.a[i] * t;
  }
  return out;
}

math::Vec2 in_ground(double angle, math::Vec2 z) { return rotate({std::cos(angle), std::sin(angle)}, z); }

Beam rich_beam() {
  Beam beam = torque_beam();
  beam.extensible = true;
  beam.gravity = 9.81;
  beam.hub_stiffness = 0.8;
  beam.hub_damping = 0.05;
  beam.mass_damping = 0.3;
  beam.stiffness_damping = 2e-3;
  return beam;
}

// Forces of the nodes from positions alone: accelerations by differences in time, in the ground's axes, and
// virtual work of a change of each coordinate by differences of the positions.
TEST(ChainEquations, ResidualsAgreeWithVirtualWork) {
  for (const Kinematics kinematics : {chord_consistent, hub_axis})
    for (const bool rich : {false, true}) {
      const Beam beam = rich ? rich_beam() : torque_beam();
      const Chain chain = discretise(beam, 2, kinematics);
      const ChainState state = some_state(chain);
      ChainEquations equations(chain);
      const ChainForces forces = equations.evaluate(state);

      const std::size_t n = chain.cells.size();
      const auto place = [&](const ChainState& s, std::size_t j) {
        return in_ground(s.angle, shape(chain, s.q).node[j]);
      };
      const double h = 2e-3;
      std::vector<math::Vec2> force(n + 1);
      for (std::size_t j = 0; j <= n; ++j) {
        math::Vec2 a = -2.5 * place(state, j);  // second difference of fourth order
        for (const double side : {-1.0, 1.0})
          a += 4.0 / 3 * place(after(state, side * h), j) + -1.0 / 12 * place(after(state, 2 * side * h), j);
        const double mass = j == 0 ? chain.root_mass : chain.cells[j - 1].mass;
        force[j] = mass * (1 / (h * h) * a + math::Vec2{0, chain.gravity});
      }
      // Errors: h^4 of the sixth derivative and rounding over h^2, both some 1e-9 of forces of 1 N.
      const double near = 2e-8;
      std::vector<double> absolute(n + 1, state.acceleration), relative(n + 1);
      for (std::size_t s = 0; s < n; ++s) {
        absolute[s + 1] = absolute[s] + state.a[per * s + turn];
        relative[s + 1] = relative[s] + state.v[per * s + turn];
      }
      const double d = 1e-5;
      std::vector<math::Vec2> drift(n + 1);  // velocity of the nodes in the hub
      {
        ChainState ahead = state, behind = state;
        for (std::size_t i = 0; i < state.q.size(); ++i) {
          ahead.q[i] += d * state.v[i];
          behind.q[i] -= d * state.v[i];
        }
        for (std::size_t j = 0; j <= n; ++j)
          drift[j] = 1 / (2 * d) * (shape(chain, ahead.q).node[j] - shape(chain, behind.q).node[j]);
      }
      for (std::size_t i = 0; i < state.q.size(); ++i) {
        const std::size_t kind = i % per, s = i / per;
        if (kind == extension && !chain.extensible) {
          EXPECT_EQ(equations.residual()[i], 0);
          continue;
        }
        ChainState ahead = state, behind = state;
        ahead.q[i] += d;
        behind.q[i] -= d;
        double work = 0;
        for (std::size_t j = 1; j <= n; ++j) {
          const math::Vec2 by =
              1 / (2 * d) * (shape(chain, ahead.q).node[j] - shape(chain, behind.q).node[j]);
          const double mass = chain.cells[j - 1].mass, inertia = chain.cells[j - 1].inertia;
          work += dot(by, in_ground(-state.angle, force[j]) + chain.mass_damping * mass * drift[j]);
          if (kind == turn && j > s) work += inertia * (absolute[j] + chain.mass_damping * relative[j]);
        }
        const Cell& cell = chain.cells[s];
        const double k = kind == slide ? cell.shear : kind == turn ? cell.bending : cell.axial;
        const double spring = k * (state.q[i] + chain.stiffness_damping * state.v[i]);
        EXPECT_NEAR(equations.residual()[i], work + spring, near + 1e-13 * std::abs(spring)) << i;
      }
      // The hub on the link: all forces, and their moment about the weld.
      math::Vec2 sum;
      double moment = chain.root_inertia * state.acceleration;
      for (std::size_t j = 0; j <= n; ++j) {
        sum += in_ground(-state.angle, force[j]);
        moment +=
            cross(shape(chain, state.q).node[j] - math::Vec2{0.05, 0}, in_ground(-state.angle, force[j]));
        if (j > 0) moment += chain.cells[j - 1].inertia * absolute[j];
      }
      EXPECT_NEAR(forces.reaction.x, sum.x, near);
      EXPECT_NEAR(forces.reaction.y, sum.y, near);
      EXPECT_NEAR(forces.moment, moment, near);
      EXPECT_NEAR(forces.torque,
                  0.30 * state.acceleration + moment + 0.05 * sum.y + chain.hub_stiffness * state.angle +
                      chain.hub_damping * state.rate,
                  near);
    }
}

// The power of the drive and of the motors of the coordinates is that of the energy and of the dampers.
TEST(ChainEquations, PowerFeedsTheEnergy) {
  for (const Kinematics kinematics : {chord_consistent, hub_axis, source_linearised}) {
    const bool printed = kinematics == source_linearised;
    const Chain chain = discretise(printed ? torque_beam() : rich_beam(), 2, kinematics);
    const ChainState state = some_state(chain);
    ChainEquations equations(chain);
    double power = equations.evaluate(state).torque * state.rate;
    for (std::size_t i = 0; i < state.q.size(); ++i) power += equations.residual()[i] * state.v[i];
    power -= equations.energy(state).loss;
    const auto energy = [&](double t) {
      const ChainState s = after(state, t);
      equations.evaluate(s);
      const ChainEnergy e = equations.energy(s);
      return e.kinetic + e.potential;
    };
    const double h = 1e-3;
    const double gain = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
    EXPECT_NEAR(power, gain, 1e-8 * (1 + energy(0))) << name_of(kinematics);
  }
}

TEST(ChainEquations, AngularMomentumChangesByTheTorque) {
  for (const Kinematics kinematics : {chord_consistent, hub_axis, source_linearised}) {
    const Chain chain = discretise(torque_beam(), 2, kinematics);
    const ChainState state = some_state(chain);
    ChainEquations equations(chain);
    const double torque = equations.evaluate(state).torque;
    const auto momentum = [&](double t) {
      const ChainState s = after(state, t);
      equations.evaluate(s);
      return equations.energy(s).angular_momentum;
    };
    const double h = 1e-3;
    const double gain = (8 * (momentum(h) - momentum(-h)) - (momentum(2 * h) - momentum(-2 * h))) / (12 * h);
    EXPECT_NEAR(torque, gain, 1e-9) << name_of(kinematics);
  }
}

// solve() undoes what a small change does to the residuals, about a state at rest under load, where there are
// no gyroscopic terms to leave out.
TEST(ChainEquations, TangentAgainstDifferences) {
  for (const Kinematics kinematics : {chord_consistent, hub_axis})
    for (const bool rich : {false, true})
      for (const bool free_hub : {false, true}) {
        Beam beam = rich ? rich_beam() : torque_beam();
        const Chain chain = discretise(beam, 2, kinematics);
        ChainState state = some_state(chain);
        state.rate = state.acceleration = 0;
        for (std::size_t i = 0; i < state.q.size(); ++i) state.v[i] = state.a[i] = 0;
        // A load that keeps its direction in the hub has no part in the balance of the hub.
        const TipLoad load = free_hub ? TipLoad{} : TipLoad{.force = {2, -3}, .couple = 0.4};
        const TangentScale scale{.acceleration = 400, .rate = 30};
        ChainEquations equations(chain);
        equations.evaluate(state, load);
        ASSERT_TRUE(equations.factor(scale, free_hub));
        const std::size_t n = state.q.size();
        for (std::size_t i = 0; i <= n; ++i) {
          if (i == n && !free_hub) continue;
          if (i < n && i % per == extension && !rich) continue;
          const auto moved = [&](double d) {
            ChainState s = state;
            if (i == n) {
              s.angle += d;
              s.rate += scale.rate * d;
              s.acceleration += scale.acceleration * d;
            } else {
              s.q[i] += d;
              s.v[i] += scale.rate * d;
              s.a[i] += scale.acceleration * d;
            }
            ChainEquations at(chain);
            const double torque = at.evaluate(s, load).torque;
            return std::pair(std::vector<double>(at.residual().begin(), at.residual().end()), torque);
          };
          const double d = 1e-5;
          auto [up, torque_up] = moved(d);
          const auto [down, torque_down] = moved(-d);
          for (std::size_t k = 0; k < n; ++k) up[k] = (up[k] - down[k]) / (2 * d);
          std::vector<double> change(n);
          const double hub = equations.solve(up, (torque_up - torque_down) / (2 * d), change);
          for (std::size_t k = 0; k < n; ++k)
            EXPECT_NEAR(change[k], k == i ? -1 : 0, 2e-5) << name_of(kinematics) << i << "," << k;
          EXPECT_NEAR(hub, i == n ? -1 : 0, 2e-5) << name_of(kinematics) << i;
        }
      }
}

TEST(ChainEquations, PrintedVelocitiesHaveThePrintedMultipliers) {
  // (3.20)-(3.22) with the matrices of the linearised velocities, written out for two divisions.
  const Chain chain = discretise(torque_beam(), 2, source_linearised);
  const ChainState s = some_state(chain);
  ChainEquations equations(chain);
  const ChainForces forces = equations.evaluate(s);
  const std::size_t n = 4;
  const double l = 0.45;
  std::vector<double> W(n), W1(n), eta(n), x(n), m(n), angle2(n), Y1(n);
  for (std::size_t j = 0; j < n; ++j) {
    m[j] = chain.cells[j].mass;
    x[j] = 0.05 + l * double(j + 1);
    for (std::size_t k = 0; k <= j; ++k) {
      W[j] += s.q[per * k];
      W1[j] += s.v[per * k];
      // Node j is (j - k + 1/2) l beyond joint k.
      const double arm = (double(j - k) + 0.5) * l;
      eta[j] += s.a[per * k] + arm * s.a[per * k + turn];
      Y1[j] += s.v[per * k] + arm * s.v[per * k + turn];
      angle2[j] += s.a[per * k + turn];
    }
    eta[j] += x[j] * s.acceleration;
  }
  double axial = -chain.root_mass * s.rate * s.rate * 0.05, across = chain.root_mass * s.acceleration * 0.05,
         lateral = 0;
  for (std::size_t j = 0; j < n; ++j) {
    axial -= m[j] * (s.acceleration * W[j] + s.rate * W1[j] + s.rate * (s.rate * x[j] + Y1[j]));
    across += m[j] * (eta[j] - s.rate * s.rate * W[j]);
    lateral += m[j] * eta[j];
  }
  EXPECT_NEAR(forces.reaction.x, axial, 1e-12);
  EXPECT_NEAR(forces.reaction.y, across, 1e-12);
  EXPECT_NEAR(forces.moment,
              l / 2 * lateral + chain.root_inertia * s.acceleration - chain.cells[0].bending * s.q[turn],
              1e-12);
  for (std::size_t k = 0; k < n; ++k) {
    double slides = 0, turns = 0;
    for (std::size_t j = k; j < n; ++j) {
      slides += m[j] * (eta[j] - s.rate * s.rate * W[j]);
      turns +=
          m[j] * (double(j - k) + 0.5) * l * eta[j] + chain.cells[j].inertia * (s.acceleration + angle2[j]);
    }
    EXPECT_NEAR(equations.residual()[per * k + slide], slides + chain.cells[k].shear * s.q[per * k + slide],
                1e-11);
    EXPECT_NEAR(equations.residual()[per * k + turn], turns + chain.cells[k].bending * s.q[per * k + turn],
                1e-11);
  }
}

TEST(ChainEquations, SectionsOfALoadedLink) {
  // Straight, turning and speeding up: tension and moment of the masses outside the cut.
  const Chain chain = discretise(spin_up_beam(), 3);
  ChainState state = state_at_rest(chain);
  state.rate = 2;
  state.acceleration = 0.5;
  ChainEquations equations(chain);
  const ChainForces forces = equations.evaluate(state);
  const auto cuts = equations.sections();
  ASSERT_EQ(cuts.size(), 8);
  for (std::size_t i = 1; i < 7; ++i) {
    double tension = 0, shear = 0, moment = 0;
    for (std::size_t s = i - 1; s < 6; ++s) {
      const double x = 8.0 / 6 * double(s + 1);
      tension += chain.cells[s].mass * x * 4;
      shear -= chain.cells[s].mass * x * 0.5;
      moment -= chain.cells[s].mass * x * 0.5 * (x - cuts[i].position) + chain.cells[s].inertia * 0.5;
    }
    EXPECT_NEAR(cuts[i].position, 8.0 / 6 * (double(i) - 0.5), 1e-14);
    EXPECT_NEAR(cuts[i].axial, tension, 1e-12);
    EXPECT_NEAR(cuts[i].shear, shear, 1e-12);
    EXPECT_NEAR(cuts[i].moment, moment, 1e-12);
  }
  EXPECT_EQ(cuts.front().moment, -forces.moment);
  EXPECT_EQ(cuts.front().axial, -forces.reaction.x);
  EXPECT_EQ(cuts.back().moment, 0);
  const Chain printed = discretise(spin_up_beam(), 3, source_linearised);
  EXPECT_NE(test::message([&] { ChainEquations(printed).sections(); }).find("no forces inside the link"),
            std::string::npos);
}

TEST(ChainEquations, AllocateNothingAfterTheFirstTime) {
  const Chain chain = discretise(rich_beam(), 4);
  const ChainState state = some_state(chain, 0.1);
  ChainEquations equations(chain);
  std::vector<double> change(state.q.size());
  const auto work = [&] {
    equations.evaluate(state);
    equations.factor({.acceleration = 1e6, .rate = 1e3}, true);
    return equations.solve(equations.residual(), 0.1, change);
  };
  work();
  const std::size_t before = test::allocations();
  work();
  EXPECT_EQ(test::allocations(), before);
}

TEST(ChainEquations, CutsOfADampedLinkCarryWhatItsJointsDo) {
  // A damper by mass between link and hub loads the joints as inertia does: their springs give the moment.
  Beam beam = torque_beam();
  beam.mass_damping = 20;
  const Chain chain = discretise(beam, 3);
  ChainState state = state_at_rest(chain);
  for (std::size_t s = 0; s < chain.cells.size(); ++s) {
    state.q[coordinates_per_cell * s + turn] = 1e-5 * (1 + double(s));
    state.v[coordinates_per_cell * s + turn] = 1e-3;
  }
  ChainEquations equations(chain);
  // Accelerations that leave no residual.
  equations.evaluate(state);
  std::vector<double> change(state.q.size());
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(equations.factor({.acceleration = 1e18}, false));
    equations.solve(equations.residual(), 0, change);
    for (std::size_t k = 0; k < change.size(); ++k) state.a[k] += 1e18 * change[k];
    equations.evaluate(state);
  }
  const auto cuts = equations.sections();
  // To the second order of the angles, 1e-4, and the rounding of the solution.
  for (std::size_t s = 0; s < chain.cells.size(); ++s) {
    const double elastic = chain.cells[s].bending * state.q[coordinates_per_cell * s + turn];
    EXPECT_NEAR(cuts[s + 1].moment, elastic, 1e-3 * elastic) << s;
  }
}

}  // namespace
}  // namespace linkwright::flexible
