// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/studies/simulation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "clearance/studies.h"
#include "linkwright/core/memory.h"
#include "linkwright/study/write.h"

namespace linkwright::clearance {
namespace {

using test::column;
using test::example_text;
using test::fact;
using test::largest;
using test::lines_of;
using test::prepare;
using test::problems_of;
using test::replaced;
using test::run_text;
using test::table;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string slider_crank() { return clearance_kind().example; }
// One turn in place of three, without friction: the reference figures are those of the first contacts.
std::string one_turn() {
  return replaced(
      replaced(slider_crank(), "to_s    = 0.036                     # three turns\nsamples = 3601",
               "to_s    = 0.012\nsamples = 1201"),
      "friction       = 0.03", "");
}

TEST(ClearanceStudy, ReportsContactsMotionAndTheEnergyAudit) {
  const study::Result r = run_text(one_turn());
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  for (const char* key : {"time_s", "O_angle_rad", "rod_angle_rad", "slider_B_x_m", "slider_B_ideal_x_m",
                          "guide_displacement_m", "A_N", "B_N", "O_drive_torque_N_m", "energy_drift_J"})
    EXPECT_EQ(column(r, "motion", key).size(), 1201u) << key;
  for (const char* key : {"B_eccentricity_x_m", "B_depth_m", "B_contact_N", "B_friction_N", "B_touches"})
    EXPECT_EQ(column(r, "pins", key).size(), 1201u) << key;
  EXPECT_THAT(table(r, "motion").status, Each("done"));
  // The published first contacts (five digits, the motion is chaotic later).
  const std::vector<double>& start = column(r, "contacts", "start_s");
  ASSERT_GE(start.size(), 3u);
  EXPECT_NEAR(start[0], 2.2728603e-4, 2e-9);
  EXPECT_NEAR(start[1], 6.3705643e-4, 6e-9);
  EXPECT_NEAR(column(r, "contacts", "approach_m_per_s")[0], 4.3857831, 4e-5);
  EXPECT_NEAR(column(r, "contacts", "force_N")[0], 45872.2, 0.5);
  EXPECT_EQ(table(r, "contacts").names[0], "B");
  // No more displacement than clearance and depth.
  const std::vector<double>&x = column(r, "pins", "B_eccentricity_x_m"),
        &y = column(r, "pins", "B_eccentricity_y_m"), &depth = column(r, "pins", "B_depth_m");
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(std::hypot(x[i], y[i]), 5e-4 + depth[i], 1e-12) << i;
  EXPECT_LT(largest(column(r, "motion", "slider_B_place_error_m")), 6.5e-4);
  EXPECT_THAT(fact(r, "contacts of B"), HasSubstr("of the time in contact"));
  EXPECT_THAT(fact(r, "energy balance"), HasSubstr("of the peak energy"));
  EXPECT_THAT(r.diagnostics, IsEmpty());
  EXPECT_THAT(to_string(r.headline), HasSubstr("contacts of pin and bush"));
  for (const study::Plot& p : r.plots)
    for (const std::string& key : p.y) EXPECT_TRUE(table(r, p.table).find(key)) << p.name << " " << key;
}

// The force of the contact is what the slider needs for its acceleration, and the crank's torque does the
// work.
TEST(ClearanceStudy, ForcesAreThoseOfTheContact) {
  const study::Result r = run_text(one_turn());
  const std::vector<double>&force = column(r, "motion", "B_x_N"),
        &acceleration = column(r, "motion", "slider_B_acceleration_x_m_per_s2"),
        &size = column(r, "motion", "B_N"), &contact = column(r, "pins", "B_contact_N");
  for (std::size_t i = 0; i < force.size(); ++i) {
    EXPECT_NEAR(force[i], 0.14 * acceleration[i], 1e-9 * (1 + std::abs(force[i]))) << i;
    EXPECT_NEAR(size[i], contact[i], 1e-9 * (1 + contact[i])) << i;
  }
  const study::Result rubbing =
      run_text(replaced(one_turn(), "poisson        = 0.3", "poisson = 0.3\nfriction = 0.03"));
  EXPECT_GT(largest(column(rubbing, "pins", "B_friction_N")), 1);
}

// A pin that stands on the ground, where a rocker has clearance: the shaking force is that of all masses.
TEST(ClearanceStudy, TheGroundFeelsItsContacts) {
  std::string text = replaced(example_text("clearance-four-bar-design-2.toml"),
                              "joint                = \"A\"", "joint = \"O4\"");
  const auto from = text.find("model                = \"continuous\"");
  ASSERT_NE(from, std::string::npos) << text;
  const auto to = text.find("[", text.find("start_rate_rad_per_s", from));
  text.replace(from, to - from,
               "model = \"contact\"\nbush_radius_mm = 5.0\nmodulus_MPa = 10.0\nfriction = 0.1\n\n");
  text = replaced(text, "to_s    = 0.628318530717959", "to_s = 0.2");
  text.erase(text.find("[[check]]"));
  const study::Result r = run_text(text);
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  EXPECT_GT(largest(column(r, "pins", "O4_contact_N")), 0);
  // Sum of mass times acceleration of the mass centres, against the sum of joint forces and contacts. Frames
  // of both bodies begin at their points O and A.
  const auto &fx = column(r, "motion", "shaking_force_x_N"), &x2 = column(r, "motion", "O2_x_N"),
             &x4 = column(r, "motion", "O4_x_N"), &fy = column(r, "motion", "shaking_force_y_N"),
             &y2 = column(r, "motion", "O2_y_N"), &y4 = column(r, "motion", "O4_y_N");
  for (std::size_t i = 0; i < fx.size(); ++i) {
    EXPECT_NEAR(fx[i], -x2[i] - x4[i], 1e-9 * (1 + std::abs(fx[i]))) << i;
    EXPECT_NEAR(fy[i], -y2[i] - y4[i], 1e-9 * (1 + std::abs(fy[i]))) << i;
  }
}

TEST(ClearanceStudy, ContinuousContactKeepsToTheReference) {
  const study::Result r = run_text(example_text("clearance-four-bar-design-2.toml"));
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  for (const study::Check& check : r.checks)
    EXPECT_TRUE(check.passed) << check.quantity << " " << check.value;
  // Every 30 degrees, 1e-6 rad: the reference figures.
  const std::vector<double>& angle = column(r, "pins", "A_link_angle_rad");
  ASSERT_EQ(angle.size(), 721u);
  EXPECT_NEAR(angle[60], 0.75008386, 1e-6);
  EXPECT_NEAR(angle[180], 1.32027769, 1e-6);
  EXPECT_NEAR(angle[360], 3.39678675, 1e-6);
  // The pin carries the tension and nothing across it.
  const std::vector<double>&tension = column(r, "pins", "A_tension_N"), &force = column(r, "motion", "A_N");
  for (std::size_t i = 0; i < force.size(); ++i) EXPECT_NEAR(force[i], tension[i], 1e-6) << i;
  EXPECT_THAT(fact(r, "contact of A"), HasSubstr("kept: minimum tension 0.63"));
  EXPECT_THAT(to_string(r.headline), HasSubstr("Pin and bush stay in contact"));
  EXPECT_THAT(r.diagnostics, IsEmpty());
}

TEST(ClearanceStudy, WarnsWhereContinuousContactFails) {
  const study::Result r = run_text(example_text("clearance-four-bar-design-1.toml"));
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  EXPECT_THAT(fact(r, "contact of A"),
              ::testing::MatchesRegex(
                  "lost at [0-9.]+ s; without contact [0-9.]+ % of the time, minimum tension -[0-9.]+ N"));
  EXPECT_TRUE(std::any_of(r.facts.begin(), r.facts.end(), [](const study::Fact& f) {
    return f.label == "contact of A" && f.verdict == study::Fact::Verdict::bad;
  }));
  ASSERT_FALSE(r.diagnostics.empty());
  EXPECT_THAT(to_string(r.diagnostics[0]), HasSubstr("the pin of 'A' is taken to touch its bush always"));
  EXPECT_THAT(to_string(r.diagnostics[0]), HasSubstr("model = \"contact\" computes flights and impacts"));
  EXPECT_THAT(to_string(r.headline), HasSubstr("outside of the model"));
}

// Without start the link begins where the ideal joint presses it, and settles about there: smaller swings
// than from any other direction.
TEST(ClearanceStudy, ContinuousContactStartsWhereTheJointPresses) {
  const std::string given = example_text("clearance-four-bar-design-2.toml");
  const auto without = [](std::string text, const std::string& key) {
    const auto from = text.find(key);
    EXPECT_NE(from, std::string::npos) << text;
    return text.erase(from, text.find('\n', from) - from);
  };
  const study::Result r = run_text(without(without(given, "start_angle_deg"), "start_rate_rad_per_s"));
  ASSERT_EQ(r.status, Status::done);
  // The ideal joint's force at the start, from the table of the ideal linkage.
  const double presses = std::atan2(-column(r, "ideal", "A_y_N")[0], -column(r, "ideal", "A_x_N")[0]);
  EXPECT_NEAR(column(r, "pins", "A_link_angle_rad")[0], presses, 1e-9);
}

TEST(ClearanceStudy, SectionsAndSpectraOfEvenDrives) {
  const study::Result r = run_text(replaced(example_text("clearance-four-bar-design-2.toml"),
                                            "to_s    = 0.628318530717959", "to_s = 2.6"));
  const std::vector<double>& turn = column(r, "section", "turn");
  ASSERT_EQ(turn.size(), 5u);  // 4.138 turns and the start
  EXPECT_NEAR(column(r, "section", "A_link_angle_rad")[1], 6.44656628 - 2 * 3.14159265358979, 1e-6);
  EXPECT_EQ(column(r, "pins", "time_s").size(), 721u) << "sections are not rows";
  const std::vector<double>&frequency = column(r, "spectrum", "frequency_Hz"),
        &amplitude = column(r, "spectrum", "A_amplitude_N");
  ASSERT_EQ(frequency.size(), amplitude.size());
  EXPECT_EQ(frequency[0], 0);
  EXPECT_GT(amplitude[0], 0.6) << "the mean tension";
}

TEST(ClearanceStudy, DrawsThePlayEnlarged) {
  const study::Result r = run_text(one_turn());
  ASSERT_EQ(r.scenes.size(), 1u);
  const study::Scene& scene = r.scenes[0];
  EXPECT_EQ(scene.title, "clearance drawn 10 x");
  EXPECT_LE(scene.samples(), 361u);
  ASSERT_EQ(scene.circles.size(), 1u);
  EXPECT_EQ(scene.circles[0].name, "clearance of B, 0.5 mm");
  const auto &centre = scene.points[std::size_t(scene.circles[0].centre)],
             &rim = scene.points[std::size_t(scene.circles[0].rim)];
  int pin = -1;
  for (const study::Scene::Joint& j : scene.joints)
    if (j.name == "B" && j.style == study::Scene::JointStyle::pivot) pin = j.point;
  ASSERT_GE(pin, 0);
  const std::vector<double>&time = column(r, "pins", "time_s"), &x = column(r, "pins", "B_eccentricity_x_m");
  for (std::size_t i = 0; i < scene.samples(); ++i) {
    EXPECT_NEAR(std::hypot(rim.x[i] - centre.x[i], rim.y[i] - centre.y[i]), 10 * 5e-4, 1e-12);
    const auto row = std::size_t(std::find(time.begin(), time.end(), scene.input[i]) - time.begin());
    ASSERT_LT(row, x.size());
    EXPECT_NEAR(scene.points[std::size_t(pin)].x[i] - centre.x[i], 10 * x[row], 1e-12) << i;
  }
}

TEST(ClearanceStudy, KeepsWhatItHasWhenTheMotionEnds) {
  const study::Result r = run_text(one_turn() + "\n[output]\nformats = [\"json\"]\n");
  const study::Result stopped =
      run_text(replaced(one_turn(), "samples = 1201", "samples = 1201\nmax_steps = 300"));
  EXPECT_EQ(stopped.status, Status::not_converged);
  const std::vector<double>& time = column(stopped, "motion", "time_s");
  ASSERT_FALSE(time.empty());
  EXPECT_LT(time.size(), 1201u);
  EXPECT_EQ(column(stopped, "motion", "slider_B_x_m").back(),
            column(r, "motion", "slider_B_x_m")[time.size() - 1]);
  EXPECT_THAT(to_string(stopped.headline), HasSubstr("It ends at"));
  // All steps, not those of the last stretch.
  EXPECT_THAT(to_string(stopped.diagnostics.at(0)), HasSubstr("300 steps used up"));
}

TEST(ClearanceStudy, SwitchesWhereContactIsLostAndSaysSo) {
  const study::Result r = run_text(example_text("clearance-four-bar-automatic.toml"));
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  for (const study::Check& check : r.checks)
    EXPECT_TRUE(check.passed) << check.quantity << " " << check.value;
  EXPECT_EQ(fact(r, "model"),
            "pin A separated from its bush at 0.153847 s, O2 at 88.15 deg; from there on real contact");
  EXPECT_THAT(to_string(r.headline),
              HasSubstr("Pin A separates from its bush at 0.1538 s, O2 at 88.15 deg, and"));
  EXPECT_THAT(r.diagnostics, IsEmpty());
  // One motion: all rows, without a jump of the pin where the models meet (10 mm/s for 0.44 ms).
  const std::vector<double>&time = column(r, "motion", "time_s"),
        &x = column(r, "pins", "A_eccentricity_x_m"), &y = column(r, "pins", "A_eccentricity_y_m"),
        &touches = column(r, "pins", "A_touches"), &force = column(r, "pins", "A_contact_N");
  ASSERT_EQ(time.size(), 1441u);
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] < 0.153847) {
      EXPECT_EQ(touches[i], 1) << i;
      EXPECT_GT(force[i], 0) << i;
      EXPECT_NEAR(std::hypot(x[i], y[i]), 1e-3, 1e-15) << i;
    }
    if (i > 0 && std::abs(time[i] - 0.153847) < 1e-3) {
      EXPECT_LT(std::hypot(x[i] - x[i - 1], y[i] - y[i - 1]), 4e-5) << i;
    }
  }
  EXPECT_EQ(std::count(touches.begin(), touches.end(), 0) > 0, true);
  EXPECT_LT(largest(column(r, "motion", "energy_drift_J")), 1e-7);
  // Peaks of the table of contacts are in the map, too.
  EXPECT_EQ(largest(column(r, "contact_map", "A_force_N")), largest(column(r, "contacts", "force_N")));
  // A map has the unit of the quantity that it draws: newtons, and a share of the time.
  for (const auto& [name, of, x_key, y_key] :
       {std::array{"contact-map", "A_force_N", "A_force_x_N", "A_force_y_N"},
        std::array{"contact-time-map", "A_time_share", "A_time_share_x", "A_time_share_y"}}) {
    const auto plot =
        std::find_if(r.plots.begin(), r.plots.end(), [&](const study::Plot& p) { return p.name == name; });
    ASSERT_NE(plot, r.plots.end()) << name;
    EXPECT_EQ(plot->y, (std::vector<std::string>{x_key, y_key}));
    const std::vector<double>&size = column(r, "contact_map", of), &u = column(r, "contact_map", x_key),
          &v = column(r, "contact_map", y_key), &angle = column(r, "contact_map", "bush_angle_rad");
    EXPECT_GT(largest(size), 0);
    for (std::size_t i = 0; i < size.size(); ++i) {
      EXPECT_NEAR(u[i], size[i] * std::cos(angle[i]), 1e-12 * largest(size));
      EXPECT_NEAR(v[i], size[i] * std::sin(angle[i]), 1e-12 * largest(size));
    }
  }
}

TEST(ClearanceStudy, AutomaticContactIsContinuousWhereThatHolds) {
  const std::string text = example_text("clearance-four-bar-design-2.toml");
  const study::Result continuous = run_text(text);
  std::string other =
      replaced(text, "model                = \"continuous\"", "model = \"automatic\"\nbush_radius_mm = 10.0");
  other.erase(other.find("[[check]]"));
  const study::Result automatic = run_text(other);
  ASSERT_EQ(automatic.status, Status::done) << to_string(automatic.headline);
  EXPECT_EQ(fact(automatic, "model"), "continuous contact holds throughout");
  EXPECT_EQ(fact(automatic, "contact of A"), fact(continuous, "contact of A"));
  EXPECT_EQ(to_string(automatic.headline), to_string(continuous.headline));
  EXPECT_EQ(column(automatic, "pins", "A_contact_N"), column(continuous, "pins", "A_tension_N"));
  for (const char* key : {"A_x_N", "O2_drive_torque_N_m", "coupler_P_x_m",
                          "coupler_P_acceleration_x_m_per_s2", "kinetic_energy_J", "work_J"})
    EXPECT_EQ(column(automatic, "motion", key), column(continuous, "motion", key)) << key;
}

TEST(ClearanceStudy, FindsThePeriodicRegimeByShooting) {
  const study::Result r = run_text(example_text("clearance-four-bar-regime.toml"));
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  for (const study::Check& check : r.checks)
    EXPECT_TRUE(check.passed) << check.quantity << " " << check.value;
  EXPECT_THAT(to_string(r.headline),
              HasSubstr("The periodic motion is neutral: pin and bush stay in contact"));
  EXPECT_THAT(fact(r, "periodic regime"), HasSubstr("found in 4 steps of Newton's method"));
  EXPECT_THAT(fact(r, "stability"), HasSubstr("Floquet multipliers 0.87793"));
  EXPECT_EQ(table(r, "orbit").names, std::vector<std::string>{"A"});
  // It does repeat: everything at the end is what it is at the start.
  const std::vector<double>&phase = column(r, "pins", "A_phase_rad"),
        &tension = column(r, "pins", "A_tension_N"), &torque = column(r, "motion", "O2_drive_torque_N_m");
  EXPECT_NEAR(phase.front(), 0.17282458, 1e-7);
  EXPECT_NEAR(phase.back(), phase.front(), 1e-9);
  EXPECT_NEAR(tension.back(), tension.front(), 1e-9);
  EXPECT_NEAR(torque.back(), torque.front(), 1e-9);
}

std::string regime_of(std::string text, const std::string& run) {
  const auto from = text.find("[simulation]");
  return text.replace(from, text.find("[[trace]]") - from,
                      "[simulation]\nregime = \"periodic\"\n" + run + "\n\n");
}
TEST(ClearanceStudy, GoesOnUntilContactsRepeat) {
  const study::Result r = run_text(
      replaced(example_text("clearance-slider-crank-regime.toml"), "samples = 721", "samples = 361"));
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  EXPECT_THAT(to_string(r.headline), HasSubstr("The motion repeats every turn after"));
  EXPECT_THAT(fact(r, "periodic regime"), HasSubstr("repeats every turn (0.03 s) after"));
  // One turn of it is reported, and what was found to repeat does.
  const std::vector<double>&time = column(r, "motion", "time_s"),
        &x = column(r, "pins", "B_eccentricity_x_m"), &y = column(r, "pins", "B_eccentricity_y_m");
  ASSERT_EQ(time.size(), 361u);
  EXPECT_NEAR(time.back() - time.front(), 0.03, 1e-12);
  EXPECT_NEAR(std::hypot(x.back() - x.front(), y.back() - y.front()), 0, 1e-5 * 5e-4 * 1.5);
  const std::vector<double>& turns = column(r, "section", "turn");
  EXPECT_NEAR(turns.back() * 0.03, time.back(), 1e-9);
  for (const double end : column(r, "contacts", "end_s")) {
    if (!std::isnan(end)) {
      EXPECT_GT(end, time.front());
    }
  }
}

TEST(ClearanceStudy, SaysWhenTheMotionDoesNotBecomePeriodic) {
  const study::Result r = run_text(regime_of(slider_crank(), "samples = 101\nmax_turns = 5"));
  EXPECT_EQ(r.status, Status::not_converged);
  EXPECT_THAT(to_string(r.headline),
              HasSubstr("The motion did not become periodic within 5 turns: in 0.06 s"));
  ASSERT_FALSE(r.diagnostics.empty());
  EXPECT_THAT(to_string(r.diagnostics[0]),
              HasSubstr("the motion did not become periodic within 5 turns: the last one changed it by"));
  EXPECT_THAT(fact(r, "periodic regime"), HasSubstr("not found within 5 turns"));
  // The section of all turns, the last turn, and all contacts are there.
  EXPECT_EQ(column(r, "section", "turn").size(), 6u);
  EXPECT_EQ(column(r, "motion", "time_s").size(), 101u);
  EXPECT_NEAR(column(r, "contacts", "start_s").front(), 2.2e-4, 1e-4);
  EXPECT_EQ(r.scenes.size(), 1u);
}

// Design 1 has no motion that keeps continuous contact: it goes over to real contact turn after turn.
TEST(ClearanceStudy, AutomaticRegimesGoOnWhereContactIsLost) {
  const study::Result r = run_text(regime_of(example_text("clearance-four-bar-automatic.toml"),
                                             "samples = 181\nmax_turns = 2\nregime_tolerance = 1e-9"));
  EXPECT_EQ(r.status, Status::not_converged) << to_string(r.headline);
  EXPECT_THAT(fact(r, "model"), HasSubstr("pin A separated from its bush at 0.153847 s"));
  EXPECT_THAT(fact(r, "shooting"), ::testing::AnyOf(HasSubstr("no periodic motion in continuous contact"),
                                                    HasSubstr("but pins separate on it")));
}

TEST(ClearanceStudy, NamesWhatRegimesCannotDo) {
  const std::string text = regime_of(slider_crank(), "");
  const auto problems = [&](const std::string& what, const std::string& by) {
    return problems_of(replaced(text, what, by));
  };
  EXPECT_THAT(problems("law       = \"constant_speed\"\nspeed_rpm = 5000.0",
                       "law = \"cycloidal\"\nfrom_deg = 0.0\nto_deg = 90.0\nduration_s = 1.0"),
              HasSubstr("no drive repeats itself with all the others: that of 'O'"));
  EXPECT_THAT(problems("law       = \"constant_speed\"\nspeed_rpm = 5000.0", "start_speed_rpm = 100.0"),
              HasSubstr("no drive repeats itself"));
  EXPECT_THAT(problems("regime = \"periodic\"", "regime = \"periodik\""),
              HasSubstr("did you mean 'periodic'?"));
  EXPECT_THAT(problems("regime = \"periodic\"", "regime = \"periodic\"\nto_s = 1.0"),
              HasSubstr("simulation.to_s: unknown key; allowed here: "));
  EXPECT_THAT(problems("regime = \"periodic\"", "regime = \"periodic\"\nmax_turns = 1"),
              HasSubstr("must be at least 2"));
  EXPECT_THAT(problems("regime = \"periodic\"", "regime = \"periodic\"\nsamples = 100001\nmax_turns = 1000"),
              HasSubstr("100001 rows a period for up to 1000 periods are more than 1e+07"));
  EXPECT_THAT(problems("regime = \"periodic\"", "regime = \"periodic\"\nregime_tolerance = 0.0"),
              HasSubstr("must be at least 1e-12"));
  EXPECT_THAT(problems("regime = \"periodic\"", "regime = \"periodic\"\nrtol = 1e-20"),
              HasSubstr("must be at least 1e-13"));
  EXPECT_THAT(problems("regime = \"periodic\"", "regime = \"periodic\"\nmax_steps = 0"),
              HasSubstr("must be at least 1"));
  EXPECT_THAT(
      problems_of(text + "\n[[mechanism.force]]\nname = \"push\"\npoint = \"slider.B\"\nforce_N = [1.0, "
                         "0.0]\nagainst = \"time\"\nargument = [0.0, 1.0]\nfactor = [0.0, 1.0]\n"),
      HasSubstr("load 'push' depends on the time, so the motion has no period"));
  EXPECT_THAT(problems("model          = \"contact\"", "model = \"automatic\"\nstart_mm = [0.0, 0.0]"),
              HasSubstr("clearance[0].start_mm: unknown key; allowed here: "));
  EXPECT_THAT(problems("bush_radius_mm = 10.0", ""),
              HasSubstr("clearance[0].bush_radius_m: this key is missing"));
  EXPECT_THAT(problems("modulus_GPa    = 207.0", "modulus_GPa = 0.0"), HasSubstr("must be more than 0"));
}

TEST(ClearanceStudy, WritesWhatItReads) {
  for (const std::string& text :
       {slider_crank(), example_text("clearance-four-bar-design-2.toml"),
        example_text("clearance-four-bar-automatic.toml"), example_text("clearance-four-bar-regime.toml")}) {
    std::string messages;
    const auto first = prepare(text, messages);
    ASSERT_TRUE(first) << messages;
    const auto second = prepare(study::to_toml(first->canonical), messages);
    ASSERT_TRUE(second) << messages;
    EXPECT_EQ(first->canonical, second->canonical);
  }
}

// A small clearance and a slow drive are what takes steps: as many as measured, and a half more.
TEST(ClearanceStudy, StepsAreFewAtOneMicrometreAndAtTenTurnsAMinute) {
  const auto steps = [](const std::string& text) {
    const study::Result r = run_text(text);
    EXPECT_EQ(r.status, Status::done) << to_string(r.headline);
    return std::stol(fact(r, "integration"));
  };
  std::string touching = slider_crank();
  const auto from = touching.find("model          = \"contact\""), to = touching.find("[environment]");
  ASSERT_TRUE(from < to && to != std::string::npos);
  touching.replace(from, to - from, "model = \"continuous\"\n\n");
  EXPECT_LT(steps(replaced(touching, "clearance_mm   = 0.5 ", "clearance_mm = 0.001 ")), 6000);
  const std::string slow = replaced(replaced(slider_crank(), "speed_rpm = 5000.0", "speed_rpm = 10.0"),
                                    "to_s    = 0.036", "to_s = 6.0");
  EXPECT_LT(steps(slow), 50000);
  // A thousand turns of it are out of reach: reported after 20000 steps, not after all that are allowed.
  const study::Result hopeless = run_text(replaced(slow, "to_s = 6.0", "to_s = 6000.0\nmax_steps = 100000"));
  EXPECT_THAT(fact(hopeless, "integration"),
              ::testing::MatchesRegex("20000 steps, [0-9]+ evaluations of the equations of motion"));
  EXPECT_THAT(lines_of(hopeless.diagnostics),
              HasSubstr("after 20000 steps: at this pace 6000 s would take about 2.6e+07"));
}

TEST(ClearanceStudy, RefusesMoreRowsThanThereIsMemoryFor) {
  const MemoryLimit limit(1e9);
  EXPECT_THAT(
      problems_of(replaced(one_turn(), "samples = 1201", "samples = 1000000")),
      AllOf(HasSubstr("simulation.samples: 1000000 rows would take "),
            HasSubstr(" GB of memory, at most 1 GB may be taken; take fewer samples, or allow more")));
}

TEST(ClearanceStudy, WarnsOfDepthsThatNoBushHas) {
  // A spring in the place of a bush of steel.
  const study::Result r =
      run_text(replaced(one_turn(), "modulus_GPa    = 207.0", "stiffness_N_per_m1_5 = 1e6"));
  EXPECT_THAT(fact(r, "depth in the bush of B"), HasSubstr("% of the radius of the pin of 9.5 mm"));
  EXPECT_THAT(lines_of(r.diagnostics), HasSubstr("the pin of 'B', 9.5 mm in radius, is pressed "));
  EXPECT_THAT(lines_of(r.diagnostics), HasSubstr("the law of contact holds for depths of a few per cent"));
}

TEST(ClearanceStudy, WarnsOfALawThatDoesNotGiveItsRestitution) {
  const std::string text = replaced(one_turn(), "\"lankarani_nikravesh\"", "\"flores_2011\"");
  const study::Result poor = run_text(replaced(text, "restitution    = 0.9", "restitution = 0.05"));
  EXPECT_THAT(lines_of(poor.diagnostics),
              HasSubstr("restitution = 0.05 of 'B': by flores_2011 an impact gives back 0.0"));
  EXPECT_THAT(lines_of(poor.diagnostics), HasSubstr("times the force and"));
  EXPECT_THAT(lines_of(poor.diagnostics), HasSubstr("on the law is within 25 % of the given value"));
  EXPECT_THAT(lines_of(run_text(text).diagnostics), Not(HasSubstr("restitution")));
}

TEST(ClearanceStudy, NamesWhatIsWrong) {
  const std::string text = slider_crank();
  const auto problems = [&](const std::string& what, const std::string& by) {
    return problems_of(replaced(text, what, by));
  };
  const std::string joint = "joint          = \"B\"", play = "clearance_mm   = 0.5 ";
  EXPECT_THAT(problems(play, "clearance_mm   = -0.5 "), HasSubstr("must be more than 0"));
  EXPECT_THAT(problems(play, "clearance_mm   = 70.0 "),
              HasSubstr("70 mm is more than half of the link 'rod', 120 mm"));
  EXPECT_THAT(problems(play, "clearance_mm   = 12.0 "),
              HasSubstr("10 mm is not more than the clearance, 12 mm"));
  EXPECT_THAT(problems(joint, "joint = \"guid\""),
              HasSubstr("there is no joint 'guid'; did you mean 'guide'?"));
  EXPECT_THAT(problems(joint, "joint = \"guide\""),
              HasSubstr("joint 'guide' is prismatic; only revolute joints have clearance"));
  EXPECT_THAT(problems(joint, "joint = \"O\""),
              HasSubstr("joint 'O' is driven: a drive needs a pin without clearance"));
  EXPECT_THAT(problems("modulus_GPa    = 207.0", "stiffness_N_per_m1_5 = 0.0"),
              HasSubstr("must be more than 0"));
  EXPECT_THAT(problems("restitution    = 0.9", "restitution = 1.2"), HasSubstr("must be at most 1"));
  EXPECT_THAT(problems("restitution    = 0.9", "restitution = 0.0"), HasSubstr("must be more than 0"));
  EXPECT_THAT(problems("friction       = 0.03", "friction_from_m_per_s = 1.0"),
              HasSubstr("0.001 m/s is not more than friction_from, 1 m/s"));
  EXPECT_THAT(problems("friction       = 0.03", "start_mm = [0.4, 0.4]"),
              HasSubstr("the pin starts 0.565685 mm off the middle of its bush, which leaves 0.5 mm"));
  EXPECT_THAT(problems("to_s    = 0.036 ", "to_s    = -0.036 "),
              HasSubstr("the simulation ends at -0.036 s, but starts at 0 s"));
  EXPECT_THAT(problems("model          = \"contact\"", "model = \"contakt\""),
              HasSubstr("did you mean 'contact'?"));
  const std::string second = "\n[[clearance]]\njoint = \"A\"\nclearance_mm = 0.5\nmodel = \"continuous\"\n";
  EXPECT_THAT(problems_of(text + second), HasSubstr("is continuous, but joint 'B' has contact"));
  EXPECT_THAT(problems_of(text + replaced(replaced(second, "\"A\"", "\"B\""), "model = \"continuous\"",
                                          "bush_radius_mm = 5.0")),
              HasSubstr("joint 'B' is given twice"));
  EXPECT_THAT(problems("name   = \"B\"\nfirst", "name   = \"B\"\nfriction = 0.1\npin_radius_mm = 5.0\nfirst"),
              HasSubstr("joint 'B' has friction of its own"));
  std::string none = text;
  const auto from = none.find("[[clearance]]");
  none.erase(from, none.find("[environment]") - from);
  EXPECT_THAT(problems_of(none), HasSubstr("no joint has clearance"));
}

}  // namespace
}  // namespace linkwright::clearance
