// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/compliance.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "suspension/studies.h"

namespace linkwright::suspension {
namespace {

using test::named;
using test::problems_of;
using test::replaced;
using test::run_text;
using test::table;
using ::testing::HasSubstr;

// The sample 5US with the stiffness of its spring.
std::string compliance_study(const std::string& rest, const std::string& stiffness = "") {
  std::string text =
      "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"suspension.corner\"\n"
      "[mechanism.wheel]\ncentre_m = [0, 0.75, 0]\ntoe_deg = 0.12\ncamber_deg = -0.6\ntyre_diameter_m = "
      "0.65\n"
      "[mechanism.spring]\nbody_m = [0.02, 0.5, 0.42]\nmoving_m = [0, 0.6, -0.11]\n" +
      stiffness;
  const auto link = [&](const char* name, const char* body, const char* carrier, const char* more = "") {
    text +=
        fmt::format("[[mechanism.link]]\nname = \"{}\"\ntype = \"US\"\nbody_m = [{}]\ncarrier_m = [{}]\n{}",
                    name, body, carrier, more);
  };
  link("lower front rod", "0.2, 0.36, -0.1", "0.022, 0.7, -0.125");
  link("lower rear rod", "-0.21, 0.37, -0.105", "-0.018, 0.695, -0.128");
  link("tie rod", "-0.125, 0.406, -0.018", "-0.15, 0.69, -0.02", "moved_by = \"rack\"\n");
  link("upper front rod", "0.14, 0.44, 0.28", "-0.005, 0.655, 0.31");
  link("upper rear rod", "-0.17, 0.45, 0.27", "-0.035, 0.648, 0.308");
  return text + "[sweep.travel]\nvalues_mm = [0]\n[compliance]\n" + rest;
}
std::string rod(const std::string& name, int stiffness) {
  return fmt::format("[[compliance.joint]]\nlink = \"{}\"\nstiffness_N_per_mm = {}\n", name, stiffness);
}
std::string rods() {
  return rod("lower front rod", 18000) + rod("lower rear rod", 20000) + rod("tie rod", 15000) +
         rod("upper front rod", 12000) + rod("upper rear rod", 12000);
}

TEST(ComplianceStudy, TellsWhatElasticRodsDo) {
  // Reference figures of five elastic rods and a spring of 30 N/mm, body fixed: a kilonewton to the left at
  // the contact, and the spring force of 4 kN there.
  const study::Result result =
      run_text(compliance_study(rods() + "[[compliance.load]]\nname = \"lateral\"\nforce_N = [0, 1000, 0]\n"
                                         "[[compliance.load]]\nname = \"weight\"\nforce_N = [0, 0, 4000]\n",
                                "stiffness_N_per_mm = 30\n"));
  ASSERT_EQ(result.status, Status::done);
  EXPECT_TRUE(result.diagnostics.empty());
  const Table& loads = table(result, "loads");
  EXPECT_NEAR(named(loads, "lateral", "toe_rad"), -0.0005945128820499071, 1e-9 * 6e-4);
  EXPECT_NEAR(named(loads, "lateral", "camber_rad"), -0.003929538567960345, 1e-9 * 4e-3);
  EXPECT_NEAR(named(loads, "lateral", "centre_z_m"), 0.00724337568465979, 1e-9 * 7e-3);
  EXPECT_NEAR(named(loads, "weight", "spring_N"), 4480.535826622259, 1e-9 * 4500);
  // The coefficients are the same figures, outboard on the left.
  EXPECT_NEAR(named(table(result, "compliance"), "lateral force steer, toe (deg/kN)", "value"),
              -0.0005945128820499071 * 180 / M_PI, 1e-9);
  const Table& forces = table(result, "load_forces-2");
  EXPECT_NEAR(named(forces, "lower front rod, body", "size_N"), 1337.7355480453393, 1e-6);
  const Table& matrix = table(result, "compliance_matrix");
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      EXPECT_NEAR(matrix.columns[j].values[i], matrix.columns[i].values[j], 1e-15);
}

TEST(ComplianceStudy, GoesOverTravelAndRack) {
  std::string text = compliance_study("support = \"contact_held\"\n" + rods());
  text = replaced(text, "values_mm = [0]", "values_mm = [-30, 0, 30]\n[sweep.rack]\nvalues_mm = [0, 10]");
  const study::Result result = run_text(text);
  ASSERT_EQ(result.status, Status::done);
  const Table& grid = table(result, "compliance_over_travel");
  ASSERT_EQ(grid.rows(), 6U);
  const Table& reference = table(result, "compliance");
  const auto column = [&](const char* key) { return grid.find(key)->values; };
  EXPECT_EQ(column("travel_m"), (std::vector<double>{-0.03, 0, 0.03, -0.03, 0, 0.03}));
  EXPECT_EQ(column("rack_m"), (std::vector<double>{0, 0, 0, 0.01, 0.01, 0.01}));
  EXPECT_NEAR(column("lateral_steer_deg_per_kN")[1],
              named(reference, "lateral force steer, toe (deg/kN)", "value"), 1e-12);
  EXPECT_NEAR(column("aligning_camber_deg_per_100_N_m")[1],
              named(reference, "aligning torque camber (deg/100 N m)", "value"), 1e-12);
  EXPECT_GT(std::abs(column("lateral_steer_deg_per_kN")[0] - column("lateral_steer_deg_per_kN")[2]), 1e-6);
}

TEST(ComplianceStudy, CarriesThePreloadOfTheSpringOverTravel) {
  std::string text = compliance_study("preload_N = 4000\n" + rods(), "stiffness_N_per_mm = 30\n");
  const study::Result result = run_text(replaced(text, "values_mm = [0]", "values_mm = [-30, 0, 30]"));
  ASSERT_EQ(result.status, Status::done);
  const Table& grid = table(result, "compliance_over_travel");
  EXPECT_NEAR(grid.find("lateral_camber_deg_per_kN")->values[1],
              named(table(result, "compliance"), "lateral force camber (deg/kN)", "value"), 1e-12);
}

TEST(ComplianceStudy, JoinsBothWheelsByTheirRack) {
  const auto run = [](const std::string& axle) {
    return run_text(compliance_study("support = \"contact_held\"\n" + rods() + "[compliance.axle]\n" + axle));
  };
  const study::Result held = run(""), soft = run("rack_stiffness_N_per_mm = 2000\n");
  const Table& matrix = table(soft, "axle_compliance_matrix");
  ASSERT_EQ(matrix.columns.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < 12; ++j)
      EXPECT_NEAR(matrix.columns[j].values[i], matrix.columns[i].values[j], 1e-15);
  // With the rack held each wheel is alone.
  EXPECT_NEAR(named(table(held, "axle_compliance"), "lateral, parallel", "left_toe_rad") * 180 / M_PI,
              named(table(held, "compliance"), "lateral force steer, toe (deg/kN)", "value"), 1e-12);
  EXPECT_EQ(named(table(held, "axle_compliance"), "lateral, parallel", "rack_m"), 0);
  // Opposing lateral forces are a mirror image: the rack keeps its place and the axle does not steer.
  EXPECT_NEAR(named(table(soft, "axle_compliance"), "lateral, opposing", "steer_rad"), 0, 1e-15);
  EXPECT_NEAR(named(table(soft, "axle_compliance"), "lateral, opposing", "rack_m"), 0, 1e-15);
  EXPECT_GT(std::abs(named(table(soft, "axle_compliance"), "lateral, parallel", "rack_m")), 1e-6);
}

TEST(ComplianceStudy, FollowsCharacteristicsOverTheLoad) {
  const std::string joint = "[[compliance.joint]]\nlink = \"lower front rod\"\nend = \"body\"\n",
                    load = "[[compliance.load]]\nname = \"bend\"\nforce_N = [0, -4000, 0]\nsteps = 4\n";
  const std::string curve =
      "radial_N_per_mm = 9000\naxial_curve = { displacement_mm = [0, 0.2, 0.5], force_N = [0, 1000, 9000] "
      "}\n";
  const study::Result result =
      run_text(compliance_study("support = \"contact_held\"\n" + joint + curve + load));
  ASSERT_EQ(result.status, Status::done);
  const Table& over = table(result, "over_load-1");
  ASSERT_EQ(over.rows(), 5U);
  EXPECT_EQ(over.find("share")->values, (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(over.find("toe_rad")->values.back(), named(table(result, "loads"), "bend", "toe_rad"));
  const auto& camber = over.find("camber_rad")->values;
  EXPECT_EQ(camber[0], 0);
  EXPECT_LT(std::abs(camber[4]), 3.9 * std::abs(camber[1]));  // progressive
  const auto& slope = over.find("lateral_camber_deg_per_kN")->values;
  EXPECT_NEAR(slope[0], named(table(result, "compliance"), "lateral force camber (deg/kN)", "value"), 1e-12);
  EXPECT_LT(std::abs(slope[4]), 0.7 * std::abs(slope[0]));
}

// A subframe on mounts and a bar between the carriers: they do what each is there for, and vanish at the ends
// of their stiffness.
TEST(ComplianceStudy, JoinsBothWheelsByASubframeAndABar) {
  const std::string bar =
      "[mechanism.anti_roll_bar]\naxis_m = [[-0.2, 0, -0.15], [-0.2, 0.1, -0.15]]\ndroplink_m = [[0, 0.6, "
      "-0.1], [0, 0.55, -0.15]]\nattached_to = \"carrier\"\nstiffness_N_m_per_rad = 1500\n";
  const auto run = [&](const std::string& axle, bool with_bar = false) {
    std::string text = compliance_study(rods() + "[compliance.axle]\n" + axle, "stiffness_N_per_mm = 30\n");
    if (with_bar) text = replaced(text, "[mechanism.spring]", bar + "[mechanism.spring]");
    return run_text(text);
  };
  const auto mount = [](const std::string& stiffness) {
    std::string out;
    for (const char* point : {"[0.25, 0.4, 0]", "[-0.25, 0.4, 0.1]"})
      out +=
          fmt::format("[[compliance.axle.mount]]\npoint_m = {}\naxial_N_per_mm = {}\nradial_N_per_mm = {}\n",
                      point, stiffness, stiffness);
    return out;
  };
  const study::Result held = run(""), soft = run(mount("3000")), hard = run(mount("1e11")),
                      barred = run("anti_roll_bar = true\n", true);
  const auto value = [](const study::Result& of, const char* load, const char* column) {
    return named(table(of, "axle_compliance"), load, column);
  };
  EXPECT_NEAR(value(hard, "lateral, parallel", "left_toe_rad"),
              value(held, "lateral, parallel", "left_toe_rad"), 1e-8);
  EXPECT_GT(std::abs(value(soft, "lateral, parallel", "left_camber_rad") -
                     value(held, "lateral, parallel", "left_camber_rad")),
            1e-5);
  // Both wheels up alike do not twist the bar; one up and one down do, and travel less.
  EXPECT_NEAR(value(barred, "vertical, parallel", "anti_roll_bar_N_m"), 0, 1e-9);
  EXPECT_NEAR(value(barred, "vertical, parallel", "left_camber_rad"),
              value(held, "vertical, parallel", "left_camber_rad"), 1e-12);
  EXPECT_GT(std::abs(value(barred, "vertical, opposing", "anti_roll_bar_N_m")), 10);
  const auto rise = [](const study::Result& of) {
    const Table& m = table(of, "axle_compliance_matrix");
    return m.find("by_left_force_z")->values[2] - m.find("by_right_force_z")->values[2];
  };
  EXPECT_LT(rise(barred), 0.9 * rise(held));
  const Table& matrix = table(soft, "axle_compliance_matrix");
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < 12; ++j)
      EXPECT_NEAR(matrix.columns[j].values[i], matrix.columns[i].values[j], 1e-14);
  const auto wrong = [&](const std::string& axle) {
    return problems_of(compliance_study(rods() + "[compliance.axle]\n" + axle, "stiffness_N_per_mm = 30\n"));
  };
  EXPECT_THAT(wrong("anti_roll_bar = true\n"),
              HasSubstr("compliance.axle.anti_roll_bar: there is no anti-roll bar"));
  EXPECT_THAT(wrong("on_subframe = [\"tie rot\"]\n" + mount("1")), HasSubstr("there is no link 'tie rot'"));
  EXPECT_THAT(wrong("on_subframe = [\"tie rod\"]\n"), HasSubstr("the subframe has no mounts"));
}

// Bushings with another stiffness in their second radial direction, and with a moment over their rotation.
TEST(ComplianceStudy, TakesFramesAndMomentsOfBushings) {
  const auto camber = [](const std::string& joint) {
    const study::Result result = run_text(
        compliance_study("support = \"contact_held\"\n[[compliance.joint]]\nlink = \"lower front rod\"\n"
                         "end = \"body\"\naxis = [1, 0, 0]\n" +
                         joint));
    EXPECT_EQ(result.status, Status::done);
    return named(table(result, "compliance"), "lateral force camber (deg/kN)", "value");
  };
  const double round = camber("axial_N_per_mm = 800\nradial_N_per_mm = 2000\n");
  // Along y 2000 N/mm, along z 9000 N/mm, or turned by a quarter: the same bushing in another frame.
  const double upright = camber(
                   "axial_N_per_mm = 800\nradial_N_per_mm = 2000\nsecond_radial_N_per_mm = 9000\n"
                   "second_axis = [0, 1, 0]\n"),
               turned = camber(
                   "axial_N_per_mm = 800\nradial_N_per_mm = 9000\nsecond_radial_N_per_mm = 2000\n"
                   "second_axis = [3, 0, 1]\n");
  EXPECT_NEAR(upright, turned, 1e-12);
  EXPECT_GT(std::abs(upright - round), 1e-6);
  const std::string straight = "axial_N_per_mm = 800\nradial_N_per_mm = 2000\n";
  EXPECT_NEAR(
      camber(straight + "torsional_N_m_per_rad = 90\nconical_N_m_per_rad = 700\n"),
      camber(straight + "torsional_curve = { rotation_deg = [0, 10], moment_N_m = [0, 15.707963267948966] }\n"
                        "conical_curve = { rotation_rad = [0, 0.1, 0.2], moment_N_m = [0, 70, 140] }\n"),
      1e-12);
  EXPECT_THAT(
      problems_of(compliance_study("[[compliance.joint]]\nlink = \"tie rod\"\nend = \"body\"\n" + straight +
                                   "conical_N_m_per_rad = 1\nconical_curve = { rotation_deg = [0, 1], "
                                   "moment_N_m = [0, 1] }\n")),
      HasSubstr("conical_curve: stands beside the conical stiffness"));
}

TEST(ComplianceStudyRead, NamesWhatIsWrong) {
  const std::string good = compliance_study(rods());
  EXPECT_THAT(problems_of(replaced(good, "link = \"tie rod\"", "link = \"tie rot\"")),
              HasSubstr("compliance.joint[2].link: there is no link 'tie rot'; did you mean 'tie rod'?"));
  EXPECT_THAT(
      problems_of(compliance_study("support = \"spring\"\n" + rods())),
      HasSubstr("compliance.support: the stiffness of the spring is not known; write stiffness_N_per_mm in"));
  EXPECT_THAT(problems_of(compliance_study("preload_N = 4000\n" + rods())),
              HasSubstr("compliance.preload_N: needs the spring that carries it"));
  EXPECT_THAT(problems_of(compliance_study(
                  "[[compliance.joint]]\nlink = \"tie rod\"\nend = \"body\"\naxial_N_per_mm = 1\n")),
              HasSubstr("compliance.joint[0].radial: is missing; a bushing has both"));
  const std::string bushing =
      "[[compliance.joint]]\nlink = \"tie rod\"\nend = \"body\"\nradial_N_per_mm = 1\n";
  EXPECT_THAT(problems_of(compliance_study(
                  bushing + "axial_curve = { displacement_mm = [0, 1, 2], force_N = [0, 5, 4] }\n")),
              HasSubstr("the force falls from 5 to 4 N"));
  EXPECT_THAT(
      problems_of(compliance_study(bushing + "axial_N_per_mm = 1\naxial_curve = { displacement_mm = "
                                             "[0, 1], force_N = [0, 5] }\n")),
      HasSubstr("compliance.joint[0].axial_curve: stands beside the axial stiffness; leave one of them"));
  const std::string wishbone =
      "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"suspension.corner\"\nsample = \"2RS-US\"\n"
      "[sweep.travel]\nvalues_mm = [0]\n[compliance]\n";
  EXPECT_THAT(problems_of(wishbone + rods()),
              HasSubstr("there is no link 'lower front rod'; there are: lower wishbone"));
  EXPECT_THAT(problems_of(wishbone + rod("lower wishbone", 1)),
              HasSubstr("compliance.joint[0].end: is missing: 'lower wishbone' is not a rod"));
}

TEST(ComplianceStudy, SaysWhatIsLeftFree) {
  const study::Result result = run_text(
      compliance_study("[[compliance.joint]]\nlink = \"tie rod\"\nend = \"body\"\nstiffness_N_per_mm = 0\n"));
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_THAT(to_string(result.diagnostics[0]), HasSubstr("compliance: no compliance: "));
}

}  // namespace
}  // namespace linkwright::suspension
