// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/simulation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "linkwright/core/memory.h"
#include "linkwright/core/numbers.h"
#include "linkwright/study/write.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using test::fact;
using test::prepare;
using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string pendulum() { return linkage_simulation_kind().example; }

TEST(LinkageSimulationStudy, ReportsMotionForcesAndTheEnergyAudit) {
  const study::Result r = run_text(pendulum());
  EXPECT_EQ(r.status, Status::done);
  const Table& t = r.tables.at(0);
  EXPECT_EQ(t.name, "motion");
  EXPECT_THAT(t.status, Each("done"));
  for (const char* key : {"time_s", "O_angle_rad", "O_joint_speed_rad_per_s",
                          "A_joint_acceleration_rad_per_s2", "kinetic_energy_J", "potential_energy_J",
                          "work_J", "energy_drift_J", "upper_angle_rad", "A_N", "shaking_force_N"})
    EXPECT_TRUE(t.find(key)) << key;
  EXPECT_FALSE(t.find("O_drive_torque_N_m")) << "the joint is free";
  ASSERT_EQ(t.find("time_s")->values.size(), 501u);
  EXPECT_EQ(t.find("time_s")->values.back(), 5.0);
  EXPECT_EQ(fact(r, "degrees of freedom"), "2, 2 free and 0 driven");
  EXPECT_THAT(fact(r, "energy balance"), HasSubstr("of the peak energy"));
  for (const double d : t.find("energy_drift_J")->values) EXPECT_NEAR(d, 0, 1e-7);
  EXPECT_THAT(r.diagnostics, IsEmpty());
  ASSERT_EQ(r.scenes.size(), 1u);
  EXPECT_EQ(r.scenes[0].input_key, "time_s");
  bool audit = false;
  for (const study::Plot& p : r.plots) {
    audit = audit || p.name == "energy-audit";
    for (const std::string& y : p.y) EXPECT_TRUE(t.find(y)) << y;
  }
  EXPECT_TRUE(audit);
}

// The pendulum of the template with a stop at its elbow.
std::string stopped_pendulum(const std::string& stop) {
  return replaced(pendulum(), "[simulation]",
                  "[[mechanism.stop]]\njoint = \"A\"\n" + stop + "\n[simulation]");
}

TEST(LinkageSimulationStudy, TablesWhatHappensAtStops) {
  const std::string text = stopped_pendulum("at_most_deg = 110.0\nat_least_deg = 30.0\nrestitution = 0.5");
  const study::Result r = run_text(text);
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  const auto found =
      std::find_if(r.tables.begin(), r.tables.end(), [](const Table& t) { return t.name == "stops"; });
  ASSERT_NE(found, r.tables.end());
  ASSERT_FALSE(found->names.empty());
  EXPECT_THAT(found->names, Each(AnyOf(HasSubstr("A lower stop"), HasSubstr("A upper stop"))));
  for (const double a : r.tables[0].find("A_angle_rad")->values) {
    EXPECT_LT(a, 110.0001 * pi / 180);
    EXPECT_GT(a, 29.9999 * pi / 180);
  }
  EXPECT_TRUE(r.tables[0].find("A_lower_stop_torque_N_m"));
  EXPECT_THAT(fact(r, "changes of stops"), HasSubstr("the first: A"));
  for (const double d : r.tables[0].find("energy_drift_J")->values) EXPECT_NEAR(d, 0, 1e-7);
  // The canonical study has one entry a stop and means the same.
  std::string messages;
  const auto first = prepare(text, messages);
  ASSERT_TRUE(first) << messages;
  const auto second = prepare(study::to_toml(first->canonical), messages);
  ASSERT_TRUE(second) << messages;
  EXPECT_EQ(first->canonical, second->canonical);
}

TEST(LinkageSimulationStudy, RefusesStopsThatAreNone) {
  const auto problems = [](const std::string& stop) { return problems_of(stopped_pendulum(stop)); };
  EXPECT_THAT(problems(""), HasSubstr("the stop of joint 'A' has no place"));
  EXPECT_THAT(problems("at_least_mm = 3.0"), HasSubstr("joint 'A' turns, and its stop is at a length"));
  EXPECT_THAT(problems("at_least_deg = 3.0\nstiffness_N_per_m = 1e4"),
              HasSubstr("the stop of 'A' has no arm on which its stiffness acts"));
  EXPECT_THAT(problems("at_least_deg = 3.0\nstiffness_N_m_per_rad = 1e4\nrestitution = 0.5"),
              HasSubstr("has a stiffness and a restitution"));
  EXPECT_THAT(problems("at_least_deg = 3.0\ndamping_N_m_s_per_rad = 1.0"),
              HasSubstr("has a damping but no stiffness"));
  EXPECT_THAT(problems("at_least_deg = 3.0\nat_most_deg = 1.0"),
              HasSubstr("its lower stop is not below its upper one"));
  EXPECT_THAT(problems_of(replaced(stopped_pendulum("at_least_deg = -60.0"), "joint = \"A\"\nat",
                                   "joint = \"Z\"\nat")),
              HasSubstr("there is no joint 'Z'"));
  EXPECT_THAT(problems_of(replaced(stopped_pendulum("at_least_deg = -60.0"), "[simulation]",
                                   "[simulation]\nroute = \"all_coordinates\"")),
              HasSubstr("all_coordinates do not take stops"));
}

TEST(LinkageSimulationStudy, HeadlineGivesTimeAndValuesOfOneInstant) {
  const study::Result r = run_text(R"(
schema = 1
kind = "simulation"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name = "ground"
points_mm = { O = [0, 0] }
[[mechanism.body]]
name = "block"
points_mm = { B = [0, 0] }
mass_kg = 1
inertia_kg_m2 = 1
centre_mm = [0, 0]
[[mechanism.joint]]
name = "guide"
type = "prismatic"
first = "ground.O"
second = "block.B"
friction = 0.2
[[drive]]
joint = "guide"
free = true
start_speed_m_per_s = 2.0
[simulation]
to_s = 3
samples = 11
)");
  ASSERT_EQ(r.status, Status::at_rest) << to_string(r.headline);
  EXPECT_THAT(to_string(r.headline), HasSubstr("In 0.9 s guide goes from 0 mm to 1005.39 mm"));
  EXPECT_THAT(to_string(r.headline), HasSubstr("at rest from 1.01937 s with guide at 1019.4 mm on"));
}

// One bar on a pin; `drive` and `body` are what is added to these tables.
std::string one_bar(const std::string& drive, const std::string& body = "") {
  return R"(
schema = 1
kind = "simulation"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name = "ground"
points_mm = { O = [0, 0] }
[[mechanism.body]]
name = "bar"
points_mm = { O = [0, 0], tip = [1000, 0] }
mass_kg = 1
inertia_kg_m2 = 0.3333
centre_mm = [500, 0]
)" + body +
         R"(
[[mechanism.joint]]
name = "pin"
first = "ground.O"
second = "bar.O"
[[drive]]
joint = "pin"
free = true
)" + drive +
         R"(
[simulation]
to_s = 1
samples = 11
)";
}

// The remarks while the study is read and when it has run.
std::string remarks_of(const std::string& text) {
  std::string messages;
  const auto study = prepare(text, messages);
  EXPECT_TRUE(study) << messages;
  RunContext context;
  return study ? messages + linkwright::test::lines_of(study::run_study(*study, context).diagnostics)
               : messages;
}

TEST(LinkageSimulationStudy, SaysThatRoundingDecidesInUnstableBalance) {
  EXPECT_THAT(remarks_of(one_bar("start_deg = 90")),
              HasSubstr("starts at rest in unstable balance: rounding decides when it leaves it"));
  EXPECT_THAT(remarks_of(one_bar("start_deg = 89")), IsEmpty());
}

TEST(LinkageSimulationStudy, SaysWhichStartOfABodyIsNotItsPlace) {
  EXPECT_THAT(remarks_of(one_bar("start_deg = 30", "start = { x_mm = 0, y_mm = 0, angle_deg = 60 }")),
              HasSubstr("body 'bar' does not start there: its place follows from the drives, which put it at "
                        "(0, 0) m, 30 deg; give the start of the joint in its [[drive]]"));
  EXPECT_THAT(remarks_of(one_bar("start_deg = 60", "start = { x_mm = 0, y_mm = 0, angle_deg = 60 }")),
              IsEmpty());
}

TEST(LinkageSimulationStudy, SaysHowLongFrictionHeldTheLinkage) {
  const study::Result r = run_text(R"(
schema = 1
kind = "simulation"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name = "ground"
points_mm = { O = [0, 0] }
[[mechanism.body]]
name = "block"
points_mm = { B = [0, 0] }
mass_kg = 2
inertia_kg_m2 = 1
centre_mm = [0, 0]
[[mechanism.joint]]
name = "guide"
type = "prismatic"
first = "ground.O"
second = "block.B"
friction = 0.3
[[mechanism.force]]
name = "push"
point = "block.B"
force_N = [10, 0]
against = "time"
argument = [0, 2]
factor = [0, 2]
[[drive]]
joint = "guide"
free = true
[simulation]
to_s = 2
samples = 21
)");
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  EXPECT_EQ(fact(r, "held by friction"), "from 0 s to 0.5886 s, 0.5886 s in all");
}

std::string brake(const std::string& keys, const std::string& type = "revolute") {
  return R"(
schema = 1
kind = "simulation"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name = "ground"
points_mm = { O = [0, 0] }
[[mechanism.body]]
name = "disc"
points_mm = { O = [0, 0] }
mass_kg = 1
inertia_kg_m2 = 2
centre_mm = [0, 0]
[[mechanism.joint]]
name = "axle"
type = ")" +
         type + R"("
first = "ground.O"
second = "disc.O"
)" + keys +
         R"(
[[drive]]
joint = "axle"
free = true
)" + (type == "revolute" ? "start_speed_rad_per_s = 10" : "start_speed_m_per_s = 10") +
         R"(
[simulation]
to_s = 20
samples = 21
)";
}

// A disc of 2 kg m2 at 10 rad/s under a brake of 4 N m stops after 5 s, having lost its 100 J.
TEST(LinkageSimulationStudy, ListsWhenJointsStickAndWhatFrictionTakes) {
  const study::Result r = run_text(brake("friction_torque_N_m = 4"));
  ASSERT_EQ(r.status, Status::at_rest) << to_string(r.headline);
  EXPECT_EQ(fact(r, "energy taken by friction"), "100 J");
  EXPECT_EQ(fact(r, "changes of friction"), "1; the first: axle sticks at 5 s");
  ASSERT_EQ(r.tables.size(), 2u);
  const Table& t = r.tables[1];
  EXPECT_EQ(t.name, "friction");
  EXPECT_EQ(t.names, std::vector<std::string>{"axle sticks"});
  EXPECT_NEAR(t.find("time_s")->values[0], 5, 1e-9);
  EXPECT_NEAR(t.find("joint_angle_rad")->values[0], 25, 1e-8);
  EXPECT_TRUE(std::isnan(t.find("joint_displacement_m")->values[0]));
  EXPECT_EQ(t.find("friction_state")->values[0], 0);
  EXPECT_EQ(r.tables[0].find("axle_friction_state")->values[0], 1);
  EXPECT_THAT(to_csv(t), HasSubstr("axle sticks,"));
}

TEST(LinkageSimulationStudy, SaysWhichFrictionDoesNotFitTheJoint) {
  EXPECT_THAT(
      problems_of(brake("friction_force_N = 4")),
      HasSubstr(
          "joint 'axle' is not a slide or slot, and has a friction force; a pin has a friction_torque"));
  EXPECT_THAT(
      problems_of(brake("friction_torque_N_m = 4", "prismatic")),
      HasSubstr(
          "joint 'axle' is not a pin, and has a friction torque; a slide or slot has a friction_force"));
  EXPECT_THAT(
      problems_of(brake("friction = 0.3\npin_radius_mm = 5\nfriction_static = 0.2")),
      HasSubstr("friction_static 0.2 of joint 'axle' is below its friction 0.3; friction_static is the "
                "larger of the two"));
  EXPECT_THAT(
      problems_of(brake("friction = 0.3\npin_radius_mm = 5\nstribeck_speed_mm_per_s = 20")),
      HasSubstr("the friction of joint 'axle' falls with the speed from no value; give friction_static"));
  EXPECT_THAT(problems_of(brake("friction_static = 0.3\npin_radius_mm = 5\nfriction_fall = \"hyperbolic\"")),
              HasSubstr("joint 'axle' has a curve of friction without a speed; give stribeck_speed"));
  EXPECT_THAT(problems_of(brake("friction = 0.3")),
              HasSubstr("give the radius of the pin, or a friction torque"));
}

// Both routes, from the file.
TEST(LinkageSimulationStudy, TakesEitherRoute) {
  const std::string text =
      replaced(slider_crank_simulation_kind().example, "to_s = 0.5", "to_s = 0.2\nsamples = 21");
  const study::Result free = run_text(text), all = run_text(text + "route = \"all_coordinates\"\n");
  ASSERT_EQ(free.status, Status::done);
  ASSERT_EQ(all.status, Status::done);
  for (const char* key : {"O_angle_rad", "guide_displacement_m", "B_N", "kinetic_energy_J"}) {
    const std::vector<double>&a = free.tables[0].find(key)->values, &b = all.tables[0].find(key)->values;
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_NEAR(a[i], b[i], 1e-6 * (1 + std::abs(a[i]))) << key << " " << i;
  }
}

TEST(LinkageSimulationStudy, MixesFreeAndDrivenJoints) {
  const std::string text = replaced(pendulum(),
                                    "joint           = \"O\"\nfree            = true\nstart_deg       = "
                                    "0.0\nstart_speed_rpm = 0.0",
                                    "joint = \"O\"\nlaw = \"constant_speed\"\nspeed_rpm = 30.0");
  const study::Result r = run_text(text);
  EXPECT_EQ(r.status, Status::done);
  EXPECT_EQ(fact(r, "degrees of freedom"), "2, 1 free and 1 driven");
  const Table& t = r.tables.at(0);
  EXPECT_TRUE(t.find("O_drive_torque_N_m"));
  EXPECT_FALSE(t.find("A_drive_torque_N_m"));
  EXPECT_NEAR(t.find("O_angle_rad")->values.back(), 5 * 3.14159265358979, 1e-9);
  for (const double d : t.find("energy_drift_J")->values) EXPECT_NEAR(d, 0, 1e-7);
}

TEST(LinkageSimulationStudy, WritesWhatItReads) {
  std::string messages;
  const auto first = prepare(pendulum(), messages);
  ASSERT_TRUE(first) << messages;
  const auto second = prepare(study::to_toml(first->canonical), messages);
  ASSERT_TRUE(second) << messages;
  EXPECT_EQ(first->canonical, second->canonical);
}

TEST(LinkageSimulationStudy, RefusesMoreRowsThanThereIsMemoryFor) {
  const MemoryLimit limit(1e9);
  const std::string text = pendulum();
  const auto at = text.find("samples = ");
  ASSERT_NE(at, std::string::npos);
  std::string many = text;
  many.replace(at, many.find('\n', at) - at, "samples = 1000000");
  EXPECT_THAT(
      problems_of(many),
      AllOf(HasSubstr("simulation.samples: 1000000 rows would take "),
            HasSubstr(" GB of memory, at most 1 GB may be taken; take fewer samples, or allow more")));
}

TEST(LinkageSimulationStudy, NamesWhatIsWrong) {
  EXPECT_THAT(problems_of(replaced(pendulum(), "free      = true", "free = false")),
              HasSubstr("joint 'A' has neither a motion law nor free = true"));
  EXPECT_THAT(problems_of(replaced(pendulum(), "free      = true", "free = true\nlaw = \"harmonic\"")),
              HasSubstr("joint 'A' is free and has a motion law"));
  EXPECT_THAT(problems_of(replaced(pendulum(), "to_s    = 5.0", "to_s = -1.0")),
              HasSubstr("the simulation ends at -1 s, but starts at 0 s"));
  // A simulation lists no quantities.
  EXPECT_THAT(problems_of(replaced(pendulum(), "mass_kg   = 0.3", "")),
              ::testing::AllOf(HasSubstr("'lower' has none; give mass_kg"),
                               ::testing::Not(HasSubstr("list quantities"))));
  EXPECT_THAT(problems_of(pendulum() + "\n[extra]\n"), HasSubstr(": extra: unknown key; allowed here: "));
  const std::string slider_crank = slider_crank_simulation_kind().example;
  EXPECT_THAT(problems_of(replaced(slider_crank,
                                   "free            = true\nstart_deg       = 90.0\nstart_speed_rpm = 600.0",
                                   "law = \"constant_speed\"\nspeed_rpm = 60.0")),
              HasSubstr("every drive has a motion law: no coordinate is left for forces to move"));
  EXPECT_THAT(problems_of(slider_crank + "route = \"all_coordinates\"\nmethod = \"adams\"\n"),
              HasSubstr("all_coordinates are projected after every step, which adams does not allow"));
}

// A motion that ends early keeps its rows and says why, with what to do.
TEST(LinkageSimulationStudy, TellsWhyAMotionEnds) {
  const std::string chain = R"(schema = 1
kind = "simulation"
[mechanism]
type = "planar.linkage"
sample = "four_bar_chain"
sample_count = 2
[[drive]]
free = true
start_deg = 90.0
start_speed_rad_per_s = -1.0
[simulation]
to_s = 2.0
samples = 201
)";
  const study::Result stopped = run_text(chain + "at_change_point = \"stop\"\n");
  EXPECT_EQ(stopped.status, Status::limit_reached);
  EXPECT_EQ(stopped.tables[0].find("time_s")->values.size(), 72u);
  EXPECT_THAT(to_string(stopped.diagnostics.at(0)), HasSubstr("can continue in either assembly mode"));
  const study::Result smooth = run_text(chain);
  EXPECT_EQ(smooth.status, Status::done);
  EXPECT_THAT(fact(smooth, "change points"), ::testing::StartsWith("2, the first at 0.7143 s with P0 at"));
  EXPECT_EQ(test::value_of_fact(smooth, "change points"), 2);
  EXPECT_THAT(
      to_string(smooth.diagnostics.at(0)),
      HasSubstr("the linkage went through 2 change points, where it can continue in either assembly mode"));
}

TEST(LinkageSimulationStudy, ExamplesPassTheirChecks) {
  for (const char* name : {"andrews-squeezer", "four-bar-chain-2", "four-bar-chain-40", "double-pendulum",
                           "stick-slip-oscillator", "toggle-clamp-stop"}) {
    SCOPED_TRACE(name);
    const auto study = test::prepare_example(test::kinds(), std::string(name) + ".toml");
    ASSERT_TRUE(study);
    RunContext context;
    const study::Result result = study::run_study(*study, context);
    EXPECT_EQ(result.status, Status::done);
    EXPECT_FALSE(result.checks.empty());
    for (const study::Check& check : result.checks)
      EXPECT_TRUE(check.passed) << check.quantity << " " << check.value << check.message;
  }
}

}  // namespace
}  // namespace linkwright::planar
