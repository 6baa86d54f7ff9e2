// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/studies/chain.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/flexible/studies.h"

namespace linkwright::flexible {
namespace {

using test::problems;
using test::run;

using linkwright::test::fact;
using linkwright::test::replaced;
using ::testing::HasSubstr;

// A steel link held level in gravity: m = 0.78 kg/m, E I = 1749 N m2.
const std::string level =
    "schema = 1\nkind = \"simulation\"\n[mechanism]\ntype = \"flexible.hub_link\"\nlength_m = "
    "1\ndensity_kg_per_m3 = 7800\narea_mm2 = 100\nsecond_moment_mm4 = 833\nelastic_modulus_GPa = "
    "210\ngravity_m_per_s2 = 9.80665\n[drive]\nlaw = \"polynomial_345\"\nfrom_deg = 0\nto_deg = "
    "0\nduration_s = 0.1\n[simulation]\nend_s = 0.2\nstep_s = 0.001\n[output]\nsamples = 101\n";

TEST(ChainStudy, StartsStraightOrAsTheWeightBends) {
  // Beam under its own weight: w L^4 / (8 E I); it stays so from the start, or swings about it by as much.
  const double sag = 0.78 * 9.80665 / (8 * 210e9 * 833e-12);
  const auto hanging = run(replaced(level, "[simulation]", "[simulation]\nstart = \"equilibrium\""));
  ASSERT_EQ(hanging.status, Status::done);
  for (const double eta : hanging.tables[0].find("tip_eta_m")->values) EXPECT_NEAR(eta, -sag, 1e-3 * sag);
  const auto fallen = run(level);
  const auto& dropped = fallen.tables[0].find("tip_eta_m")->values;
  EXPECT_NEAR(*std::min_element(dropped.begin(), dropped.end()), -2 * sag, 0.1 * sag);
  EXPECT_THAT(fact(hanging, "change of the tip with twice the divisions"),
              ::testing::MatchesRegex("[0-9.e-]+ mm"));
}

TEST(ChainStudy, WarnsOfLongStepsAndRefusesAbsurdOnes) {
  // First vibration: 3.516 / (2 pi) sqrt(E I / (m L^4)) = 8.38 Hz.
  const auto result = run(replaced(level, "step_s = 0.001", "step_s = 0.02"));
  ASSERT_FALSE(result.diagnostics.empty());
  EXPECT_THAT(to_string(result.diagnostics[0].message), HasSubstr("the first vibration of 8.38"));
  EXPECT_THAT(problems(replaced(level, "step_s = 0.001", "step_s = 2")),
              HasSubstr("simulation.step_s: is 2 s, longer than the 0.2 s of the motion"));
  EXPECT_THAT(problems(replaced(level, "step_s = 0.001", "step_s = 1e-9")),
              HasSubstr("makes 2e+08 steps, at most 1e7 are allowed"));
}

TEST(ChainStudy, ShapesDrivesForModesThatAreThere) {
  const std::string few = replaced(level, "[simulation]", "[simulation]\ndivisions = 1");
  EXPECT_THAT(problems(replaced(few, "[simulation]", "[drive.shaping]\nmode = 5\n[simulation]")),
              HasSubstr("is for mode 5, but there are 4"));
  EXPECT_THAT(problems(replaced(replaced(level,
                                         "law = \"polynomial_345\"\nfrom_deg = 0\nto_deg = "
                                         "0\nduration_s = 0.1\n",
                                         "law = \"none\"\n"),
                                "[simulation]", "[drive.shaping]\n[simulation]")),
              HasSubstr("there is no drive to be shaped"));
}

TEST(ChainStudy, KeepsWhatWasReached) {
  // A rod of rubber folds under its weight.
  const auto result = run(replaced(replaced(level, "elastic_modulus_GPa = 210", "elastic_modulus_kPa = 1000"),
                                   "end_s = 0.2", "end_s = 2"));
  EXPECT_EQ(result.status, Status::limit_reached);
  EXPECT_THAT(to_string(result.headline), HasSubstr("the chain folded"));
  EXPECT_GT(result.tables[0].rows(), 1u);
  EXPECT_LT(result.tables[0].rows(), 101u);
  ASSERT_EQ(result.scenes.size(), 1u);
  EXPECT_EQ(result.scenes[0].input.size(), result.tables[0].rows());
}

TEST(ChainStudy, DrawsTheBendingAsAsked) {
  EXPECT_THAT(to_string(run(level).scenes[0].title), HasSubstr("bending drawn 2"));
  EXPECT_THAT(to_string(run(replaced(level, "end_s", "deflection_scale = 3.5\nend_s")).scenes[0].title),
              HasSubstr("bending drawn 3.5 x"));
}

}  // namespace
}  // namespace linkwright::flexible
