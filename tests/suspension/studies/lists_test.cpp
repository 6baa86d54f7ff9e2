// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/lists.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "linkwright/suspension/corner/suspension.h"
#include "suspension/studies.h"

namespace linkwright::suspension {
namespace {

using test::problems_of;
using test::replaced;
using test::run_text;
using test::sample;
using test::sweep;
using ::testing::HasSubstr;

constexpr const char* printed =
    "$ Right wheel, millimetres, x rearward, y to the right, z up\n"
    "   1  Lower wishbone front pivot     1020.0     370.0     190.0\n"
    "   2  Lower wishbone rear pivot      1370.0     370.0     200.0\n"
    "   3  Lower wishbone outer ball      1192.0     715.0     170.0\n"
    "   4  Upper wishbone front pivot     1080.0     440.0     465.0\n"
    "   5  Upper wishbone rear pivot      1340.0     440.0     450.0\n"
    "   6  Upper wishbone outer ball      1222.0     665.0     515.0\n"
    "   7  Tie rod inner ball             1325.0     415.0     253.0\n"
    "   8  Tie rod outer ball             1340.0     700.0     258.0\n"
    "   9  Wheel centre                   1200.0     760.0     300.0\n"
    "  10  Battery                         500.0     100.0     250.0\n";

const std::string mechanism = R"([mechanism]
type = "suspension.corner"
side = "right"
[mechanism.hard_points]
file = "car.txt"
x = "rearward"
y = "right"
z = "up"
origin_mm = [1200, 0, -300]
[mechanism.wheel]
point = "wheel centre"
tyre_diameter_mm = 640
[[mechanism.link]]
name = "lower wishbone"
type = "RS"
points = ["lower wishbone front pivot", "lower wishbone rear pivot", "lower wishbone outer ball"]
[[mechanism.link]]
name = "upper wishbone"
type = "RS"
points = ["upper wishbone front pivot", "upper wishbone rear pivot", "upper wishbone outer ball"]
[[mechanism.link]]
name = "tie rod"
type = "US"
points = ["tie rod inner ball", "tie rod outer ball"]
moved_by = "rack"
)";

std::filesystem::path folder_with_list() {
  const auto folder = std::filesystem::temp_directory_path() / "linkwright_lists";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "car.txt") << printed;
  return folder;
}

const study::ResultFile& file_named(const study::Result& result, std::string_view name) {
  static const study::ResultFile none;
  for (const study::ResultFile& f : result.files)
    if (f.name == name) return f;
  ADD_FAILURE() << name;
  return none;
}

std::vector<HardPoint> points_of_text(const std::string& text, PointUnit unit) {
  Diagnostics problems;
  const auto points = read_hard_points(text, "written", unit, problems);
  for (const Diagnostic& d : problems) ADD_FAILURE() << to_string(d);
  return points.value_or(std::vector<HardPoint>{});
}

TEST(Lists, WritesThePointsOfACornerInEveryForm) {
  const auto folder = folder_with_list();
  const study::Result result = run_text(
      "schema = 1\nkind = \"analysis\"\n" + mechanism + sweep +
          "[[list]]\nformat = \"text\"\n[[list]]\nformat = \"csv\"\n[[list]]\nformat = \"spreadsheet\"\n"
          "[[list]]\nformat = \"csv\"\nunit = \"m\"\nx = \"forward\"\ny = \"left\"\norigin_mm = [0, 0, 0]\n"
          "[[list]]\nformat = \"property\"\n",
      folder);
  ASSERT_EQ(result.files.size(), 5U);
  // The points that the suspension has, in the list's own frame and unit, with its names.
  std::vector<HardPoint> expected = points_of_text(printed, PointUnit::mm);
  expected.pop_back();
  for (const char* name : {"list-text.txt", "list-csv.csv", "list-spreadsheet.csv"}) {
    const auto points = points_of_text(file_named(result, name).text, PointUnit::mm);
    ASSERT_EQ(points.size(), expected.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(points[i].name, expected[i].name);
      EXPECT_LE(norm(points[i].at - expected[i].at), 1e-15);
    }
  }
  EXPECT_THAT(file_named(result, "list-text.txt").text, HasSubstr("\"Tie rod inner ball\""));
  const auto vehicle = points_of_text(file_named(result, "list-csv-2.csv").text, PointUnit::m);
  EXPECT_LE(norm(vehicle.at(8).at - Vec3{0, -0.76, 0}), 1e-15);
  EXPECT_THAT(file_named(result, "list-property.txt").text,
              ::testing::ContainsRegex("'Wheel centre' +'right' "));
  // A suspension without a list has the names of its links.
  const study::Result other = run_text(sample("2RS-US", sweep + "[[list]]\nformat = \"csv\"\n"));
  EXPECT_THAT(other.files.at(0).text, HasSubstr("\ntie_rod_body,-125,415,-47\n"));
}

TEST(Lists, WritesAFoundDesignAsTheListThatItCameFrom) {
  const auto folder = folder_with_list();
  const study::Result result = run_text("schema = 1\nkind = \"synthesis\"\n" + mechanism + R"(
[[design]]
point = "tie rod.body"
box_mm = 60.0
given = ["x"]
[target]
type = "wheel_parameters"
[[target.curve]]
quantity = "toe"
measure = "change"
travel_mm = [-60, -30, 30, 60]
value_deg = 0.0
tolerance_deg = 0.02
[optimiser]
method = "recommended"
starts = 4
)",
                                        folder);
  ASSERT_EQ(result.files.size(), 1U);
  EXPECT_EQ(result.files[0].name, "list-car.txt");
  const auto before = points_of_text(printed, PointUnit::mm),
             after = points_of_text(result.files[0].text, PointUnit::mm);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    if (i != 6) {
      EXPECT_EQ(after[i], before[i]);
    }
  EXPECT_EQ(after[6].at.x, before[6].at.x);
  // Where the table of the result has it, in the vehicle's frame.
  const Table* table = result.table("hard_points");
  ASSERT_NE(table, nullptr);
  const PointFrame frame{Direction::rearward, Direction::right, Direction::up, {1.2, 0, -0.3}};
  const Vec3 found = to_vehicle(frame, after[6].at);
  EXPECT_NE(after[6].at.z, before[6].at.z);
  EXPECT_NEAR(found.y, test::named(*table, "tie_rod_body", "y_m"), 1e-15);
  EXPECT_NEAR(found.z, test::named(*table, "tie_rod_body", "z_m"), 1e-15);
  EXPECT_THAT(result.files[0].text, HasSubstr("$ Right wheel, millimetres, x rearward"));
}

TEST(Lists, SaysWhatIsWrong) {
  EXPECT_THAT(problems_of(sample("2RS-US", sweep + "[[list]]\nformat = \"cvs\"\n")),
              HasSubstr("list[0].format: is 'cvs', must be one of: text, property, csv"));
  EXPECT_THAT(problems_of(sample("2RS-US", sweep + "[[list]]\nformat = \"csv\"\nx = \"up\"\n")),
              HasSubstr("x and z both lie along up and down; for example x = \"rearward\""));
}

}  // namespace
}  // namespace linkwright::suspension
