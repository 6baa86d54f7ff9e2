// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/continuum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flexible/beams.h"
#include "support/message.h"

namespace linkwright::flexible {
namespace {

TEST(Continuum, PublishedBeamsByThreeTheories) {
  for (const std::string id : {"freq-T31", "freq-T32"}) {
    Beam beam =
        id == "freq-T31" ? spin_up_beam(Theory::euler_bernoulli) : torque_beam(Theory::euler_bernoulli);
    const auto compare = [&](const char* key) {
      const auto expected = figures(id, key), found = continuum_frequencies(beam, 3);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k] / expected[k], 1, 1e-10) << key;
    };
    compare("exact_EB_tip_mass_rad_s");
    const auto roots = figures(id, "exact_lambda"), found = continuum_frequencies(beam, 3);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(std::sqrt(found[k] / beam.frequency_scale()), roots[k], 1e-10);
    beam.theory = Theory::rayleigh;
    compare("rayleigh_continuum_rad_s");
    beam.theory = Theory::euler_bernoulli;
    beam.tip_mass = 0;
    compare("exact_EB_no_tip_mass_rad_s");
  }
  const auto expected = figures("timoshenko-stub", "exact_rad_s"), found = continuum_frequencies(stub(), 3);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k] / expected[k], 1, 1e-10);
}

TEST(Continuum, FrequencyEquationWithTipMass) {
  const Beam beam = spin_up_beam(Theory::euler_bernoulli);
  const double mu = beam.tip_mass / beam.mass();
  const auto found = continuum_frequencies(beam, 8);
  for (int k = 0; k < 8; ++k) {
    const double z = std::sqrt(found[k] / beam.frequency_scale());
    const double left =
        1 + std::cos(z) * std::cosh(z) + z * mu * (std::cos(z) * std::sinh(z) - std::sin(z) * std::cosh(z));
    EXPECT_NEAR(left / std::cosh(z), 0, 1e-11) << k;
  }
  // The eighth lies where its numbers grow to e^24: 7.5 pi of the plain cantilever, drawn down by the mass.
  EXPECT_NEAR(std::sqrt(found[7] / beam.frequency_scale()), 7.5 * 3.14159, 1);
}

TEST(Continuum, FreeHubs) {
  // A hub of great inertia, or held by a great spring, does not move; a pinned link without tip mass and hub
  // vibrates at tan z = tanh z, z = 3.926602.
  Beam beam = spin_up_beam(Theory::euler_bernoulli);
  beam.hub_radius = 0.5;
  const auto clamped = continuum_frequencies(beam, 2);
  beam.hub_inertia = 1e12;
  const auto heavy = continuum_frequencies(beam, 2, Hub::free);
  beam.hub_inertia = 0.1;
  beam.hub_stiffness = 1e12;
  const auto held = continuum_frequencies(beam, 2, Hub::free);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(heavy[k] / clamped[k], 1, 1e-9);
    EXPECT_NEAR(held[k] / clamped[k], 1, 1e-9);
  }
  beam.hub_stiffness = beam.hub_inertia = beam.hub_radius = beam.tip_mass = 0;
  const auto pinned = continuum_frequencies(beam, 1, Hub::free);
  EXPECT_NEAR(std::sqrt(pinned[0] / beam.frequency_scale()), 3.926602312047919, 1e-10);
}

TEST(Continuum, RefusesBeamsThatAreNone) {
  Beam beam = spin_up_beam();
  beam.area = 0;
  EXPECT_NE(test::message([&] { continuum_frequencies(beam, 1); }).find("area = 0 m2: it must be positive"),
            std::string::npos);
  EXPECT_NE(test::message([] { continuum_frequencies(spin_up_beam(), 0); }).find("0 frequencies"),
            std::string::npos);
}

TEST(Continuum, FrequenciesAlongTheLink) {
  Beam beam = stub();
  const double wave = std::sqrt(beam.elastic_modulus / beam.density);
  beam.tip_mass = 0;
  const auto bare = axial_frequencies(beam, 3);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(bare[k] / (wave * (k + 0.5) * 3.14159265358979), 1, 1e-14);
  // A heavy tip on a spring E A / L; a third of the link moves along: relative error (m / 3 m_p)^2 / 10.
  beam.tip_mass = 1e5 * beam.mass();
  EXPECT_NEAR(axial_frequencies(beam, 1)[0] / std::sqrt(beam.elastic_modulus * beam.area / beam.length /
                                                        (beam.tip_mass + beam.mass() / 3)),
              1, 1e-10);
}

}  // namespace
}  // namespace linkwright::flexible
