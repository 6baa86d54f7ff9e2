// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/linkage_path.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/study/write.h"
#include "planar/studies.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using testing::HasSubstr;

// Boom and stick of tests/published with their cylinders, drawn at 20 and -60 deg.
std::string boom_and_stick(const std::map<std::string, std::string>& changed) {
  return text_of({{"1", R"(
schema = 1
kind   = "analysis"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name      = "ground"
points_mm = { O = [0, 0], D = [400, -500] }
[[mechanism.body]]
name      = "boom"
points_mm = { O = [0, 0], B = [3000, 0], C = [1200, 350], E = [1300, 450] }
start     = { angle_deg = 20 }
)"},
                  {"2", R"(mass_kg = 0
[[mechanism.body]]
name      = "stick"
points_mm = { B = [0, 0], F = [-450, 120], T = [1800, 0] }
start     = { x_mm = 2819.0778623577252, y_mm = 1026.0604299770062, angle_deg = -60 }
mass_kg   = 0
[[mechanism.body]]
name      = "barrel 1"
points_mm = { P = [0, 0] }
start     = { x_mm = 400, y_mm = -500, angle_deg = 62.3 }
mass_kg   = 0
[[mechanism.body]]
name      = "piston 1"
points_mm = { P = [0, 0] }
start     = { x_mm = 1007.924, y_mm = 739.3165, angle_deg = 62.3 }
mass_kg   = 0
[[mechanism.body]]
name      = "barrel 2"
points_mm = { P = [0, 0] }
start     = { x_mm = 1067.691, y_mm = 867.488, angle_deg = 21.4 }
mass_kg   = 0
[[mechanism.body]]
name      = "piston 2"
points_mm = { P = [0, 0] }
start     = { x_mm = 2698.001, y_mm = 1475.772, angle_deg = 21.4 }
mass_kg   = 0
[[mechanism.joint]]
name   = "O"
first  = "ground.O"
second = "boom.O"
[[mechanism.joint]]
name   = "B"
first  = "boom.B"
second = "stick.B"
[[mechanism.joint]]
name   = "D"
first  = "ground.D"
second = "barrel 1.P"
[[mechanism.joint]]
name   = "C"
first  = "boom.C"
second = "piston 1.P"
[[mechanism.joint]]
name   = "E"
first  = "boom.E"
second = "barrel 2.P"
[[mechanism.joint]]
name   = "F"
first  = "stick.F"
second = "piston 2.P"
[[mechanism.joint]]
name   = "boom cylinder"
type   = "prismatic"
first  = "barrel 1.P"
second = "piston 1.P"
[[mechanism.joint]]
name   = "stick cylinder"
type   = "prismatic"
first  = "barrel 2.P"
second = "piston 2.P"
[[mechanism.force]]
name     = "load"
point    = "stick.T"
force_N  = [0, -12000]
)"},
                  {"3", R"(
[path]
point   = "stick.T"
drives  = ["boom cylinder", "stick cylinder"]
from_mm = [4200, -500]
samples = 41
)"},
                  {"4", R"(
[[path.step]]
type       = "line"
to_mm      = [2600, -1600]
duration_s = 4
)"}},
                 changed);
}

TEST(LinkagePath, BoomAndStickFollowALineAsInTheReference) {
  const study::Result result = run_text(boom_and_stick({}));
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  EXPECT_THAT(to_string(result.headline), HasSubstr("The path is followed to its end."));
  EXPECT_EQ(fact(result, "share of the path reached"), "100 %");
  const Value& rows = at(published_case("planar-machines.json", "boom-and-stick-on-a-line"), "computed.rows");
  for (const std::size_t row : {0u, 1u, 2u, 4u}) {
    const std::vector<double> wanted = numbers(rows.as_array()[row]);
    const std::size_t i = 10 * static_cast<std::size_t>(wanted[0]);
    EXPECT_NEAR(column(result, "stick_T_x_m")[i], wanted[1], 1e-13);
    EXPECT_NEAR(column(result, "stick_T_y_m")[i], wanted[2], 1e-13);
    EXPECT_NEAR(column(result, "boom_angle_rad")[i], wanted[3] * pi / 180, 1e-12);
    EXPECT_NEAR(column(result, "boom_cylinder_displacement_m")[i], wanted[5], 1e-10);
    EXPECT_NEAR(column(result, "stick_cylinder_displacement_m")[i], wanted[6], 1e-10);
    EXPECT_NEAR(column(result, "boom_cylinder_drive_speed_m_per_s")[i], wanted[7], 1e-7);
    EXPECT_NEAR(column(result, "stick_cylinder_drive_speed_m_per_s")[i], wanted[8], 1e-7);
    EXPECT_NEAR(column(result, "boom_cylinder_drive_force_N")[i], wanted[9], 0.01);
    EXPECT_NEAR(column(result, "stick_cylinder_drive_force_N")[i], wanted[10], 0.01);
  }
  const Table& path = *result.table("path");
  EXPECT_EQ(path.rows(), 41u);
  EXPECT_EQ(path.find("path_share")->values.back(), 1);
  ASSERT_EQ(result.scenes[0].targets.size(), 1u);
  // The power of the drives is that against the load: the masses are none.
  for (std::size_t i = 0; i < 41; ++i)
    EXPECT_NEAR(
        column(result, "boom_cylinder_drive_power_W")[i] + column(result, "stick_cylinder_drive_power_W")[i],
        12000 * column(result, "stick_T_speed_y_m_per_s")[i], 1e-7);
}

// Two links on pins, in the middle of the drawing.
std::string two_links(const std::map<std::string, std::string>& changed) {
  return text_of(
      {{"1", R"(
schema = 1
kind   = "analysis"
[mechanism]
type  = "planar.linkage"
drawn = true
[[mechanism.body]]
name      = "frame"
points_mm = { O = [0, 0] }
[[mechanism.body]]
name      = "boom"
points_mm = { O = [0, 0], B = [2819.0778623577252, 1026.0604299770062] }
mass_kg   = 30
[[mechanism.body]]
name      = "stick"
points_mm = { B = [2819.0778623577252, 1026.0604299770062], T = [3719.0778623577252, -532.7852960450313] }
mass_kg   = 12
[[mechanism.joint]]
name   = "O"
first  = "frame.O"
second = "boom.O"
[[mechanism.joint]]
name   = "B"
first  = "boom.B"
second = "stick.B"
)"},
       {"2", "[path]\npoint = \"stick.T\"\ndrives = [\"O\", \"B\"]\nfrom_mm = [4200, 0]\nsamples = 101\n"},
       {"3", "[[path.step]]\ntype = \"line\"\nto_mm = [5200, 0]\nduration_s = 2\n"}},
      changed);
}

TEST(LinkagePath, PathOutOfReachNamesShareAndPlace) {
  const study::Result result = run_text(two_links({}));
  EXPECT_EQ(result.status, Status::limit_reached);
  EXPECT_EQ(fact(result, "share of the path reached"), "60 %");
  EXPECT_THAT(to_string(result.headline),
              HasSubstr("The path is reached to 60 %, (4800 mm, 0 mm): 'boom' and 'stick' are stretched."));
  ASSERT_FALSE(result.troubles.empty());
  EXPECT_LT(result.table("sweep")->rows(), 101u);
}

// The study as it was read is read again alike.
TEST(LinkagePath, CanonicalStudyIsReadAlike) {
  std::string messages;
  for (const std::string& text :
       {boom_and_stick({}),
        two_links(
            {{"3",
              "[[path.step]]\ntype = \"table\"\ntimes_s = [0, 1, 2]\npoints_mm = [[4200, 0], [3900, "
              "200], [3800, 0]]\n[[drive]]\njoint = \"O\"\nhighest_deg = 90\npath_start_deg = 1\n"}})}) {
    const auto first = prepare(text, messages);
    ASSERT_TRUE(first) << messages;
    const auto second = prepare(study::to_toml(first->canonical), messages);
    ASSERT_TRUE(second) << messages;
    EXPECT_EQ(first->canonical, second->canonical);
  }
}

// Drive power, row by row, is the rate of the energy of the moving masses.
TEST(LinkagePath, PowerBalances) {
  const study::Result result = run_text(two_links(
      {{"3",
        "[[path.step]]\ntype = \"arc\"\nthrough_mm = [3900, 700]\nto_mm = [3000, 900]\nspeed_mm_per_s = 900\n"
        "[[path.step]]\ntype = \"dwell\"\nduration_s = 0.5\n"
        "[[path.step]]\ntype = \"curve\"\npoints_mm = [[3400, 200], [3900, 300], [4200, 0]]\nduration_s = "
        "1.5\n"}}));
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  const std::vector<double>&o = column(result, "O_drive_power_W"), &b = column(result, "B_drive_power_W"),
        &kinetic = column(result, "kinetic_power_W"), &weight = column(result, "weight_power_W");
  double most = 0, off = 0;
  for (std::size_t i = 0; i < o.size(); ++i) {
    most = std::max(most, std::abs(o[i]) + std::abs(b[i]));
    off = std::max(off, std::abs(o[i] + b[i] + weight[i] - kinetic[i]));
  }
  EXPECT_GT(most, 10);
  EXPECT_LT(off, 1e-11 * most);
}

TEST(LinkagePath, OneFreedomFollowsOneCoordinate) {
  const std::string text = R"(
schema = 1
kind   = "analysis"
[mechanism]
type = "planar.slider_crank"
[mechanism.parameters]
crank_mm = 50
rod_mm   = 150
[drive]
joint     = "O"
path_start_deg = 80
[path]
point   = "slider.B"
along   = "x"
from_mm = [180, 0]
samples = 11
[[path.step]]
type       = "line"
to_mm      = [120, 0]
duration_s = 1
[output]
quantities = ["position", "rates"]
)";
  const study::Result result = run_text(text);
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  const Value& c = published_case("planar-machines.json", "slider-crank-inverse");
  EXPECT_NEAR(column(result, "O_angle_rad")[0] * 180 / pi, numbers(at(c, "computed.crank_deg"))[0], 1e-11);
  const study::Result other = run_text(replaced(text, "path_start_deg = 80", "path_start_deg = -80"));
  EXPECT_NEAR(column(other, "O_angle_rad")[0] * 180 / pi, numbers(at(c, "computed.crank_deg"))[1], 1e-11);
}

// A drive that does not follow has its law; a table of places comes from a file.
TEST(LinkagePath, OtherDrivesHaveTheirLawsAndTablesComeFromFiles) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "linkwright_path_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "places.csv") << "time_s,x_mm\n0,4200\n";
  const std::string file = "[[path.step]]\ntype = \"table\"\nfile = \"places.csv\"\n";
  const std::string path = "[path]\npoint = \"stick.T\"\nalong = \"x\"\ndrives = [\"O\"]\nsamples = 5\n";
  const std::string law =
      "[[drive]]\njoint = \"B\"\nlaw = \"cycloidal\"\nfrom_deg = 0\nto_deg = 20\nduration_s = 2\n";
  EXPECT_THAT(::linkwright::test::problems_of(kinds(), two_links({{"2", path}, {"3", law + file}}), folder),
              HasSubstr("places.csv"));
  std::ofstream(folder / "places.csv") << "time_s;x_mm;y_mm\n0;3500;0\n0,5;3600;1\n1;3700;2\n2;3800;0\n";
  const study::Result result = run_text(two_links({{"2", path}, {"3", law + file}}), folder);
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  EXPECT_NEAR(column(result, "stick_T_x_m")[1], 3.6, 1e-13);
  EXPECT_NEAR(column(result, "stick_T_x_m")[4], 3.8, 1e-13);
  EXPECT_NEAR(column(result, "B_angle_rad")[4], 20 * pi / 180, 1e-15);
  std::filesystem::remove_all(folder);
}

TEST(LinkagePath, SaysWhatIsWrong) {
  const auto wrong = [](const std::map<std::string, std::string>& changed) {
    return problems_of(two_links(changed));
  };
  const std::string line = "[[path.step]]\ntype = \"line\"\nto_mm = [4000, 0]\nduration_s = 2\n";
  const std::string path = "[path]\npoint = \"stick.T\"\nfrom_mm = [4200, 0]\n";
  EXPECT_THAT(wrong({{"2", "[path]\npoint = \"stick.X\"\ndrives = [\"O\", \"B\"]\n"}}),
              HasSubstr("there is no point 'stick.X'"));
  EXPECT_THAT(wrong({{"2", "[path]\npoint = \"frame.O\"\ndrives = [\"O\", \"B\"]\n"}}),
              HasSubstr("the point 'frame.O' is fixed to the ground"));
  EXPECT_THAT(wrong({{"2", path + "drives = [\"O\", \"elbow\"]\n"}}), HasSubstr("there is no joint 'elbow'"));
  EXPECT_THAT(
      wrong({{"2", path + "drives = [\"O\"]\n"},
             {"3", line + "[[drive]]\njoint = \"B\"\nlaw = \"constant_speed\"\nspeed_deg_per_s = 1\n"}}),
      HasSubstr("a point asks for two drives, 1 is free"));
  EXPECT_THAT(wrong({{"2", path + "along = \"pose\"\ndrives = [\"O\", \"B\"]\n"}}),
              HasSubstr("a point with an angle asks for three drives, 2 are free"));
  EXPECT_THAT(wrong({{"2", "[path]\npoint = \"stick.T\"\ndrives = [\"O\", \"B\"]\nfrom_mm = [5000, 0]\n"}}),
              HasSubstr("the linkage does not reach (5000, 0) mm, where the path begins"));
  EXPECT_THAT(wrong({{"3", "[[path.step]]\ntype = \"line\"\nto_mm = [4000, 0]\n"}}),
              HasSubstr("step 1 (line): has no duration"));
  EXPECT_THAT(wrong({{"4", "[sweep]\ntype = \"time\"\n"}}),
              HasSubstr("the path gives the motion and its rows"));
  EXPECT_THAT(wrong({{"4", "[[drive]]\njoint = \"B\"\nlaw = \"constant_speed\"\nspeed_deg_per_s = 1\n"}}),
              HasSubstr("joint 'B' follows the path, and has a law"));
}

}  // namespace
}  // namespace linkwright::planar
