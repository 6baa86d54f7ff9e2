// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/corner_columns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "linkwright/core/units.h"
#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {
namespace {

TEST(CornerColumns, HaveKeysOfTheirOwnAndNumbersOfASteeredCornerWithSpring) {
  const CornerPlan plan = prepare_suspension(corner_sample("2RS-US").suspension);
  const CornerPosition at =
      solve_position(plan, Driver::wheel_centre_z, {0.03, 0.02}, reference_position(plan));
  const WheelParameters wheel = wheel_parameters(plan, at);
  const CornerRow row{at, wheel, Driver::spring};
  std::set<std::string_view> keys;
  for (const CornerColumn& c : corner_columns()) {
    EXPECT_TRUE(keys.insert(c.key).second) << c.key;
    EXPECT_TRUE(std::isfinite(value_of(c, row))) << c.key;
  }
  EXPECT_EQ(value_of(*corner_column("toe"), row), wheel.angles.toe);
  EXPECT_EQ(value_of(*corner_column("roll_centre_height"), row), wheel.roll_centre_height);
  EXPECT_EQ(value_of(*corner_column("caster"), row), wheel.axis_at_spring->caster);
  EXPECT_EQ(corner_column("toe_rad"), nullptr);
}

TEST(CornerColumns, AreMissingWhereThereIsNoPosition) {
  const CornerPosition nowhere{.status = Status::no_assembly};
  const WheelParameters wheel{.status = Status::no_assembly};
  for (const CornerColumn& c : corner_columns())
    EXPECT_TRUE(std::isnan(value_of(c, {nowhere, wheel, Driver::spring}))) << c.key;
}

TEST(CornerColumns, AreMissingForAReason) {
  for (const CornerSample& sample : corner_samples()) {
    const CornerPlan plan = prepare_suspension(sample.suspension);
    const CornerPosition at = reference_position(plan);
    const WheelParameters wheel = wheel_parameters(plan, at);
    const CornerRow row{at, wheel, sample.suspension.spring ? Driver::spring : Driver::wheel_centre_z};
    for (const CornerColumn& c : corner_columns())
      EXPECT_EQ(std::isnan(value_of(c, row)), !why_missing(sample.suspension, c).empty())
          << sample.name << " " << c.key << " " << why_missing(sample.suspension, c);
  }
}

TEST(SteeringAxisOf, TakesWhatIsHeld) {
  const CornerPlan plan = prepare_suspension(corner_sample("2RS-US").suspension);
  const WheelParameters wheel = wheel_parameters(plan, reference_position(plan));
  EXPECT_EQ(steering_axis_of(wheel, Driver::spring)->lock, Driver::spring);
  EXPECT_EQ(steering_axis_of(wheel, Driver::wheel_centre_z)->lock, Driver::wheel_centre_z);
  EXPECT_EQ(steering_axis_of(wheel, Driver::contact_z)->lock, Driver::contact_z);
  const CornerPlan rigid = prepare_suspension(corner_sample("R").suspension);
  EXPECT_EQ(steering_axis_of(wheel_parameters(rigid, reference_position(rigid)), Driver::spring), nullptr);
}

}  // namespace
}  // namespace linkwright::suspension
