// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/studies/drive.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/flexible/studies.h"

namespace linkwright::flexible {
namespace {

using test::kinds;

using linkwright::test::fact;
using linkwright::test::replaced;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string study_with(const std::string& law, bool shaped = false) {
  return "schema = 1\nkind = \"simulation\"\n[mechanism]\ntype = \"flexible.hub_link\"\nlength_m = "
         "1.8\ndensity_kg_per_m3 = 2766\narea_mm2 = 250\nsecond_moment_mm4 = 130.21\nelastic_modulus_GPa = "
         "69\ntip_mass_kg = 0.085\nhub_inertia_kg_m2 = 0.3\n[drive]\n" +
         law + (shaped ? "[drive.shaping]\n" : "") +
         "[simulation]\nend_s = 3\ndivisions = 2\ncompare_divisions = false\n[output]\nsamples = 301\n";
}

// Every law of joints and both torques, by words.
const std::vector<std::string> laws = {
    "law = \"constant_speed\"\nspeed_rpm = 20\n",
    "law = \"cycloidal\"\nfrom_deg = 10\nto_deg = 90\nstart_s = 0.2\nduration_s = 1\n",
    "law = \"polynomial_345\"\nfrom_deg = 10\nto_deg = 90\nduration_s = 1\nhigher_coefficients = [5]\n",
    "law = \"polynomial\"\nfrom_deg = 0\nto_deg = 50\nduration_s = 1\nstart_speed_rad_per_s = 0\n"
    "end_speed_rad_per_s = 1\n",
    "law = \"table\"\ntimes_s = [0, 0.3, 0.7, 1]\nvalues_deg = [0, 10, 30, 35]\nends = \"rest\"\n",
    "law = \"table\"\ntimes_s = [0, 0.3, 0.7, 1]\nvalues_deg = [0, 10, 30, 0]\ncurve = \"cubic\"\nends = "
    "\"periodic\"\n",
    "law = \"harmonic\"\namplitude_deg = 20\nfrequency_Hz = 0.4\n",
    "law = \"spin_up\"\nspeed_rad_per_s = 2\nduration_s = 1\n",
    "law = \"sine_torque\"\ntorque_N_m = 2\nduration_s = 1\n",
    "law = \"torque_table\"\ntimes_s = [0, 0.5, 0.6, 1]\ntorques_N_m = [0, 2, -2, 0]\n",
};

TEST(DriveStudy, EveryLawDrivesAndIsShaped) {
  for (const std::string& law : laws)
    for (const bool shaped : {false, true}) {
      const auto result = linkwright::test::run_text(kinds(), study_with(law, shaped));
      ASSERT_EQ(result.status, Status::done) << law << to_string(result.headline);
      const Table& motion = result.tables.front();
      const auto &balance = motion.find("energy_balance_J")->values,
                 &kinetic = motion.find("kinetic_energy_J")->values;
      double drift = 0, energy = 0;
      for (std::size_t i = 0; i < balance.size(); ++i) {
        drift = std::max(drift, std::abs(balance[i] - balance[0]));
        energy = std::max(energy, kinetic[i]);
      }
      // No jump of the speed that the work of the drive does not know, shaped or not. The integration of
      // the work is of fourth order but where accelerations jump.
      EXPECT_LT(drift, 2e-3 * energy) << law << shaped;
    }
}

TEST(DriveStudy, ShapingQuietensWhatMovesFromRestToRest) {
  for (const std::size_t i : {1u, 2u, 4u}) {
    const auto left = [&](bool shaped) {
      return std::stod(fact(linkwright::test::run_text(kinds(), study_with(laws[i], shaped)),
                            "vibration of the tip after the drive"));
    };
    EXPECT_LT(left(true), 0.25 * left(false)) << laws[i];
  }
}

TEST(DriveStudy, KnowsBreaksEndsAndStarts) {
  const DriveLaw turn = study::Driven<study::JointKind::rotary, math::CycloidalMotion>{{0.1, 2, 0.5, 1}};
  const JointDrive drive = joint_drive(turn, 10);
  EXPECT_THAT(drive.breaks, ElementsAre(0.5, 1.5));
  EXPECT_EQ(drive.quiet, 1.5);
  EXPECT_EQ(drive.angle, 0.1);
  EXPECT_EQ(drive.last, 2);
  EXPECT_FALSE(drive.free());
  const JointDrive even =
      joint_drive(study::Driven<study::JointKind::rotary, math::ConstantSpeed>{{0.5, 3}}, 2);
  EXPECT_EQ(even.quiet, 0);
  EXPECT_EQ(even.rate, 3);
  EXPECT_EQ(even.last, 6.5);
  EXPECT_FALSE(
      joint_drive(study::Driven<study::JointKind::rotary, math::HarmonicMotion>{{0, 1, 2, 0}}, 2).quiet);
  const JointDrive pushed = joint_drive(TorqueTableForm{.law = {{0.5, 1, 2}, {1, 2, 3}}, .angle = 0.3}, 9);
  EXPECT_THAT(pushed.breaks, ElementsAre(0.5, 1, 2));
  EXPECT_EQ(pushed.quiet, 2);
  EXPECT_EQ(pushed.last, 0.3);
  EXPECT_TRUE(joint_drive(FreeForm{0.2, 1}, 9).free());
  EXPECT_EQ(joint_drive(SpinUpForm{{2, 1}}, 3).last, 5);
}

TEST(DriveStudy, TellsWhatIsWrongWithALaw) {
  const auto problems = [](const std::string& law) {
    return linkwright::test::problems_of(kinds(), study_with(law));
  };
  EXPECT_THAT(problems("law = \"turn\"\n"), HasSubstr("drive.law: is 'turn', must be one of: spin_up, "));
  EXPECT_THAT(problems(""), HasSubstr("drive.law: this key is missing"));
  EXPECT_THAT(problems("law = \"table\"\ntimes_s = [0, 1, 1]\nvalues_deg = [0, 1, 2]\n"),
              HasSubstr("drive.times_s: must increase, but 1 s follows 1 s (row 3)"));
  EXPECT_THAT(problems("law = \"table\"\n"), HasSubstr("drive.times_s: this key is missing"));
  EXPECT_THAT(problems("law = \"polynomial\"\nfrom_deg = 0\nduration_s = 1\n"),
              HasSubstr("a start position alone is not a motion"));
  EXPECT_THAT(problems("law = \"torque_table\"\ntimes_s = [0, 1]\ntorques_N_m = [1]\n"),
              HasSubstr("drive.torques_N_m: has 1 torques for 2 times"));
  EXPECT_THAT(problems("law = \"torque_table\"\ntimes_s = [0, 2, 1]\ntorques_N_m = [1, 2, 3]\n"),
              HasSubstr("must increase, but 1 s follows 2 s (row 3)"));
}

}  // namespace
}  // namespace linkwright::flexible
