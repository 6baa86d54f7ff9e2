#include "linkwright/suspension/wheel_quantities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "linkwright/suspension/samples.h"

namespace linkwright::suspension {
namespace {

TEST(WheelQuantities, EachIsAnotherNumberOfTheParameters) {
  const GuidePlan plan = prepare(guide_sample("2RS-KS").guide);
  const GuidePosition at =
      solve_position(plan, Driver::wheel_centre_z, {0.03, 0.02}, reference_position(plan));
  const WheelParameters parameters = wheel_parameters(plan, at);
  std::set<double> values;
  for (const auto& name : names(WheelQuantity{})) {
    const double value = value_of(parameters, name.value);
    EXPECT_TRUE(std::isfinite(value)) << name.name;
    // With the spring held the screw has no pitch.
    if (name.value != WheelQuantity::axis_pitch_at_spring) {
      EXPECT_TRUE(values.insert(value).second) << name.name;
    }
    EXPECT_FALSE(unit_of(name.value).empty()) << name.name;
  }
  EXPECT_EQ(value_of(parameters, WheelQuantity::camber), parameters.angles.camber);
  EXPECT_EQ(value_of(parameters, WheelQuantity::caster_at_spring), parameters.axis_at_spring->caster);
  EXPECT_EQ(unit_of(WheelQuantity::toe_by_travel), "rad/m");
}

TEST(WheelQuantities, WhatAPositionShowsByItselfIsKnownWithoutMotions) {
  WheelGuide guide = guide_sample("2RS-KS").guide;
  guide.links[1] = guide.links[0];
  guide.links[1].name = "double";
  const GuidePlan plan = prepare(guide);
  const WheelParameters parameters = wheel_parameters(plan, {.place = {{plan.wheel.centre, {}}, 0}});
  ASSERT_EQ(parameters.status, Status::singular);
  for (const auto& name : names(WheelQuantity{}))
    EXPECT_EQ(std::isfinite(value_of(parameters, name.value)), at_rest(name.value)) << name.name;
}

}  // namespace
}  // namespace linkwright::suspension
