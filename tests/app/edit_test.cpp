// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/edit.h"

#include <gmock/gmock.h>

#include <string>

namespace linkwright::app {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* linkage = R"(# My leg.
schema = 1
kind   = "analysis"

[mechanism]
type = "planar.linkage"

[[mechanism.body]]
name      = "ground"
points_mm = { O = [0, 0], B0 = [600, 0] }   # the frame

[[mechanism.body]]
name      = "crank"
points_mm = { O = [0, 0], A = [100.0, 0] }
mass_kg   = 0.36                    # of aluminium
)";

std::string change(std::string_view text, std::vector<Edit> edits) {
  Diagnostics diagnostics;
  const std::string out = edited(text, edits, diagnostics);
  for (const Diagnostic& d : diagnostics) ADD_FAILURE() << to_string(d);
  return out;
}
std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(EditStudy, ANumberIsReplacedWhereItStandsAndNothingElse) {
  EXPECT_EQ(change(linkage, {{"mechanism.body[1].mass_kg", 0.4}}), replaced(linkage, "0.36 ", "0.4 "));
}

TEST(EditStudy, AnotherUnitOfTheSameDimensionStays) {
  EXPECT_EQ(change(linkage, {{"mechanism.body[1].points_m.A", Value(Value::Array{0.12345, -0.02})}}),
            replaced(linkage, "A = [100.0, 0]", "A = [123.45, -20.0]"));
  EXPECT_EQ(change(linkage, {{"mechanism.body[0].points_m.B0[0]", 0.65}}),
            replaced(linkage, "[600, 0]", "[650.0, 0]"));
}

TEST(EditStudy, SeveralValuesAreReplacedInTheirOrder) {
  const std::string out = change(linkage, {{"mechanism.body[0].points_m.O", Value(Value::Array{1.0, 2.0})},
                                           {"mechanism.body[1].points_m.O", Value(Value::Array{3.0, 4.0})}});
  EXPECT_EQ(out, replaced(replaced(linkage, "O = [0, 0], B0", "O = [1000.0, 2000.0], B0"), "O = [0, 0], A",
                          "O = [3000.0, 4000.0], A"));
}

TEST(EditStudy, AListOfPointsIsReplacedWhole) {
  const std::string study = R"([target]
points_mm = [
  [3.0, 3.0], [2.5, 3.5],
]   # of the hand
closed = false
)";
  const Value points(Value::Array{Value(Value::Array{0.001, 0.002}), Value(Value::Array{0.0035, -0.001})});
  EXPECT_EQ(change(study, {{"target.points_m", points}}),
            "[target]\npoints_mm = [\n  [1.0, 2.0],\n  [3.5, -1.0]\n]   # of the hand\nclosed = false\n");
  EXPECT_EQ(change("{\"target\": {\"points_m\": [[0, 1]], \"closed\": true}}", {{"target.points_m", points}}),
            "{\"target\": {\"points_m\": [\n  [0.001, 0.002],\n  [0.0035, -0.001]\n], \"closed\": true}}");
}

TEST(EditStudy, LettersBeyondAsciiBeforeAValueDoNotMoveIt) {
  const std::string text =
      "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\ntitles = { \"\u00e4\u00f6\" "
      "= 1.0, b = 2.0 }\n";
  EXPECT_EQ(change(text, {{"mechanism.titles.b", 3.0}}), replaced(text, "b = 2.0", "b = 3.0"));
}

TEST(EditStudy, ASampleIsOpened) {
  const std::string text =
      "# A line.\nschema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\nsample = "
      "\"hoeken\"\n";
  const std::string out = change(text, {{"mechanism.body[1].points_m.A", Value(Value::Array{0.11, 0.0})}});
  EXPECT_THAT(out, StartsWith("# A line.\nschema = 1\n"));
  EXPECT_THAT(out, HasSubstr("points_mm = { O = [0.0, 0.0], A = [110.0, 0.0] }"));
  EXPECT_THAT(out, testing::Not(HasSubstr("[]")));
  EXPECT_THAT(out, testing::Not(HasSubstr("hoeken")));
  // The angles of the sample are read in the unit that they were shown in.
  EXPECT_THAT(out, HasSubstr("_deg = "));
  EXPECT_THAT(out, testing::Not(HasSubstr("_rad = ")));
  // From then on it is a text like any other.
  EXPECT_EQ(change(out, {{"mechanism.body[1].points_m.A", Value(Value::Array{0.1, 0.0})}}),
            replaced(out, "A = [110.0, 0.0]", "A = [100.0, 0.0]"));
}

constexpr const char* four_bar = R"(schema = 1
kind   = "analysis"

[mechanism]
type   = "planar.four_bar"
branch = "open"    # or crossed

[mechanism.parameters]   # of the drawing
ground_mm  = 600.0
crank_mm   = 100.0
coupler_mm = 400.0
rocker_mm  = 320.0
)";

TEST(EditStudy, AWordIsReplacedWhereItStands) {
  EXPECT_EQ(change(four_bar, {{"mechanism.branch", "crossed"}}),
            replaced(four_bar, "\"open\"", "\"crossed\""));
}

TEST(EditStudy, WhatHasADefaultIsPutInWhereItsTableStandsInTheUnitsOfTheStudy) {
  EXPECT_EQ(change(four_bar, {{"mechanism.parameters.pivot_x_m", 0.03}}),
            replaced(four_bar, "# of the drawing\n", "# of the drawing\npivot_x_mm = 30.0\n"));
  // A table that is not there either comes at the end.
  EXPECT_EQ(change(four_bar, {{"environment.gravity_m_per_s2", 0.0}}),
            std::string(four_bar) + "\n[environment]\ngravity_mm_per_s2 = 0.0\n");
}

TEST(EditStudy, ANumberBecomesARangeAndBack) {
  const std::string search = R"(schema = 1
kind = "synthesis"
[mechanism]
type = "planar.four_bar"
[mechanism.parameters]
crank_mm = { min = 10, max = 90 }   # free
[target]
points_mm = [[0, 0], [10, 5], [20, 0]]
)";
  Value range = Value::object();
  range["min"] = 0.02;
  range["max"] = 0.08;
  EXPECT_EQ(change(search, {{"mechanism.parameters.crank_m", range}}),
            replaced(search, "{ min = 10, max = 90 }", "{ min = 20.0, max = 80.0 }"));
  const std::string fixed = replaced(search, "{ min = 10, max = 90 }", "50.0");
  EXPECT_EQ(change(search, {{"mechanism.parameters.crank_m", 0.05}}), fixed);
  EXPECT_EQ(change(fixed, {{"mechanism.parameters.crank_m", range}}),
            replaced(search, "{ min = 10, max = 90 }", "{ min = 20.0, max = 80.0 }"));
}

constexpr const char* body_poses = R"([mechanism]
type = "planar.four_bar"

[target]
type = "poses"

# The first.
[[target.pose]]
x_mm      = 10.0
y_mm      = 20.0
angle_deg = 30.0   # of the plate

# The second.
[[target.pose]]
x_mm      = 40.0
y_mm      = 50.0
angle_deg = 60.0

[optimiser]
max_solutions = 3
)";

Value body_pose(double x, double y, double angle) {
  Value out = Value::object();
  out["x_m"] = x;
  out["y_m"] = y;
  out["angle_rad"] = angle;
  return out;
}

TEST(EditStudy, ATableIsPutBehindTheOthersOfItsListInTheirUnits) {
  EXPECT_EQ(change(body_poses, {{"target.pose[2]", body_pose(0.07, -0.08, 0)}}),
            replaced(body_poses, "60.0\n",
                     "60.0\n\n[[target.pose]]\nx_mm      = 70.0\ny_mm      = -80.0\nangle_deg = 0.0\n"));
  // A study without such a list gets one, behind the table that it comes into; of an entry of a list into
  // that one.
  Value mass = Value::object();
  mass["mass_kg"] = 2.0;
  EXPECT_EQ(
      change(linkage, {{"mechanism.body[0].attached[0]", mass}}),
      replaced(linkage, "# the frame\n", "# the frame\n\n[[mechanism.body.attached]]\nmass_kg = 2.0\n"));
  Value spring = Value::object();
  spring["first"] = "ground.O";
  EXPECT_EQ(change(linkage, {{"mechanism.spring[0]", spring}}),
            std::string(linkage) + "\n[[mechanism.spring]]\nfirst = \"ground.O\"\n");
  EXPECT_EQ(change("[target]\npose = [{ x_mm = 1.0 }]\n", {{"target.pose[1]", body_pose(0.001, 0.002, 0)}}),
            "[target]\n\n[[target.pose]]\nx_mm = 1.0\n\n[[target.pose]]\nx_m = 0.001\ny_m = 0.002\nangle_rad "
            "= 0.0\n");
}

TEST(EditStudy, ATableOfAListIsTakenOutAndSoIsAKey) {
  EXPECT_EQ(
      change(body_poses, {{"target.pose[0]", Value()}}),
      replaced(body_poses,
               "[[target.pose]]\nx_mm      = 10.0\ny_mm      = 20.0\nangle_deg = 30.0   # of the plate\n\n",
               ""));
  EXPECT_EQ(change(linkage, {{"mechanism.body[1]", Value()}}),
            std::string(linkage).substr(
                0, std::string_view(linkage).find("\n[[mechanism.body]]\nname      = \"crank\"") + 1));
  EXPECT_EQ(change(linkage, {{"mechanism.body[1].mass_kg", Value()}}),
            replaced(linkage, "mass_kg   = 0.36                    # of aluminium\n", ""));
  EXPECT_EQ(change("{\"a\": [{\"b\": 1}, {\"b\": 2}]}", {{"a[0]", Value()}}),
            "{\n  \"a\": [\n    {\n      \"b\": 2\n    }\n  ]\n}\n");
}

TEST(EditStudy, WhatCannotBeChangedLeavesTheTextAndSaysWhy) {
  Diagnostics diagnostics;
  const std::vector<Edit> nowhere{{"mechanism.body[7].mass_kg", 1.0}};
  EXPECT_EQ(edited(linkage, nowhere, diagnostics), linkage);
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_EQ(to_string(diagnostics[0].message), "'body' has 2 entries, counted from 0");
  const std::vector<Edit> path{{"mechanism..x", 1.0}};
  EXPECT_EQ(edited(linkage, path, diagnostics), linkage);
  EXPECT_EQ(to_string(diagnostics.back().message), "is not the path of a key");
  const std::string broken = "schema = = 1\n";
  const std::vector<Edit> mass{{"mechanism.mass_kg", 1.0}};
  EXPECT_EQ(edited(broken, mass, diagnostics), broken);
  EXPECT_EQ(diagnostics.back().severity, Diagnostic::Severity::error);
}

}  // namespace
}  // namespace linkwright::app
