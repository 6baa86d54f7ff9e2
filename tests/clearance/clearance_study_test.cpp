#include "linkwright/clearance/clearance_study.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "clearance/studies.h"
#include "linkwright/study/write.h"

namespace linkwright::clearance {
namespace {

using ::testing::Each;
using testing::fact;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::prepare;
using testing::problems_of;
using testing::replaced;
using testing::run_text;

const Table& table(const study::Result& r, std::string_view name) {
  for (const Table& t : r.tables)
    if (t.name == name) return t;
  ADD_FAILURE() << "no table " << name;
  static const Table none;
  return none;
}
const std::vector<double>& values(const study::Result& r, std::string_view name, std::string_view key) {
  const Column* c = table(r, name).find(key);
  if (c) return c->values;
  ADD_FAILURE() << "no column " << name << "." << key;
  static const std::vector<double> none;
  return none;
}
double largest(const std::vector<double>& v) {
  double out = 0;
  for (const double x : v) out = std::max(out, std::abs(x));
  return out;
}

std::string slider_crank() { return clearance_kind().example; }
// One turn in place of three, without friction: the reference figures are those of the first contacts.
std::string one_turn() {
  return replaced(
      replaced(slider_crank(), "to_s    = 0.036                     # three turns\nsamples = 3601",
               "to_s    = 0.012\nsamples = 1201"),
      "friction       = 0.03", "");
}

// Text of an example: the two designs of Varedi et al. 2014 in continuous contact.
std::string example(const std::string& name) {
  std::ifstream file(LINKWRIGHT_SOURCE_DIR "/examples/studies/" + name + ".toml");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_FALSE(text.str().empty()) << name;
  return text.str();
}

TEST(ClearanceStudy, ReportsContactsMotionAndTheEnergyAudit) {
  const study::Result r = run_text(one_turn());
  ASSERT_EQ(r.status, Status::done) << r.headline;
  for (const char* key : {"time_s", "O_angle_rad", "rod_angle_rad", "slider_B_x_m", "slider_B_ideal_x_m",
                          "guide_way_m", "A_N", "B_N", "O_drive_torque_N_m", "energy_drift_J"})
    EXPECT_EQ(values(r, "motion", key).size(), 1201u) << key;
  for (const char* key : {"B_eccentricity_x_m", "B_depth_m", "B_contact_N", "B_friction_N", "B_touches"})
    EXPECT_EQ(values(r, "pins", key).size(), 1201u) << key;
  EXPECT_THAT(table(r, "motion").status, Each("done"));
  // The published first contacts (five digits, the motion is chaotic later).
  const std::vector<double>& start = values(r, "contacts", "start_s");
  ASSERT_GE(start.size(), 3u);
  EXPECT_NEAR(start[0], 2.2728603e-4, 2e-9);
  EXPECT_NEAR(start[1], 6.3705643e-4, 6e-9);
  EXPECT_NEAR(values(r, "contacts", "approach_m_per_s")[0], 4.3857831, 4e-5);
  EXPECT_NEAR(values(r, "contacts", "force_N")[0], 45872.2, 0.5);
  EXPECT_EQ(table(r, "contacts").names[0], "B");
  // No more play than clearance and depth.
  const std::vector<double>&x = values(r, "pins", "B_eccentricity_x_m"),
        &y = values(r, "pins", "B_eccentricity_y_m"), &depth = values(r, "pins", "B_depth_m");
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(std::hypot(x[i], y[i]), 5e-4 + depth[i], 1e-12) << i;
  EXPECT_LT(largest(values(r, "motion", "slider_B_place_error_m")), 6.5e-4);
  EXPECT_THAT(fact(r, "contacts of B"), HasSubstr("of the time in contact"));
  EXPECT_THAT(fact(r, "energy balance"), HasSubstr("of the peak energy"));
  EXPECT_THAT(r.diagnostics, IsEmpty());
  EXPECT_THAT(r.headline, HasSubstr("contacts of pin and bush"));
  for (const study::Plot& p : r.plots)
    for (const std::string& key : p.y) EXPECT_TRUE(table(r, p.table).find(key)) << p.name << " " << key;
}

// The force of the contact is what the slider needs for its acceleration, and the crank's torque does the
// work.
TEST(ClearanceStudy, ForcesAreThoseOfTheContact) {
  const study::Result r = run_text(one_turn());
  const std::vector<double>&force = values(r, "motion", "B_x_N"),
        &acceleration = values(r, "motion", "slider_B_acceleration_x_m_per_s2"),
        &size = values(r, "motion", "B_N"), &contact = values(r, "pins", "B_contact_N");
  for (std::size_t i = 0; i < force.size(); ++i) {
    EXPECT_NEAR(force[i], 0.14 * acceleration[i], 1e-9 * (1 + std::abs(force[i]))) << i;
    EXPECT_NEAR(size[i], contact[i], 1e-9 * (1 + contact[i])) << i;
  }
  const study::Result rubbing =
      run_text(replaced(one_turn(), "poisson        = 0.3", "poisson = 0.3\nfriction = 0.03"));
  EXPECT_GT(largest(values(rubbing, "pins", "B_friction_N")), 1);
}

// A pin that stands on the ground, where a rocker is loose: the shaking force is that of all masses.
TEST(ClearanceStudy, TheGroundFeelsItsContacts) {
  std::string text =
      replaced(example("loose-four-bar-design-2"), "joint                = \"A\"", "joint = \"O4\"");
  const auto from = text.find("model                = \"continuous\"");
  ASSERT_NE(from, std::string::npos) << text;
  const auto to = text.find("[", text.find("start_rate_rad_per_s", from));
  text.replace(from, to - from,
               "model = \"contact\"\nbush_radius_mm = 5.0\nmodulus_MPa = 10.0\nfriction = 0.1\n\n");
  text = replaced(text, "to_s    = 0.628318530717959", "to_s = 0.2");
  text.erase(text.find("[[check]]"));
  const study::Result r = run_text(text);
  ASSERT_EQ(r.status, Status::done) << r.headline;
  EXPECT_GT(largest(values(r, "pins", "O4_contact_N")), 0);
  // Sum of mass times acceleration of the mass centres, against the sum of joint forces and contacts. Frames
  // of both bodies begin at their points O and A.
  const auto &fx = values(r, "motion", "shaking_force_x_N"), &x2 = values(r, "motion", "O2_x_N"),
             &x4 = values(r, "motion", "O4_x_N"), &fy = values(r, "motion", "shaking_force_y_N"),
             &y2 = values(r, "motion", "O2_y_N"), &y4 = values(r, "motion", "O4_y_N");
  for (std::size_t i = 0; i < fx.size(); ++i) {
    EXPECT_NEAR(fx[i], -x2[i] - x4[i], 1e-9 * (1 + std::abs(fx[i]))) << i;
    EXPECT_NEAR(fy[i], -y2[i] - y4[i], 1e-9 * (1 + std::abs(fy[i]))) << i;
  }
}

TEST(ClearanceStudy, ContinuousContactKeepsToTheReference) {
  const study::Result r = run_text(example("loose-four-bar-design-2"));
  ASSERT_EQ(r.status, Status::done) << r.headline;
  for (const study::Check& check : r.checks)
    EXPECT_TRUE(check.passed) << check.quantity << " " << check.value;
  // Every 30 degrees, 1e-6 rad: the reference figures.
  const std::vector<double>& angle = values(r, "pins", "A_link_angle_rad");
  ASSERT_EQ(angle.size(), 721u);
  EXPECT_NEAR(angle[60], 0.75008386, 1e-6);
  EXPECT_NEAR(angle[180], 1.32027769, 1e-6);
  EXPECT_NEAR(angle[360], 3.39678675, 1e-6);
  // The pin carries the tension and nothing across it.
  const std::vector<double>&tension = values(r, "pins", "A_tension_N"), &force = values(r, "motion", "A_N");
  for (std::size_t i = 0; i < force.size(); ++i) EXPECT_NEAR(force[i], tension[i], 1e-6) << i;
  EXPECT_THAT(fact(r, "contact of A"), HasSubstr("kept: least tension 0.63"));
  EXPECT_THAT(r.headline, HasSubstr("Pin and bush stay in contact"));
  EXPECT_THAT(r.diagnostics, IsEmpty());
}

TEST(ClearanceStudy, WarnsWhereContinuousContactFails) {
  const study::Result r = run_text(example("loose-four-bar-design-1"));
  ASSERT_EQ(r.status, Status::done) << r.headline;
  EXPECT_THAT(fact(r, "contact of A"), HasSubstr("lost at"));
  EXPECT_TRUE(std::any_of(r.facts.begin(), r.facts.end(), [](const study::Fact& f) {
    return f.label == "contact of A" && f.verdict == study::Fact::Verdict::bad;
  }));
  ASSERT_FALSE(r.diagnostics.empty());
  EXPECT_THAT(to_string(r.diagnostics[0]), HasSubstr("the pin of 'A' is taken to touch its bush always"));
  EXPECT_THAT(to_string(r.diagnostics[0]), HasSubstr("model = \"contact\" computes flights and impacts"));
  EXPECT_THAT(r.headline, HasSubstr("outside of the model"));
}

// Without start the link begins where the ideal joint presses it, and settles about there: smaller swings
// than from any other direction.
TEST(ClearanceStudy, ContinuousContactStartsWhereTheJointPresses) {
  const std::string given = example("loose-four-bar-design-2");
  const auto without = [](std::string text, const std::string& key) {
    const auto from = text.find(key);
    EXPECT_NE(from, std::string::npos) << text;
    return text.erase(from, text.find('\n', from) - from);
  };
  const study::Result r = run_text(without(without(given, "start_angle_deg"), "start_rate_rad_per_s"));
  ASSERT_EQ(r.status, Status::done);
  // The ideal joint's force at the start, from the table of the ideal linkage.
  const double presses = std::atan2(-values(r, "ideal", "A_y_N")[0], -values(r, "ideal", "A_x_N")[0]);
  EXPECT_NEAR(values(r, "pins", "A_link_angle_rad")[0], presses, 1e-9);
}

TEST(ClearanceStudy, SectionsAndSpectraOfEvenDrives) {
  const study::Result r =
      run_text(replaced(example("loose-four-bar-design-2"), "to_s    = 0.628318530717959", "to_s = 2.6"));
  const std::vector<double>& turn = values(r, "section", "turn");
  ASSERT_EQ(turn.size(), 5u);  // 4.138 turns and the start
  EXPECT_NEAR(values(r, "section", "A_link_angle_rad")[1], 6.44656628 - 2 * 3.14159265358979, 1e-6);
  EXPECT_EQ(values(r, "pins", "time_s").size(), 721u) << "sections are no rows";
  const std::vector<double>&frequency = values(r, "spectrum", "frequency_Hz"),
        &amplitude = values(r, "spectrum", "A_amplitude_N");
  ASSERT_EQ(frequency.size(), amplitude.size());
  EXPECT_EQ(frequency[0], 0);
  EXPECT_GT(amplitude[0], 0.6) << "the mean tension";
}

TEST(ClearanceStudy, DrawsThePlayEnlarged) {
  const study::Result r = run_text(one_turn());
  ASSERT_EQ(r.scenes.size(), 1u);
  const study::Scene& scene = r.scenes[0];
  EXPECT_EQ(scene.title, "motion, play drawn 10 x");
  EXPECT_LE(scene.samples(), 361u);
  ASSERT_EQ(scene.circles.size(), 1u);
  EXPECT_EQ(scene.circles[0].name, "clearance of B, 0.5 mm");
  const auto &centre = scene.points[std::size_t(scene.circles[0].centre)],
             &rim = scene.points[std::size_t(scene.circles[0].rim)];
  int pin = -1;
  for (const study::Scene::Joint& j : scene.joints)
    if (j.name == "B" && j.style == study::Scene::JointStyle::pivot) pin = j.point;
  ASSERT_GE(pin, 0);
  const std::vector<double>&time = values(r, "pins", "time_s"), &x = values(r, "pins", "B_eccentricity_x_m");
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
  const std::vector<double>& time = values(stopped, "motion", "time_s");
  ASSERT_FALSE(time.empty());
  EXPECT_LT(time.size(), 1201u);
  EXPECT_EQ(values(stopped, "motion", "slider_B_x_m").back(),
            values(r, "motion", "slider_B_x_m")[time.size() - 1]);
  EXPECT_THAT(stopped.headline, HasSubstr("It ends at"));
  EXPECT_THAT(to_string(stopped.diagnostics.at(0)), HasSubstr("steps used up"));
}

TEST(ClearanceStudy, WritesWhatItReads) {
  for (const std::string& text : {slider_crank(), example("loose-four-bar-design-2")}) {
    std::string messages;
    const auto first = prepare(text, messages);
    ASSERT_TRUE(first) << messages;
    const auto second = prepare(study::to_toml(first->canonical), messages);
    ASSERT_TRUE(second) << messages;
    EXPECT_EQ(first->canonical, second->canonical);
  }
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
