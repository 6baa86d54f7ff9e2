// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/groups.h"

#include <gtest/gtest.h>

#include "linkwright/core/numbers.h"

namespace linkwright::report {
namespace {

TEST(Groups, NamesAndUnitsOfColumns) {
  EXPECT_EQ(label_of({"toe_deg", "toe (deg)", {}}), "toe (deg)");
  EXPECT_EQ(label_of({"toe_deg", "", {}}), "toe_deg");
  EXPECT_EQ(unit_of({"x", "O1 x, ground on crank (N)", {}}), "(N)");
  EXPECT_EQ(unit_of({"x", "share", {}}), "");
  EXPECT_EQ(unit_of({"x", "angle (of the crank) mean", {}}), "");
}

TEST(Groups, ValuesInRisingOrderWithTheirRows) {
  Table table;
  table.add("z_m", "z (m)", {-0.5, -0.7, nan, -0.5});
  study::Plot plot;
  plot.group = "z_m";
  const auto groups = groups_of(plot, table);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].label, "z -700 mm");
  EXPECT_EQ(groups[0].rows, (std::vector<std::size_t>{1}));
  EXPECT_EQ(groups[1].label, "z -500 mm");
  EXPECT_EQ(groups[1].rows, (std::vector<std::size_t>{0, 3}));
}

TEST(Groups, MayHaveNames) {
  Table table;
  table.add("study", "study", {2, 1, 3});
  study::Plot plot;
  plot.group = "study";
  plot.group_names = {"before", "after"};
  const auto groups = groups_of(plot, table);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].label, "before");
  EXPECT_EQ(groups[1].label, "after");
  EXPECT_EQ(groups[2].label, "study 3");
}

TEST(Groups, AreNamedInTheUnitThatIsShown) {
  const auto named = [](const char* key, const char* label, double value) {
    Table table;
    table.add(key, label, {value});
    study::Plot plot;
    plot.group = key;
    return groups_of(plot, table).at(0).label;
  };
  EXPECT_EQ(named("steer_rad", "steer (rad)", pi / 4), "steer 45°");
  EXPECT_EQ(named("reach_m", "reach (m)", 1.5), "reach 1.5 m");
  EXPECT_EQ(named("rack_mm", "", -30), "rack -30 mm");
  EXPECT_EQ(named("run", "run", 3), "run 3");
  EXPECT_EQ(named("pull", "pull (lbf)", 3), "pull 3 lbf");  // known to its label alone
}

TEST(Groups, WithoutTheColumnAllRowsAreOne) {
  Table table;
  table.add("z_m", "z (m)", {-0.5, nan});
  for (const char* column : {"", "gone"}) {
    study::Plot plot;
    plot.group = column;
    const auto groups = groups_of(plot, table);
    ASSERT_EQ(groups.size(), 1u);
    EXPECT_EQ(groups[0].label, "");
    EXPECT_EQ(groups[0].rows, (std::vector<std::size_t>{0, 1}));
  }
}

}  // namespace
}  // namespace linkwright::report
