#include "linkwright/suspension/guide/hard_points.h"

#include <gmock/gmock.h>

#include "linkwright/suspension/guide/position.h"
#include "linkwright/suspension/guide/samples.h"
#include "linkwright/suspension/wheel/parameters.h"
#include "support/message.h"

namespace linkwright::suspension {
namespace {

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

TEST(HardPoints, ReadsListsAsSuspensionProgramsPrintThem) {
  const auto points = read(
      "$ Front suspension, static\n"
      "Hardpoints                          X        Y        Z\n"
      "   1  Lower wishbone, front pivot   -120.5   350.0   150\r\n"
      "   2  Lower wishbone rear pivot      210.25\t355.0   145.0\n"
      "\n"
      "'tie_rod.inner'  +95.0; 330.0; 2.1e2\n"
      "Wheel centre (static)   0,5   720,0   300,0\n"
      "mass 24.5\n");
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[0], (HardPoint{"lower_wishbone_front_pivot", {-0.1205, 0.35, 0.15}}));
  EXPECT_EQ(points[1], (HardPoint{"lower_wishbone_rear_pivot", {0.21025, 0.355, 0.145}}));
  EXPECT_EQ(points[2], (HardPoint{"tie_rod_inner", {0.095, 0.33, 0.21}}));
  EXPECT_EQ(points[3], (HardPoint{"wheel_centre_static", {0.0005, 0.72, 0.3}}));
  EXPECT_EQ(read("a,1,2,3\nb , 4, 5, 6\n", PointUnit::m)[1], (HardPoint{"b", {4, 5, 6}}));
}

TEST(HardPoints, ReadsCsvWithTheUnitsOfItsColumns) {
  const auto points = read("name,x_mm,y_cm,z_m,group\n\"Tie rod, inner\",1,2,3,7\nb,4,5,6,8\n");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0], (HardPoint{"tie_rod_inner", {0.001, 0.02, 3}}));
}

TEST(HardPoints, ReadsCsvAsSpreadsheetsWriteIt) {
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

TEST(HardPoints, ReadsBackWhatItsTableWrites) {
  const std::vector<HardPoint> points{{"lower_front", {0.1234567890123, -0.2, 0.3}}, {"b", {1e-9, 2, 3}}};
  EXPECT_EQ(read(to_csv(hard_point_table(points))), points);
}

TEST(HardPoints, OfAGuideGoByItsLinks) {
  const std::vector<HardPoint> points = points_of(guide_sample("2RS-US").guide);
  ASSERT_EQ(points.size(), 11U);
  EXPECT_EQ(points[1], (HardPoint{"lower_wishbone_body_2", {-0.17, 0.37, -0.1}}));
  EXPECT_EQ(points[7], (HardPoint{"tie_rod_carrier", {-0.14, 0.7, -0.042}}));
  EXPECT_EQ(points[10].name, "wheel_centre");
}

TEST(HardPoints, SaysWhatIsWrongWithAList) {
  EXPECT_THAT(problems_of(""), HasSubstr("points.txt: error: holds no point; one point a line: name x y z"));
  EXPECT_THAT(
      problems_of("a 1 2 3\nA 1 2 4\n"),
      HasSubstr("points.txt:2:1: error: a: is given twice, at different places; give every point a name"));
  EXPECT_THAT(problems_of("1 2 3\n"), HasSubstr("points.txt:1:1: error: a point has no name"));
  EXPECT_THAT(problems_of("a 1 2 3e9\n"),
              HasSubstr("lies at (0.001, 0.002, 3e+06) m; is the unit of the list right?"));
  EXPECT_THAT(problems_of("name,x_mm,y_mm\na,1,2\n"), HasSubstr("z: this column is missing; write z_mm"));
  EXPECT_THAT(problems_of("name,x_mm,y_mm,z_mm\na,1,,2\n"),
              HasSubstr("points.txt:2:1: error: a: a coordinate is missing"));
}

TEST(PointFrame, TurnsAndMirrorsPoints) {
  const PointFrame rearward{Direction::rearward, Direction::right, Direction::up, {1, 0, 0.3}};
  const Vec3 at = to_vehicle(rearward, {0.2, 0.7, 0.1});
  EXPECT_NEAR(at.x, 0.8, 1e-15);
  EXPECT_NEAR(at.y, -0.7, 1e-15);
  EXPECT_NEAR(at.z, 0.4, 1e-15);
  const Vec3 back = from_vehicle(rearward, at);
  EXPECT_NEAR(norm(back - Vec3{0.2, 0.7, 0.1}), 0, 1e-15);
  // Left-handed: y and z exchanged.
  EXPECT_EQ(to_vehicle({Direction::forward, Direction::up, Direction::left, {}}, {1, 2, 3}), (Vec3{1, 3, 2}));
}

TEST(PointFrame, NamesAxesThatSpanNoSpace) {
  EXPECT_EQ(problem({Direction::rearward, Direction::right, Direction::up, {}}), "");
  EXPECT_EQ(problem({Direction::forward, Direction::right, Direction::rearward, {}}),
            "x and z both lie along forward and rearward");
}

}  // namespace
}  // namespace linkwright::suspension
