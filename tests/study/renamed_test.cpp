// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/renamed.h"

#include <gmock/gmock.h>

#include "linkwright/study/study.h"

namespace linkwright::study {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Today {
  Value document;
  std::vector<std::string> warnings;
};
Today today(const std::string& text) {
  Diagnostics diagnostics;
  const Value given = read_text(text, Syntax::toml, "a.toml", diagnostics);
  Today out{with_todays_names(given, "a.toml", diagnostics), {}};
  for (const Diagnostic& d : diagnostics) out.warnings.push_back(to_string(d));
  return out;
}
std::string at(const Value& document, std::initializer_list<std::string_view> path) {
  const Value* v = &document;
  for (std::string_view key : path) {
    if (v->is_array()) v = &v->as_array().at(0);
    v = v->find(key);
    if (!v) return "nothing";
  }
  return v->is_string() ? v->as_string() : "a " + std::string(v->type_name());
}

TEST(Renamed, OldNamesAreReadWithAWarningThatGivesTheNewOne) {
  const Today t = today(
      "kind = \"analysis\"\n[mechanism]\ntype = \"suspension.wheel_guide\"\n[output]\n"
      "quantities = [\"toe\", \"spin\"]\n[[check]]\nquantity = \"sweep.spin_deg.max\"\nat = { spin_deg = 1 "
      "}\n"
      "[[target]]\nspin_rad = 0.1\n");
  EXPECT_EQ(at(t.document, {"mechanism", "type"}), "suspension.corner");
  EXPECT_EQ(t.document.find("output")->find("quantities")->as_array()[1].as_string(), "carrier_pitch");
  EXPECT_EQ(at(t.document, {"check", "quantity"}), "sweep.carrier_pitch_deg.max");
  EXPECT_EQ(at(t.document, {"check", "at", "carrier_pitch_deg"}), "a integer");
  EXPECT_EQ(at(t.document, {"target", "carrier_pitch_rad"}), "a number");
  EXPECT_EQ(at(t.document, {"target", "spin_rad"}), "nothing");
  ASSERT_EQ(t.warnings.size(), 5u);
  EXPECT_EQ(
      t.warnings[0],
      "a.toml:3:8: warning: mechanism.type: 'suspension.wheel_guide' is now called 'suspension.corner'; the "
      "old name will be read until the next version");
  EXPECT_EQ(t.warnings[2],
            "a.toml:7:12: warning: check[0].quantity: 'sweep.spin_deg.max' is now called "
            "'sweep.carrier_pitch_deg.max'; the old name will be read until the next version");
}

TEST(Renamed, HoldsForTheMechanismsItIsOf) {
  EXPECT_THAT(today("[mechanism]\ntype = \"parallel.delta\"\n[drive]\nlead_mm = 5\n").warnings, IsEmpty());
  EXPECT_THAT(
      today("kind = \"regulation\"\n[mechanism]\ntype = \"planar.linkage\"\n").warnings,
      ElementsAre("a.toml:1:8: warning: kind: 'regulation' is now called 'speed_fluctuation'; the old name "
                  "will be read until the next version"));
}

TEST(Renamed, ColumnsOfSlidesByTheEndOfTheirName) {
  const Today t = today(
      "[mechanism]\ntype = \"planar.linkage\"\n[[check]]\nquantity = \"motion.piston_way_mm.max_abs\"\n");
  EXPECT_EQ(at(t.document, {"check", "quantity"}), "motion.piston_displacement_mm.max_abs");
  const auto quantity = [](const std::string& text) {
    return at(
        today("[mechanism]\ntype = \"clearance.linkage\"\n[[check]]\nquantity = \"" + text + "\"\n").document,
        {"check", "quantity"});
  };
  EXPECT_EQ(quantity("errors.guide_way_worst_mm.max"), "errors.guide_displacement_worst_mm.max");
  EXPECT_EQ(quantity("statistics.guide_way_yield"), "statistics.guide_displacement_yield");
  EXPECT_EQ(quantity("pins.A_lead_deg.max"), "pins.A_phase_deg.max");
  EXPECT_EQ(quantity("best.lead_max_deg"), "best.phase_max_deg");
  // A joint may be called so.
  EXPECT_EQ(quantity("reactions.run_way_x_N.max"), "reactions.run_way_x_N.max");
}

TEST(Renamed, CodesOfLinks) {
  const std::string text = "[mechanism]\ntype = \"suspension.corner\"\nsample = \"2RS-KS\"\n";
  const Today sample = today(text);
  EXPECT_EQ(at(sample.document, {"mechanism", "sample"}), "2RS-US");
  EXPECT_THAT(sample.warnings,
              ElementsAre("a.toml:3:10: warning: mechanism.sample: '2RS-KS' is now called '2RS-US'; the old "
                          "name will be read until the next version"));
  const Today link = today("[mechanism]\ntype = \"suspension.corner\"\n[[mechanism.link]]\ntype = \"KS\"\n");
  EXPECT_EQ(at(link.document, {"mechanism", "link", "type"}), "US");
  EXPECT_THAT(today("[mechanism]\ntype = \"planar.linkage\"\nsample = \"KS\"\n").warnings, IsEmpty());
}

TEST(Renamed, BothNamesAtOnceAreLeftToTheReader) {
  const Today t =
      today("[mechanism]\ntype = \"suspension.corner\"\n[target]\nspin_deg = 1\ncarrier_pitch_deg = 2\n");
  EXPECT_THAT(t.warnings, IsEmpty());
  EXPECT_EQ(at(t.document, {"target", "spin_deg"}), "a integer");
}

TEST(Renamed, KindsAreFoundByBothNames) {
  EXPECT_EQ(todays_kind("synthesis/suspension.wheel_guide/carrier_poses"),
            "synthesis/suspension.corner/carrier_poses");
  EXPECT_EQ(todays_kind("regulation/planar.linkage"), "speed_fluctuation/planar.linkage");
  EXPECT_EQ(todays_kind("synthesis/clearance.four_bar/lead"), "synthesis/clearance.four_bar/phase");
  EXPECT_EQ(todays_kind("analysis/planar.four_bar"), "analysis/planar.four_bar");
}

TEST(Renamed, NothingIsRenamedTwice) {
  for (const Renamed& r : renamed())
    for (const Renamed& other : renamed())
      EXPECT_FALSE(r.of == other.of && r.now == other.before && r.mechanism == other.mechanism) << r.before;
}

}  // namespace
}  // namespace linkwright::study
