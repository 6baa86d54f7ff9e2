// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/form.h"
#include "planar/studies.h"

namespace linkwright::planar::load_formulas {
namespace {

using namespace linkwright::planar::test;
using testing::HasSubstr;

// A slider-crank on the ground, with loads.
std::string slider_crank(const std::string& loads, const std::string& motion, const char* kind = "analysis") {
  return fmt::format(R"(
schema = 1
kind   = "{}"

[mechanism]
type = "planar.linkage"

[[mechanism.body]]
name      = "ground"
points_mm = {{ O = [0, 0] }}

[[mechanism.body]]
name          = "crank"
points_mm     = {{ O = [0, 0], A = [50, 0] }}
mass_kg       = 1
inertia_kg_m2 = 0.01

[[mechanism.body]]
name          = "rod"
points_mm     = {{ A = [0, 0], B = [150, 0] }}
mass_kg       = 1
centre_mm     = [75, 0]
inertia_kg_m2 = 0.002

[[mechanism.body]]
name      = "slider"
points_mm = {{ B = [0, 0] }}
mass_kg   = 2

[[mechanism.joint]]
name   = "O"
first  = "ground.O"
second = "crank.O"

[[mechanism.joint]]
name   = "A"
first  = "crank.A"
second = "rod.A"

[[mechanism.joint]]
name   = "B"
first  = "rod.B"
second = "slider.B"

[[mechanism.joint]]
name          = "guide"
type          = "prismatic"
first         = "ground.O"
second        = "slider.B"
direction_deg = 0

[[mechanism.assembly]]
bodies = ["rod", "slider"]
mode   = "plus"

)",
                     kind) +
         loads + motion;
}
const std::string sweep =
    "\n[drive]\njoint = \"O\"\nspeed_rad_per_s = 4\n"
    "[[sweep.input]]\njoint = \"O\"\nfrom_deg = -400\nto_deg = 400\nsamples = 33\n";
std::string force(const std::string& along, const std::string& across = "0") {
  return fmt::format("[[mechanism.force]]\nname = \"push\"\npoint = \"slider.B\"\nformula = ['{}', '{}']\n",
                     along, across);
}
std::string torque(const std::string& formula) {
  return fmt::format("[[mechanism.torque]]\nname = \"turn\"\nbody = \"crank\"\nformula = '{}'\n", formula);
}

std::vector<double> drives(const std::string& loads) {
  return column(run_text(slider_crank(loads, sweep)), "O_drive_torque_N_m");
}

// The torque of the drive changes by what the loads do to the crank: by virtual work of a force.
TEST(LoadFormula, NamesJointsPointsAndSprings) {
  const study::Result bare = run_text(slider_crank("", sweep));
  const std::vector<double> without = column(bare, "O_drive_torque_N_m"), q = column(bare, "O_angle_rad"),
                            slide = column(bare, "guide_displacement_m"),
                            speed = column(bare, "guide_speed_m_per_s");
  struct Case {
    std::string loads;
    std::function<double(std::size_t)> torque;
  };
  const std::string spring =
      "[[mechanism.spring]]\nname = \"none\"\nfirst = \"ground.O\"\nsecond = \"slider.B\"\n"
      "stiffness_N_per_m = 0\n";
  for (const Case& c : {
           Case{torque("3 N*m + 0.5 N*m * q(\"O\")"), [&](std::size_t i) { return 3 + 0.5 * q[i]; }},
           Case{torque("-0.2 N*m*s * rate(\"O\") + 0.1 N*m*s * speed"), [](std::size_t) { return -0.4; }},
           Case{force("-40 N/m * q(\"guide\") - 3 N*s/m * rate(\"guide\")", "1 kN"),
                [&](std::size_t i) { return (-40 * slide[i] - 3 * speed[i]) * speed[i] / 4; }},
           Case{force("-40 N/m * x - 3 N*s/m * vx + 5 N/m * y + 5 N*s/m * vy"),
                [&](std::size_t i) { return (-40 * slide[i] - 3 * speed[i]) * speed[i] / 4; }},
           Case{force("-40 N/m * x(\"rod.B\") - 3 N*s/m * vx(\"rod.B\")"),
                [&](std::size_t i) { return (-40 * slide[i] - 3 * speed[i]) * speed[i] / 4; }},
           Case{spring + force("-40 N/m * length(\"none\") - 3 N*s/m * speed(\"none\")"),
                [&](std::size_t i) { return (-40 * slide[i] - 3 * speed[i]) * speed[i] / 4; }},
       }) {
    SCOPED_TRACE(c.loads);
    const std::vector<double> with = drives(c.loads);
    ASSERT_EQ(with.size(), 33u);
    for (std::size_t i = 0; i < with.size(); ++i) EXPECT_NEAR(with[i], without[i] - c.torque(i), 1e-10) << i;
  }
}

// The angle of a pin that no drive turns is counted over its turns as well.
TEST(LoadFormula, CountsTheTurnsOfPins) {
  const study::Result result = run_text(slider_crank(torque("1 N*m * q(\"A\")"), sweep)),
                      bare = run_text(slider_crank("", sweep));
  const std::vector<double> with = column(result, "O_drive_torque_N_m"),
                            without = column(bare, "O_drive_torque_N_m");
  double last = without[0] - with[0];
  for (std::size_t i = 1; i < with.size(); ++i) {
    const double now = without[i] - with[i];
    EXPECT_LT(std::abs(now - last), 1) << i;
    last = now;
  }
  EXPECT_GT(std::abs(last - (without[0] - with[0])), 3 * pi);
}

TEST(LoadFormula, TurnsWithItsBody) {
  const std::string turned = "turns_with_body = true\n";
  const std::string fixed = "[[mechanism.force]]\nname = \"push\"\npoint = \"rod.B\"\nforce_N = [3, -2]\n",
                    formula =
                        "[[mechanism.force]]\nname = \"push\"\npoint = \"rod.B\"\n"
                        "formula = [\"3 N\", \"-2 N\"]\n";
  EXPECT_EQ(drives(fixed + turned), drives(formula + turned));
  EXPECT_EQ(drives(fixed), drives(formula));
}

// A block of 2 kg that runs against a spring of 800 N/m which it touches: it comes back after half a period,
// with the speed that it had.
TEST(LoadFormula, BendsAreEventsOfASimulation) {
  const auto text = [](const std::string& law) {
    return fmt::format(R"(
schema = 1
kind   = "simulation"

[mechanism]
type = "planar.linkage"


[[mechanism.body]]
name      = "ground"
points_mm = {{ O = [0, 0] }}

[[mechanism.body]]
name      = "block"
points_mm = {{ O = [0, 0] }}
mass_kg   = 2

[[mechanism.joint]]
name          = "guide"
type          = "prismatic"
first         = "ground.O"
second        = "block.O"
direction_deg = 0

[[mechanism.force]]
name    = "buffer"
point   = "block.O"
formula = ["{}", "0"]

[drive]
joint                = "guide"
free                 = true
start_mm             = 0
start_speed_mm_per_s = 700

[simulation]
to_s    = 1
samples = 101
)",
                       law);
  };
  const double touch = 0.1 / 0.7, back = touch + pi / std::sqrt(400.0);
  for (const char* law :
       {"-max(0, 800 N/m * (x - 100 mm))", "if(x < 100 mm, 0, -800 N/m * (x - 100 mm))",
        "table(x, 100 mm, 0, 300 mm, -160 N)", "-400 N/m * (abs(x - 100 mm) + x - 100 mm)"}) {
    SCOPED_TRACE(law);
    const study::Result result = run_text(text(law));
    ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
    EXPECT_NEAR(column(result, "guide_displacement_m").back(), 0.1 - 0.7 * (1 - back), 1e-9);
    EXPECT_NEAR(column(result, "guide_speed_m_per_s").back(), -0.7, 1e-9);
  }
}

TEST(LoadFormula, SaysWhatIsWrong) {
  const auto wrong = [](const std::string& loads) { return problems_of(slider_crank(loads, sweep)); };
  EXPECT_THAT(wrong(torque("3 N")),
              HasSubstr("mechanism.torque[0].formula: column 1: is a force, and must be a torque"));
  EXPECT_THAT(wrong(force("3 N*m * q(\"guide\")")),
              HasSubstr("mechanism.force[0].formula: \"3 N*m * q(\"guide\")\", column 1: is a quantity in"));
  EXPECT_THAT(wrong(torque("1 N*m * q(\"P\")")), HasSubstr("column 11: there is no joint 'P'"));
  EXPECT_THAT(wrong(torque("1 N*m/m * x(\"crank.B\")")), HasSubstr("body 'crank': there is no point 'B'"));
  EXPECT_THAT(wrong(torque("1 N * length(\"rope\")")), HasSubstr("there is no strut or spring 'rope'"));
  EXPECT_THAT(wrong(torque("1 N * x(\"B\")")), HasSubstr("'B' is not a point; write body.point"));
  EXPECT_THAT(wrong("[[mechanism.torque]]\nname = \"turn\"\nbody = \"crank\"\n"),
              HasSubstr("torque 'turn' has no size"));
  EXPECT_THAT(wrong(torque("1 N*m") + "torque_N_m = 3\n"),
              HasSubstr("torque 'turn' has a size and a formula"));
  EXPECT_THAT(wrong(torque("1 N*m") + "against = \"time\"\nargument = [0, 1]\nfactor = [1, 2]\n"),
              HasSubstr("torque 'turn' has a table and a formula"));
  EXPECT_THAT(wrong("[[mechanism.force]]\nname = \"push\"\npoint = \"slider.B\"\nformula = ['1 N']\n"),
              HasSubstr("force 'push' has 1 formulas"));
  const study::Result without = run_text(slider_crank(torque("1 N*m / (1 - sign(q(\"O\")))"), sweep));
  EXPECT_EQ(without.status, Status::limit_reached);
  EXPECT_THAT(lines_of(without.diagnostics), HasSubstr("the formula of torque 'turn' has no value"));
}

TEST(LoadFormula, ReadsBack) {
  std::vector<FormProblem> problems;
  LinkageForm form;
  form.bodies = {{.name = "ground", .points = {{"O", {0, 0}}}},
                 {.name = "arm", .points = {{"O", {0, 0}}, {"A", {1, 0}}}}};
  form.joints = {{.name = "O", .first = "ground.O", .second = "arm.O"}};
  form.forces = {{.name = "f", .point = "arm.A", .formula = {{"1 N", "2 N/m * x"}}}};
  form.torques = {{.name = "t", .body = "arm", .formula = "3 N*m * q('O')"}};
  const Linkage linkage = linkage_of(form, problems);
  ASSERT_TRUE(problems.empty()) << problems[0].message;
  const LinkageForm again = form_of(linkage);
  EXPECT_EQ(again.forces[0].formula, form.forces[0].formula);
  EXPECT_EQ(again.torques[0].formula, form.torques[0].formula);
  EXPECT_FALSE(again.forces[0].force || again.torques[0].torque);
  EXPECT_EQ(linkage.counted_pins, std::vector<int>{0});
}

}  // namespace
}  // namespace linkwright::planar::load_formulas
