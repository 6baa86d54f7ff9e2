// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "clearance/published_four_bar.h"
#include "linkwright/clearance/four_bar_clearance.h"

namespace linkwright::clearance {
namespace {

TEST(PublishedClearance, DesignsAreThoseOfTheReference) {
  for (const auto& [ours, id] : {std::pair{published_design_1(), "gamma-design1-table2-g0-w10"},
                                 std::pair{published_design_2(), "gamma-design2-table3-g0-w10"}}) {
    const ClearanceFourBar wanted = published_four_bar(id);
    const ClearanceInstant a = clearance_instant(ours, 1, 10, 0, {1.2, 15}),
                           b = clearance_instant(wanted, 1, 10, 0, {1.2, 15});
    EXPECT_NEAR(std::abs(a.position.point - b.position.point), 0, 1e-16);
    EXPECT_NEAR(a.link_acceleration / b.link_acceleration, 1, 1e-11);
    EXPECT_NEAR(a.tension / b.tension, 1, 1e-11);
  }
}

TEST(PublishedClearance, ClearanceOfTheClosestFit) {
  const Value& best = test::at(computed("infer-r"), "ranking").as_array().at(0);
  EXPECT_EQ(test::numbers(test::at(best, "ground_crank_coupler_rocker_from_a")),
            (std::vector<double>{1, 2, 3, 4}));
  // 36 points of the path here, another number there.
  EXPECT_NEAR(inferred_clearance(), test::number_at(best, "r_fit_m"), 1e-7);
}

TEST(PublishedClearance, ComparisonsComeOut) {
  const auto rows = compare_with_published_clearance();
  ASSERT_EQ(rows.size(), 8u);
  EXPECT_NEAR(rows[0].ours, 0.988, 1e-3);
  EXPECT_NEAR(rows[1].ours, 0.06548915, 1e-8);
  EXPECT_NEAR(rows[2].ours, 0.0152133, 1e-7);
  EXPECT_NEAR(rows[3].ours, 0.6319, 1e-3);
  EXPECT_NEAR(rows[4].ours, 3.5485, 5e-3);
  EXPECT_GT(rows[5].ours, 30);
  EXPECT_GE(rows[6].ours, 10);
  EXPECT_GT(rows[7].ours, 10);
  for (const ClearanceComparison& row : rows)
    EXPECT_THAT(row.verdict, ::testing::AnyOf("reproduced", "corrected", "not reproduced"));
}

}  // namespace
}  // namespace linkwright::clearance
