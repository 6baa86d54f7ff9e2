// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/studies/arm.h"

#include <gmock/gmock.h>

#include <cmath>

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

const std::string& example() { return kinds()[0].example; }

std::string link(const std::string& more, const std::string& length = "0.9",
                 const std::string& modulus = "6.9e10") {
  return "[[mechanism.link]]\nlength_m = " + length +
         "\ndensity_kg_per_m3 = 2766\narea_mm2 = 250\nsecond_moment_mm4 = 130.21\nelastic_modulus_Pa = " +
         modulus + "\n" + more;
}
const std::string head =
    "schema = 1\nkind = \"simulation\"\n[mechanism]\ntype = \"flexible.arm\"\nhub_radius_m = "
    "0.05\nhub_inertia_kg_m2 = 0.3\n";
const std::string pulse =
    "[[drive]]\nlink = \"link1\"\nlaw = \"sine_torque\"\ntorque_N_m = 4\nduration_s = 1\n";
const std::string times =
    "[simulation]\nend_s = 1.5\nstep_s = 0.005\ncompare_divisions = false\n[output]\nsamples = 31\n";

TEST(ArmStudy, WeldedHalvesAreOneLink) {
  const auto halves =
      run(head + link("divisions = 2\n") + link("tip_mass_kg = 0.085\ndivisions = 2\n") + pulse + times);
  ASSERT_EQ(halves.status, Status::done) << to_string(halves.headline);
  const auto whole =
      run("schema = 1\nkind = \"simulation\"\n[mechanism]\ntype = \"flexible.hub_link\"\nhub_radius_m = "
          "0.05\nhub_inertia_kg_m2 = 0.3\nlength_m = 1.8\ndensity_kg_per_m3 = 2766\narea_mm2 = "
          "250\nsecond_moment_mm4 = 130.21\nelastic_modulus_Pa = 6.9e10\ntip_mass_kg = 0.085\n"
          "[drive]\nlaw = \"sine_torque\"\ntorque_N_m = 4\nduration_s = 1\n" +
          replaced(times, "[output]", "divisions = 4\n[output]"));
  ASSERT_EQ(whole.status, Status::done);
  const auto compare = [&](const char* of_arm, const char* of_link, double tolerance) {
    const auto &a = column(halves, of_arm), &b = column(whole, of_link);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], tolerance) << of_arm << " " << i;
  };
  // The arm takes the tip from the extrapolated chain, the link extrapolates the tip: both to the error of
  // the integration, some 1e-6 m. All else is the same computation.
  compare("tip_across_m", "tip_eta_m", 1e-5);
  compare("hub_angle_rad", "hub_angle_rad", 1e-12);
  compare("hub_moment_N_m", "moment_N_m", 1e-9);
  compare("kinetic_energy_J", "kinetic_energy_J", 1e-9);
  // At the weld, halfway, the link bends less than at the hub.
  EXPECT_LT(std::abs(column(halves, "link2_weld_moment_N_m")[10]),
            std::abs(column(halves, "hub_moment_N_m")[10]));
}

// Two stiff links turned by cycloidal laws in gravity against Lagrange's equations of two rigid bodies.
TEST(ArmStudy, StiffLinksNeedTheTorquesOfRigidOnes) {
  const double l1 = 0.6, l2 = 0.4, g = 9.81, pi = M_PI;
  // Bending stiffness 1e7 N m2, without rotary inertia.
  const auto stiff = [](const std::string& more, const std::string& length) {
    return replaced(link("theory = \"euler_bernoulli\"\n" + more, length, "1e15"), "130.21", "1e4");
  };
  const auto result =
      run("schema = 1\nkind = \"simulation\"\n[mechanism]\ntype = \"flexible.arm\"\nhub_inertia_kg_m2 = "
          "0.3\ngravity_m_per_s2 = 9.81\n" +
          stiff("divisions = 1\n", "0.6") +
          stiff("tip_mass_kg = 0.3\ndivisions = 1\n[mechanism.link.hinge]\nmass_kg = 0.2\n", "0.4") +
          "[[drive]]\nlink = \"link1\"\nlaw = \"cycloidal\"\nfrom_deg = 0\nto_deg = 60\nduration_s = 1\n"
          "[[drive]]\nlink = \"link2\"\nlaw = \"cycloidal\"\nfrom_deg = 90\nto_deg = 30\nduration_s = 1\n" +
          "[simulation]\nstart = \"equilibrium\"\nend_s = 1\nstep_s = 0.002\ncompare_divisions = "
          "false\n[output]\nsamples = 21\n");
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  const double m = 2766 * 250e-6, m1 = m * l1, m2 = m * l2;
  const double J1 = m1 * l1 * l1 / 3 + 0.3 + (m2 + 0.3 + 0.2) * l1 * l1;
  const double J2 = m2 * l2 * l2 / 3 + 0.3 * l2 * l2;
  const double S1 = m1 * l1 / 2 + (m2 + 0.3 + 0.2) * l1, S2 = m2 * l2 / 2 + 0.3 * l2;
  const auto& time = column(result, "time_s");
  // The links bend by 1e-7 m, and the law, whose jerk begins with a step, leaves them vibrations of a part in
  // 1e4 of forces of some N: 2e-4 N m and 5e-4 N.
  for (std::size_t i = 1; i + 1 < time.size(); ++i) {
    const double x = time[i], s = x - std::sin(2 * pi * x) / (2 * pi), v = 1 - std::cos(2 * pi * x),
                 a = 2 * pi * std::sin(2 * pi * x), turn1 = pi / 3, turn2 = -pi / 3;
    const double q1 = turn1 * s, w1 = turn1 * v, a1 = turn1 * a;
    const double q2 = q1 + pi / 2 + turn2 * s, w2 = w1 + turn2 * v, a2 = a1 + turn2 * a, d = q1 - q2;
    const double second =
        J2 * a2 + l1 * S2 * (std::cos(d) * a1 - std::sin(d) * w1 * w1) + g * S2 * std::cos(q2);
    const double first =
        J1 * a1 + l1 * S2 * (std::cos(d) * a2 + std::sin(d) * w2 * w2) + g * S1 * std::cos(q1);
    EXPECT_NEAR(column(result, "link2_torque_N_m")[i], second, 2e-4) << i;
    EXPECT_NEAR(column(result, "hub_torque_N_m")[i], first + second, 1e-3) << i;
    EXPECT_NEAR(column(result, "tip_x_m")[i], l1 * std::cos(q1) + l2 * std::cos(q2), 1e-6) << i;
    EXPECT_NEAR(column(result, "rigid_tip_y_m")[i], l1 * std::sin(q1) + l2 * std::sin(q2), 1e-12) << i;
    // Force in the hinge: what moves the mass centre of all that it carries.
    const double fx = (m2 + 0.3) * -l1 * (a1 * std::sin(q1) + w1 * w1 * std::cos(q1)) -
                      S2 * (a2 * std::sin(q2) + w2 * w2 * std::cos(q2));
    const double joint_mass = 0.2 * -l1 * (a1 * std::sin(q1) + w1 * w1 * std::cos(q1));
    EXPECT_NEAR(column(result, "link2_force_x_N")[i], fx + joint_mass, 5e-4) << i;
  }
  EXPECT_THAT(fact(result, "largest torque in the hinge of link2"), ::testing::MatchesRegex("[0-9.e-]+ N m"));
  EXPECT_NE(to_string(result.scenes.at(0).title).find("bending drawn"), std::string::npos);
}

TEST(ArmStudy, KeepsItsEnergyWithoutDrives) {
  // Swings from level about a free hub and a sprung hinge.
  const auto result = run(
      replaced(head, "hub_inertia", "gravity_m_per_s2 = 9.81\nhub_inertia") + link("divisions = 2\n") +
      link("divisions = 2\n[mechanism.link.hinge]\nstiffness_N_m_per_rad = 20\n") +
      "[[drive]]\nlink = \"link1\"\nlaw = \"none\"\nangle_deg = -30\n" + replaced(times, "0.005", "0.0005"));
  ASSERT_EQ(result.status, Status::done);
  const auto &balance = column(result, "energy_balance_J"), &kinetic = column(result, "kinetic_energy_J");
  double peak = 0;
  for (const double k : kinetic) peak = std::max(peak, k);
  for (const double b : balance) EXPECT_NEAR(b, 0, 1e-6 * peak);
  EXPECT_GT(peak, 1);
  EXPECT_EQ(result.tables[0].find("link2_torque_N_m"), nullptr);
}

TEST(ArmStudy, ReportsBendingTorquesAndVibration) {
  const auto result = run(example());
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  EXPECT_THAT(to_string(result.headline), HasSubstr("The tip leaves that of the rigid arm by up to"));
  EXPECT_THAT(fact(result, "largest bending stress of upper"), HasSubstr("MPa, at its root, at"));
  EXPECT_THAT(fact(result, "change of the tip with twice the divisions"),
              ::testing::MatchesRegex("[0-9.e-]+ mm"));
  EXPECT_THAT(fact(result, "frequencies at the end"),
              ::testing::MatchesRegex("[0-9.e-]+, [0-9.e-]+, [0-9.e-]+ Hz"));
  const double shaped = std::stod(fact(result, "vibration of the tip after the drive")),
               plain = std::stod(fact(result, "the same without shaping"));
  EXPECT_LT(shaped, 0.25 * plain);
  // Stress is moment by fibre and section.
  const auto &moment = column(result, "fore_bending_moment_N_m"),
             &stress = column(result, "fore_bending_stress_Pa");
  for (std::size_t i = 0; i < moment.size(); ++i)
    EXPECT_NEAR(stress[i], moment[i] * 1.5e-3 / 56.25e-12, 1e-9 * stress[i]);
  const Table& sections = result.tables.back();
  ASSERT_EQ(sections.name, "sections");
  EXPECT_EQ(sections.names, (std::vector<std::string>{"upper", "fore"}));
  EXPECT_DOUBLE_EQ(sections.find("bending_moment_N_m")->values[1],
                   *std::max_element(moment.begin(), moment.end()));
  ASSERT_EQ(result.scenes.size(), 1u);
  EXPECT_EQ(result.scenes[0].vectors.size(), 2u);
  EXPECT_EQ(result.scenes[0].moments.size(), 2u);
}

TEST(ArmStudy, KeepsWhatWasReached) {
  const auto result =
      run(replaced(example(), "elastic_modulus_GPa = 70.0\nfibre", "elastic_modulus_kPa = 70.0\nfibre"));
  EXPECT_NE(result.status, Status::done);
  EXPECT_THAT(to_string(result.headline), HasSubstr(" s: the chain folded."));
  EXPECT_GE(result.tables.at(0).rows(), 1u);
}

TEST(ArmStudy, TellsWhatIsWrong) {
  const std::string two = head + link("") + link("");
  EXPECT_THAT(problems(head + pulse + times), HasSubstr("mechanism.link: this key is missing"));
  EXPECT_THAT(problems(head + "link = []\n" + pulse + times), HasSubstr("an arm has at least one link"));
  EXPECT_THAT(problems(replaced(example(), "elastic_modulus_GPa = 70.0", "elastic_modulus_GPa = 0")),
              HasSubstr("mechanism.link[0].elastic_modulus_GPa: is 0 GPa, must be at least 1e-09 GPa"));
  EXPECT_THAT(problems(replaced(example(), "mass_kg             = 0.5", "damping_N_m_s_per_rad = -1")),
              HasSubstr("mechanism.link[1].hinge.damping_N_m_s_per_rad: is -1"));
  EXPECT_THAT(problems(two + times), HasSubstr(": drive: this key is missing"));
  // All at once.
  const std::string many = problems(two + pulse + pulse + replaced(times, "0.005", "9"));
  EXPECT_THAT(many, HasSubstr("drive[1].link: 'link1' has a drive already"));
  EXPECT_THAT(many, HasSubstr("simulation.step_s: is 9 s, longer than the 1.5 s of the motion"));
  EXPECT_THAT(problems(two + pulse + replaced(pulse, "link1", "link2") + times),
              HasSubstr("drive[1].link: 'link2' is welded on: it has no hinge to be driven"));
  EXPECT_THAT(problems(two + pulse + pulse + times), HasSubstr("drive[1].link: 'link1' has a drive already"));
  EXPECT_THAT(problems(two + replaced(pulse, "link1", "link3") + times),
              HasSubstr("there is no link 'link3'"));
  EXPECT_THAT(problems(replaced(example(), "link       = \"upper\"", "link       = \"fore\"")),
              HasSubstr("nothing turns the hub with link 'upper'"));
  EXPECT_THAT(problems(replaced(example(), "name                = \"fore\"", "name = \"upper\"")),
              HasSubstr("'upper' is also the name of another link"));
  EXPECT_THAT(problems(replaced(example(), "\"fore\"\nlength", "\"hub\"\nlength")),
              HasSubstr("is 'hub', which stands for the hub itself"));
  EXPECT_THAT(problems(replaced(example(), "divisions           = 2\n\n", "divisions = 2\nhinge = {}\n")),
              HasSubstr("the first link is welded to the hub"));
  EXPECT_THAT(problems(replaced(example(), "step_s = 0.005", "step_s = 50")),
              HasSubstr("is 50 s, longer than the 2 s of the motion"));
  EXPECT_THAT(problems(replaced(example(), "to_deg     = 60.0\nduration_s = 1.0", "to_deg = 60.0")),
              HasSubstr("drive[0].duration_s: this key is missing"));
  EXPECT_THAT(problems(replaced(example(), "tip_mass_kg", "theory = \"timoshenko\"\ntip_mass_kg")),
              HasSubstr("a Timoshenko beam needs a positive one"));
}

}  // namespace
}  // namespace linkwright::flexible
