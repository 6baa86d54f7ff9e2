// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/corner.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/parameters.h"
#include "suspension/studies.h"

namespace linkwright::suspension {
namespace {

using test::column;
using test::head;
using test::problems_of;
using test::racks;
using test::replaced;
using test::run_text;
using test::sample;
using test::sweep;
using ::testing::AllOf;
using ::testing::HasSubstr;

// The same car printed by another program: millimetres, x rearward, y to the right, origin 1.2 m ahead of
// and 0.3 m below the wheel centres, and the wheel on the right.
TEST(CornerStudy, ReadsPrintedHardPointsOfTheRightWheelInAnotherFrame) {
  const auto folder = std::filesystem::temp_directory_path() / "linkwright_hard_points";
  std::filesystem::create_directories(folder);
  const Suspension& left = corner_sample("2RS-US").suspension;
  std::ofstream file(folder / "car.txt");
  file << "$ printed in mm: X rearward, Y right, Z up\n";
  const auto print = [&](const char* name, const Vec3& at) {
    // Forward x becomes 1200 - x; the right wheel's y is the left one's in this frame; z + 300.
    file << fmt::format("{:24} {:.3f} {:.3f} {:.3f}\n", name, 1200 - at.x * 1e3, at.y * 1e3,
                        at.z * 1e3 + 300);
  };
  print("LCA front", left.links[0].body[0]);
  print("LCA rear", left.links[0].body[1]);
  print("LCA outer", left.links[0].carrier[0]);
  print("UCA front", left.links[1].body[0]);
  print("UCA rear", left.links[1].body[1]);
  print("UCA outer", left.links[1].carrier[0]);
  print("Tie rod inner", left.links[2].body[0]);
  print("Tie rod outer", left.links[2].carrier[0]);
  print("Spring top", left.spring->body);
  print("Spring bottom", left.spring->moving);
  print("Wheel centre", left.wheel.centre);
  file.close();
  const std::string text = head + R"(side = "right"
[mechanism.hard_points]
file = "car.txt"
x = "rearward"
y = "right"
z = "up"
origin_mm = [1200, 0, -300]
[mechanism.wheel]
point = "wheel centre"
toe_deg = 0.1
camber_deg = -0.5
tyre_diameter_mm = 640
[[mechanism.link]]
name = "lower wishbone"
type = "RS"
points = ["LCA front", "LCA rear", "LCA outer"]
[[mechanism.link]]
name = "upper wishbone"
type = "RS"
points = ["UCA front", "UCA rear", "UCA outer"]
[[mechanism.link]]
name = "tie rod"
type = "US"
points = ["Tie rod inner", "Tie rod outer"]
moved_by = "rack"
[mechanism.spring]
points = ["Spring top", "Spring bottom"]
attached_to = "lower wishbone"
)" + sweep + racks;
  const study::Result right = run_text(text, folder);
  const study::Result known = run_text(sample("2RS-US", sweep + racks));
  ASSERT_EQ(right.status, Status::done);
  for (const char* key : {"toe_rad", "camber_rad", "carrier_pitch_rad", "half_track_change_m",
                          "roll_centre_height_m", "caster_rad", "kingpin_inclination_rad", "trail_m",
                          "scrub_radius_m", "motion_ratio", "wheelbase_change_m", "anti_pitch_tangent"})
    for (std::size_t rack = 0; rack < 3; ++rack)
      for (std::size_t i = 0; i < 5; ++i)
        EXPECT_NEAR(column(right, key).at(5 * rack + i), column(known, key).at(5 * (2 - rack) + i), 1e-12)
            << key;
  // Places are where the right wheel is: y < 0.
  EXPECT_NEAR(column(right, "centre_y_m").at(7), -0.76, 1e-12);
  EXPECT_NEAR(column(right, "centre_x_m").at(0), column(known, "centre_x_m").at(10), 1e-12);
  std::filesystem::remove_all(folder);
}

// A list of another program with columns of both sides: names are proposed, edited once and then read.
TEST(CornerStudy, ProposesNamesForAListOfAnotherProgram) {
  const auto folder = std::filesystem::temp_directory_path() / "linkwright_point_names";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "car.csv")
      << "Double A-Arm;;;;;;\n;Left;;;Right;;\nPoint;X [mm];Y [mm];Z [mm];X [mm];Y [mm];Z [mm]\n"
         "CHAS_LowFor;150;220;120;150;-220;120\nCHAS_LowAft;-160;230;118;-160;-230;118\n"
         "CHAS_UppFor;140;260;270;140;-260;270\nCHAS_UppAft;-150;265;262;-150;-265;262\n"
         "UPRI_LowPnt;5;560;115;5;-560;115\nUPRI_UppPnt;-12;535;290;-12;-535;290\n"
         "CHAS_TiePnt;60;225;160;60;-225;160\nUPRI_TiePnt;75;550;165;75;-550;165\nQuux;1;2;3;;;\n";
  const auto study = [](const std::string& side, const std::string& right) {
    return head + "side = \"" + side +
           "\"\n[mechanism.hard_points]\nfile = \"car.csv\"\nnames = \"names.txt\"\n[mechanism.wheel]\n"
           "centre_mm = [0, " +
           (side == "left" ? "600" : "-600") +
           ", 203]\ncamber_deg = 1.5\ntyre_diameter_mm = 406\n[[mechanism.link]]\nname = \"low\"\ntype = "
           "\"RS\"\npoints = [\"lower front" +
           right + "\", \"lower rear" + right + "\", \"lower outer" + right +
           "\"]\n[[mechanism.link]]\nname = \"up\"\ntype = \"RS\"\npoints = [\"upper front" + right +
           "\", \"upper rear" + right + "\", \"upper outer" + right +
           "\"]\n[[mechanism.link]]\nname = \"tie rod\"\ntype = \"US\"\npoints = [\"tie rod inner" + right +
           "\", \"steering arm end" + right + "\"]\nmoved_by = \"rack\"\n" + sweep;
  };
  const study::Result first = run_text(study("left", ""), folder);
  EXPECT_EQ(first.status, Status::infeasible);
  EXPECT_THAT(to_string(first.headline), HasSubstr("names.txt is not there"));
  ASSERT_EQ(first.files.size(), 1U);
  EXPECT_EQ(first.files[0].name, "names.txt");
  const std::string& proposed = first.files[0].text;
  for (const char* line :
       {"lower front = CHAS_LowFor\n", "lower rear = CHAS_LowAft\n", "upper front = CHAS_UppFor\n",
        "lower outer = UPRI_LowPnt\n", "upper outer = UPRI_UppPnt\n", "tie rod inner = CHAS_TiePnt\n",
        "steering arm end =\n", "# UPRI_TiePnt\n", "# Quux\n"})
    EXPECT_THAT(proposed, HasSubstr(line));
  const auto save = [&](const std::string& text) { std::ofstream(folder / "names.txt") << text; };
  save(proposed);
  EXPECT_THAT(
      problems_of(study("left", ""), folder),
      HasSubstr("'steering arm end =' has not two names; write: name in the study = name in the list"));
  const std::string names = replaced(proposed, "arm end =", "arm end = upri tiepnt");
  save(names);
  const study::Result left = run_text(study("left", ""), folder);
  ASSERT_EQ(left.status, Status::done);
  // The right one by the columns of its side.
  std::filesystem::remove(folder / "names.txt");
  const std::string right_names = run_text(study("right", " right"), folder).files.at(0).text;
  EXPECT_THAT(right_names, HasSubstr("lower front right = CHAS_LowFor right\n"));
  save(replaced(right_names, "arm end right =", "arm end right = UPRI_TiePnt right"));
  const study::Result right = run_text(study("right", " right"), folder);
  ASSERT_EQ(right.status, Status::done);
  for (const char* key : {"toe_rad", "camber_rad", "roll_centre_height_m"})
    EXPECT_EQ(column(left, key), column(right, key));
  save(names + "upper front = nothing\nlower spring = CHAS_LowFort\n");
  EXPECT_THAT(problems_of(study("left", ""), folder),
              AllOf(HasSubstr("'upper front' is given twice"),
                    HasSubstr("the list has no point 'CHAS_LowFort'; did you mean 'chas_lowfor'?")));
  // Other kinds of studies do not propose.
  std::filesystem::remove(folder / "names.txt");
  EXPECT_THAT(problems_of(replaced(study("left", ""), "\"analysis\"", "\"synthesis\"") +
                              "[target]\ntype = \"wheel_parameters\"\n",
                          folder),
              HasSubstr("mechanism.hard_points.names: cannot read"));
  std::filesystem::remove_all(folder);
}

TEST(CornerStudyRead, NamesWhatIsWrongWithTheMechanism) {
  const std::string good = sample("5US", sweep);
  EXPECT_THAT(problems_of(replaced(good, "5US", "5KX")),
              HasSubstr("mechanism.sample: there is no sample '5KX'; there are: R, RR-US"));
  EXPECT_THAT(problems_of(replaced(good, "[sweep", "[mechanism.wheel]\ntyre_diameter_m = 0.6\n[sweep")),
              HasSubstr("mechanism.wheel: a sample brings its own; remove it, or the sample"));
  EXPECT_THAT(problems_of(head + sweep), AllOf(HasSubstr("mechanism.wheel: this key is missing"),
                                               HasSubstr("mechanism.link: there are no links")));
  const std::string wheel = head + "[mechanism.wheel]\ncentre_m = [0, 0.7, 0]\ntyre_diameter_m = 0.6\n";
  const auto link = [](const std::string& type, const std::string& points) {
    return "[[mechanism.link]]\nname = \"arm\"\ntype = \"" + type + "\"\n" + points;
  };
  EXPECT_THAT(
      problems_of(wheel + link("RS", "body_m = [0, 0.3, 0]\ncarrier_m = [0, 0.7, 0]\n") + sweep),
      HasSubstr("mechanism.link[0].body_m: a link of type RS needs 2 points here, there are 1; two points on "
                "the axis: [[x, y, z], [x, y, z]]"));
  EXPECT_THAT(problems_of(wheel + link("US", "points = [\"a\", \"b\"]\n") + sweep),
              HasSubstr("mechanism.link[0].points: there is no hard point 'a': there are none; give "
                        "[mechanism.hard_points] file"));
  EXPECT_THAT(
      problems_of(wheel +
                  link("US", "body_m = { near = [0, 0.3, 0], box_m = 0.1 }\ncarrier_m = [0, 0.7, 0]\n") +
                  sweep),
      HasSubstr("mechanism.link[0].body_m: is a design variable, but this kind of study has none"));
  // One rod leaves the carrier five freedoms.
  EXPECT_THAT(problems_of(wheel + link("US", "body_m = [0, 0.3, 0]\ncarrier_m = [0, 0.7, 0]\n") + sweep),
              HasSubstr("mechanism.links: the links constrain 1 of the carrier's 6 degrees of freedom"));
  EXPECT_THAT(problems_of(wheel + "[mechanism.hard_points]\nx = \"left\"\n" +
                          link("US", "body_m = [0, 0.3, 0]\ncarrier_m = [0, 0.7, 0]\n") + sweep),
              HasSubstr("x and y both lie along left and right"));
  EXPECT_THAT(problems_of(wheel + "[mechanism.hard_points]\nfile = \"nowhere.csv\"\n" + sweep),
              HasSubstr("mechanism.hard_points.file: cannot read './nowhere.csv'; file names are relative"));
}

TEST(CornerStudyRead, CanonicalStudiesAreStudiesOfTheSameCorner) {
  std::string messages;
  const auto prepared = test::prepare(test::kinds().at(0).example, messages);
  ASSERT_TRUE(prepared) << messages;
  const Value& mechanism = *prepared->canonical.find("mechanism");
  EXPECT_FALSE(mechanism.find("hard_points"));
  Diagnostics problems;
  Value again = prepared->canonical;
  const auto second = study::prepare(again, "canonical", ".", test::kinds(), problems);
  ASSERT_TRUE(second) << (problems.empty() ? "" : to_string(problems[0]));
  EXPECT_EQ(second->canonical, prepared->canonical);
}

TEST(CornerStudyRead, WhatIsFixedToARodOffItsLineIsKept) {
  // The rods of the 5US sample, and its spring on the first of them.
  const Suspension& suspension = corner_sample("5US").suspension;
  std::string text = head + "[mechanism.wheel]\ncentre_m = " + test::written(suspension.wheel.centre) +
                     "\ntyre_diameter_m = 0.63\n";
  for (const CornerLink& l : suspension.links)
    text += fmt::format("[[mechanism.link]]\nname = \"{}\"\ntype = \"US\"\nbody_m = {}\ncarrier_m = {}\n",
                        l.name, test::written(l.body[0]), test::written(l.carrier[0]));
  const std::string first = suspension.links[0].name;
  text += "[mechanism.spring]\nbody_m = " + test::written(suspension.spring->body) +
          "\nmoving_m = " + test::written(suspension.spring->moving) + "\nattached_to = \"" + first + "\"\n" +
          sweep;
  const study::Result result = run_text(text);
  EXPECT_EQ(result.status, Status::done);
  Suspension same = suspension;
  same.spring->link = 0;
  const CornerPlan plan = prepare_suspension(same);
  EXPECT_NEAR(column(result, "motion_ratio").at(4),
              wheel_parameters(
                  plan, solve_position(plan, Driver::wheel_centre_z, {0.08, 0}, reference_position(plan)))
                  .motion_ratio,
              1e-9);
  // A suspension with an axis of its own moves otherwise, and the canonical study keeps it.
  const std::string other =
      replaced(text, "type = \"US\"\n", "type = \"US\"\ncross_axis = [1.0, 0.5, 0.2]\n");
  EXPECT_GT(std::abs(column(run_text(other), "motion_ratio").at(4) - column(result, "motion_ratio").at(4)),
            1e-4);
  std::string messages;
  const auto prepared = test::prepare(other, messages);
  ASSERT_TRUE(prepared) << messages;
  const Value& link = prepared->canonical.find("mechanism")->find("link")->as_array().at(0);
  ASSERT_TRUE(link.find("cross_axis"));
  EXPECT_EQ(link.find("cross_axis")->as_array().at(1).as_number(), 0.5);
}

TEST(CornerStudyRead, SlipsOfUnitsAreToldWhereTheyAre) {
  const std::string& example = test::example("");
  EXPECT_THAT(
      problems_of(replaced(example, "tyre_diameter_mm = 640.0", "tyre_diameter_m = 90.0")),
      AllOf(HasSubstr("mechanism.wheel: the tyre's radius is 45 m"), HasSubstr("check tyre_diameter")));
  EXPECT_THAT(problems_of(replaced(example, "points_mm]", "points_m]")),
              HasSubstr("are these millimetres in keys of metres?"));
}

TEST(CornerStudyRead, CouplersBeginOnTheLineOrOffIt) {
  CornerDescription d;
  d.suspension = corner_sample("interconnected").suspension;
  d.suspension.couplers[0].begin = Vec3{0.02, 0.6, 0.08};
  for (const CornerLink& l : d.suspension.links) d.links.push_back(given_link(l));
  for (const Coupler& c : d.suspension.couplers)
    d.couplers.push_back({.name = c.name, .first = c.first, .second = c.second, .point = {c.point, c.point}});
  const Value mechanism = write_suspension(d);
  const Value& coupler = mechanism.find("coupler")->as_array().at(0);
  ASSERT_TRUE(coupler.find("first_point_m"));
  EXPECT_EQ(coupler.find("first_point_m")->as_array().at(1).as_number(), 0.6);
  EXPECT_FALSE(coupler.find("fraction"));
  d.suspension.couplers[0].begin.reset();
  EXPECT_TRUE(write_suspension(d).find("coupler")->as_array().at(0).find("fraction"));
}

}  // namespace
}  // namespace linkwright::suspension
