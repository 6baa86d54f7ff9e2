// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/serial_arm.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/serial_arm/serial_arm.h"
#include "linkwright/study/write.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using test::fact;
using test::keys;
using test::prepare;
using test::problems_of;
using test::run_text;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Parts of a good study, any of which a test may replace.
std::string study_text(const std::map<std::string, std::string>& changed = {}) {
  std::map<std::string, std::string> parts = {
      {"1 head", "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.serial_arm\"\n"},
      {"2 upper", "[[mechanism.link]]\nname = \"upper\"\nlength_m = 0.4\nmass_kg = 3\n"},
      {"3 fore",
       "[[mechanism.link]]\nname = \"fore\"\nlength_mm = 300\nmass_kg = 2\ninertia_kg_m2 = 0.02\n"
       "centre_distance_mm = 100\ncentre_angle_deg = 10\n"},
      {"4 payload", "[[mechanism.link.attached]]\nmass_kg = 1\ndistance_m = 0.3\n"},
      {"5 drive",
       "[[drive]]\nlink = \"upper\"\nlaw = \"cycloidal\"\nfrom_deg = 0\nto_deg = 90\nduration_s = 2\n"},
      {"6 drive", "[[drive]]\nlink = \"fore\"\nlaw = \"harmonic\"\namplitude_deg = 30\nfrequency_Hz = 0.5\n"},
      {"7 sweep", "[sweep.time]\nto_s = 2\nsamples = 5\n"}};
  return test::text_of(std::move(parts), changed);
}

std::string problems(const std::map<std::string, std::string>& changed) {
  return problems_of(study_text(changed));
}

study::Result run(const std::map<std::string, std::string>& changed = {}) {
  return run_text(study_text(changed));
}

TEST(SerialArmStudyRead, NamesWhatIsWrongWithTheLinks) {
  EXPECT_THAT(problems({{"2 upper", "[[mechanism.link]]\nname = \"upper\"\nlength_m = 0\nmass_kg = -1\n"}}),
              ::testing::AllOf(HasSubstr("mechanism.link[0].length_m: is 0 m, must be at least 1e-09 m"),
                               HasSubstr("mechanism.link[0].mass_kg: is -1 kg, must be at least 0 kg")));
  EXPECT_THAT(
      problems({{"2 upper", "[[mechanism.link]]\nname = \"upper arm\"\nlength_m = 1\nmass_kg = 1\n"}}),
      HasSubstr("name: is 'upper arm', must begin with a letter and contain letters, digits and _ only"));
  EXPECT_THAT(problems({{"2 upper", "[[mechanism.link]]\nname = \"fore\"\nlength_m = 1\nmass_kg = 1\n"}}),
              HasSubstr("mechanism.link[1].name: 'fore' is also the name of another link"));
  EXPECT_THAT(problems({{"2 upper", ""}, {"3 fore", ""}, {"4 payload", ""}}),
              HasSubstr("mechanism.link: this key is missing"));
  EXPECT_THAT(problems({{"2 upper", "link = []\n"}, {"3 fore", ""}, {"4 payload", ""}}),
              HasSubstr("mechanism.link: an arm has at least one link"));
  EXPECT_THAT(problems({{"4 payload", "[[mechanism.link.attached]]\nmass_kg = 1\n"}}),
              HasSubstr("mechanism.link[1].attached[0].distance_m: this key is missing"));
}

TEST(SerialArmStudyRead, NamesWhatIsWrongWithTheDrives) {
  EXPECT_THAT(problems({{"6 drive", "[[drive]]\nlink = \"for\"\nlaw = \"constant_speed\"\nspeed_rpm = 1\n"}}),
              ::testing::AllOf(HasSubstr("drive[1].link: there is no link 'for'; did you mean 'fore'?"),
                               ::testing::Not(HasSubstr("has no drive"))));
  EXPECT_THAT(problems({{"6 drive", ""}}),
              HasSubstr("drive: link 'fore' has no drive; add [[drive]] with link = \"fore\""));
  EXPECT_THAT(
      problems({{"6 drive", "[[drive]]\nlink = \"upper\"\nlaw = \"constant_speed\"\nspeed_rpm = 1\n"}}),
      HasSubstr("drive[1].link: 'upper' has a drive already"));
  EXPECT_THAT(problems({{"5 drive", ""}, {"6 drive", ""}}), HasSubstr("drive: this key is missing"));
  EXPECT_THAT(
      problems({{"6 drive", "[[drive]]\nlink = \"fore\"\nlaw = \"constant_speed\"\nspeed_m_per_s = 1\n"}}),
      HasSubstr("is an angular speed, but 'm_per_s' is not a unit of it"));
  EXPECT_THAT(problems({{"6 drive",
                         "[[drive]]\nlink = \"fore\"\nlaw = \"table\"\ntimes_s = [0, 1, 1]\n"
                         "values_deg = [0, 3, 5]\n"}}),
              HasSubstr("drive[1].times_s: must increase, but 1 s follows 1 s (row 3)"));
  EXPECT_THAT(
      problems({{"6 drive", "[[drive]]\nlink = \"fore\"\nlaw = \"table\"\ntimes_s = [0, 1, 2]\n"}}),
      ::testing::AllOf(HasSubstr("drive[1].values_rad: this key is missing"), Not(HasSubstr("rows"))));
  EXPECT_THAT(
      problems({{"6 drive", "[[drive]]\nlink = \"fore\"\nangle = \"relative\"\nlaw = \"harmonic\"\n"}}),
      HasSubstr("is 'relative', must be one of: absolute, joint"));
}

TEST(SerialArmStudyRead, NamesWhatIsWrongWithSweepAndOutput) {
  EXPECT_THAT(problems({{"7 sweep", "[sweep.time]\nfrom_s = 2\nto_s = 2\nsamples = 5\n"}}),
              HasSubstr("sweep.time.to_s: is 2 s, must be after 2 s, where the sweep begins"));
  EXPECT_THAT(problems({{"7 sweep", ""}}), HasSubstr("sweep: this key is missing"));
  EXPECT_THAT(
      problems({{"8 output", "[output]\nquantities = [\"torque\"]\n"}}),
      HasSubstr("'torque' is none of: position, rates, reactions, torques, power, energy; did you mean "
                "'torques'?"));
}

TEST(SerialArmStudyRead, LinksWithoutNamesAreNumberedAndUniform) {
  std::string messages;
  const auto study = prepare(study_text({{"2 upper", "[[mechanism.link]]\nlength_m = 0.4\nmass_kg = 3\n"},
                                         {"5 drive",
                                          "[[drive]]\nlink = \"link1\"\nlaw = \"constant_speed\"\n"
                                          "speed_rpm = 1\n"}}),
                             messages);
  ASSERT_TRUE(study) << messages;
  const Value& link = study->canonical.find("mechanism")->find("link")->as_array()[0];
  EXPECT_EQ(link.find("name")->as_string(), "link1");
  EXPECT_EQ(link.find("inertia_kg_m2")->as_number(), 3 * 0.4 * 0.4 / 12);
  EXPECT_EQ(link.find("centre_distance_m")->as_number(), 0.2);
}

TEST(SerialArmStudyRead, CanonicalStudyReadsBackToItself) {
  std::string messages;
  const auto first = prepare(study_text({{"8 output", "[output]\nquantities = [\"torques\"]\n"}}), messages);
  ASSERT_TRUE(first) << messages;
  const Value& drive = first->canonical.find("drive")->as_array()[0];
  EXPECT_EQ(drive.find("to_rad")->as_number(), pi / 2);
  EXPECT_EQ(drive.find("law")->as_string(), "cycloidal");
  const auto second = prepare(study::to_toml(first->canonical), messages);
  ASSERT_TRUE(second) << messages;
  EXPECT_EQ(first->canonical, second->canonical);
}

TEST(SerialArmStudyRead, ItsOwnExampleIsGood) {
  std::string messages;
  EXPECT_TRUE(prepare(serial_arm_kind().example, messages)) << messages;
}

TEST(SerialArmStudyRun, OfThePublishedArmPassesItsChecks) {
  const auto study = test::prepare_example(test::kinds(), "arm-pick-and-place.toml");
  ASSERT_TRUE(study);
  RunContext context;
  const study::Result result = study::run_study(*study, context);
  EXPECT_EQ(result.status, Status::done);
  EXPECT_THAT(result.diagnostics, IsEmpty());
  ASSERT_EQ(result.checks.size(), 5u);
  for (const study::Check& check : result.checks)
    EXPECT_TRUE(check.passed) << check.quantity << " " << check.value << check.message;
  EXPECT_EQ(fact(result, "largest force at O1").substr(0, 8), "5.8059 N");
  EXPECT_EQ(fact(result, "largest torque of upper arm, motor in the joint"), "1.9635 N m at 2.4 s");
  EXPECT_EQ(fact(result, "largest torque of upper arm, motor on the ground"), "-1.6802 N m at 6.1 s");
  // Rounding: the two routes differ by some 1e-15 of a watt.
  EXPECT_THAT(fact(result, "power balance"), ::testing::ContainsRegex("within [0-9.]+e-1[4-7] of"));
  EXPECT_THAT(to_string(result.headline), HasSubstr("The joint forces reach 5.8059 N at "));
  // Every plot finds its columns, and those over time follow the scene.
  const Table& sweep = result.tables[0];
  ASSERT_EQ(result.scenes.size(), 1u);
  EXPECT_EQ(result.scenes[0].input, sweep.columns[0].values);
  for (const study::Plot& plot : result.plots) {
    EXPECT_NE(sweep.find(plot.x), nullptr) << plot.name;
    for (const std::string& y : plot.y) EXPECT_NE(sweep.find(y), nullptr) << plot.name << " " << y;
    EXPECT_EQ(plot.scene, plot.x == "time_s" ? "motion" : "") << plot.name;
  }
}

TEST(SerialArmStudyRun, HasItsColumnsInOrder) {
  const study::Result result = run();
  EXPECT_THAT(keys(result.tables[0]), ElementsAreArray({"time_s",
                                                        "upper_angle_rad",
                                                        "fore_angle_rad",
                                                        "upper_speed_rad_per_s",
                                                        "fore_speed_rad_per_s",
                                                        "upper_acceleration_rad_per_s2",
                                                        "fore_acceleration_rad_per_s2",
                                                        "O1_x_N",
                                                        "O1_y_N",
                                                        "O2_x_N",
                                                        "O2_y_N",
                                                        "upper_torque_absolute_N_m",
                                                        "fore_torque_absolute_N_m",
                                                        "upper_torque_joint_N_m",
                                                        "fore_torque_joint_N_m",
                                                        "upper_power_absolute_W",
                                                        "fore_power_absolute_W",
                                                        "upper_power_joint_W",
                                                        "fore_power_joint_W",
                                                        "power_W",
                                                        "kinetic_energy_J",
                                                        "potential_energy_J",
                                                        "O2_x_m",
                                                        "O2_y_m",
                                                        "tip_x_m",
                                                        "tip_y_m",
                                                        "tip_speed_m_per_s",
                                                        "O1_N",
                                                        "O2_N"}));
  EXPECT_THAT(keys(run({{"8 output", "[output]\nquantities = [\"energy\"]\n"}}).tables[0]),
              ElementsAreArray({"time_s", "kinetic_energy_J", "potential_energy_J"}));
}

TEST(SerialArmStudyRun, ComputesWhatTheArmDoes) {
  const study::Result result = run();
  const Table& sweep = result.tables[0];
  const SerialArm arm{0, {{0.4, {3, 0.04, 0.2, 0}, {}}, {0.3, {2, 0.02, 0.1, pi / 18}, {{1, 0.3, 0}}}}};
  const std::vector<ArmElement> e = elements(arm);
  const math::MotionCurve upper(math::CycloidalMotion{0, pi / 2, 0, 2}),
      fore(math::HarmonicMotion{0, pi / 6, 0.5, 0});
  const std::vector<math::Motion> motion = {upper(1.5), fore(1.5)};
  std::vector<ArmLinkRates> r(2);
  std::vector<ArmJointLoads> loads(2);
  rates(e, 0, motion, r);
  reactions(e, r, 9.81, loads);
  const auto value = [&](std::string_view key) { return sweep.find(key)->values[3]; };
  EXPECT_NEAR(value("time_s"), 1.5, 1e-15);
  EXPECT_NEAR(value("O2_x_N"), loads[1].force.real(), 1e-12);
  EXPECT_NEAR(value("O1_y_N"), loads[0].force.imag(), 1e-12);
  EXPECT_NEAR(value("upper_torque_joint_N_m"), loads[0].joint_torque, 1e-12);
  EXPECT_NEAR(value("upper_torque_absolute_N_m"), loads[0].absolute_torque, 1e-12);
  EXPECT_NEAR(value("power_W"), energy_rate(e, r, 9.81), 1e-12);
  EXPECT_NEAR(value("upper_power_joint_W") + value("fore_power_joint_W"), value("power_W"), 1e-12);
  EXPECT_NEAR(value("upper_power_absolute_W") + value("fore_power_absolute_W"), value("power_W"), 1e-12);
  EXPECT_NEAR(value("kinetic_energy_J"), energy(e, r, 9.81).kinetic, 1e-14);
  EXPECT_NEAR(value("tip_x_m"), point(r[1], 0.3).position.real(), 1e-15);
}

TEST(SerialArmStudyRun, JointAnglesCountFromTheLinkBefore) {
  const study::Result result =
      run({{"6 drive",
            "[[drive]]\nlink = \"fore\"\nangle = \"joint\"\nlaw = \"harmonic\"\namplitude_deg = 30\n"
            "frequency_Hz = 0.5\n"}});
  const Table &joint = result.tables[0], absolute = run().tables[0];
  for (std::string_view key : {"angle_rad", "speed_rad_per_s", "acceleration_rad_per_s2"}) {
    const auto column = [&](const Table& table, const char* link) {
      return table.find(std::string(link) + "_" + std::string(key))->values[1];
    };
    EXPECT_NEAR(column(joint, "fore"), column(absolute, "fore") + column(absolute, "upper"), 1e-15) << key;
    EXPECT_EQ(column(joint, "upper"), column(absolute, "upper")) << key;
  }
}

TEST(SerialArmStudyRun, DrawsCounterweightsButNotThePayloadAtTheTip) {
  const study::Scene plain = run().scenes[0];
  ASSERT_EQ(plain.points.size(), 3u);
  EXPECT_EQ(plain.bodies.size(), 2u);
  EXPECT_EQ(plain.joints.back().name, "tip");
  const study::Scene balanced =
      run({{"4 payload", "[[mechanism.link.attached]]\nmass_kg = 6\ndistance_m = -0.15\n"}}).scenes[0];
  ASSERT_EQ(balanced.points.size(), 5u);
  ASSERT_EQ(balanced.circles.size(), 1u);
  EXPECT_EQ(balanced.circles[0].name, "6 kg");
  EXPECT_EQ(balanced.circles[0].centre, 3);
  EXPECT_NEAR(std::hypot(balanced.points[4].x[2] - balanced.points[3].x[2],
                         balanced.points[4].y[2] - balanced.points[3].y[2]),
              drawn_radius(6), 1e-15);
  EXPECT_EQ(balanced.bodies.back().points, (std::vector<int>{1, 3}));
  // Behind joint O2, opposite to the tip.
  const auto& p = balanced.points;
  EXPECT_NEAR(p[3].x[2] - p[1].x[2], -0.5 * (p[2].x[2] - p[1].x[2]), 1e-15);
  EXPECT_NEAR(p[3].y[2] - p[1].y[2], -0.5 * (p[2].y[2] - p[1].y[2]), 1e-15);
}

TEST(SerialArmStudyRun, CancelledRunKeepsItsFirstRows) {
  std::string messages;
  const auto study =
      prepare(study_text({{"7 sweep", "[sweep.time]\nto_s = 2\nsamples = 100000\n"}}), messages);
  ASSERT_TRUE(study) << messages;
  RunContext context;
  context.cancel();
  const study::Result result = study::run_study(*study, context);
  EXPECT_EQ(result.status, Status::cancelled);
  EXPECT_EQ(result.tables[0].rows(), 1024u);
}

// The same arm as any linkage: the same names and signs of joints, forces and angles, by another route.
TEST(SerialArmStudyRun, IsAnArmOfTheGeneralLinkage) {
  const std::string law = "law = \"harmonic\"\namplitude_deg = 30\nfrequency_Hz = 0.5\n";
  const study::Result arm = run({{"6 drive", "[[drive]]\nlink = \"fore\"\nangle = \"joint\"\n" + law}});
  const study::Result any = run_text(
      "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\n"
      "body = [ { name = \"ground\", points_m = { O1 = [0, 0] } },\n"
      "  { name = \"upper\", points_m = { O1 = [0, 0], O2 = [0.4, 0] }, mass_kg = 3, inertia_kg_m2 = 0.04, "
      "centre_m = [0.2, 0] },\n"
      "  { name = \"fore\", points_m = { O2 = [0, 0], tip = [0.3, 0] }, mass_kg = 2, inertia_kg_m2 = 0.02, "
      "centre_m = [0.09848077530122081, 0.01736481776669304], "
      "attached = [ { mass_kg = 1, at_m = [0.3, 0] } ] } ]\n"
      "joint = [ { name = \"O1\", first = \"ground.O1\", second = \"upper.O1\" },\n"
      "  { name = \"O2\", first = \"upper.O2\", second = \"fore.O2\" } ]\n"
      "[[drive]]\njoint = \"O1\"\nlaw = \"cycloidal\"\nfrom_deg = 0\nto_deg = 90\nduration_s = 2\n"
      "[[drive]]\njoint = \"O2\"\n" +
      law + "[sweep.time]\nto_s = 2\nsamples = 5\n");
  ASSERT_EQ(any.status, Status::done);
  for (const auto& [of_arm, of_any] : std::vector<std::pair<const char*, const char*>>{
           {"upper_angle_rad", "upper_angle_rad"},
           {"fore_angle_rad", "fore_angle_rad"},
           {"fore_speed_rad_per_s", "fore_speed_rad_per_s"},
           {"fore_acceleration_rad_per_s2", "fore_acceleration_rad_per_s2"},
           {"O1_x_N", "O1_x_N"},
           {"O1_y_N", "O1_y_N"},
           {"O2_x_N", "O2_x_N"},
           {"O2_y_N", "O2_y_N"},
           {"upper_torque_joint_N_m", "O1_drive_torque_N_m"},
           {"fore_torque_joint_N_m", "O2_drive_torque_N_m"},
           {"power_W", "drive_power_W"}}) {
    const Column *a = arm.tables[0].find(of_arm), *b = any.tables[0].find(of_any);
    ASSERT_TRUE(a && b) << of_arm;
    for (std::size_t i = 0; i < a->values.size(); ++i)
      EXPECT_NEAR(a->values[i], b->values[i], 1e-11) << of_arm << ' ' << i;
  }
}

}  // namespace
}  // namespace linkwright::planar
