// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "flexible/beams.h"
#include "linkwright/flexible/simulation.h"

// All tabulated motions of tests/published/flexible-link.json: the two published examples with the three
// kinematics. The source prints them as plots, without numbers.
namespace linkwright::flexible {
namespace {

using enum Kinematics;

struct Tolerances {
  double angle, tip, force, force_relative, moment;
};

const Sample& at_time(const Simulation& run, double t) {
  for (const Sample& s : run.samples)
    if (std::abs(s.time - t) < 1e-9) return s;
  throw std::runtime_error("no sample at " + std::to_string(t));
}

void compare(const Simulation& run, const Value& expected, const Tolerances& t, const std::string& what) {
  const auto column = [&](const char* key) { return test::numbers(test::at(expected, key)); };
  const auto times = column("t_s"), theta = column("theta_rad"), xi = column("tip_xi_m"),
             eta = column("tip_eta_m"), rx = column("R_xi_N"), ry = column("R_eta_N"), m = column("M_O1_Nm");
  ASSERT_EQ(times.size(), 8);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Sample& s = at_time(run, times[i]);
    const std::string where = what + " at " + std::to_string(times[i]);
    EXPECT_NEAR(s.angle, theta[i], t.angle) << where;
    EXPECT_NEAR(s.tip_xi, xi[i], t.tip) << where;
    EXPECT_NEAR(s.tip_eta, eta[i], t.tip) << where;
    EXPECT_NEAR(s.reaction_xi, rx[i], t.force + t.force_relative * std::abs(rx[i])) << where;
    EXPECT_NEAR(s.reaction_eta, ry[i], t.force + t.force_relative * std::abs(ry[i])) << where;
    EXPECT_NEAR(s.moment, m[i], t.moment) << where;
  }
}

struct Variant {
  const char* key;
  Kinematics kinematics;
  int divisions;
  Theory theory = Theory::rayleigh;
};
constexpr Variant variants[] = {{"CC_n2", chord_consistent, 2},
                                {"CC_n4", chord_consistent, 4},
                                {"HX_n2", hub_axis, 2},
                                {"SL_n2", source_linearised, 2},
                                {"CC_n2_timoshenko_nu03_k56", chord_consistent, 2, Theory::timoshenko},
                                {"CC_n2_euler_bernoulli_J0", chord_consistent, 2, Theory::euler_bernoulli}};

class SpinUps : public ::testing::TestWithParam<const char*> {};

TEST_P(SpinUps, AllColumns) {
  const std::string id = std::string("spinup-omega0-") + GetParam();
  const double speed = std::stod(GetParam());
  const bool fast = speed > 10;
  int compared = 0;
  for (const Variant& v : variants) {
    const Value* expected = computed(id).find(v.key);
    if (!expected) continue;
    const Chain chain = discretise(spin_up_beam(v.theory), v.divisions, v.kinematics);
    const SpinUp law{speed, 15};
    const double breaks[] = {15};
    const Simulation run = simulate_motion(
        chain, law,
        {.end = 20, .output_interval = 0.005, .step = 0.0025, .breaks = breaks, .extrapolate = true});
    ++compared;
    if (expected->is_string()) {  // diverges
      EXPECT_TRUE(run.unstable);
      ASSERT_FALSE(run.warnings.empty());
      EXPECT_NE(run.warnings[0].find(
                    "the straight chain of 4 cells with hub_axis kinematics is unstable beyond 8.5797"),
                std::string::npos)
          << run.warnings[0];
      EXPECT_EQ(run.status, Status::limit_reached) << "the chain folds";
      EXPECT_GT(run.samples.size(), 500);
      continue;
    }
    ASSERT_EQ(run.status, Status::done) << run.message;
    EXPECT_FALSE(run.unstable);
    const Tolerances tolerances{1e-12, fast ? 2e-5 : 1e-5, 1e-3, 1e-5, 1e-3};
    compare(run, *expected, tolerances, id + " " + v.key);
    if (!expected->find("peak_lag")) continue;
    const Extreme peak = smallest(run.samples, &Sample::tip_eta, 0, 20);
    EXPECT_NEAR(peak.value, test::number_at(*expected, "peak_lag.tip_eta_m"), fast ? 2e-5 : 1e-5)
        << id << v.key;
    EXPECT_NEAR(peak.time, test::number_at(*expected, "peak_lag.t_s"), 5e-3) << id << v.key;
    const double residual = std::max(largest(run.samples, &Sample::tip_eta, 15, 20).value,
                                     -smallest(run.samples, &Sample::tip_eta, 15, 20).value);
    EXPECT_NEAR(residual, test::number_at(*expected, "residual_amplitude_after_T_m"), 2e-5) << id << v.key;
  }
  EXPECT_GE(compared, 4);
}

// The beam itself, not a chain, from a spectral solution.
TEST_P(SpinUps, AFineChainAgainstTheContinuum) {
  const std::string id = std::string("spinup-omega0-") + GetParam();
  const double speed = std::stod(GetParam());
  const Chain chain = discretise(spin_up_beam(), 12);
  const double breaks[] = {15};
  const Simulation run = simulate_motion(
      chain, SpinUp{speed, 15},
      {.end = 20, .output_interval = 0.005, .step = 0.005, .breaks = breaks, .extrapolate = true});
  ASSERT_EQ(run.status, Status::done);
  const Value& expected = test::at(computed(id), "continuum");
  const Extreme peak = smallest(run.samples, &Sample::tip_eta, 0, 20);
  EXPECT_NEAR(peak.value, test::number_at(expected, "peak_lag.tip_eta_m"), 1e-4);
  EXPECT_NEAR(peak.time, test::number_at(expected, "peak_lag.t_s"), 5e-3);
  const auto times = test::numbers(test::at(expected, "t_s")),
             eta = test::numbers(test::at(expected, "tip_eta_m"));
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (speed > 10 && times[i] > 10) continue;  // phases of the higher modes
    EXPECT_NEAR(at_time(run, times[i]).tip_eta, eta[i], speed > 10 ? 1e-3 : 1e-4) << times[i];
  }
  // After T the axial force swings about that of the straight link.
  double mean = 0;
  long count = 0;
  for (const Sample& s : run.samples)
    if (s.time > 15) mean += s.reaction_xi, ++count;
  const double steady = test::number_at(computed(id), "steady_R_xi_N");
  EXPECT_NEAR(mean / double(count), steady, 2e-3 * std::abs(steady));
}

TEST(PublishedMotions, ConvergeWithTheNumberOfDivisions) {
  // Fourth order: 16 times nearer to the beam with twice the divisions, as the lag is midway in the fastest
  // spin-up.
  const auto times = figures("spinup-omega0-16", "continuum.t_s"),
             eta = figures("spinup-omega0-16", "continuum.tip_eta_m");
  ASSERT_EQ(times[2], 7.5);
  const auto error = [&](int n) {
    const Simulation run =
        simulate_motion(discretise(spin_up_beam(), n), SpinUp{16, 15},
                        {.end = 7.5, .output_interval = 7.5, .step = 0.0025, .extrapolate = true});
    return std::abs(run.samples.back().tip_eta - eta[2]);
  };
  const double two = error(2), four = error(4), eight = error(8);
  EXPECT_LT(two, 8e-3);
  EXPECT_LT(four, two / 10);
  EXPECT_LT(eight, four / 10);
}

INSTANTIATE_TEST_SUITE_P(Published, SpinUps, ::testing::Values("0.6", "2", "4", "8", "12", "16"));

class Torques : public ::testing::TestWithParam<const char*> {};

TEST_P(Torques, AllColumns) {
  const std::string id = std::string("torque-tau0-") + GetParam();
  const double torque = std::stod(GetParam());
  const double breaks[] = {2};
  int compared = 0;
  for (const Variant& v : variants) {
    const Value* expected = computed(id).find(v.key);
    if (!expected) continue;
    const Chain chain = discretise(torque_beam(v.theory), v.divisions, v.kinematics);
    const Simulation run = simulate_torque(
        chain, SinePulse{torque, 2},
        {.end = 5, .output_interval = 0.002, .step = 0.001, .breaks = breaks, .extrapolate = true});
    ASSERT_EQ(run.status, Status::done) << run.message;
    ++compared;
    // Under 4 and 6 N m the stiffest vibrations of hub_axis, 1e5 rad/s, stay alive in its forces; steps of 1
    // ms damp them, so there only the place of hub and tip can agree (the next test follows the forces).
    const bool noisy = v.kinematics == hub_axis && torque > 3;
    const double any = 1;
    compare(run, *expected,
            noisy ? Tolerances{5e-5, 5e-5, any, 0, any} : Tolerances{5e-5, 5e-5, 5e-3, 1e-4, 2e-3},
            id + " " + v.key);
    if (!expected->find("peaks")) continue;
    const Extreme first = smallest(run.samples, &Sample::tip_eta, 0, 1),
                  second = largest(run.samples, &Sample::tip_eta, 1, 2.2);
    EXPECT_NEAR(first.value, test::number_at(*expected, "peaks.min.tip_eta_m"), 5e-5) << id << v.key;
    EXPECT_NEAR(first.time, test::number_at(*expected, "peaks.min.t_s"), 5e-3) << id << v.key;
    EXPECT_NEAR(second.value, test::number_at(*expected, "peaks.max.tip_eta_m"), 5e-5) << id << v.key;
    EXPECT_NEAR(second.time, test::number_at(*expected, "peaks.max.t_s"), 5e-3) << id << v.key;
  }
  EXPECT_GE(compared, 4);
}

TEST(PublishedMotions, ForcesOfTheHubAxisChainNeedTheStiffestVibrations) {
  const Chain chain = discretise(torque_beam(), 2, hub_axis);
  const auto expected = figures("torque-tau0-4", "HX_n2.R_xi_N");
  const auto error = [&](double step) {
    const Simulation run =
        simulate_torque(chain, SinePulse{4, 2}, {.end = 1, .output_interval = 0.5, .step = step});
    EXPECT_NEAR(run.samples[1].reaction_xi, expected[0], 5e-3);
    return std::abs(run.samples[2].reaction_xi - expected[1]);
  };
  EXPECT_GT(error(1e-3), 0.05);
  EXPECT_LT(error(1e-5), 5e-4);
}

TEST_P(Torques, AFineChainAgainstTheContinuum) {
  const std::string id = std::string("torque-tau0-") + GetParam();
  const double breaks[] = {2};
  const Simulation run = simulate_torque(
      discretise(torque_beam(), 12), SinePulse{std::stod(GetParam()), 2},
      {.end = 5, .output_interval = 0.002, .step = 0.002, .breaks = breaks, .extrapolate = true});
  ASSERT_EQ(run.status, Status::done);
  const Value& expected = test::at(computed(id), "continuum");
  const auto times = test::numbers(test::at(expected, "t_s")),
             eta = test::numbers(test::at(expected, "tip_eta_m")),
             theta = test::numbers(test::at(expected, "theta_rad"));
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(at_time(run, times[i]).tip_eta, eta[i], 1e-4) << times[i];
    EXPECT_NEAR(at_time(run, times[i]).angle, theta[i], 1e-4) << times[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Published, Torques, ::testing::Values("1", "2", "4", "6"));

}  // namespace
}  // namespace linkwright::flexible
