// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/strut.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/planar/linkage/form.h"
#include "planar/linkages.h"
#include "planar/studies.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using testing::HasSubstr;

// A bonnet that a gas spring holds open, as tests/published has it, at angles of its hinge O.
std::string bonnet(const std::string& strut, const std::string& motion) {
  return R"(
schema = 1
kind   = "analysis"

[mechanism]
type = "planar.linkage"

[[mechanism.body]]
name      = "car"
points_mm = { O = [0, 0], P = [20, -60] }

[[mechanism.body]]
name          = "bonnet"
points_mm     = { O = [0, 0], Q = [300, -60] }
mass_kg       = 15.0
centre_mm     = [613.9662026198, 86.2873225952]
inertia_kg_m2 = 2.0

[[mechanism.joint]]
name   = "O"
first  = "car.O"
second = "bonnet.O"

)" + strut +
         motion;
}
const std::string gas =
    "[[mechanism.strut]]\nname = \"lift\"\nfirst = \"car.P\"\nsecond = \"bonnet.Q\"\n"
    "gas = { extended_N = 900, extended_mm = 356, stroke_mm = 80, progression = 1.35 }\n";
const std::string sweep =
    "[drive]\njoint = \"O\"\nspeed_deg_per_s = 10.0\n"
    "[[sweep.input]]\njoint = \"O\"\nfrom_deg = 0.0\nto_deg = 75.0\nsamples = 76\n";

std::string strut(const std::string& law) {
  return "[[mechanism.strut]]\nname = \"lift\"\nfirst = \"car.P\"\nsecond = \"bonnet.Q\"\n" + law + "\n";
}

TEST(Strut, GasSpringOfABonnetNeedsThePublishedTorques) {
  const study::Result result = run_text(bonnet(gas, sweep));
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  const Value& wanted = at(published_case("planar-machines.json", "bonnet-gas-spring"), "computed");
  const std::vector<double>& torque = column(result, "O_drive_torque_N_m");
  EXPECT_NEAR(torque.front(), -number_at(wanted, "torque_at_0_N_m"), 1e-6);
  EXPECT_NEAR(torque.back(), -number_at(wanted, "torque_at_75_N_m"), 1e-6);
}

// The energy that is stored falls with the work of the strut; drive, weight and loads balance the motion.
TEST(Strut, ColumnsAgreeWithEachOther) {
  const study::Result result = run_text(bonnet(gas, sweep));
  const std::vector<double>&length = column(result, "lift_length_m"),
        &speed = column(result, "lift_speed_m_per_s"), &force = column(result, "lift_force_N"),
        &energy = column(result, "lift_energy_J"), &drive = column(result, "drive_power_W"),
        &load = column(result, "load_power_W"), &weight = column(result, "weight_power_W"),
        &kinetic = column(result, "kinetic_power_W");
  for (std::size_t i = 0; i < length.size(); ++i) {
    EXPECT_NEAR(force[i], 900 * (1 + 0.35 * (0.356 - length[i]) / 0.08), 1e-9);
    EXPECT_NEAR(load[i], force[i] * speed[i], 1e-10);
    EXPECT_NEAR(drive[i] + load[i] + weight[i], kinetic[i], 1e-10);
    // Of a linear force the mean over a step is that of both ends.
    if (i == 0) continue;
    EXPECT_NEAR(energy[i - 1] - energy[i], (force[i] + force[i - 1]) / 2 * (length[i] - length[i - 1]),
                1e-10);
  }
}

TEST(Strut, CylinderOfABoomHoldsThePublishedLoad) {
  const Value& boom = published_case("planar-machines.json", "hydraulic-boom");
  for (const Value& row : at(boom, "computed.rows").as_array()) {
    const std::vector<double> wanted = numbers(row);  // angle, length, its derivative, force, pressure
    const std::string text = fmt::format(R"(
schema = 1
kind   = "analysis"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name     = "frame"
points_m = {{ O = [0, 0], P = [0.35, -0.45] }}
[[mechanism.body]]
name     = "boom"
points_m = {{ O = [0, 0], Q = [1.2, 0.15], L = [3, 0] }}
mass_kg  = 0.0
[[mechanism.joint]]
name   = "O"
first  = "frame.O"
second = "boom.O"
[[mechanism.strut]]
name     = "cylinder"
first    = "frame.P"
second   = "boom.Q"
cylinder = {{ bore_mm = 100, rod_mm = 56, pressure_Pa = {:.17g}, back_pressure_MPa = 0.5 }}
[[mechanism.force]]
name    = "load"
point   = "boom.L"
force_N = [0, -8000]
[drive]
joint           = "O"
speed_rad_per_s = 1.0
[[sweep.input]]
joint    = "O"
from_deg = {}
to_deg   = {}
samples  = 2
)",
                                         wanted[4], wanted[0], wanted[0] + 1);
    SCOPED_TRACE(text);
    const study::Result result = run_text(text);
    EXPECT_NEAR(column(result, "cylinder_length_m")[0], wanted[1], 1e-12);
    EXPECT_NEAR(column(result, "cylinder_speed_m_per_s")[0], wanted[2], 1e-12);
    EXPECT_NEAR(column(result, "cylinder_force_N")[0], wanted[3], 1e-7);
    EXPECT_NEAR(column(result, "O_drive_torque_N_m")[0], 0, 1e-6);
  }
}

// The stored energy is the integral of the force, by every law that goes by the length alone.
TEST(Strut, StoredEnergyIsTheIntegralOfTheForce) {
  Strut table{.force = 2, .factor = {LoadArgument::length, {0.2, 0.3, 0.5}, {10, 40, -20}}};
  Strut constant{.force = -30};
  Strut spring{.gas = GasSpring{900, 0.356, 0.08, 1.35}};
  Strut cylinder{.cylinder = Cylinder{0.1, 0.056, 5e5, 1e5}};
  Linkage any = grounded({{"O", 0}});
  any.bodies.push_back({.name = "arm", .points = {{"O", 0}, {"A", 1}}});
  any.joints.push_back({.name = "O", .first = {0, 0}, .second = {1, 0}});
  any.driven = {0};
  const LinkagePlan plan = planned(any);
  const LinkageMotion motion(plan);
  for (const Strut& s : {table, constant, spring, cylinder}) {
    ASSERT_TRUE(stores_energy(s));
    for (const double length : {0.13, 0.24, 0.33, 0.61}) {
      const double slope = (stored_energy(s, length + 1e-4) - stored_energy(s, length - 1e-4)) / 2e-4;
      EXPECT_NEAR(slope, -push_of(s, any, plan, motion, {.length = length}, 0, 0),
                  1e-6 * std::abs(slope) + 1e-9);
    }
  }
  table.factor.against = LoadArgument::speed;
  EXPECT_FALSE(stores_energy(table));
}

TEST(Strut, TablesGoByWhatTheySay) {
  const auto force = [](const std::string& law) {
    return column(run_text(bonnet(strut(law), sweep)), "lift_force_N");
  };
  const std::vector<double> angle =
      force("against = \"input\"\nargument_deg = [0, 75]\nforce_table_N = [0, 750]");
  EXPECT_NEAR(angle[30], 300, 1e-9);
  const std::vector<double> length =
      force("against = \"length\"\nargument_mm = [200, 400]\nforce_table_N = [200, 400]");
  EXPECT_NEAR(length[0], 280, 1e-9);
  const study::Result damper = run_text(
      bonnet(strut("against = \"speed\"\nargument_m_per_s = [-1, 1]\nforce_table_N = [1000, -1000]"), sweep));
  EXPECT_NEAR(column(damper, "lift_force_N")[40], -1000 * column(damper, "lift_speed_m_per_s")[40], 1e-9);
  EXPECT_EQ(damper.tables[0].find("lift_energy_J"), nullptr);
}

TEST(Strut, PressuresOfCylindersMayBeFormulas) {
  const auto force = [](const std::string& pressures) {
    return column(
        run_text(bonnet(strut("cylinder = { bore_mm = 40, rod_mm = 25, " + pressures + " }"), sweep)),
        "lift_force_N");
  };
  const double bore = pi / 4 * 0.04 * 0.04, ring = bore - pi / 4 * 0.025 * 0.025;
  const std::vector<double> rising =
      force("pressure_formula = 'table(q(\"O\"), 0 deg, 1 MPa, 10 deg, 3 MPa)', back_pressure_MPa = 0.4");
  EXPECT_NEAR(rising[0], 1e6 * bore - 0.4e6 * ring, 1e-9);
  EXPECT_NEAR(rising[5], 2e6 * bore - 0.4e6 * ring, 1e-9);
  EXPECT_NEAR(rising[50], 3e6 * bore - 0.4e6 * ring, 1e-9);
  const std::vector<double> back = force("pressure_MPa = 1, back_pressure_formula = '2 MPa * q(\"O\") / pi'");
  EXPECT_NEAR(back[45], 1e6 * bore - 0.5e6 * ring, 1e-9);
  const auto wrong = [](const std::string& pressures) {
    return problems_of(bonnet(strut("cylinder = { bore_mm = 40, " + pressures + " }"), sweep));
  };
  EXPECT_THAT(wrong("rod_mm = 2"), HasSubstr("cylinder 'lift' has no pressure"));
  EXPECT_THAT(wrong("pressure_MPa = 1, pressure_formula = '1 MPa'"),
              HasSubstr("cylinder 'lift' has a pressure and a formula of it"));
  EXPECT_THAT(wrong("pressure_formula = '1 N'"),
              HasSubstr("mechanism.strut[0].cylinder: \"1 N\", column 1: is a force, and must be a stress"));
}

TEST(Strut, FormulasAreTheTablesThatTheyDescribe) {
  const auto analysed = [](const std::string& law) { return run_text(bonnet(strut(law), sweep)); };
  const study::Result gas_law = run_text(bonnet(gas, sweep)),
                      formula = analysed("formula = \"900 N * (1 + 0.35 * (356 mm - s) / (80 mm))\"");
  ASSERT_EQ(formula.status, Status::done) << to_string(formula.headline);
  for (const char* key : {"lift_force_N", "O_drive_torque_N_m", "load_power_W"})
    for (std::size_t i = 0; i < 76; ++i)
      EXPECT_NEAR(column(formula, key)[i], column(gas_law, key)[i], 1e-9) << key;
  const study::Result damper = analysed("formula = \"-if(v > 0, 1, 2) * 1000 N*s/m * v\"");
  EXPECT_NEAR(column(damper, "lift_force_N")[40], -1000 * column(damper, "lift_speed_m_per_s")[40], 1e-9);
  EXPECT_EQ(damper.tables[0].find("lift_energy_J"), nullptr);
  // What a formula goes by besides time is not forgotten.
  LinkageForm form;
  form.bodies = {{.name = "ground", .points = {{"O", {0, 0}}}},
                 {.name = "arm", .points = {{"O", {0, 0}}, {"A", {1, 0}}}}};
  form.joints = {{.name = "O", .first = "ground.O", .second = "arm.O"}};
  for (const char* text : {"1 N/s * time + 1 N*s/m * v", "1 N/s * time"})
    form.struts.push_back({.name = text, .first = "ground.O", .second = "arm.A", .formula = text});
  std::vector<FormProblem> problems;
  const Linkage both = linkage_of(form, problems);
  EXPECT_TRUE(goes_by(both.struts[0], LoadArgument::speed));
  EXPECT_FALSE(goes_by(both.struts[1], LoadArgument::speed));
  EXPECT_TRUE(goes_by(both.struts[0], LoadArgument::time));
}

// A formula of the length alone is no stored energy, but its work closes the balance all the same.
TEST(Strut, FormulasKeepTheBalanceOfASimulation) {
  const std::string motion =
      "[drive]\njoint = \"O\"\nfree = true\nstart_deg = 30.0\n[simulation]\nto_s = 0.6\nsamples = 61\n";
  const auto moved = [&](const std::string& law) {
    return run_text(replaced(bonnet(law, motion), "\"analysis\"", "\"simulation\""));
  };
  const study::Result by_law = moved(gas),
                      formula = moved(strut("formula = \"900 N * (1 + 0.35 * (356 mm - s) / (80 mm))\""));
  ASSERT_EQ(formula.status, Status::done) << to_string(formula.headline);
  EXPECT_LE(largest(column(formula, "energy_drift_J")), 1e-7);
  EXPECT_NEAR(column(formula, "O_angle_rad").back(), column(by_law, "O_angle_rad").back(), 1e-8);
  const study::Result pulsed =
      moved(strut("formula = \"700 N + 50 N * sin(2*pi*time / (0.2 s)) - 100 N*s/m * v\""));
  ASSERT_EQ(pulsed.status, Status::done) << to_string(pulsed.headline);
  EXPECT_LE(largest(column(pulsed, "energy_drift_J")), 1e-7);
}

TEST(Strut, AFormulaWithoutAValueIsNamed) {
  const std::string law = "formula = \"1 N / (1 - floor(s / (300 mm)))\"";
  const study::Result swept = run_text(bonnet(strut(law), sweep));
  EXPECT_EQ(swept.status, Status::limit_reached);
  EXPECT_THAT(lines_of(swept.diagnostics),
              HasSubstr("the formula of strut 'lift' has no value at a length of 30"));
  const std::string motion =
      "[drive]\njoint = \"O\"\nfree = true\nstart_deg = 30.0\n[simulation]\nto_s = 0.6\n";
  const study::Result moved =
      run_text(replaced(bonnet(strut("formula = \"700 N * sqrt(0.3 - time / (1 s))\""), motion),
                        "\"analysis\"", "\"simulation\""));
  EXPECT_EQ(moved.status, Status::limit_reached);
  EXPECT_THAT(lines_of(moved.diagnostics),
              HasSubstr("the formula of strut 'lift' has no value from there on"));
  const auto wrong = [](const std::string& text) {
    return problems_of(bonnet(strut("formula = \"" + text + "\""), sweep));
  };
  EXPECT_THAT(wrong("200 N + 15 mm"),
              HasSubstr("mechanism.strut[0].formula: column 9: cannot add a length to a force"));
  EXPECT_THAT(
      wrong("F + 1 N"),
      HasSubstr("column 1: nothing is called 'F' here; there are time, s, v, q(\"...\"), rate(\"...\"), "));
}

TEST(Strut, SimulationsKeepTheEnergy) {
  const std::string motion =
      "[drive]\njoint = \"O\"\nfree = true\nstart_deg = 30.0\n[simulation]\nto_s = 0.6\nsamples = 61\n";
  std::string text = replaced(bonnet(gas, motion), "\"analysis\"", "\"simulation\"");
  const study::Result result = run_text(text);
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  EXPECT_LE(largest(column(result, "energy_drift_J")), 1e-7);
  EXPECT_GT(largest(column(result, "kinetic_energy_J")), 0.1);
  EXPECT_LE(largest(column(result, "work_J")), 1e-9);
  const study::Result damped = run_text(
      replaced(text, "[drive]",
               "[[mechanism.strut]]\nname = \"damper\"\nfirst = \"car.P\"\nsecond = \"bonnet.Q\"\nagainst = "
               "\"speed\"\nargument_m_per_s = [-1, 1]\nforce_table_N = [900, -900]\n[drive]"));
  EXPECT_LE(largest(column(damped, "energy_drift_J")), 1e-7);
  EXPECT_LT(column(damped, "work_J").back(), -0.01);
}

TEST(Strut, AGasSpringBeyondItsStrokeIsNamed) {
  const study::Result swept = run_text(bonnet(gas, replaced(sweep, "75.0", "90.0")));
  EXPECT_EQ(swept.status, Status::limit_reached);
  EXPECT_THAT(lines_of(swept.diagnostics), HasSubstr("gas spring 'lift' would be 35"));
  EXPECT_THAT(lines_of(swept.diagnostics), HasSubstr("it goes from 276 mm to 356 mm"));
  EXPECT_TRUE(std::isnan(column(swept, "lift_force_N").back()));
  const std::string motion =
      "[drive]\njoint = \"O\"\nfree = true\nstart_deg = 60.0\n[simulation]\nto_s = 3.0\n";
  const study::Result moved = run_text(replaced(bonnet(gas, motion), "\"analysis\"", "\"simulation\""));
  EXPECT_EQ(moved.status, Status::limit_reached);
  EXPECT_THAT(lines_of(moved.diagnostics), HasSubstr("gas spring 'lift' is extended"));
  const study::Result start =
      run_text(replaced(replaced(bonnet(gas, motion), "\"analysis\"", "\"simulation\""), "60.0", "120.0"));
  EXPECT_THAT(lines_of(start.diagnostics), HasSubstr("would be"));
}

TEST(Strut, WrongInputIsNamed) {
  const auto wrong = [](const std::string& law) { return problems_of(bonnet(strut(law), sweep)); };
  EXPECT_THAT(wrong(""), HasSubstr("strut 'lift' has no force"));
  EXPECT_THAT(wrong("force_N = 3\ncylinder = { bore_mm = 30, pressure_MPa = 1 }"),
              HasSubstr("strut 'lift' has several forces"));
  EXPECT_THAT(wrong("cylinder = { bore_mm = 30, rod_mm = 40, pressure_MPa = 1 }"),
              HasSubstr("its rod of 40 mm does not fit into its bore of 30 mm"));
  EXPECT_THAT(wrong("gas = { extended_N = 900, stroke_mm = 80 }"),
              HasSubstr("gas spring 'lift' has no extended length"));
  EXPECT_THAT(wrong("gas = { extended_N = 900, extended_mm = 70, stroke_mm = 80 }"),
              HasSubstr("its stroke of 80 mm is as long as its extended length of 70 mm"));
  EXPECT_THAT(wrong("against = \"length\"\nargument_s = [0, 1]\nforce_table_N = [1, 2]"),
              HasSubstr("strut 'lift' goes by length, which is not in argument_s"));
  EXPECT_THAT(wrong("against = \"length\"\nargument_kg = [0, 1]\nforce_table_N = [1, 2]"),
              HasSubstr("argument_kg"));
  EXPECT_THAT(wrong("force_table_N = [1, 2]"), HasSubstr("it is not said what it goes by"));
  EXPECT_THAT(wrong("against = \"speed\"\nforce_table_N = [1, 2]"), HasSubstr("has no arguments"));
  EXPECT_THAT(wrong("against = \"x\"\nforce_table_N = [1, 2]"), HasSubstr("but has two points"));
  EXPECT_THAT(wrong("against = \"length\"\nargument_mm = [1, 0]\nforce_table_N = [1, 2]"),
              HasSubstr("do not rise"));
  EXPECT_THAT(wrong("against = \"length\"\nargument_mm = [0, 1]\nforce_table_N = [1, 2]\nperiod = 1.0"),
              HasSubstr("its table goes by length, which does not repeat"));
  EXPECT_THAT(problems_of(bonnet(replaced(gas, "bonnet.Q", "car.O"), sweep)), HasSubstr("on body 'car'"));
}

TEST(Strut, FormsCarryEveryLaw) {
  LinkageForm form;
  form.bodies = {{.name = "ground", .points = {{"O", {0, 0}}}},
                 {.name = "arm", .points = {{"O", {0, 0}}, {"A", {1, 0}}}}};
  form.joints = {{.name = "O", .first = "ground.O", .second = "arm.O"}};
  const auto add = [&](const char* name) -> StrutForm& {
    form.struts.push_back({.name = name, .first = "ground.O", .second = "arm.A"});
    return form.struts.back();
  };
  add("constant").force = 3;
  add("gas").gas = GasSpringForm{900.0, 0.356, 0.08, 1.35};
  add("cylinder").cylinder = CylinderForm{.bore = 0.1, .rod = 0.05, .pressure = 1e6, .back_pressure = 1e5};
  add("formula").formula = "3 N + 2 N/mm * s";
  StrutForm& table = add("table");
  table.against = LoadArgument::time;
  table.times = {0.0, 1.0};
  table.force_table = {5.0, 6.0};
  std::vector<FormProblem> problems;
  const LinkageForm again = form_of(linkage_of(form, problems));
  ASSERT_TRUE(problems.empty()) << to_string(problems[0].message);
  ASSERT_EQ(again.struts.size(), 5u);
  EXPECT_EQ(again.struts[3].formula, "3 N + 2 N/mm * s");
  EXPECT_EQ(again.struts[0].force, 3);
  EXPECT_EQ(again.struts[1].gas->extended_length, 0.356);
  EXPECT_EQ(again.struts[2].cylinder->back_pressure, 1e5);
  EXPECT_EQ(again.struts[4].times, table.times);
  EXPECT_EQ(again.struts[4].force_table, table.force_table);
}

TEST(Strut, PreloadOfASpringGivesItsFreeLength) {
  const std::string spring =
      "[[mechanism.spring]]\nname = \"s\"\nfirst = \"car.P\"\nsecond = \"bonnet.Q\"\nstiffness_N_per_mm = 2\n"
      "preload_N = 100\n";
  const std::string text =
      replaced(bonnet(spring, sweep), "type = \"planar.linkage\"", "type = \"planar.linkage\"\ndrawn = true");
  // 280 mm as drawn, so 230 mm without force: the same torque as of a spring of that length.
  const study::Result result = run_text(text);
  const study::Result same = run_text(replaced(text, "preload_N = 100", "free_length_mm = 230"));
  EXPECT_NEAR(column(result, "O_drive_torque_N_m")[50], column(same, "O_drive_torque_N_m")[50], 1e-9);
  EXPECT_THAT(problems_of(replaced(text, "preload_N = 100", "preload_N = 600")),
              HasSubstr("is 280 mm long there and cannot pull with 600 N"));
  EXPECT_THAT(problems_of(replaced(text, "preload_N", "free_length_mm = 3\npreload_N")),
              HasSubstr("spring 's' has a preload and a free length"));
  EXPECT_THAT(problems_of(replaced(text, "drawn = true", "")),
              HasSubstr("the length at which spring 's' has its preload is not known"));
}

}  // namespace
}  // namespace linkwright::planar
