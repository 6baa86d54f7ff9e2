// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/simulation.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "flexible/beams.h"
#include "linkwright/core/numbers.h"
#include "linkwright/flexible/chain_equations.h"
#include "linkwright/flexible/modes.h"
#include "linkwright/flexible/statics.h"
#include "linkwright/math/ode.h"
#include "support/message.h"

namespace linkwright::flexible {
namespace {

using enum Kinematics;
const double pulse_end[] = {2};

// Another way to the same motion: mass matrix and forces put together column by column from the residuals,
// which are linear in the accelerations, then an explicit Runge-Kutta method of order 8 at 1e-11.
struct Explicit {
  const Chain& chain;
  ChainEquations equations{chain};
  ChainState state = state_at_rest(chain);
  std::vector<std::size_t> active;

  explicit Explicit(const Chain& c) : chain(c) {
    for (std::size_t i = 0; i < state.q.size(); ++i)
      if (i % coordinates_per_cell != extension) active.push_back(i);
  }
  // y = coordinates, angle, rates, angular rate
  void accelerate(std::span<const double> y, double torque, std::span<double> rate) {
    const Eigen::Index n = Eigen::Index(active.size()) + 1;
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
      state.q[active[i]] = y[i];
      state.v[active[i]] = y[n + i];
    }
    state.angle = y[n - 1];
    state.rate = y[2 * n - 1];
    const auto residual = [&](Eigen::Index column) {
      state.acceleration = column == n - 1;
      for (double& a : state.a) a = 0;
      if (column >= 0 && column < n - 1) state.a[active[column]] = 1;
      const ChainForces& f = equations.evaluate(state);
      Eigen::VectorXd r(n);
      for (Eigen::Index i = 0; i + 1 < n; ++i) r[i] = equations.residual()[active[i]];
      r[n - 1] = f.torque - torque;
      return r;
    };
    const Eigen::VectorXd rest = residual(-1);
    Eigen::MatrixXd mass(n, n);
    for (Eigen::Index c = 0; c < n; ++c) mass.col(c) = residual(c) - rest;
    const Eigen::VectorXd a = mass.partialPivLu().solve(-rest);
    for (Eigen::Index i = 0; i < n; ++i) {
      rate[i] = y[n + i];
      rate[n + i] = a[i];
    }
  }
};

TEST(Simulation, AgreesWithAnExplicitMethodOnTheMassMatrix) {
  for (const Kinematics kinematics : {chord_consistent, hub_axis, source_linearised})
    for (const int n : {1, 2}) {
      // A soft, thick link: its stiffest vibration is slow enough for an explicit method.
      Beam beam = torque_beam();
      beam.elastic_modulus = 1e9;
      beam.second_moment = 4e-8;
      beam.area = 1e-3;
      if (kinematics != source_linearised) beam.gravity = 3;
      const Chain chain = discretise(beam, n, kinematics);
      const SinePulse law{10, 0.4};
      Explicit other(chain);
      const std::size_t half = other.active.size() + 1;
      std::vector<double> y(2 * half);
      const auto f = [&](double t, std::span<const double> at, std::span<double> rate) {
        other.accelerate(at, law(t), rate);
        return true;
      };
      const math::OdeOptions tight{
          .relative_tolerance = 1e-10, .absolute_tolerance = 1e-12, .max_steps = 1'000'000};
      math::OdeWorkspace workspace;
      const auto report = math::integrate(f, y, 0, 0.3, tight, workspace);
      ASSERT_EQ(report.status, Status::done) << report.message;

      const Simulation run = simulate_torque(
          chain, law,
          {.end = 0.3, .output_interval = 0.1, .step = 2.5e-4, .extrapolate = true, .keep_states = true});
      ASSERT_EQ(run.status, Status::done) << run.message;
      ChainState last = state_at_rest(chain);
      for (std::size_t i = 0; i < other.active.size(); ++i) last.q[other.active[i]] = y[i];
      ChainEquations equations(chain);
      last.angle = y[half - 1];
      equations.evaluate(last);
      EXPECT_GT(std::abs(run.samples.back().tip_eta), 0.01);
      EXPECT_NEAR(run.samples.back().angle, y[half - 1], 2e-6) << name_of(kinematics) << n;
      EXPECT_NEAR(run.samples.back().tip_eta, equations.tip().y, 2e-6) << name_of(kinematics) << n;
    }
}

TEST(Simulation, IsOfSecondOrderAndOfFourthWithExtrapolation) {
  const Chain chain = discretise(torque_beam(), 2);
  const SinePulse law{2, 2};
  const auto tip = [&](double step, bool extrapolate) {
    return simulate_torque(chain, law,
                           {.end = 0.5, .output_interval = 0.25, .step = step, .extrapolate = extrapolate})
        .samples.back()
        .tip_eta;
  };
  const double exact = tip(1.25e-4, true);
  const double ratio = (tip(4e-3, false) - exact) / (tip(2e-3, false) - exact);
  EXPECT_NEAR(ratio, 4, 0.3);
  EXPECT_LT(std::abs(tip(4e-3, true) - exact), 0.1 * std::abs(tip(2e-3, false) - exact));
}

TEST(Simulation, KeepsTheBooksOfEnergyAndMomentum) {
  const Simulation torque =
      simulate_torque(discretise(torque_beam(), 2), SinePulse{4, 2},
                      {.end = 5, .output_interval = 0.25, .step = 2.5e-3, .breaks = pulse_end});
  ASSERT_EQ(torque.status, Status::done);
  double most = 0, at_end = 0;
  for (const Sample& s : torque.samples) {
    most = std::max(most, s.kinetic + s.potential);
    EXPECT_NEAR(s.energy_balance(), 0, 1e-4 * std::max(most, s.work));
    if (s.time < 2) continue;
    if (at_end == 0) at_end = s.kinetic + s.potential;
    EXPECT_NEAR((s.kinetic + s.potential) / at_end, 1, 1e-5);  // nothing drives it any more
    EXPECT_NEAR(s.angular_momentum, 0, 1e-6);                  // the pulse has no net impulse
  }
  const Simulation spin = simulate_motion(discretise(spin_up_beam(), 2), SpinUp{4, 15},
                                          {.end = 20, .output_interval = 1, .step = 2.5e-3});
  for (const Sample& s : spin.samples) EXPECT_NEAR(s.energy_balance(), 0, 1e-7 * spin.samples.back().work);
  EXPECT_GT(spin.samples.back().work, 100);
}

TEST(Simulation, DampersTakeWhatTheBooksSay) {
  for (const auto& [mass, stiffness, hub] :
       {std::tuple{0.4, 0.0, 0.0}, std::tuple{0.0, 0.01, 0.0}, std::tuple{0.0, 0.0, 0.02}}) {
    Beam beam = torque_beam();
    beam.mass_damping = mass;
    beam.stiffness_damping = stiffness;
    beam.hub_damping = hub;
    beam.gravity = 1;
    beam.hub_stiffness = 0.5;
    const Simulation run =
        simulate_torque(discretise(beam, 4), SinePulse{1, 2},
                        {.end = 8, .output_interval = 0.5, .step = 1e-3, .breaks = pulse_end});
    ASSERT_EQ(run.status, Status::done);
    const Sample& last = run.samples.back();
    EXPECT_GT(last.dissipated, 0.01);
    for (const Sample& s : run.samples) EXPECT_NEAR(s.energy_balance(), 0, 2e-5);
  }
}

TEST(Simulation, FreeVibrationDecaysAsItsDampingSays) {
  // The damping ratio of the first mode is mass_damping / (2 w) + stiffness_damping w / 2.
  Beam beam = torque_beam();
  beam.stiffness_damping = 0.01;
  beam.mass_damping = 0.1;
  const Chain chain = discretise(beam, 4);
  const double w = modes(chain, 1)[0].frequency, ratio = 0.05 / w + 0.005 * w;
  const Deflection shape = mode_shape(chain, 1).link;
  Start start{.q = std::vector<double>(coordinates_per_cell * chain.cells.size())};
  for (std::size_t s = 0; s < chain.cells.size(); ++s) {
    const double l = chain.cells[s].length, delta = shape.angle[s + 1] - shape.angle[s];
    start.q[coordinates_per_cell * s + turn] = 1e-3 * delta;
    start.q[coordinates_per_cell * s + slide] =
        1e-3 * (shape.eta[s + 1] - shape.eta[s] - l * shape.angle[s] - l / 2 * delta);
  }
  const double damped = w * std::sqrt(1 - ratio * ratio), period = 2 * pi / damped;
  const Simulation run = simulate_motion(
      chain, [](double) { return HubMotion{}; },
      {.end = 4 * period, .output_interval = period, .step = period / 500, .extrapolate = true}, start);
  ASSERT_EQ(run.status, Status::done);
  EXPECT_NEAR(run.samples[0].tip_eta, 1e-3, 1e-9);
  for (int k = 1; k <= 4; ++k)
    EXPECT_NEAR(run.samples[k].tip_eta, 1e-3 * std::exp(-ratio * w * period * k), 2e-8) << k;
}

TEST(Simulation, SteadyDragUnderConstantAcceleration) {
  // Slow spin-up: tip_eta = -1.2748 theta'' m for Table 3.1, quasi-static, here with the hub speeding up
  // gently.
  const auto law = [](double t) {
    const double rise = std::min(t / 100, 1.0);  // a cubic ramp of the acceleration to 0.01 rad/s2
    const double a = 1e-3 * rise * rise * (3 - 2 * rise);
    return HubMotion{.acceleration = a};
  };
  const Simulation run =
      simulate_motion(discretise(spin_up_beam(), 4), law, {.end = 150, .output_interval = 50, .step = 0.02});
  EXPECT_NEAR(run.samples.back().tip_eta, -1.2748e-3, 2e-7);
}

TEST(Simulation, MirroredDrivesGiveMirroredMotions) {
  const Chain chain = discretise(spin_up_beam(), 3);
  const SimulationOptions options{.end = 8, .output_interval = 1, .step = 5e-3};
  const Simulation left = simulate_motion(chain, SpinUp{6, 15}, options),
                   right = simulate_motion(chain, SpinUp{-6, 15}, options);
  for (std::size_t i = 0; i < left.samples.size(); ++i) {
    EXPECT_NEAR(left.samples[i].tip_eta, -right.samples[i].tip_eta, 1e-12);
    EXPECT_NEAR(left.samples[i].reaction_xi, right.samples[i].reaction_xi, 1e-9);
  }
}

TEST(Simulation, ATorqueGivesTheMotionThatNeedsIt) {
  // The motion under a torque, prescribed as a motion, needs that torque.
  const Chain chain = discretise(torque_beam(), 2);
  const double step = 1e-3;
  const Simulation torque =
      simulate_torque(chain, SinePulse{2, 2}, {.end = 1, .output_interval = step, .step = step});
  const auto law = [&](double t) {
    const auto i = std::min<std::size_t>(std::size_t(std::lround(t / step)), torque.samples.size() - 1);
    return HubMotion{torque.samples[i].angle, torque.samples[i].rate, torque.samples[i].acceleration};
  };
  const Simulation motion = simulate_motion(chain, law, {.end = 1, .output_interval = 0.1, .step = step});
  for (std::size_t i = 0; i < motion.samples.size(); ++i) {
    const Sample& s = torque.samples[100 * i];
    EXPECT_NEAR(motion.samples[i].torque, s.torque, 1e-7);
    EXPECT_NEAR(motion.samples[i].tip_eta, s.tip_eta, 1e-9);
    EXPECT_NEAR(motion.samples[i].reaction_eta, s.reaction_eta, 1e-7);
  }
}

TEST(Simulation, HonoursJumpsOfTheDrive) {
  // A constant torque that ends at a time no step would hit: the hub of a nearly rigid link then keeps its
  // speed.
  Beam beam = torque_beam();
  beam.elastic_modulus *= 1e5;
  const Chain chain = discretise(beam, 1);
  const double off = 0.3333, torque = 2;
  const auto law = [&](double t) { return t < off ? torque : 0.0; };
  const double breaks[] = {off};
  const Simulation run =
      simulate_torque(chain, law, {.end = 1, .output_interval = 0.25, .step = 0.01, .breaks = breaks});
  ASSERT_EQ(run.status, Status::done);
  EXPECT_NEAR(run.samples.back().angular_momentum, torque * off, 1e-8);
  // The acceleration is there from the start: the torque over the inertia, but for the link's last softness.
  const double inertia = 0.30 + beam.mass() * (1.8 * 1.8 / 3 + 0.05 * 1.85) + 0.085 * 1.85 * 1.85;
  EXPECT_NEAR(run.samples[0].acceleration * inertia, torque, 0.1);
  const Simulation blind = simulate_torque(chain, law, {.end = 1, .output_interval = 0.25, .step = 0.01});
  EXPECT_GT(std::abs(blind.samples.back().angular_momentum - torque * off), 1e-3);
}

TEST(Simulation, MassesWithoutTurnInertiaAndWithoutHub) {
  Beam beam = torque_beam(Theory::euler_bernoulli);
  beam.hub_inertia = 0;
  const Simulation run =
      simulate_torque(discretise(beam, 3), SinePulse{0.5, 2},
                      {.end = 3, .output_interval = 0.5, .step = 1e-3, .breaks = pulse_end});
  ASSERT_EQ(run.status, Status::done) << run.message;
  EXPECT_NEAR(run.samples.back().angular_momentum, 0, 1e-6);
  for (const Sample& s : run.samples) EXPECT_NEAR(s.energy_balance(), 0, 1e-4);
}

TEST(Simulation, ALinkThatStretches) {
  // Published peak of Kane's beam: about -0.57 to -0.58 m; computed by a spectral beam -0.57376 m at 6.762 s.
  const double breaks[] = {15};
  const Simulation run = simulate_motion(
      discretise(kane_beam(), 8), SpinUp{6, 15},
      {.end = 20, .output_interval = 0.01, .step = 0.005, .breaks = breaks, .extrapolate = true});
  ASSERT_EQ(run.status, Status::done);
  const Extreme peak = smallest(run.samples, &Sample::tip_eta, 0, 20);
  EXPECT_NEAR(peak.value, -0.57376, 2e-4);
  EXPECT_NEAR(peak.time, 6.762, 5e-3);
  // Steady stretch 5.14e-4 m, about which it goes on vibrating.
  double mean = 0;
  int count = 0;
  for (const Sample& s : run.samples)
    if (s.time > 15) mean += s.tip_xi, ++count;
  EXPECT_NEAR(mean / count, 5.143e-4, 1e-5);
}

TEST(Simulation, MeetsATolerance) {
  const Chain chain = discretise(torque_beam(), 2);
  const Simulation run = simulate_torque(
      chain, SinePulse{2, 2},
      {.end = 1, .output_interval = 0.25, .step = 0.05, .extrapolate = true, .tolerance = 1e-5});
  ASSERT_EQ(run.status, Status::done);
  EXPECT_LE(run.error, 1e-5);
  EXPECT_LT(run.step, 0.01);
  const Simulation fine = simulate_torque(
      chain, SinePulse{2, 2}, {.end = 1, .output_interval = 0.25, .step = 2e-4, .extrapolate = true});
  for (int i = 0; i <= 4; ++i) EXPECT_NEAR(run.samples[i].tip_eta, fine.samples[i].tip_eta, 1e-5);
}

TEST(Simulation, WarnsOfKinksAndStopsWhereTheChainFolds) {
  const Chain chain = discretise(spin_up_beam(), 1);
  const auto jerk = [](double a) {
    return [a](double t) { return HubMotion{a * t * t * t / 6, a * t * t / 2, a * t}; };
  };
  const Simulation bent = simulate_motion(chain, jerk(4), {.end = 1.2, .output_interval = 0.1, .step = 1e-3});
  EXPECT_EQ(bent.status, Status::done);
  ASSERT_FALSE(bent.warnings.empty());
  EXPECT_NE(bent.warnings.back().find("rad to each other, more than 0.5: take more divisions"),
            std::string::npos);
  const Simulation folded =
      simulate_motion(chain, jerk(20), {.end = 3, .output_interval = 0.1, .step = 1e-3});
  EXPECT_EQ(folded.status, Status::limit_reached);
  EXPECT_NE(folded.message.find("the chain folded"), std::string::npos);
  EXPECT_GT(folded.samples.size(), 1);
  EXPECT_LT(folded.samples.size(), 31);
}

TEST(Simulation, HalvesStepsThatDoNotConverge) {
  // Five iterations do not do for a step of 50 ms through a strong pulse, but for its parts.
  const Chain chain = discretise(torque_beam(), 2);
  const Simulation run = simulate_torque(
      chain, SinePulse{6, 2}, {.end = 2, .output_interval = 0.5, .step = 0.05, .max_iterations = 5});
  ASSERT_EQ(run.status, Status::done) << run.message;
  ASSERT_EQ(run.warnings.size(), 1);
  EXPECT_NE(run.warnings[0].find("did not converge and were halved: take a shorter step"), std::string::npos);
  EXPECT_GT(run.steps, 40);
  EXPECT_NEAR(run.samples.back().angular_momentum, 0, 0.05);
}

TEST(Simulation, KeepsWhatItHasWhereAStepFails) {
  const Chain chain = discretise(torque_beam(), 2);
  const auto law = [](double t) { return t < 0.5 ? 1.0 : NAN; };
  const Simulation run = simulate_torque(chain, law, {.end = 1, .output_interval = 0.1, .step = 0.01});
  EXPECT_EQ(run.status, Status::not_converged);
  EXPECT_EQ(run.message, "the step of 0.0001562 s to 0.5 s does not converge");
  EXPECT_EQ(run.samples.size(), 5);
  EXPECT_FALSE(std::isnan(run.samples.back().tip_eta));
}

TEST(Simulation, StopsWhenAsked) {
  RunContext context;
  context.cancel();
  const Simulation run =
      simulate_motion(discretise(spin_up_beam(), 2), SpinUp{4, 15},
                      {.end = 20, .output_interval = 0.1, .step = 1e-3, .context = &context});
  EXPECT_EQ(run.status, Status::cancelled);
  EXPECT_EQ(run.message, "stopped at 0.128 s");
  EXPECT_EQ(run.samples.size(), 2);
}

TEST(Simulation, KeepsTheLongerStepWhenTheShorterOneIsStopped) {
  // Cancelled as soon as the second run, with half the step, reports its beginning.
  RunContext context;
  double last = 0;
  context.set_progress([&](const Progress& p) {
    if (p.fraction < last) context.cancel();
    last = p.fraction;
  });
  const Simulation run = simulate_motion(
      discretise(spin_up_beam(), 2), SpinUp{4, 15},
      {.end = 20, .output_interval = 0.1, .step = 0.01, .extrapolate = true, .context = &context});
  EXPECT_EQ(run.status, Status::cancelled);
  EXPECT_EQ(run.samples.size(), 201);
  EXPECT_NEAR(run.step, 0.01, 1e-12);  // equal steps between samples: to rounding
  EXPECT_TRUE(std::isnan(run.error));
  EXPECT_NE(run.message.find("the run with half the step was stopped at"), std::string::npos) << run.message;
}

TEST(Simulation, RefusesWhatMakesNoSense) {
  const Chain chain = discretise(spin_up_beam(), 1);
  const auto told = [&](const SimulationOptions& o, const Start& start = {}) {
    return test::message([&] { simulate_motion(chain, SpinUp{1, 1}, o, start); });
  };
  EXPECT_NE(told({.end = 1, .output_interval = 0.1})
                .find("end 1 s, output interval 0.1 s, step 0 s: all must be positive"),
            std::string::npos);
  EXPECT_NE(
      told({.end = 1, .output_interval = 0.1, .step = 0.1, .spectral_radius = 1}).find("spectral radius 1"),
      std::string::npos);
  EXPECT_NE(
      told({.end = 1, .output_interval = 0.1, .step = 0.1}, {.q = {1}}).find("a start of 1 coordinates"),
      std::string::npos);
}

}  // namespace
}  // namespace linkwright::flexible
