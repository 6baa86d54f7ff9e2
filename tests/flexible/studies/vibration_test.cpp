// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/studies/vibration.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "flexible/beams.h"
#include "linkwright/core/numbers.h"
#include "linkwright/flexible/continuum.h"
#include "linkwright/flexible/modes.h"
#include "linkwright/study/write.h"
#include "tests/flexible/studies.h"

namespace linkwright::flexible {
namespace {

using test::kinds;
using test::problems;
using test::run;

using linkwright::test::column;
using linkwright::test::fact;
using linkwright::test::lines_of;
using linkwright::test::replaced;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Table 3.1 of Boskovic 2018 without tip mass, whose frequencies are known over the speed.
const std::string bare =
    "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"flexible.hub_link\"\nlength_m = "
    "8\ndensity_kg_per_m3 = 2766.7\narea_m2 = 7.2968e-5\nsecond_moment_m4 = 8.2189e-9\nelastic_modulus_Pa = "
    "6.8952e10\n[vibration]\nmodes = 2\ndivisions = 4\n";

double scale() {
  Beam beam = spin_up_beam();
  beam.tip_mass = 0;
  return beam.frequency_scale();
}

TEST(VibrationStudy, CampbellDiagramOfThePublishedBeam) {
  const auto result = run(bare + "[campbell]\nto_rad_per_s = " + std::to_string(8 * scale()) +
                          "\nsamples = 9\norders = [1, 2.5]\n");
  ASSERT_EQ(result.status, Status::done) << lines_of(result.diagnostics);
  EXPECT_THAT(lines_of(result.diagnostics), IsEmpty());
  const auto& first = column(result, "campbell", "mode_1_rad_per_s");
  ASSERT_EQ(first.size(), 9u);
  int compared = 0;
  for (const Value& row : test::at(computed("rotating-frequency"), "table").as_array()) {
    const double eta = test::number_at(row, "eta");
    if (eta > 8) continue;
    // The speed is written to 1e-6 rad/s.
    EXPECT_NEAR(first[static_cast<std::size_t>(eta)] / scale(), test::number_at(row, "CC_n4"), 1e-6) << eta;
    ++compared;
  }
  EXPECT_GE(compared, 7);
  // A multiple of the speed that meets a frequency is that frequency.
  const auto &order = column(result, "crossings", "order"), &mode = column(result, "crossings", "mode"),
             &speed = column(result, "crossings", "speed_rad_per_s"),
             &rate = column(result, "crossings", "frequency_rad_per_s");
  Beam beam = spin_up_beam();
  beam.tip_mass = 0;
  ASSERT_EQ(order.size(), 2u);  // mode 1 by both
  for (std::size_t i = 0; i < 2; ++i) {
    const int k = static_cast<int>(mode[i]);
    EXPECT_EQ(k, 1);
    EXPECT_NEAR(rate[i], order[i] * speed[i], 1e-12);
    EXPECT_NEAR(modes(discretise(beam, 4), k, {.speed = speed[i]})[0].frequency, rate[i], 1e-9);
  }
  EXPECT_THAT(fact(result, "resonant speeds"), HasSubstr(" rad/s (mode 1 by 1 x), "));
  EXPECT_EQ(column(result, "campbell", "order_2_5_rad_per_s").back() /
                column(result, "campbell", "speed_rad_per_s").back(),
            2.5);
}

TEST(VibrationStudy, FrequenciesAgainstTheContinuum) {
  const auto result = run(replaced(bare, "divisions = 4", "divisions = 8") + "[load]\n");
  const Beam beam = [] {
    Beam b = spin_up_beam();
    b.tip_mass = 0;
    return b;
  }();
  const auto exact = continuum_frequencies(beam, 2);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(column(result, "frequencies", "continuum_Hz")[k] * 2 * pi, exact[k], 1e-9);
    EXPECT_NEAR(column(result, "frequencies", "continuum_error")[k], 0, 1e-3);
    EXPECT_LT(std::abs(column(result, "frequencies", "finer_change")[k]),
              1.1 * std::abs(column(result, "frequencies", "continuum_error")[k]) + 1e-9);
  }
  // Too coarse: reported.
  const auto coarse =
      run(replaced(replaced(bare, "divisions = 4", "divisions = 1"), "modes = 2", "modes = 3"));
  EXPECT_THAT(
      lines_of(coarse.diagnostics),
      HasSubstr("vibration.divisions: mode 1 is 1.1 % off the continuum, 0.4686 Hz against 0.4633 Hz"));
  // Shapes and their scenes: the weld stays, the largest deflection is 1 m in the table.
  EXPECT_EQ(result.scenes.size(), 2u);
  EXPECT_THAT(to_string(result.scenes[0].title), ::testing::MatchesRegex("mode 1, 0.463[0-9]? Hz"));
  const auto& eta = column(result, "shapes", "mode_2_eta_m");
  EXPECT_EQ(eta.front(), 0);
  double largest = 0;
  for (const double e : eta) largest = std::max(largest, std::abs(e));
  EXPECT_NEAR(largest, 1, 1e-12);
  // Nothing on it: nothing bends.
  EXPECT_EQ(column(result, "deflection", "eta_m").back(), 0);
}

TEST(VibrationStudy, WarnsWhereTheChainLosesItsStability) {
  const double known =
      test::number_at(computed("rotating-frequency"), "HX_spurious_critical_speed_T31_rad_s.2");
  const auto result = run(replaced(bare, "modes = 2\ndivisions = 4",
                                   "modes = 2\ndivisions = 2\nkinematics = "
                                   "\"hub_axis\"") +
                          "[campbell]\nto_rad_per_s = 20\n");
  // The case has the published tip mass.
  const auto with_tip = run(replaced(replaced(bare, "modes = 2\ndivisions = 4",
                                              "modes = 2\ndivisions = 2\nkinematics = \"hub_axis\""),
                                     "elastic_modulus_Pa", "tip_mass_kg = 0.085\nelastic_modulus_Pa") +
                            "[campbell]\nto_rad_per_s = 20\n");
  EXPECT_EQ(result.status, Status::singular);
  EXPECT_EQ(with_tip.status, Status::singular);
  EXPECT_THAT(lines_of(with_tip.diagnostics),
              HasSubstr("campbell.to: the straight chain loses its stability at " +
                        fmt::format("{:.5g}", known) + " rad/s"));
  EXPECT_THAT(lines_of(with_tip.diagnostics),
              HasSubstr("take kinematics = \"chord_consistent\", or more divisions"));
  EXPECT_TRUE(std::isnan(column(with_tip, "campbell", "mode_1_rad_per_s").back()));
  EXPECT_FALSE(std::isnan(column(with_tip, "campbell", "mode_1_rad_per_s").front()));
  EXPECT_THAT(to_string(with_tip.headline), HasSubstr("The chain loses its stability at"));
}

TEST(VibrationStudy, LargeDeflection) {
  // The elastica of the reference: P L^2 / E I = 2, across the link.
  const Beam beam = spin_up_beam();
  const auto result = run(bare + "[load]\nforce_N = [0, " +
                          fmt::format("{:.17g}", 2 * beam.bending_stiffness() / 64) + "]\n");
  const auto expected = figures("static-elastica", "PL2_EI_2.CC_n4");
  // The equilibrium of the same chain, found elsewhere.
  EXPECT_NEAR(column(result, "deflection", "angle_rad").back(), expected[0], 1e-8);
  EXPECT_NEAR(-column(result, "deflection", "xi_m").back() / 8, expected[1], 1e-8);
  EXPECT_NEAR(column(result, "deflection", "eta_m").back() / 8, expected[2], 1e-8);
  EXPECT_NEAR(column(result, "deflection", "linear_eta_m").back(),
              tip_deflection(beam, 2 * beam.bending_stiffness() / 64), 1e-6);
  // Moments: zero at the tip, force by its arm at the weld.
  const auto& moment = column(result, "sections", "moment_N_m");
  EXPECT_NEAR(moment.back(), 0, 1e-9);
  EXPECT_NEAR(std::abs(moment.front()),
              2 * beam.bending_stiffness() / 64 * (8 + column(result, "deflection", "xi_m").back()), 1e-4);
  // And in between by the arm that is left; cut 4 of 8 joints lies at 3.5 m, half of the way between nodes.
  const auto& position = column(result, "sections", "position_m");
  const auto &along = column(result, "deflection", "xi_m"),
             &node = column(result, "deflection", "position_m");
  ASSERT_EQ(position[4], 3.5);
  EXPECT_NEAR(
      std::abs(moment[4]),
      2 * beam.bending_stiffness() / 64 * (8 + along.back() - (node[3] + along[3] + node[4] + along[4]) / 2),
      1e-6);
  EXPECT_NEAR(std::hypot(column(result, "sections", "axial_N")[4], column(result, "sections", "shear_N")[4]),
              2 * beam.bending_stiffness() / 64, 1e-9);
  EXPECT_THAT(fact(result, "change of the tip with 8 divisions"), ::testing::MatchesRegex("[0-9.e-]+ mm"));
  EXPECT_THAT(to_string(result.headline), HasSubstr("Under the load the tip moves by"));
  // Along the link: Euler's load is pi^2 E I / (4 L^2), and beyond it the straight link has buckled.
  const auto buckled = run(bare + "[load]\nforce_N = [-30, 0]\n");
  EXPECT_THAT(lines_of(buckled.diagnostics), HasSubstr("it has buckled"));
}

TEST(VibrationStudy, GravityAndSpeedHoldTheLink) {
  const std::string heavy =
      replaced(bare, "elastic_modulus_Pa", "gravity_m_per_s2 = 1.0\nelastic_modulus_Pa");
  const auto result = run(heavy);
  // w L^4 / 8 E I for a small weight.
  const Beam beam = spin_up_beam();
  const double linear = beam.density * beam.area * std::pow(8, 4) / (8 * beam.bending_stiffness());
  EXPECT_NEAR(column(result, "deflection", "eta_m").back(), -linear, 0.01 * linear);
  EXPECT_EQ(fact(result, "left out of the frequencies"), "gravity");
  const auto turning = run(heavy + "[load]\nspeed_rad_per_s = 4\n");
  EXPECT_LT(std::abs(column(turning, "deflection", "eta_m").back()),
            0.8 * std::abs(column(result, "deflection", "eta_m").back()));
  const auto hanging = run(heavy + "[load]\nangle_deg = -90\n");
  EXPECT_NEAR(column(hanging, "deflection", "eta_m").back(), 0, 1e-9);
}

TEST(VibrationStudy, FreeHubsAndLinksThatStretch) {
  const std::string free =
      replaced(replaced(bare, "elastic_modulus_Pa", "hub_inertia_kg_m2 = 0.3\nelastic_modulus_Pa"),
               "divisions = 4", "divisions = 8\nhub = \"free\"");
  const auto result = run(free);
  EXPECT_EQ(column(result, "frequencies", "frequency_Hz").front(), 0);
  EXPECT_EQ(column(result, "frequencies", "continuum_Hz").front(), 0);
  EXPECT_NEAR(column(result, "frequencies", "continuum_error").back(), 0, 1e-3);
  EXPECT_EQ(column(result, "frequencies", "hub_angle_rad").front(), 1);
  EXPECT_EQ(result.scenes[0].title, "mode 1: turns freely");
  EXPECT_THAT(lines_of(result.diagnostics), IsEmpty());
  // A short thick link stretches at a frequency among its first ones.
  const auto thick =
      run("schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"flexible.hub_link\"\nlength_m = "
          "1\ndensity_kg_per_m3 "
          "= 7800\narea_m2 = 0.01\nsecond_moment_m4 = 3.3333e-5\nelastic_modulus_Pa = 2.1e11\ntip_mass_kg = "
          "20\nextensible "
          "= true\n[vibration]\nmodes = 3\ndivisions = 16\n");
  EXPECT_THAT(lines_of(thick.diagnostics), IsEmpty());
  EXPECT_NEAR(column(thick, "frequencies", "continuum_error").back(), 0, 0.01);
}

TEST(VibrationStudy, WritesWhatItReads) {
  for (const std::string& text : {vibration_kind().example, bare}) {
    std::string problem;
    const auto first = linkwright::test::prepare(kinds(), text, problem);
    ASSERT_TRUE(first) << problem;
    const std::string written = study::to_toml(first->canonical);
    const auto again = linkwright::test::prepare(kinds(), written, problem);
    ASSERT_TRUE(again) << problem << written;
    EXPECT_EQ(study::to_toml(again->canonical), written);
  }
}

TEST(VibrationStudy, NamesWhatIsWrong) {
  EXPECT_THAT(
      problems(replaced(replaced(bare, "modes = 2", "modes = 20"), "divisions = 4", "divisions = 2")),
      HasSubstr("vibration.modes: a link of 2 divisions has 8 modes, 20 are asked for; take more divisions"));
  EXPECT_THAT(problems(bare + "[campbell]\nfrom_rpm = 10\nto_rpm = 10\n"),
              HasSubstr("campbell.to_rpm: the speeds end at 10 rpm, where they begin or before"));
  EXPECT_THAT(problems(bare + "[campbell]\nsamples = 10\n"),
              HasSubstr("campbell.to_rad_per_s: this key is missing"));
  EXPECT_THAT(problems(bare + "[campbell]\nto_rpm = 10\norders = [0]\n"), HasSubstr("must be more than 0"));
  EXPECT_THAT(problems(replaced(bare, "divisions = 4", "divisions = 4\nkinematics = \"source_linearised\"") +
                       "[load]\nforce_N = [0, 1]\n"),
              HasSubstr("the printed equations have neither gravity nor damping nor stretching"));
  EXPECT_THAT(problems(replaced(replaced(bare, "[vibration]",
                                         "extensible = true\nhub_inertia_kg_m2 = 1\n[vibration]"),
                                "divisions = 4", "divisions = 4\nhub = \"free\"") +
                       "[campbell]\nto_rpm = 10\n"),
              HasSubstr("the frequencies of an extensible link on a free hub that turns are not known"));
  EXPECT_THAT(problems(replaced(bare, "length_m = 8", "length_m = -8")),
              HasSubstr("mechanism.length_m: is -8 m, must be at least "));
}

}  // namespace
}  // namespace linkwright::flexible
