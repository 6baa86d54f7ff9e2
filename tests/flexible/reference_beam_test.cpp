// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/reference_beam.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flexible/beams.h"
#include "linkwright/flexible/continuum.h"
#include "linkwright/flexible/simulation.h"
#include "support/message.h"

namespace linkwright::flexible {
namespace {

// Enough for slow motions to some 1e-6 m, and ten times as fast as the default: the stiffest of its
// vibrations set the steps of an explicit method.
constexpr ReferenceOptions coarse{.degree = 7, .points = 16};

TEST(ReferenceBeam, LargeDeflectionsAreThoseOfTheElastica) {
  const Beam beam = spin_up_beam();
  for (const int load : {1, 2, 5, 10}) {
    const ReferenceShape found =
        reference_shape(beam, {0, load * beam.bending_stiffness() / 64}, {.degree = 14});
    ASSERT_EQ(found.status, Status::done);
    const auto expected = figures("static-elastica", "PL2_EI_" + std::to_string(load) + ".elastica");
    EXPECT_NEAR(found.angle, expected[0], 1e-8);
    EXPECT_NEAR(1 - found.tip.x / 8, expected[1], 1e-8);
    EXPECT_NEAR(found.tip.y / 8, expected[2], 1e-8);
  }
}

TEST(ReferenceBeam, FrequenciesOnATurningHub) {
  Beam beam = spin_up_beam();
  beam.tip_mass = 0;
  const double scale = beam.frequency_scale();
  for (const Value& row : test::at(computed("rotating-frequency"), "table").as_array()) {
    const double speed = test::number_at(row, "eta") * scale;
    const double found = reference_frequencies(beam, 1, speed)[0] / scale;
    EXPECT_NEAR(found, test::number_at(row, "reference_inplane"), 1e-6) << speed / scale;
    // Out of the plane the squares differ by that of the speed (Wright et al. 1982), rotary inertia apart.
    EXPECT_NEAR(std::hypot(found, speed / scale), test::number_at(row, "reference_flap"), 1e-5);
  }
  const auto found = reference_frequencies(spin_up_beam(), 3, 0),
             exact = continuum_frequencies(spin_up_beam(), 3);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k] / exact[k], 1, 1e-7);
}

void compare(const std::vector<Sample>& samples, const Value& expected, double tip, double force) {
  const auto column = [&](const char* key) { return test::numbers(test::at(expected, key)); };
  const auto times = column("t_s"), theta = column("theta_rad"), xi = column("tip_xi_m"),
             eta = column("tip_eta_m"), rx = column("R_xi_N"), ry = column("R_eta_N"), m = column("M_O1_Nm");
  std::size_t at = 0;
  for (const Sample& s : samples) {
    if (at == times.size() || std::abs(s.time - times[at]) > 1e-9) continue;
    EXPECT_NEAR(s.angle, theta[at], tip);
    EXPECT_NEAR(s.tip_xi, xi[at], tip) << s.time;
    EXPECT_NEAR(s.tip_eta, eta[at], tip) << s.time;
    EXPECT_NEAR(s.reaction_xi, rx[at], force + 1e-5 * std::abs(rx[at])) << s.time;
    EXPECT_NEAR(s.moment, m[at], force) << s.time;
    ++at;
  }
  EXPECT_EQ(at, times.size());
}

TEST(ReferenceBeam, SpinUpAsComputedElsewhere) {
  const double breaks[] = {15};
  const ReferenceMotion run = reference_motion(
      spin_up_beam(), SpinUp{4, 15},
      {.end = 20, .output_interval = 0.02, .tolerance = 1e-7, .breaks = breaks, .beam = coarse});
  ASSERT_EQ(run.status, Status::done) << run.message;
  const Value& expected = test::at(computed("spinup-omega0-4"), "continuum");
  compare(run.samples, expected, 5e-6, 5e-3);
  const Extreme peak = smallest(run.samples, &Sample::tip_eta, 0, 20);
  EXPECT_NEAR(peak.value, test::number_at(expected, "peak_lag.tip_eta_m"), 1e-6);
  // A third formulation: geometrically exact finite elements that stretch and shear, 16 and 32 of them (their
  // errors fall with the square of the length), extrapolated: -0.62089 m at 7.5 s.
  const Value& elements = test::at(computed("spinup-omega0-4"), "geometrically_exact_FE_32");
  for (const Sample& s : run.samples)
    if (std::abs(s.time - 7.5) < 1e-9) {
      EXPECT_NEAR(s.tip_eta, -0.62089, 5e-5);
      EXPECT_NEAR(s.tip_eta, test::numbers(test::at(elements, "tip_eta_m"))[2], 4e-4);
    }
  // And the chain.
  const Simulation chain = simulate_motion(
      discretise(spin_up_beam(), 16), SpinUp{4, 15},
      {.end = 20, .output_interval = 2.5, .step = 0.005, .breaks = breaks, .extrapolate = true});
  for (std::size_t i = 0; i < chain.samples.size(); ++i)
    EXPECT_NEAR(chain.samples[i].tip_eta, run.samples[125 * i].tip_eta, 5e-6);
}

TEST(ReferenceBeam, TorqueAsComputedElsewhere) {
  const double breaks[] = {2};
  const ReferenceMotion run = reference_torque(
      torque_beam(), SinePulse{6, 2},
      {.end = 3, .output_interval = 0.02, .tolerance = 1e-7, .breaks = breaks, .beam = coarse});
  ASSERT_EQ(run.status, Status::done) << run.message;
  const auto expected = figures("torque-tau0-6", "continuum.tip_eta_m"),
             theta = figures("torque-tau0-6", "continuum.theta_rad");
  for (int i = 1; i <= 6; ++i) {
    EXPECT_NEAR(run.samples[25 * i].tip_eta, expected[i - 1], 2e-5) << i;
    EXPECT_NEAR(run.samples[25 * i].angle, theta[i - 1], 2e-5) << i;
  }
  double largest_energy = 0;
  for (const Sample& s : run.samples) {
    largest_energy = std::max(largest_energy, s.kinetic + s.potential);
    EXPECT_NEAR(s.energy_balance(), 0, 1e-6 * largest_energy);
    if (s.time >= 2) {
      EXPECT_NEAR(s.angular_momentum, 0, 1e-7);
    }
  }
}

TEST(ReferenceBeam, RefusesWhatItDoesNotKnow) {
  Beam beam = torque_beam();
  beam.gravity = 9.81;
  EXPECT_NE(test::message([&] {
              reference_shape(beam, {0, 1});
            }).find("no shear, extension, gravity or damping"),
            std::string::npos);
  EXPECT_NE(test::message([&] {
              reference_frequencies(torque_beam(), 1, 0, {.degree = 30});
            }).find("degree 30 with 32 points"),
            std::string::npos);
  EXPECT_NE(test::message([&] {
              reference_motion(torque_beam(), SpinUp{1, 1}, {.end = 1});
            }).find("output interval 0 s"),
            std::string::npos);
}

}  // namespace
}  // namespace linkwright::flexible
