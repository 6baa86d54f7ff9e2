// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/former_names.h"

#include <gtest/gtest.h>

#include <type_traits>

namespace linkwright::suspension {
namespace {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
// A program with the former names is the program with those of today.
TEST(FormerNames, AreThoseOfToday) {
  EXPECT_TRUE((std::is_same_v<WheelGuide, Suspension>));
  EXPECT_TRUE((std::is_same_v<GuidePosition, CornerPosition>));
  ASSERT_EQ(guide_samples().size(), corner_samples().size());
  const GuideSample& sample = guide_sample(corner_samples()[0].name);
  EXPECT_EQ(&sample, &corner_samples()[0]);
  const GuidePlan plan = prepare_guide(sample.suspension);
  EXPECT_EQ(plan.links.size(), prepare_suspension(sample.suspension).links.size());
}
#pragma GCC diagnostic pop

}  // namespace
}  // namespace linkwright::suspension
