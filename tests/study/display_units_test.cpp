// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_output_units.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"
#include "support/message.h"

namespace linkwright::study {
namespace {
using ::testing::HasSubstr;

Value document(std::string_view text) {
  Diagnostics diagnostics;
  Value value = read_text(text, Syntax::toml, "s.toml", diagnostics);
  for (const Diagnostic& d : diagnostics) ADD_FAILURE() << to_string(d);
  return value;
}

TEST(DisplayUnits, AreThoseThatTheKeysCarryMostOften) {
  const DisplayUnits units = units_of(document(R"(
crank_mm = 100
rod_mm = { min = 1, max = 2 }
width_m = 0.1
points_cm = [[1, 2]]
step_deg = 5
[other]
speed_rpm = 60
youngs_modulus_GPa = 210
label_in = "a text"
)"));
  EXPECT_EQ(units.of(Dimension::length).suffix, "mm");
  EXPECT_EQ(units.of(Dimension::angle).suffix, "deg");
  EXPECT_EQ(units.of(Dimension::speed_angular).suffix, "rpm");
  EXPECT_EQ(units.of(Dimension::acceleration_angular).suffix, "deg_per_s2") << "follows the angle";
  EXPECT_EQ(units.of(Dimension::speed).suffix, "mm_per_s") << "follows the length";
  EXPECT_EQ(units.of(Dimension::mass).suffix, "kg") << "SI where nothing tells";
  EXPECT_FALSE(units.chosen(Dimension::pressure)) << "no stress has the size of a modulus";
  EXPECT_EQ(units.text(0.0031, Dimension::length), "3.1 mm");
  EXPECT_EQ(units.text(pi, Dimension::angle), "180 deg");
  EXPECT_EQ(units.text(1.23456, Dimension::none), "1.235");
}

TEST(DisplayUnits, ConvertTablesAndObjects) {
  DisplayUnits units = units_of(document("a_mm = 1\nb_deg = 2\n"));
  Table table{.name = "t"};
  table.add("crank_angle_rad", "crank angle (rad)", {0, pi, std::nan("")});
  table.add("rod_x_m", "rod x (m)", {0.5, -1, 0});
  table.add("force_N", "force (N)", {1, 2, 3});
  table.add("count", "count", {1, 2, 3});
  table.add("travel_by_angle_m_per_rad", "travel by angle (m/rad)", {1, 2, 3});
  const Table shown = in_units(table, units);
  EXPECT_EQ(shown.columns[0].key, "crank_angle_deg");
  EXPECT_EQ(shown.columns[0].label, "crank angle (deg)");
  EXPECT_EQ(shown.columns[0].values[1], 180);
  EXPECT_TRUE(std::isnan(shown.columns[0].values[2]));
  EXPECT_EQ(shown.columns[1].key, "rod_x_mm");
  EXPECT_EQ(shown.columns[1].values[0], 500);
  EXPECT_EQ(shown.columns[2].key, "force_N");
  // A unit that divides one stays: it is no angle that is shown.
  EXPECT_EQ(shown.columns[4].key, "travel_by_angle_m_per_rad");
  EXPECT_EQ(shown.columns[4].values[0], 1);
  EXPECT_EQ(shown.columns[3].key, "count");
  Value object;
  object["error_m2"] = 2e-6;
  object["name_m"] = "text";
  object["gone_m"] = Value();
  EXPECT_EQ(to_json(in_units(object, units)), R"({"error_mm2":2.0,"name_m":"text","gone_mm":null})");
}

TEST(DisplayUnits, SixDigits) {
  EXPECT_EQ(six_digits(1.23456789e-7), 1.23457e-7);
  EXPECT_EQ(six_digits(-1234567.0), -1.23457e6);
  EXPECT_TRUE(std::isnan(six_digits(std::nan(""))));
}

std::string read(std::string_view text, OutputUnits& units) {
  Diagnostics diagnostics;
  const Value value = read_text(text, Syntax::toml, "s.toml", diagnostics);
  DocumentReader reader(value, "s.toml", diagnostics);
  reader.root()(field::entry("units"), units);
  reader.finish();
  return test::lines_of(diagnostics);
}

TEST(OutputUnits, ReadsWordsAndLists) {
  OutputUnits units;
  EXPECT_EQ(read("units = 'study'", units), "");
  EXPECT_EQ(units.choice, OutputUnits::Choice::study);
  EXPECT_EQ(to_json(write_value(units)), R"("study")");
  EXPECT_EQ(read("units = ['mm', 'deg', 'kN']", units), "");
  EXPECT_EQ(to_json(write_value(units)), R"(["mm","deg","kN"])");
  const DisplayUnits chosen = chosen_units(units, {});
  EXPECT_EQ(chosen.key("force_N").key, "force_kN");
  EXPECT_EQ(chosen.key("speed_m_per_s").key, "speed_mm_per_s");
  EXPECT_EQ(chosen.key("mass_kg").key, "mass_kg");
}

TEST(OutputUnits, TellsWhatIsNoUnit) {
  OutputUnits units;
  EXPECT_THAT(read("units = 'stdy'", units), HasSubstr("units: is 'stdy', must be"));
  EXPECT_THAT(read("units = 'stdy'", units), HasSubstr("did you mean 'study'?"));
  EXPECT_THAT(read("units = ['mm', 'parsec']", units),
              HasSubstr("units[1]: is not a unit that keys may carry"));
  EXPECT_THAT(read("units = ['mm', 'm']", units),
              HasSubstr("units[1]: is a second unit of a length, after 'mm'; keep one of them"));
  EXPECT_THAT(read("units = 3", units), HasSubstr("must be \"si\", \"study\""));
}

}  // namespace
}  // namespace linkwright::study
