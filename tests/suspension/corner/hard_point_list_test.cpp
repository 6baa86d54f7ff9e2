// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/hard_point_list.h"

#include <gmock/gmock.h>

#include "support/message.h"
#include "support/study_text.h"

namespace linkwright::suspension {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::vector<HardPoint> read(std::string_view text, PointUnit unit = PointUnit::mm) {
  Diagnostics problems;
  const auto points = read_hard_points(text, "points.txt", unit, problems);
  for (const Diagnostic& d : problems) ADD_FAILURE() << to_string(d);
  return points.value_or(std::vector<HardPoint>{});
}

std::string problems_of(std::string_view text) {
  Diagnostics problems;
  EXPECT_FALSE(read_hard_points(text, "points.txt", PointUnit::mm, problems));
  return test::lines_of(problems);
}

TEST(HardPointList, ReadsListsAsSuspensionProgramsPrintThem) {
  const auto points = read(
      "$ Front suspension, static\n"
      "Hardpoints                          X        Y        Z\n"
      "   1  Lower wishbone, front pivot   -120.5   350.0   150\r\n"
      "   2  Lower wishbone rear pivot      210.25\t355.0   145.0\n"
      "\n"
      "'tie_rod.inner'  +95.0; 330.0; 2.1e2\n"
      "Wheel centre (static)   0,5   720,0   300,0\n");
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[0], (HardPoint{"lower_wishbone_front_pivot", {-0.1205, 0.35, 0.15}}));
  EXPECT_EQ(points[1], (HardPoint{"lower_wishbone_rear_pivot", {0.21025, 0.355, 0.145}}));
  EXPECT_EQ(points[2], (HardPoint{"tie_rod_inner", {0.095, 0.33, 0.21}}));
  EXPECT_EQ(points[3], (HardPoint{"wheel_centre_static", {0.0005, 0.72, 0.3}}));
  EXPECT_EQ(read("a,1,2,3\nb , 4, 5, 6\n", PointUnit::m)[1], (HardPoint{"b", {4, 5, 6}}));
}

TEST(HardPointList, ReadsTheHardPointsOfPropertyFiles) {
  const std::string file =
      "$---------------------------------------------------------------------MDI_HEADER\n"
      "[MDI_HEADER]\nFILE_VERSION = 4.0\n"
      "[UNITS]\nLENGTH = 'inch'\nANGLE = 'degrees'\n"
      "$-------------------------------------------------------------HARDPOINT\n[HARDPOINT]\n"
      "{hardpoint_name   symmetry   x_value   y_value   z_value}\n"
      " 'lca_front'        'left/right'  -200.0   -400.0   150.0\n"
      " \"rack_house\"       'single'  10  0  2e2\r\n"
      " 'battery'          'right'  1.0  2.0  3.0\n"
      "[PARAMETER]\n{parameter_name symmetry type value}\n 'camber_angle' 'left/right' 'real' -1.0\n";
  const auto points = read(test::replaced(file, "'inch'", "'mm'"), PointUnit::m);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0], (HardPoint{"lca_front", {-0.2, -0.4, 0.15}}));
  EXPECT_EQ(points[1], (HardPoint{"rack_house", {0.01, 0, 0.2}}));
  EXPECT_EQ(points[2], (HardPoint{"battery_right", {0.001, 0.002, 0.003}}));
  EXPECT_NEAR(read(file)[0].at.y, -400 * 0.0254, 1e-12);
  EXPECT_THAT(problems_of(test::replaced(file, "'single'", "'centre'")),
              HasSubstr("points.txt:11:1: error: rack_house: is not a row of hard points; write 'name' "
                        "'left/right' x y z"));
  EXPECT_THAT(problems_of(test::replaced(file, "10  0  2e2", "10  0  2e2  7")),
              HasSubstr("rack_house: is not a row of hard points"));
  EXPECT_THAT(problems_of(test::replaced(file, "'inch'", "'ell'")),
              HasSubstr("'ell' is not a known unit of length"));
}

TEST(HardPointList, ReadsCsvWithTheUnitsOfItsColumns) {
  const auto points = read("name,x_mm,y_cm,z_m,group\n\"Tie rod, inner\",1,2,3,7\nb,4,5,6,8\n");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0], (HardPoint{"tie_rod_inner", {0.001, 0.02, 3}}));
}

TEST(HardPointList, ReadsCsvAsSpreadsheetsWriteIt) {
  const HardPoint expected{"tie_rod_inner", {0.0015, 0.02, 3}};
  for (const char* text : {"Name;X [mm];Y [cm];Z [m]\nTie rod, inner;1,5;2;3\n",
                           "# from the drawing\n\nname\tx_mm\ty_cm\tz_m\nTie rod, inner\t1,5\t2\t3\n",
                           "sep=;\n\"Name\";x (mm);y (cm);z (m)\n\"Tie rod, inner\";1.5;2;3;;\n"})
    EXPECT_EQ(read(text), std::vector{expected}) << text;
  // The headings of a printed list name no units: its own are given by the study.
  EXPECT_EQ(read("name\tx\ty\tz\nb\t1\t2\t3\n"), (std::vector<HardPoint>{{"b", {0.001, 0.002, 0.003}}}));
  EXPECT_THAT(problems_of("# a\nname,x_mm,y_mm,z_mm\n\n# b\nfront,1,2,\n"),
              HasSubstr("points.txt:5:1: error: front: a coordinate is missing"));
}

TEST(HardPointList, ReadsColumnsOfBothSides) {
  const std::vector<HardPoint> expected{{"chas_lowfor", {0.1005, 0.2, 0.15}},
                                        {"rack", {0, 0, 0.1}},
                                        {"chas_lowfor_right", {0.1005, -0.2, 0.151}}};
  for (const char* text :
       {"Double A-Arm;;;;;;\n;Left;;;Right;;\nPoint;X [mm];Y [mm];Z [mm];X [mm];Y [mm];Z [mm]\n"
        "CHAS_LowFor;100,5;200;150;100,5;-200;151\nRack;0;0;100;;;\n",
        "Name,Left X,Left Y,Left Z,Right X,Right Y,Right Z\nCHAS_LowFor,100.5,200,150,100.5,-200,151\n"
        "Rack,0,0,100\n",
        "sep=;\n\"Point\";\"Left (cm)\";;;\"Right (cm)\";;\n;X;Y;Z;X;Y;Z\nCHAS_LowFor;10,05;20;15;10,05;-20;"
        "15,1\nRack;0;0;10;;;\n",
        "Point\tx_l_mm\ty_l_mm\tz_l_mm\tx_r_mm\ty_r_mm\tz_r_mm\nCHAS_LowFor\t100,5\t200\t150\t100,5\t-200\t"
        "151\nRack\t0\t0\t100\t\t\t\n"})
    EXPECT_EQ(read(text), expected) << text;
  // Under titles, with the headings repeated.
  const auto sections = read(
      "Front,,,,,,\n,Left,,,Right,,\nName,X,Y,Z,X,Y,Z\nlow,1,2,3,1,-2,3\nRear,,,,,,\n,Left,,,Right,,\n"
      "Name,X,Y,Z,X,Y,Z\nlow,-1,2,3,-1,-2,3\n");
  ASSERT_EQ(sections.size(), 4U);
  EXPECT_EQ(sections[0], (HardPoint{"front_low", {0.001, 0.002, 0.003}}));
  EXPECT_EQ(sections[3], (HardPoint{"rear_low_right", {-0.001, -0.002, 0.003}}));
  // A title that names a side is not that of a group.
  EXPECT_EQ(read("Left side;;;\nName;X;Y;Z\nb;1;2;3\n"),
            (std::vector<HardPoint>{{"b", {0.001, 0.002, 0.003}}}));
  EXPECT_THAT(problems_of(";Left;;;Right;;\nName;X;Y;Z;X;Y;Z\nlow;1;2;3;1;;3\n"),
              HasSubstr("points.txt:3:1: error: low_right: a coordinate is missing"));
  EXPECT_THAT(problems_of(";Left;;;Centre;;\nName;X;Y;Z;X;Y;Z\nlow;1;2;3;1;2;3\n"),
              HasSubstr("it has 6 numbers in a row"));
}

TEST(HardPointList, ReadsBackWhatItsTableWrites) {
  const std::vector<HardPoint> points{{"lower_front", {0.1234567890123, -0.2, 0.3}}, {"b", {1e-9, 2, 3}}};
  EXPECT_EQ(read(to_csv(hard_point_table(points))), points);
}

TEST(HardPointList, SaysWhatIsWrongWithAList) {
  EXPECT_THAT(problems_of(""), HasSubstr("points.txt: error: holds no point; one point a line: name x y z"));
  EXPECT_THAT(problems_of("a 1 2 3\nA 1 2 4\n"),
              HasSubstr("points.txt:2:1: error: a: is given twice, at different positions"));
  EXPECT_THAT(problems_of("1 2 3\n"), HasSubstr("points.txt:1:1: error: a point has no name"));
  EXPECT_THAT(problems_of("a 1 2 3e9\n"),
              HasSubstr("lies at (0.001, 0.002, 3e+06) m; is the unit of the list right?"));
  EXPECT_THAT(problems_of("name,x_mm,y_mm\na,1,2\n"), HasSubstr("z: this column is missing; write z_mm"));
  EXPECT_THAT(problems_of("name,x_mm,y_mm,z_mm\na,1,,2\n"),
              HasSubstr("points.txt:2:1: error: a: a coordinate is missing"));
}

TEST(HardPointList, ReadsARevisedPointWithARemark) {
  const std::vector<HardPoint> expected{{"tie_rod_inner", {0.001, 0.002, 0.003}}};
  for (const char* line : {"tie_rod_inner 1 2 3 # rev B",
                           "tie_rod_inner 1 2 3 rev B",
                           "tie_rod_inner 1 2 3 // rev 2",
                           "tie_rod_inner 1 2 3 mm",
                           "tie_rod_inner 1 mm, 2 mm, 3 mm",
                           "tie_rod_inner 1mm 2mm 3mm",
                           "tie_rod_inner 0.1 0.2 0.3 cm",
                           "tie_rod_inner 1 2 3;",
                           "tie_rod_inner 1 2 3 ; rev B",
                           "tie_rod_inner (1, 2, 3)",
                           "tie_rod_inner (1,2,3)",
                           "tie_rod_inner = 1, 2, 3",
                           "tie_rod_inner = 1,2,3",
                           "tie_rod_inner = [1 2 3];",
                           "[1 2 3]; % tie_rod_inner",
                           "[1, 2, 3] # tie rod inner",
                           "1 2 3 tie_rod_inner",
                           "1,2,3,tie_rod_inner",
                           "4 1 2 3 tie rod inner",
                           "tie rod inner: 1; 2; 3",
                           "tie_rod_inner x=1 y=2 z=3",
                           "tie_rod_inner X 1 Y 2 Z 3 mm",
                           "4) tie rod inner {1, 2, 3}",
                           "tie_rod_inner 1.0D+00 2.0D0 3.d0",
                           "tie_rod_inner 1 2 3 ! rev B"})
    EXPECT_EQ(read(line), expected) << line;
  // Signs of documents.
  EXPECT_EQ(read("a\xC2\xA0\xE2\x88\x92"
                 "1 2 3"),
            (std::vector<HardPoint>{{"a", {-0.001, 0.002, 0.003}}}));
}

TEST(HardPointList, TakesUnitsFromARowOfTheirOwn) {
  const std::vector<HardPoint> expected{{"b", {0.01, 0.02, 0.03}}};
  for (const char* text : {"name,x,y,z\n-,cm,cm,cm\nb,1,2,3\n", "name x y z\n- cm cm cm\nb 1 2 3\n",
                           "Point X Y Z\n[cm] [cm] [cm]\nb 1 2 3\n", "name x_cm y_cm z_cm\nb 1 2 3\n",
                           "Units: cm\nb 1 2 3\n", "name;x;y;z\n;[cm];[cm];[cm]\nb;1,0;2;3\n"})
    EXPECT_EQ(read(text), expected) << text;
  EXPECT_THAT(problems_of("name,x_mm,y_mm,z_mm\n,cm,cm,cm\nb,1,2,3\n"),
              HasSubstr("points.txt:2:1: error: x: is in cm here and in mm in the header"));
}

TEST(HardPointList, ReadsColumnsInAnyOrder) {
  const std::vector<HardPoint> expected{{"tie_rod_inner", {0.001, 0.002, 0.003}}};
  for (const char* text : {"x_mm,y_mm,z_mm,name\n1,2,3,Tie rod inner\n",
                           "Nr;Point;Y [mm];X [mm];Z [mm]\n7;tie rod inner;2;1;3\n",
                           "name,x,y,z,remark\ntie rod inner,1,2,3,rev B\n",
                           "name,x_mm,y_mm,z_mm\ntie rod inner,1,2,3 # rev B, ok\n"})
    EXPECT_EQ(read(text), expected) << text;
  EXPECT_THAT(problems_of("name z y x\na 1 2 3\n"),
              HasSubstr("points.txt:1:1: error: the coordinates are in the order z, y, x"));
  EXPECT_THAT(problems_of("name,x_mm,y_mm,z_mm\na,1,2,3\nb,1,2,3,rev B\n"),
              HasSubstr("points.txt:3:1: error: b: 'b,1,2,3,rev B' is not read: 5 values, the header has 4"));
}

TEST(HardPointList, NamesEveryLineThatItDoesNotRead) {
  EXPECT_THAT(
      problems_of("a 1 2 3\na 4 5\n"),
      AllOf(HasSubstr("points.txt:2:1: error: a: 'a 4 5' is not read: it has 2 numbers, a point has three"),
            HasSubstr("write a point as: name x y z")));
  // One number beside the name of a point may be a revision that breaks off.
  EXPECT_THAT(problems_of("a 1 2 3\na 4\n"), HasSubstr("error: a: 'a 4' is not read: it has 1 number,"));
  EXPECT_THAT(problems_of("a 1 2 3\na 4 5 6O\n"),
              HasSubstr("error: a: 'a 4 5 6O' is not read: '6O' is not a number"));
  EXPECT_THAT(
      problems_of("a 1 2 3\na 4 5 6 7\n"),
      HasSubstr("points.txt:2:1: error: a: has four numbers here, and is also a point without the 4"));
  EXPECT_THAT(problems_of("a 1 2 3 4 5\n"), HasSubstr("it has 5 numbers in a row, a point has three"));
  EXPECT_THAT(problems_of("a 1,234.5 350 150\n"), HasSubstr("write thousands without a separator"));
  EXPECT_THAT(
      problems_of("a 1 2 3\na 4 5 6\n"),
      HasSubstr("points.txt:2:1: error: a: is given twice, at different positions: (0.001, 0.002, 0.003) m "
                "in line 1 and (0.004, 0.005, 0.006) m here; neither is taken; remove the line that no "
                "longer holds"));
  Diagnostics problems;
  EXPECT_TRUE(read_hard_points("Saved 14.03.2026 12:30:15\na 1 2 3\nmass 24.5\n", "points.txt", PointUnit::mm,
                               problems));
  EXPECT_THAT(
      test::lines_of(problems),
      AllOf(HasSubstr("points.txt:1:1: warning: saved: 'Saved 14.03.2026 12:30:15' is not read: "),
            HasSubstr("points.txt:3:1: warning: mass: 'mass 24.5' is not read: it has 1 number, a point "
                      "has three; put # before a line that is not meant")));
}

}  // namespace
}  // namespace linkwright::suspension
