// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "linkwright/suspension/corner/hard_point_list.h"
#include "linkwright/suspension/corner/suspension.h"
#include "support/message.h"
#include "support/study_text.h"

namespace linkwright::suspension {
namespace {

using ::testing::HasSubstr;

HardPointList read_whole(std::string_view text, PointUnit unit = PointUnit::mm) {
  Diagnostics problems;
  auto list = read_hard_point_list(text, "points.txt", unit, problems);
  for (const Diagnostic& d : problems) ADD_FAILURE() << to_string(d) << "\n" << text;
  return list.value_or(HardPointList{});
}

std::vector<HardPoint> points_in(const HardPointList& list) {
  std::vector<HardPoint> out;
  for (const ListedPoint& p : list.points) out.push_back(p.point);
  return out;
}

std::vector<Vec3> places_in(const HardPointList& list) {
  std::vector<Vec3> out;
  for (const ListedPoint& p : list.points) out.push_back(p.point.at);
  return out;
}

/// Moves the point with this number by a third of a millimetre, which no decimal number is.
std::vector<Vec3> with_moved(const HardPointList& list, std::size_t i) {
  std::vector<Vec3> out = places_in(list);
  out.at(i) += Vec3{1e-3 / 3, -1e-3 / 3, 2e-3 / 3};
  return out;
}

// Poznanovic 2016, examples 1, 2 and 4.
constexpr const char* public_sets[]{"front_5US", "strut_SP-3US", "rear_5US"};

TEST(HardPointListWrite, ReadsTheSameBitsBackFromEveryForm) {
  for (const char* name : public_sets) {
    const std::vector<HardPoint> points = points_of(corner_sample(name).suspension);
    for (const auto& format : names(ListFormat{}))
      for (const auto& unit : names(PointUnit{})) {
        const std::string text = write_hard_points(points, format.value, unit.value);
        const HardPointList list = read_whole(text, unit.value);
        // Sections are those of an axle each; the points of one corner have none.
        EXPECT_EQ(list.format, format.value == ListFormat::sections ? ListFormat::csv : format.value);
        ASSERT_EQ(list.points.size(), points.size()) << text;
        for (std::size_t i = 0; i < points.size(); ++i) {
          EXPECT_EQ(list.points[i].point.name, points[i].name);
          // Not every length in metres is a number of another unit.
          EXPECT_LE(norm(list.points[i].point.at - points[i].at), unit.value == PointUnit::m ? 0 : 3e-16);
        }
        // Read, write, read: the same bits, as a list of its own and in a new one.
        EXPECT_EQ(write_hard_points(list, places_in(list)), text);
        EXPECT_EQ(write_hard_points(points_in(list), format.value, unit.value), text);
        EXPECT_EQ(
            points_in(read_whole(write_hard_points(points_in(list), format.value, unit.value), unit.value)),
            points_in(list));
        // A point that has moved, by a number of many digits.
        std::vector<Vec3> moved = with_moved(list, 1);
        const std::string once = write_hard_points(list, moved);
        const HardPointList again = read_whole(once, unit.value);
        EXPECT_LE(norm(again.points.at(1).point.at - moved[1]), 3e-16) << once;
        moved[1] = again.points.at(1).point.at;
        EXPECT_EQ(places_in(again), moved);
        EXPECT_EQ(write_hard_points(list, moved), once);
      }
  }
}

TEST(HardPointListWrite, WritesShortNumbers) {
  const std::vector<HardPoint> points{{"Tie rod, inner", {0.1205, -0.35, 0}},
                                      {"hub right", {0.1, -0.75, 1e-9}}};
  EXPECT_EQ(write_hard_points(points, ListFormat::csv, PointUnit::mm),
            "name,x_mm,y_mm,z_mm\ntie_rod_inner,120.5,-350,0\nhub right,100,-750,1e-06\n");
  EXPECT_EQ(write_hard_points(points, ListFormat::spreadsheet, PointUnit::mm),
            "Name;X [mm];Y [mm];Z [mm]\ntie_rod_inner;120,5;-350;0\nhub right;100;-750;1e-06\n");
  EXPECT_THAT(write_hard_points(points, ListFormat::property, PointUnit::in),
              HasSubstr("LENGTH = 'inch'\n[HARDPOINT]\n"));
  EXPECT_THAT(write_hard_points(points, ListFormat::property, PointUnit::m),
              HasSubstr(" 'hub'            'right'                         0.1                  -0.75"));
}

TEST(HardPointListWrite, KeepsEverythingElseOfAList) {
  const auto moved = [](std::string_view text, std::size_t i, const Vec3& at) {
    const HardPointList list = read_whole(text);
    std::vector<Vec3> all = places_in(list);
    all.at(i) = at;
    const std::string out = write_hard_points(list, all);
    EXPECT_EQ(places_in(read_whole(out)), all) << out;
    return out;
  };
  const Vec3 at{1.25, -0.3505, 0.0625};
  EXPECT_EQ(moved("$ static\n 1  Ball, lower   10.0    20.0   30.0  # rev B\n 2  b  1 2 3\n", 0, at),
            "$ static\n 1  Ball, lower   1250  -350.5   62.5  # rev B\n 2  b  1 2 3\n");
  EXPECT_EQ(moved("ball = (1,2,3)\n", 0, at), "ball = (1250, -350.5, 62.5)\n");
  EXPECT_EQ(moved("ball x=1cm y=2cm z=3cm\n", 0, at), "ball x=125cm y=-35.05cm z=6.25cm\n");
  EXPECT_EQ(moved("ball  0,5  720,0  300\n", 0, at), "ball 1250 -350,5 62,5\n");
  EXPECT_EQ(moved("1.0D+00 2.0D0 3.d0 ball\n", 0, at), "1250 -350.5 62.5 ball\n");
  EXPECT_EQ(moved("name,z_m,x_mm,y_cm,group\n\"Tie rod, inner\",1,2,3,7\n", 0, at),
            "name,z_m,x_mm,y_cm,group\n\"Tie rod, inner\",0.0625,1250,-35.05,7\n");
  EXPECT_EQ(moved("sep=;\nName;X [mm];Y [mm];Z [mm]\nb;\"1,5\";2;3\n", 0, at),
            "sep=;\nName;X [mm];Y [mm];Z [mm]\nb;\"1250\";-350,5;62,5\n");
  EXPECT_EQ(moved("ball 1 2 3\nother 4 5 6\nball 1 2 3\n", 0, at),
            "ball 1250 -350.5 62.5\nother 4 5 6\nball 1250 -350.5 62.5\n");
  EXPECT_EQ(moved("[UNITS]\n LENGTH = 'cm'\n[HARDPOINT]\n 'lca'  'left/right'  -20.0   -40.0   15.0\n"
                  "[PARAMETER]\n 'camber' 'left/right' 'real' -1.0\n",
                  0, at),
            "[UNITS]\n LENGTH = 'cm'\n[HARDPOINT]\n 'lca'  'left/right'    125  -35.05   6.25\n"
            "[PARAMETER]\n 'camber' 'left/right' 'real' -1.0\n");
}

TEST(HardPointListWrite, WritesBothSidesWhereTheyStand) {
  const std::string text = ";Left;;;Right;;\nPoint;X;Y;Z;X;Y;Z\nlow;100,5;200;150;100,5;-200;151\n";
  const HardPointList list = read_whole(text);
  EXPECT_EQ(list.points.at(1).label, "low right");
  std::vector<Vec3> moved = places_in(list);
  EXPECT_EQ(write_hard_points(list, moved), text);
  moved[1].y = -0.2105;
  EXPECT_EQ(write_hard_points(list, moved), test::replaced(text, "-200", "-210,5"));
}

TEST(HardPointListWrite, ReadsNumberedPointsAndHeadingsOverSeveralRows) {
  EXPECT_EQ(points_in(read_whole("Static values\n 1   10.5  20  30\n 12  40  50  60\n")),
            (std::vector<HardPoint>{{"1", {0.0105, 0.02, 0.03}}, {"12", {0.04, 0.05, 0.06}}}));
  const std::vector<HardPoint> expected{{"tie_rod_inner", {0.015, 0.02, 0.03}}};
  for (const char* text : {"Front suspension;;;\nPoint;Coordinates [cm];;\n;X;Y;Z\nTie rod, inner;1,5;2;3\n",
                           "Front suspension\nPoint;X (cm);Y (cm);Z (cm)\nTie rod, inner;1,5;2;3\n",
                           "Point;Side;Coordinates (cm);;\n;;X;Y;Z\nTie rod, inner;left;1,5;2;3\n"})
    EXPECT_EQ(points_in(read_whole(text)), expected) << text;
}

TEST(HardPointListWrite, ReadsAndWritesSectionsOfFrontAndRear) {
  const std::string text =
      "Vehicle,,,\nFront Suspension,,,\nDouble A-Arm,,,\nPoint,X [mm],Y [mm],Z "
      "[mm]\nCHAS_LowFor,100.5,200,150\n"
      "UPRI_TiePnt,-60,600,160\nRear Suspension,,,\nDouble A-Arm,,,\nPoint,X [mm],Y [mm],Z [mm]\n"
      "CHAS_LowFor,-1500,250,155\n";
  const HardPointList list = read_whole(text);
  EXPECT_EQ(list.format, ListFormat::sections);
  const std::vector<HardPoint> points = points_in(list);
  EXPECT_EQ(points, (std::vector<HardPoint>{{"front_chas_lowfor", {0.1005, 0.2, 0.15}},
                                            {"front_upri_tiepnt", {-0.06, 0.6, 0.16}},
                                            {"rear_chas_lowfor", {-1.5, 0.25, 0.155}}}));
  std::vector<Vec3> moved = places_in(list);
  moved[2] = {-1.25, 0.25, 0.155};
  EXPECT_EQ(write_hard_points(list, moved), test::replaced(text, "-1500", "-1250"));
  const std::string written = write_hard_points(points, ListFormat::sections, PointUnit::mm);
  EXPECT_EQ(written,
            "Name,X [mm],Y [mm],Z [mm]\nFront\nchas_lowfor,100.5,200,150\nupri_tiepnt,-60,600,160\nRear\n"
            "chas_lowfor,-1500,250,155\n");
  EXPECT_EQ(points_in(read_whole(written)), points);
}

TEST(HardPointListWrite, ReadsAndWritesPointsInJson) {
  const std::string text = R"({
  "Name": "front", // subchassis: x forward, y outboard, z up
  "Spindle": { "Mass": 1.1, "COM": [0, 0.9, -0.02], "Inertia": [1, 2, 3] },
  "Upper Control Arm": {
    "Location Upright": [ -0.014, 0.71, 1.6e-1 ],
    "Location Chassis": [0.0, 0.4, 0.18]
  },
  "UCA Front": [0.1, 0.2, 0.3],
  "Curve": [[0, 1, 2], [3, 4, 5]], "Flag": true
})";
  const HardPointList list = read_whole(text, PointUnit::m);
  EXPECT_EQ(list.format, ListFormat::json);
  EXPECT_EQ(points_in(list),
            (std::vector<HardPoint>{{"spindle_com", {0, 0.9, -0.02}},
                                    {"upper_control_arm_location_upright", {-0.014, 0.71, 0.16}},
                                    {"upper_control_arm_location_chassis", {0, 0.4, 0.18}},
                                    {"uca_front", {0.1, 0.2, 0.3}}}));
  std::vector<Vec3> moved = places_in(list);
  moved[1].z = 0.1625;
  EXPECT_EQ(write_hard_points(list, moved), test::replaced(text, "1.6e-1", "0.1625"));
  const std::vector<HardPoint> rocker{{"Rocker axis", {0.1, 0.2, 0.3}}};
  const std::string written = write_hard_points(rocker, ListFormat::json, PointUnit::mm);
  EXPECT_EQ(written, "{\n  \"Rocker axis\": [100, 200, 300]\n}\n");
  EXPECT_EQ(points_in(read_whole(written)), (std::vector<HardPoint>{{"rocker_axis", {0.1, 0.2, 0.3}}}));
  const auto problem = [](std::string_view bad) {
    Diagnostics problems;
    EXPECT_FALSE(read_hard_point_list(bad, "car.json", PointUnit::m, problems));
    return test::lines_of(problems);
  };
  EXPECT_THAT(problem("{\n \"a\": [1, 2, x]\n}"),
              HasSubstr("car.json:2:1: error: 'x' is not a value of JSON"));
  EXPECT_THAT(problem("{ \"a\": [1, 2, 3]"), HasSubstr("an object has no end; close it with }"));
  EXPECT_THAT(problem("{ \"a\" [1, 2, 3] }"), HasSubstr("':' is missing after \"a\""));
  EXPECT_THAT(problem("{ \"Mass\": 2 }"), HasSubstr("holds no point"));
}

}  // namespace
}  // namespace linkwright::suspension
