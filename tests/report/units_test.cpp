// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/units.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/study/kind.h"

namespace linkwright::report {
namespace {

TEST(Units, SuffixesDecide) {
  EXPECT_DOUBLE_EQ(display_unit("crank_angle_rad").factor * pi, 180);
  EXPECT_EQ(display_unit("crank_angle_rad").symbol, "°");
  EXPECT_EQ(display_unit("drive_torque_N_m").symbol, "N m");
  // Not the angle, the length or the time that they end with.
  EXPECT_EQ(display_unit("stiffness_N_m_per_rad").symbol, "N m/rad");
  EXPECT_EQ(display_unit("speed_rad_per_s").symbol, "rad/s");
  EXPECT_EQ(display_unit("speed_rad_per_s").factor, 1);
  EXPECT_EQ(display_unit("toe_deg").factor, 1);
  EXPECT_EQ(display_unit("share").symbol, "");
}

TEST(Units, EveryUnitOfKeysIsShown) {
  EXPECT_EQ(display_unit("toe_deg_per_s").symbol, "°/s");
  EXPECT_EQ(display_unit("toe_rad_per_m").symbol, "°/m");
  EXPECT_DOUBLE_EQ(display_unit("toe_rad_per_m").factor * pi, 180);
  EXPECT_EQ(display_unit("inertia_kg_mm2").symbol, "kg mm²");
  EXPECT_EQ(display_unit("strokes_per_min").symbol, "1/min");
  EXPECT_EQ(display_unit("wear_um").symbol, "µm");
  for (const Dimension dimension : all_dimensions())
    for (const Unit& unit : units(dimension))
      EXPECT_FALSE(display_unit("a_" + std::string(unit.suffix)).symbol.empty()) << unit.suffix;
}

// The units with which the viewer's own tests work; when this fails, the file must become `made`.
TEST(Units, TheViewerIsTestedWithTheseUnits) {
  std::string made =
      "// SPDX-License-Identifier: BSD-3-Clause\n\n"
      "// The units of a report for which none were chosen, for the tests here. Made from core/units;\n"
      "// tests/report/units_test.cpp fails when it is not up to date, and prints what it must be.\n"
      "import { useUnits } from \"../src/units\";\n\nexport const units = [\n";
  for (const ShownSuffix& s : shown_suffixes({}))
    made += fmt::format(
        "  {{ suffix: \"{}\", symbol: \"{}\", factor: {}, key: \"{}\", steps: [{}, {}, {}, {}], by_size: {} "
        "}},\n",
        s.suffix, s.symbol, s.factor, s.key, s.from.multiply, s.from.divide, s.to.divide, s.to.multiply,
        s.by_size);
  made += "];\nuseUnits(units);\n";
  std::ifstream file(LINKWRIGHT_SOURCE_DIR "/web/tests/units.ts");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), made);
}

const ShownSuffix& shown(const std::vector<ShownSuffix>& all, std::string_view suffix) {
  for (const ShownSuffix& s : all)
    if (s.suffix == suffix) return s;
  throw std::runtime_error("no such suffix");
}

TEST(Units, ThoseThatWereChosenAreShown) {
  study::DisplayUnits units;
  for (const char* key : {"crank_mm", "start_deg", "speed_rpm"}) units.choose(*split_unit(key));
  units.follow();
  const auto all = shown_suffixes(units);
  EXPECT_EQ(shown(all, "_m").symbol, "mm");
  EXPECT_EQ(shown(all, "_m").key, "_mm");
  EXPECT_FALSE(shown(all, "_m").by_size);
  EXPECT_EQ(shown(all, "_rad_per_s").symbol, "rpm");
  EXPECT_DOUBLE_EQ(shown(all, "_rad_per_s").factor, 30 / pi);
  EXPECT_EQ(shown(all, "_rad_per_s2").symbol, "°/s²");
  EXPECT_EQ(shown(all, "_rad_per_m").symbol, "°/100 mm");
  EXPECT_EQ(shown(all, "_rad_per_m").key, "_deg_per_100mm");
  EXPECT_DOUBLE_EQ(shown(all, "_rad_per_m").factor, 18 / pi);
  EXPECT_EQ(shown(all, "_N_per_m").symbol, "N/mm");
  EXPECT_EQ(shown(all, "_N_m").symbol, "N m");
  EXPECT_EQ(shown(all, "_m3").symbol, "m³");
  // A file has the very numbers of a table that the program writes in these units.
  const ShownSuffix& speed = shown(all, "_rad_per_s");
  const Table table =
      study::in_units({.name = "t", .columns = {{"motor_rad_per_s", "motor (rad/s)", {0.1, 7.3}}}}, units);
  EXPECT_EQ(table.columns[0].key, "motor_rpm");
  EXPECT_EQ(table.columns[0].values[1],
            7.3 * speed.from.multiply / speed.from.divide * speed.to.divide / speed.to.multiply);
}

TEST(Units, WithoutAChoiceDegreesAndTheSizeOfLengths) {
  const auto all = shown_suffixes({});
  EXPECT_EQ(shown(all, "_rad").symbol, "°");
  EXPECT_EQ(shown(all, "_rad").key, "_deg");
  EXPECT_TRUE(shown(all, "_m").by_size);
  EXPECT_EQ(shown(all, "_m").key, "_m");
  EXPECT_TRUE(shown(all, "_Pa").by_size);
  EXPECT_FALSE(shown(all, "_mm").by_size);
}

TEST(Units, SizesDecideForLengthsAndStresses) {
  EXPECT_EQ(display_unit("way_m", 0.999).symbol, "mm");
  EXPECT_EQ(display_unit("way_m", 0.999).factor, 1000);
  EXPECT_EQ(display_unit("way_m", 1).symbol, "m");
  EXPECT_EQ(display_unit("way_m").symbol, "m");
  EXPECT_EQ(display_unit("stress_Pa", 1e4).symbol, "MPa");
  EXPECT_EQ(display_unit("stress_Pa", 9e3).symbol, "Pa");
  EXPECT_EQ(display_unit("stress_Pa").symbol, "Pa");
}

TEST(Units, LabelsCarryTheUnitThatIsShown) {
  EXPECT_EQ(label_with({"crank_angle_rad", "crank angle (rad)", {}}, display_unit("crank_angle_rad")),
            "crank angle (°)");
  EXPECT_EQ(label_with({"crank_angle_rad", "", {}}, display_unit("crank_angle_rad")), "crank angle (°)");
  EXPECT_EQ(label_with({"O1_x_N", "O1 x, ground on crank [N]", {}}, display_unit("O1_x_N")),
            "O1 x, ground on crank (N)");
  EXPECT_EQ(label_with({"share", "share (1/s)", {}}, {}), "share (1/s)");
  EXPECT_EQ(label_with({"time_share", "", {}}, {}), "time_share");
  EXPECT_EQ(label_with({"a_m", "(m)", {}}, {1, "m"}), "(m) (m)");
}

TEST(Units, QuantitiesAreWrittenForPeople) {
  EXPECT_EQ(quantity(pi / 4, display_unit("a_rad")), "45°");
  EXPECT_EQ(quantity(-0.0125, display_unit("a_m", 0.02)), "-12.5 mm");
  EXPECT_EQ(quantity(3, {}), "3");
}

}  // namespace
}  // namespace linkwright::report
