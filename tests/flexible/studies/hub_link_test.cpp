// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/studies/hub_link.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/memory.h"
#include "support/published.h"
#include "tests/flexible/studies.h"

namespace linkwright::flexible {
namespace {

using test::kinds;
using test::problems;
using test::run;

using linkwright::test::column;
using linkwright::test::fact;
using linkwright::test::replaced;
using ::testing::HasSubstr;
using ::testing::Not;

// Table 3.1 of Boskovic 2018, spun up to 4 rad/s.
const std::string spin_up =
    "schema = 1\nkind = \"simulation\"\n[mechanism]\ntype = \"flexible.hub_link\"\nlength_m = "
    "8\ndensity_kg_per_m3 = 2766.7\n"
    "area_m2 = 7.2968e-5\nsecond_moment_m4 = 8.2189e-9\nelastic_modulus_Pa = 6.8952e10\ntip_mass_kg = 0.085\n"
    "[drive]\nlaw = \"spin_up\"\nspeed_rad_per_s = 4\nduration_s = 15\n"
    "[simulation]\nend_s = 20\ndivisions = 4\ncompare_divisions = false\n[output]\nsamples = 9\n";

TEST(HubLinkStudy, SpinsUpAsComputedElsewhere) {
  const auto result = run(spin_up);
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  // Every 2.5 s; the tip as computed by generalised-alpha elsewhere, to its 1e-5 m and half of the last
  // digit.
  const std::vector<double> expected{0,         -0.173840, -0.512840, -0.620824, -0.396378,
                                     -0.112029, 0.003235,  -0.007508, -0.004467};
  const auto& tip = column(result, "tip_eta_m");
  ASSERT_EQ(tip.size(), expected.size());
  for (std::size_t i = 0; i < tip.size(); ++i) EXPECT_NEAR(tip[i], expected[i], 2e-5) << i;
  const auto& balance = column(result, "energy_balance_J");
  EXPECT_NEAR(balance.back(), balance.front(), 1e-3);
  EXPECT_THAT(fact(result, "frequencies at rest"),
              ::testing::MatchesRegex("0.4209, [0-9.e-]+, [0-9.e-]+ Hz"));
}

TEST(HubLinkStudy, TellsWhatTheDivisionsChange) {
  const auto result =
      run(replaced(replaced(spin_up, "compare_divisions = false\n", ""), "divisions = 4", "divisions = 2"));
  EXPECT_THAT(fact(result, "change of the tip with twice the divisions"),
              ::testing::MatchesRegex("[0-9.e-]+ mm"));
}

TEST(HubLinkStudy, TellsWhatThePrintedVelocitiesMiss) {
  const auto result = run(replaced(replaced(spin_up, "speed_rad_per_s = 4", "speed_rad_per_s = 16"),
                                   "divisions = 4", "divisions = 2\nkinematics = \"source_linearised\""));
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  // At 7.5 s -2.785605 m against -1.160206 m of exact kinematics, whose largest sample is -1.656991 m.
  EXPECT_THAT(
      fact(result, "difference of the tip from chord_consistent"),
      HasSubstr("1625 mm, 0.98 times its largest displacement: the printed velocities lack the stiffening"));
  EXPECT_EQ(result.tables.back().name, "chord_consistent");
  EXPECT_EQ(result.plots.front().baseline, "chord_consistent");
  for (const study::Fact& f : run(spin_up).facts)
    EXPECT_THAT(to_string(f.label), Not(HasSubstr("chord_consistent")));
}

TEST(HubLinkStudy, AgreesWithAnElastica) {
  const std::string beside =
      replaced(replaced(spin_up, "divisions = 4", "divisions = 8\ncompare_elastica = true"), "end_s = 20",
               "end_s = 5");
  const auto result = run(beside);
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  // 2e-6 m of the divisions at this speed, in mm.
  const std::string told = fact(result, "difference of the tip from an elastica");
  EXPECT_LT(std::stod(told), 5e-3) << told;
  EXPECT_GT(std::stod(told), 0) << told;
  EXPECT_EQ(result.tables.back().name, "elastica");
  EXPECT_EQ(result.plots.front().baseline, "elastica");
  EXPECT_THAT(
      problems(replaced(beside, "tip_mass_kg = 0.085", "tip_mass_kg = 0.085\ngravity_m_per_s2 = 9.81")),
      HasSubstr("compare_elastica: the elastica starts from rest, without shaping, and has no gravity"));
}

TEST(HubLinkStudy, ShapingLeavesLessVibration) {
  const std::string& example = kinds()[1].example;
  const auto amplitude = [](const study::Result& result) {
    return std::stod(fact(result, "vibration of the tip after the drive"));
  };
  const double shaped = amplitude(run(example));
  const double plain = amplitude(run(replaced(
      example,
      "[drive.shaping]                        # leave it out to see the vibration\nshaper = \"zv\"\n", "")));
  EXPECT_LT(shaped, 0.2 * plain);
  // And with damping of the material it dies away.
  const auto damped =
      run(replaced(example, "fibre_distance_mm", "stiffness_damping_s = 0.01\nfibre_distance_mm"));
  EXPECT_EQ(damped.status, Status::done);
  EXPECT_GT(column(damped, "dissipated_J").back(), 0);
}

TEST(HubLinkStudy, SwingsFreelyUnderGravity) {
  const auto result =
      run("schema = 1\nkind = \"simulation\"\n[mechanism]\ntype = \"flexible.hub_link\"\nlength_m = "
          "1\ndensity_kg_per_m3 = 7800\n"
          "area_mm2 = 100\nsecond_moment_mm4 = 833\nelastic_modulus_GPa = 210\nhub_inertia_kg_m2 = "
          "0.01\ngravity_m_per_s2 = 9.80665\n"
          "[drive]\nlaw = \"none\"\nangle_deg = -80\n[simulation]\nend_s = 2\nstep_s = 0.002\n");
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  // A rigid pendulum of m L^2/3 + J_H takes 2 pi sqrt(I / (m g L / 2)) = 1.657 s for small swings.
  const auto &angle = column(result, "hub_angle_rad"), &time = column(result, "time_s");
  double crossing = 0;
  for (std::size_t i = 1; i < time.size() && crossing == 0; ++i)
    if (angle[i - 1] > -M_PI / 2 && angle[i] <= -M_PI / 2) crossing = time[i];
  EXPECT_NEAR(4 * crossing, 1.657 * 1.002, 0.03);
  EXPECT_THAT(fact(result, "drift of the energy audit"),
              ::testing::MatchesRegex("[0-9.]+e-[0-9]+ J .[0-9.]+e-[0-9]+ of the peak."));
}

TEST(HubLinkStudy, RefusesMoreCellsAndSamplesThanThereIsMemoryFor) {
  const MemoryLimit limit(1e9);
  const std::string fine = replaced(spin_up, "divisions = 4", "divisions = 500");
  EXPECT_THAT(problems(replaced(fine, "samples = 9", "samples = 100000")),
              ::testing::AllOf(HasSubstr("output.samples: 100000 samples of 1000 cells would take "),
                               HasSubstr("at most 1 GB may be taken; take fewer samples or divisions")));
  std::string messages;
  EXPECT_TRUE(linkwright::test::prepare(kinds(), fine, messages)) << messages;
}

TEST(HubLinkStudy, TellsWhatIsWrong) {
  EXPECT_THAT(problems(replaced(spin_up, "elastic_modulus_Pa = 6.8952e10", "elastic_modulus_Pa = 0")),
              HasSubstr("mechanism.elastic_modulus_Pa: is 0 Pa, must be at least 1 Pa"));
  EXPECT_THAT(problems(replaced(spin_up, "length_m = 8", "length_m = -8")),
              HasSubstr("length_m: is -8 m, must be at least 1e-06 m"));
  EXPECT_THAT(problems(replaced(spin_up, "tip_mass_kg", "theory = \"timoshenko\"\ntip_mass_kg")),
              HasSubstr("shear modulus = 0 Pa: a Timoshenko beam needs a positive one"));
  EXPECT_THAT(problems(replaced(spin_up, "[simulation]", "[simulation]\nstep_s = 1e-7")),
              HasSubstr("at most 1e7 are allowed"));
  EXPECT_THAT(problems(replaced(replaced(spin_up, "tip_mass_kg", "gravity_m_per_s2 = 9\ntip_mass_kg"),
                                "[simulation]", "[simulation]\nkinematics = \"source_linearised\"")),
              HasSubstr("the printed equations have neither gravity nor damping"));
}

}  // namespace
}  // namespace linkwright::flexible
