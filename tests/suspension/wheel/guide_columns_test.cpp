// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/guide_columns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "linkwright/core/units.h"
#include "linkwright/suspension/guide/samples.h"

namespace linkwright::suspension {
namespace {

TEST(GuideColumns, HaveKeysOfTheirOwnAndNumbersOfASteeredGuideWithSpring) {
  const GuidePlan plan = prepare_guide(guide_sample("2RS-US").guide);
  const GuidePosition at =
      solve_position(plan, Driver::wheel_centre_z, {0.03, 0.02}, reference_position(plan));
  const WheelParameters wheel = wheel_parameters(plan, at);
  const GuideRow row{at, wheel, Driver::spring};
  std::set<std::string_view> keys;
  for (const GuideColumn& c : guide_columns()) {
    EXPECT_TRUE(keys.insert(c.key).second) << c.key;
    EXPECT_TRUE(std::isfinite(value_of(c, row))) << c.key;
  }
  EXPECT_EQ(value_of(*guide_column("toe"), row), wheel.angles.toe);
  EXPECT_EQ(value_of(*guide_column("roll_centre_height"), row), wheel.roll_centre_height);
  EXPECT_EQ(value_of(*guide_column("caster"), row), wheel.axis_at_spring->caster);
  EXPECT_EQ(guide_column("toe_rad"), nullptr);
}

TEST(GuideColumns, AreMissingWhereThereIsNoPosition) {
  const GuidePosition nowhere{.status = Status::no_assembly};
  const WheelParameters wheel{.status = Status::no_assembly};
  for (const GuideColumn& c : guide_columns())
    EXPECT_TRUE(std::isnan(value_of(c, {nowhere, wheel, Driver::spring}))) << c.key;
}

TEST(GuideColumns, AreMissingForAReason) {
  for (const GuideSample& sample : guide_samples()) {
    const GuidePlan plan = prepare_guide(sample.guide);
    const GuidePosition at = reference_position(plan);
    const WheelParameters wheel = wheel_parameters(plan, at);
    const GuideRow row{at, wheel, sample.guide.spring ? Driver::spring : Driver::wheel_centre_z};
    for (const GuideColumn& c : guide_columns())
      EXPECT_EQ(std::isnan(value_of(c, row)), !why_missing(sample.guide, c).empty())
          << sample.name << " " << c.key << " " << why_missing(sample.guide, c);
  }
}

TEST(SteeringAxisOf, TakesWhatIsHeld) {
  const GuidePlan plan = prepare_guide(guide_sample("2RS-US").guide);
  const WheelParameters wheel = wheel_parameters(plan, reference_position(plan));
  EXPECT_EQ(steering_axis_of(wheel, Driver::spring)->lock, Driver::spring);
  EXPECT_EQ(steering_axis_of(wheel, Driver::wheel_centre_z)->lock, Driver::wheel_centre_z);
  EXPECT_EQ(steering_axis_of(wheel, Driver::contact_z)->lock, Driver::contact_z);
  const GuidePlan rigid = prepare_guide(guide_sample("R").guide);
  EXPECT_EQ(steering_axis_of(wheel_parameters(rigid, reference_position(rigid)), Driver::spring), nullptr);
}

}  // namespace
}  // namespace linkwright::suspension
