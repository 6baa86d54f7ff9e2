#include "linkwright/report/units.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"

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

// The list of the viewer is made from the one here: when this fails, the file must become `made`.
TEST(Units, TheViewerHasTheSameUnits) {
  std::string made =
      "// How numbers are shown, by the suffix of their key: [suffix, factor, symbol]. Made from "
      "core/units;\n"
      "// tests/report/units_test.cpp fails when it is not up to date, and prints what it must be.\n"
      "export const suffixes: [string, number, string][] = [\n";
  for (const SuffixUnit& s : suffix_units())
    made += fmt::format("  [\"{}\", {}, \"{}\"],\n", s.suffix, s.factor, s.symbol);
  made += "];\n";
  std::ifstream file(LINKWRIGHT_SOURCE_DIR "/web/src/suffixes.ts");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), made);
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
