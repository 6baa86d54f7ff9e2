// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/direct/published_targets.h"

#include <gtest/gtest.h>

#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

TEST(PublishedTargets, AreThePolynomialsAndTolerances) {
  const DirectTask task = published_direct_task();
  const Value& computed = test::at(published("ex5-targets"), "computed");
  ASSERT_EQ(task.objectives.size(), 3U);
  for (const auto& [name, k] : {std::pair{"toe_rad", 0}, {"camber_rad", 1}, {"relative_track", 2}}) {
    const auto values = test::numbers(test::at(computed, name));
    const auto& points = task.objectives[static_cast<std::size_t>(k)].curves.at(0).points;
    ASSERT_EQ(points.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(points[i].value, values[i], 1e-14) << name << i;
  }
  for (const auto& [name, k] : {std::pair{"tolerance_toe_rad", 0}, {"tolerance_camber_rad", 1}}) {
    const auto values = test::numbers(test::at(computed, name));
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(task.objectives[static_cast<std::size_t>(k)].curves[0].points[i].tolerance, values[i],
                  1e-14);
  }
  EXPECT_NEAR(task.objectives[2].curves[0].points[3].tolerance, test::number_at(computed, "tolerance_track"),
              1e-14);
}

TEST(PublishedTargets, StandAtTheOptimum) {
  DirectTask task = published_direct_task();
  place_published_boxes(task, 1);
  const DirectSynthesis at_optimum = assess(task, {}, task.suspension);
  ASSERT_TRUE(at_optimum.answer.assembled);
  EXPECT_NEAR(at_optimum.largest, min_largest_deviation, 1e-7);
  EXPECT_NEAR(at_optimum.objectives[2], 0.37343510118783946, 1e-8);
}

TEST(PublishedTargets, BoxesHoldTheOptimum) {
  DirectTask task = published_direct_task();
  place_published_boxes(task, 3);
  ASSERT_EQ(task.designed.size(), 9U);
  for (const DesignVariable& d : task.designed) {
    EXPECT_NEAR(d.upper - d.lower, 0.150, 1e-15);
    EXPECT_LT(d.lower, design_value(task.suspension, d.number));
    EXPECT_GT(d.upper, design_value(task.suspension, d.number));
  }
}

}  // namespace
}  // namespace linkwright::suspension
