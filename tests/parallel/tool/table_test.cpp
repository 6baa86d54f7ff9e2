// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/tool/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "linkwright/core/numbers.h"
#include "support/message.h"

namespace linkwright::parallel {
namespace {

using ::testing::HasSubstr;

std::string problems(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_tool_table(text, "way.csv", diagnostics)) << text;
  return test::lines_of(diagnostics);
}
ToolTable table(const std::string& text) {
  Diagnostics diagnostics;
  const auto out = read_tool_table(text, "way.csv", diagnostics);
  EXPECT_TRUE(out && diagnostics.empty()) << text;
  return out.value_or(ToolTable());
}

TEST(ToolTable, ReadsPointsInAnyUnitAndOrder) {
  const ToolTable t = table("x_mm,time_ms,z_m,y_cm\n100,0,-0.5,2\n110,250,-0.6,3\n");
  EXPECT_EQ(t.file, "way.csv");
  EXPECT_EQ(t.times, (std::vector<double>{0, 0.25}));
  EXPECT_EQ(t.points, (std::vector<Coordinates>{{0.1, 0.02, -0.5}, {0.11, 0.03, -0.6}}));
  EXPECT_TRUE(t.rotations.empty());
}

TEST(ToolTable, ReadsRotationVectorsAndAngles) {
  const double quarter = pi / 2;
  const ToolTable t = table(
      "time_s,x_m,y_m,z_m,rotation_x_deg,rotation_y_deg,rotation_z_deg,status\n"
      "0,0,0,0,0,0,90,done\n1,0,0,0,0,90,0,done\n");
  EXPECT_EQ(t.rotations, (std::vector<Coordinates>{{0, 0, quarter}, {0, quarter, 0}}));
  // A quarter about x and then one about z: a third of a turn about (1, 1, 1) with z going to x ... x to y.
  const ToolTable r =
      table("time_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n0,0,0,0,90,0,90\n1,0,0,0,0,30,0\n");
  const double third = 2 * pi / 3 / std::numbers::sqrt3;
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(r.rotations[0][k], third, 1e-15);
  EXPECT_NEAR(r.rotations[1][1], pi / 6, 1e-15);
}

TEST(ToolTable, TellsWhereACellIsWrong) {
  EXPECT_THAT(problems("time_s,x_m,y_m,z_m\n0,0,0,0\n1,0,oops,0\n"),
              HasSubstr("way.csv:3:5: error: y_m: 'oops' is not a number"));
  EXPECT_THAT(problems("time_s,x_m,y_m,z_m\n0,0,0,0\n1,0,,0\n"),
              HasSubstr("way.csv: error: y_m: row 2 holds no number"));
  EXPECT_THAT(problems("time_s,x_m,y_m,z_m\n0,0,0,0\n1,0,2e9,0\n"),
              HasSubstr("way.csv: error: y_m: row 2 holds 2e+09, more than 1e+09 in SI units"));
  EXPECT_THAT(problems("time_s,x_m,y_m,z_m\n0,0,0,0\n2,0,0,0\n2,0,1,0\n"),
              HasSubstr("way.csv: error: time: times must increase, but row 3 with 2 s follows 2 s"));
}

TEST(ToolTable, TellsWhichColumnIsWrong) {
  EXPECT_THAT(problems("time_s,x,y_m,z_m\n0,0,0,0\n1,0,0,0\n"),
              HasSubstr("x: needs the unit of a length; write x_m"));
  EXPECT_THAT(problems("time_m,x_m,y_m,z_m\n0,0,0,0\n1,0,0,0\n"),
              HasSubstr("time_m: needs the unit of a time; write time_s"));
  EXPECT_THAT(problems("time_s,x_m,y_m\n0,0,0\n1,0,0\n"), HasSubstr("z: column is missing; add z_m"));
  EXPECT_THAT(problems("time_s,x_m,y_m,z_m,force_N\n0,0,0,0,0\n1,0,0,0,0\n"),
              HasSubstr("force_N: unknown column; columns are time, x, y, z and rotation_x, rotation_y, "
                        "rotation_z or roll, pitch, yaw, each with its unit"));
  EXPECT_THAT(problems("time_s,x_m,x_mm,y_m,z_m\n0,0,0,0,0\n1,0,0,0,0\n"),
              HasSubstr("x_mm: x is given twice"));
  EXPECT_THAT(problems("time_s,x_m,y_m,z_m,roll_deg,yaw_deg\n0,0,0,0,0,0\n1,0,0,0,0,0\n"),
              HasSubstr("pitch: column is missing; add pitch_rad"));
  EXPECT_THAT(problems("time_s,x_m,y_m,z_m,rotation_x_deg,rotation_y_deg,rotation_z_deg,roll_deg,pitch_deg,"
                       "yaw_deg\n0,0,0,0,0,0,0,0,0,0\n1,0,0,0,0,0,0,0,0,0\n"),
              HasSubstr("roll: the rotation is given twice; give rotation_x, rotation_y, rotation_z or roll, "
                        "pitch, yaw"));
  EXPECT_THAT(problems("name,time_s,x_m,y_m,z_m\na,0,0,0,0\nb,1,0,0,0\n"),
              HasSubstr("name: unknown column; rows of points have no names"));
  EXPECT_THAT(problems("time_s,x_m,y_m,z_m\n0,0,0,0\n"), HasSubstr("1 rows, needs at least 2"));
  EXPECT_THAT(problems(""), HasSubstr("the file is empty"));
}

}  // namespace
}  // namespace linkwright::parallel
