// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/modes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flexible/beams.h"
#include "linkwright/flexible/continuum.h"
#include "support/message.h"

namespace linkwright::flexible {
namespace {

using enum Kinematics;

TEST(Modes, ChainsOfThePublishedBeams) {
  for (const std::string id : {"freq-T31", "freq-T32"})
    for (const Theory theory : {Theory::rayleigh, Theory::timoshenko}) {
      const Beam beam = id == "freq-T31" ? spin_up_beam(theory) : torque_beam(theory);
      const bool shear = theory == Theory::timoshenko;
      const Value& by_n =
          test::at(computed(id), shear ? "chain_timoshenko_nu03_k56_rad_s" : "chain_rayleigh_rad_s");
      int compared = 0;
      for (const int n : {1, 2, 3, 4, 8}) {
        const Value* known = by_n.find(std::to_string(n));
        if (!known) continue;
        const auto expected = test::numbers(*known);
        for (const Kinematics kinematics : {chord_consistent, hub_axis, source_linearised}) {
          const auto found = modes(discretise(beam, n, kinematics), 3);
          for (int k = 0; k < 3; ++k, ++compared) {
            // The figures come from a general eigenvalue routine, which loses digits of the first mode to the
            // largest eigenvalue of the chain, 1e9 times as large.
            EXPECT_NEAR(found[k].frequency / expected[k], 1, 1e-7) << id << " n=" << n << " mode " << k;
            EXPECT_EQ(found[k].growth, 0);
          }
        }
      }
      EXPECT_GE(compared, 36);
    }
}

TEST(Modes, ShearAndTipInertiaOfAShortBeam) {
  for (const int n : {2, 4, 8, 16}) {
    const auto expected = figures("timoshenko-stub", "chain_rad_s." + std::to_string(n));
    const auto found = modes(discretise(stub(), n), 3);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k].frequency / expected[k], 1, 1e-9) << n;
  }
}

TEST(Modes, ConvergeToTheContinuum) {
  // Hub driven and free. Simpson's masses give the first mode with n^-4; n^-2 with shear or rotary inertia at
  // the tip, and on a free hub. At n = 200, 400 cells whose joints are 1e11 times as stiff as the mode, 1e-6
  // is left.
  for (const Hub hub : {Hub::driven, Hub::free})
    for (const Beam& beam : {spin_up_beam(Theory::euler_bernoulli), torque_beam(), stub()}) {
      const auto exact = continuum_frequencies(beam, 3, hub);
      const int rigid = hub == Hub::free ? 1 : 0;
      const auto error = [&](int n, int k) {
        const auto found = modes(discretise(beam, n), k + rigid, {.hub = hub});
        if (rigid) {
          EXPECT_EQ(found[0].frequency, 0);
        }
        return std::abs(found.back().frequency / exact[k - 1] - 1);
      };
      EXPECT_LT(error(16, 1), error(4, 1) / 12);
      EXPECT_LT(error(16, 1), 1e-4);
      EXPECT_LT(error(200, 1), 1e-6);
      EXPECT_LT(error(200, 3), 2e-5);
    }
}

TEST(Modes, FrequenciesOnATurningHub) {
  Beam beam = spin_up_beam();
  beam.tip_mass = 0;
  const double scale = beam.frequency_scale();
  struct {
    const char* key;
    Kinematics kinematics;
    int n;
  } columns[] = {{"SL_n2", source_linearised, 2}, {"SL_n4", source_linearised, 4},
                 {"HX_n2", hub_axis, 2},          {"HX_n4", hub_axis, 4},
                 {"HX_n8", hub_axis, 8},          {"CC_n2", chord_consistent, 2},
                 {"CC_n4", chord_consistent, 4},  {"CC_n8", chord_consistent, 8}};
  int unstable = 0;
  for (const Value& row : test::at(computed("rotating-frequency"), "table").as_array()) {
    const double speed = test::number_at(row, "eta") * scale;
    for (const auto& column : columns) {
      const Mode found = modes(discretise(beam, column.n, column.kinematics), 1, {.speed = speed})[0];
      const Value& known = test::at(row, column.key);
      if (known.is_null()) {
        EXPECT_EQ(found.frequency, 0);
        EXPECT_GT(found.growth, 0);
        ++unstable;
      } else {
        EXPECT_NEAR(found.frequency / scale, known.as_number(), 1e-7)
            << column.key << " at " << speed / scale;
        EXPECT_EQ(found.growth, 0);
      }
    }
    // The chain against the beam itself, as it is to be for four divisions up to 12 w_s.
    const double cc = modes(discretise(beam, 4), 1, {.speed = speed})[0].frequency / scale;
    EXPECT_NEAR(cc / test::number_at(row, "reference_inplane"), 1, 1e-3);
  }
  EXPECT_EQ(unstable, 1);
}

TEST(Modes, SpuriousCriticalSpeeds) {
  const Beam beam = spin_up_beam();
  for (const int n : {2, 3, 4, 8}) {
    const auto found = critical_speed(discretise(beam, n, hub_axis), 100);
    ASSERT_TRUE(found) << n;
    const double expected = test::number_at(computed("rotating-frequency"),
                                            "HX_spurious_critical_speed_T31_rad_s." + std::to_string(n));
    EXPECT_NEAR(*found / expected, 1, 1e-8) << n;
  }
  for (const int n : {2, 3, 4, 8, 50})
    EXPECT_EQ(critical_speed(discretise(beam, n), 24 * beam.frequency_scale()), std::nullopt) << n;
}

TEST(Modes, ExtensionAndBendingJoinOnATurningHub) {
  // One cell of a massless beam with a tip mass would be a point on two springs; here the first mode of the
  // extensible link against the inextensible one: they differ by the share of the axial stiffness.
  Beam beam = kane_beam();
  const double rigid = modes(discretise(
                                 [&] {
                                   Beam b = beam;
                                   b.extensible = false;
                                   return b;
                                 }(),
                                 8),
                             1, {.speed = 6})[0]
                           .frequency;
  const double soft = modes(discretise(beam, 8), 1, {.speed = 6})[0].frequency;
  EXPECT_NEAR(soft / rigid, 1, 1e-3);
  EXPECT_NE(soft, rigid);
  EXPECT_NE(test::message([&] {
              modes(discretise(beam, 2), 1, {.speed = 6, .hub = Hub::free});
            }).find("extensible link on a free hub that turns at 6 rad/s"),
            std::string::npos);
}

TEST(Modes, ShapeOfTheFirstMode) {
  // A uniform cantilever without tip mass, from its closed form (z = 1.875104, its ratio 0.734096).
  Beam beam = spin_up_beam(Theory::euler_bernoulli);
  beam.tip_mass = 0;
  const ModeShape found = mode_shape(discretise(beam, 8), 1);
  const double z = 1.8751040687119611, ratio = 0.7340955137589128;
  const auto line = [&](double s) {
    return std::cosh(s) - std::cos(s) - ratio * (std::sinh(s) - std::sin(s));
  };
  ASSERT_EQ(found.link.eta.size(), 17);
  for (int j = 0; j <= 16; ++j) EXPECT_NEAR(found.link.eta[j], line(z * j / 16) / line(z), 1e-5);
  const ModeShape turning = mode_shape(discretise(torque_beam(), 4), 1, {.hub = Hub::free});
  EXPECT_NEAR(turning.hub_angle, 1, 1e-12);
  for (const double eta : turning.link.eta) EXPECT_NEAR(eta, 0, 1e-6);
  // Angular momentum of a free vibration is zero.
  const Chain chain = discretise(torque_beam(), 4);
  const ModeShape second = mode_shape(chain, 2, {.hub = Hub::free});
  double momentum = (chain.hub_inertia + chain.root_inertia + chain.root_mass * 0.0025) * second.hub_angle;
  double largest = momentum;
  for (int s = 0; s < 8; ++s) {
    const double x = 0.05 + 1.8 * (s + 1) / 8;
    momentum += chain.cells[s].mass * x * (x * second.hub_angle + second.link.eta[s + 1]) +
                chain.cells[s].inertia * (second.hub_angle + second.link.angle[s + 1]);
  }
  EXPECT_NEAR(momentum, 0, 1e-7 * std::abs(largest));
}

TEST(Modes, CampbellDiagram) {
  Beam beam = spin_up_beam();
  beam.tip_mass = 0;
  const double scale = beam.frequency_scale();
  const Table table = campbell(discretise(beam, 2, hub_axis), std::vector{0.0, 10 * scale, 12 * scale}, 2);
  ASSERT_EQ(table.rows(), 3);
  EXPECT_EQ(table.columns[1].key, "mode_1_rad_per_s");
  EXPECT_NEAR(table.columns[1].values[1] / scale, 2.58624, 5e-6);
  EXPECT_TRUE(std::isnan(table.columns[1].values[2]));
  EXPECT_FALSE(std::isnan(table.columns[2].values[2]));
  EXPECT_EQ(table.status, (std::vector<std::string>{"done", "done", "singular"}));
}

TEST(Modes, RefuseMoreThanThereAre) {
  EXPECT_EQ(modes(discretise(spin_up_beam(), 1), 4).size(), 4);
  EXPECT_NE(
      test::message([] { modes(discretise(spin_up_beam(), 1), 5); }).find("mode 5 of a chain that has 4"),
      std::string::npos);
  // Without rotary inertia half of the coordinates have no frequency of their own.
  EXPECT_NE(test::message([] {
              modes(discretise(spin_up_beam(Theory::euler_bernoulli), 1), 3);
            }).find("mode 3 of a chain that has 2"),
            std::string::npos);
}

}  // namespace
}  // namespace linkwright::flexible
