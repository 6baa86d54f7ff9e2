// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "planar/studies.h"

// Turns that are counted: of torsion springs, of the angles of bodies, and of loads that go by the input.
namespace linkwright::planar {
namespace {

using test::replaced;
using test::run_text;
using test::table;
using ::testing::Each;
using ::testing::HasSubstr;

// A disc of 1 kg m2 on a pin, a torsion spring of 2 N m/rad from the ground, no weight, started at 10 rad/s.
const char* const disc = R"(schema = 1
kind = "simulation"
[environment]
gravity_m_per_s2 = 0
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name = "ground"
points_m = { O = [0, 0] }
[[mechanism.body]]
name = "disc"
points_m = { O = [0, 0], P = [0.1, 0] }
mass_kg = 1
inertia_kg_m2 = 1
centre_m = [0, 0]
[[mechanism.joint]]
name = "O"
first = "ground.O"
second = "disc.O"
[[mechanism.torsion_spring]]
name = "spring"
first = "ground"
second = "disc"
stiffness_N_m_per_rad = 2
free_angle_deg = 0
[[drive]]
joint = "O"
free = true
start_speed_rad_per_s = 10
[simulation]
to_s = 10
samples = 1001
rtol = 1e-10
)";

double peak(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

TEST(CountedTurns, ATorsionSpringRemembersWholeTurns) {
  const study::Result r = run_text(disc);
  EXPECT_EQ(r.status, Status::done);
  const Table& motion = table(r, "motion");
  const std::vector<double>& angle = motion.find("O_angle_rad")->values;
  // 10 sin(sqrt(2) t) / sqrt(2).
  for (std::size_t i = 0; i < angle.size(); ++i)
    EXPECT_NEAR(angle[i], 10 / std::sqrt(2) * std::sin(std::sqrt(2) * 0.01 * static_cast<double>(i)), 1e-6);
  EXPECT_NEAR(peak(motion.find("potential_energy_J")->values), 50, 1e-3);
  // The angle of the body counts the same turns, however far apart the rows are.
  const study::Result coarse = run_text(replaced(disc, "samples = 1001", "samples = 6"));
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(table(coarse, "motion").find("O_angle_rad")->values[i],
                table(coarse, "motion").find("disc_angle_rad")->values[i], 1e-12);
}

TEST(CountedTurns, ASpringMayBeWoundUp) {
  // Three turns: the disc starts at rest, 6 pi from where the spring has no torque.
  const study::Result r = run_text(replaced(replaced(disc, "free_angle_deg = 0", "free_angle_deg = -1080"),
                                            "start_speed_rad_per_s = 10", "start_speed_rad_per_s = 0"));
  const std::vector<double>& angle = table(r, "motion").find("O_angle_rad")->values;
  for (std::size_t i = 0; i < angle.size(); ++i)
    EXPECT_NEAR(angle[i], 6 * pi * (std::cos(std::sqrt(2) * 0.01 * static_cast<double>(i)) - 1), 1e-5);
}

TEST(CountedTurns, AnAnalysisTwistsTheSpringAsFarAsItsJoint) {
  std::string text = replaced(disc, "kind = \"simulation\"", "kind = \"analysis\"");
  text = replaced(text, "free = true\nstart_speed_rad_per_s = 10\n", "speed_rad_per_s = 0\n");
  text.erase(text.find("[simulation]"));
  text += "[sweep]\n[[sweep.input]]\nfrom_deg = 0\nto_deg = 900\nsamples = 5\n";  // 0, 225, 450, 675, 900
  const study::Result r = run_text(text);
  const std::vector<double>& torque = table(r, "sweep").find("O_drive_torque_N_m")->values;
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(torque[static_cast<std::size_t>(i)], 2 * math::radians(225) * i, 1e-12);
  EXPECT_NEAR(torque[1], 7.854, 5e-4);
  EXPECT_NEAR(table(r, "sweep").find("disc_angle_rad")->values[4], math::radians(900), 1e-12);
}

TEST(CountedTurns, BothRoutesOfASimulationAgree) {
  const study::Result r =
      run_text(replaced(disc, "rtol = 1e-10", "rtol = 1e-10\nroute = \"all_coordinates\""));
  const std::vector<double>& angle = table(r, "motion").find("O_angle_rad")->values;
  for (std::size_t i = 0; i < angle.size(); ++i)
    EXPECT_NEAR(angle[i], 10 / std::sqrt(2) * std::sin(std::sqrt(2) * 0.01 * static_cast<double>(i)), 1e-5);
}

// A torque on the disc tabled over a turn, or over two.
std::string loaded(const std::string& argument, const std::string& factor, const std::string& more = "") {
  std::string text = replaced(disc, "kind = \"simulation\"", "kind = \"analysis\"");
  text = replaced(text, "free = true\nstart_speed_rad_per_s = 10\n", "speed_rad_per_s = 0\n");
  const std::size_t spring = text.find("[[mechanism.torsion_spring]]");
  text.replace(spring, text.find("[[drive]]") - spring,
               "[[mechanism.torque]]\nname = \"load\"\nbody = \"disc\"\ntorque_N_m = 1\nagainst = \"input\"\n"
               "argument = " +
                   argument + "\nfactor = " + factor + "\n" + more);
  text.erase(text.find("[simulation]"));
  return text + "[sweep]\n[[sweep.input]]\nfrom_deg = -360\nto_deg = 1440\nsamples = 21\n";  // every 90 deg
}

TEST(CountedTurns, ALoadOverWholeTurnsRepeats) {
  const std::string turn = "[0, 1.5707963, 3.1415927, 4.712389, 6.2831853]", factor = "[0, 1, 2, 3, 0]";
  const study::Result r = run_text(loaded(turn, factor));
  const std::vector<double>& torque = table(r, "sweep").find("O_drive_torque_N_m")->values;
  for (int i = 0; i < 21; ++i) EXPECT_NEAR(torque[static_cast<std::size_t>(i)], -(i % 4), 1e-6) << i;
  // Over two turns, as of a four-stroke engine.
  const study::Result two =
      run_text(loaded("[0, 3.1415926536, 6.2831853072, 9.4247779608, 12.5663706144]", factor));
  const std::vector<double>& slow = table(two, "sweep").find("O_drive_torque_N_m")->values;
  for (int i = 0; i < 21; ++i) {
    const int phase = (i + 4) % 8;  // -360 deg is the middle of the table
    EXPECT_NEAR(slow[static_cast<std::size_t>(i)], phase == 7 ? -1.5 : -phase / 2.0, 1e-6) << i;
  }
  // Part of a turn is held at its ends unless it is told to repeat; nothing repeats that is told not to.
  const study::Result held = run_text(loaded("[0, 1.5707963267948966]", "[0, 1]"));
  EXPECT_NEAR(table(held, "sweep").find("O_drive_torque_N_m")->values[20], -1, 1e-9);
  std::string warnings;
  for (const Diagnostic& d : held.diagnostics) warnings += to_string(d.message);
  EXPECT_THAT(warnings,
              HasSubstr("the table of 'load' ends within the motion, from -360° to 1440° of O: beyond it the "
                        "load keeps its last value"));
  const study::Result quarter =
      run_text(loaded("[0, 1.5707963267948966]", "[1, 2]", "period = 3.141592653589793\n"));
  EXPECT_NEAR(table(quarter, "sweep").find("O_drive_torque_N_m")->values[18], -1, 1e-9);
  EXPECT_NEAR(table(quarter, "sweep").find("O_drive_torque_N_m")->values[19], -2, 1e-9);
  const study::Result once = run_text(loaded(turn, factor, "period = 0\n"));
  EXPECT_NEAR(table(once, "sweep").find("O_drive_torque_N_m")->values[11], 0, 1e-9);
  EXPECT_THAT(test::problems_of(loaded(turn, factor, "period = 3\n")),
              HasSubstr("its period 3 is shorter than its table"));
}

}  // namespace
}  // namespace linkwright::planar
