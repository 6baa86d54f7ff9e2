// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/design.h"

#include <gmock/gmock.h>

#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::study {
namespace {

Value tables_of(std::string_view text) {
  Diagnostics diagnostics;
  Value value = read_text(text, Syntax::toml, "s.toml", diagnostics);
  for (const Diagnostic& d : diagnostics) ADD_FAILURE() << to_string(d);
  return value;
}

Result result_of(std::string_view tables) {
  Result result;
  result.solutions.push_back({.label = "Crank-rocker, open (1.5)"});
  result.solutions.back().study = tables_of(tables);
  return result;
}

DisplayUnits usual_units() { return units_of(tables_of("a_mm = 1\nb_deg = 1\nc_rpm = 1")); }

TEST(Design, BecomesAWholeStudyInTheUnitsOfTheSource) {
  Result result = result_of(R"toml(
[mechanism]
type = "planar.linkage"
rod_m = 0.3
at_m = [0.1, 0.2]
spring = []
speed_rpm = 60.0
[[mechanism.body]]
name = "crank"
points_m = { O_m = [0.0, 0.0], A = [0.07, -0.029] }
[sweep]
from_rad = 0.0
samples = 5
)toml");
  complete_designs(result, "My linkage", usual_units());
  EXPECT_EQ(result.solutions[0].study, tables_of(R"toml(
schema = 1
kind = "analysis"
title = "My linkage: Crank-rocker, open (1.5)"
[mechanism]
type = "planar.linkage"
rod_mm = 300.0
at_mm = [100.0, 200.0]
speed_rpm = 60.0
[[mechanism.body]]
name = "crank"
points_mm = { O_m = [0.0, 0.0], A = [70.0, -29.0] }
[sweep]
from_deg = 0.0
samples = 5
)toml"))
      << to_toml(result.solutions[0].study);
}

TEST(Design, KeepsTheKindThatItsDomainChose) {
  Result result = result_of("kind = \"simulation\"\n[mechanism]\ntype = \"planar.linkage\"");
  complete_designs(result, "A", {});
  EXPECT_EQ(to_toml(result.solutions[0].study), R"toml(schema = 1
kind = "simulation"
title = "A: Crank-rocker, open (1.5)"

[mechanism]
type = "planar.linkage"
)toml");
}

TEST(Design, IsKeptOfTheBestSolutionsAlone) {
  Result result = result_of("[mechanism]\ntype = \"a\"");
  result.solutions.resize(max_designs + 1, result.solutions[0]);
  result.solutions[2].study = Value();
  complete_designs(result, "A", {});
  EXPECT_TRUE(result.solutions[0].study.is_object());
  EXPECT_TRUE(result.solutions[2].study.is_null()) << "there was none";
  EXPECT_TRUE(result.solutions[max_designs - 1].study.is_object());
  EXPECT_TRUE(result.solutions[max_designs].study.is_null());
}

TEST(Design, HasAFileWithAReadableName) {
  Solution solution{.label = "Crank-rocker, open (1.5) \xC2\xB5"};
  EXPECT_EQ(design_name(solution, 1), "1-crank-rocker-open-1.5");
  solution.label = "../..";
  EXPECT_EQ(design_name(solution, 12), "12") << "no way out of the folder";
  solution.label = std::string(1000, 'a');
  EXPECT_EQ(design_name(solution, 1).size(), 60u) << "file systems take no names of any length";
  solution.label = "";
  EXPECT_EQ(design_name(solution, 3), "3");
}

TEST(Design, FileTellsWhereItComesFrom) {
  Result result = result_of("[mechanism]\ntype = \"planar.four_bar\"");
  result.solutions[0].label = "a\nschema = 2";
  complete_designs(result, "My\npath", {});
  EXPECT_EQ(design_toml(result.solutions[0], 1, "My\npath", "linkwright 1"),
            "#:schema ./analysis-planar.four_bar.schema.json\n"
            "# Solution 1 of \"My path\", found by linkwright 1: a schema = 2\n"
            "schema = 1\n"
            "kind = \"analysis\"\n"
            "title = \"My\\npath: a\\nschema = 2\"\n"
            "\n"
            "[mechanism]\n"
            "type = \"planar.four_bar\"\n");
}

}  // namespace
}  // namespace linkwright::study
