// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/quantities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/derivatives.h"

namespace linkwright::suspension {
namespace {

TEST(WheelQuantities, EachIsAnotherNumberOfTheParameters) {
  const CornerPlan plan = prepare_suspension(corner_sample("2RS-US").suspension);
  const CornerPosition at =
      solve_position(plan, Driver::wheel_centre_z, {0.03, 0.02}, reference_position(plan));
  const WheelParameters parameters = wheel_parameters(plan, at);
  std::set<double> values;
  for (const auto& name : names(WheelQuantity{})) {
    const double value = value_of(parameters, name.value);
    EXPECT_TRUE(std::isfinite(value)) << name.name;
    // The screw has no pitch with the spring held, and its axis is the line through both ball joints.
    if (name.value != WheelQuantity::axis_pitch_at_spring && !name.name.starts_with("geometric_")) {
      EXPECT_TRUE(values.insert(value).second) << name.name;
    }
    EXPECT_FALSE(row_of(name.value).unit.empty()) << name.name;
  }
  EXPECT_EQ(value_of(parameters, WheelQuantity::camber), parameters.angles.camber);
  EXPECT_EQ(value_of(parameters, WheelQuantity::caster_at_spring), parameters.axis_at_spring->caster);
  EXPECT_EQ(row_of(WheelQuantity::toe_by_travel).unit, "rad/m");
}

TEST(WheelQuantities, WhatAPositionShowsByItselfIsKnownWithoutMotions) {
  Suspension suspension = corner_sample("2RS-US").suspension;
  suspension.links[1] = suspension.links[0];
  suspension.links[1].name = "double";
  const CornerPlan plan = prepare_suspension(suspension);
  const WheelParameters parameters = wheel_parameters(plan, {.place = {{plan.wheel.centre, {}}, 0}});
  ASSERT_EQ(parameters.status, Status::singular);
  for (const auto& name : names(WheelQuantity{}))
    if (!name.name.starts_with("geometric_") && !name.name.starts_with("arm_")) {
      EXPECT_EQ(std::isfinite(value_of(parameters, name.value)), row_of(name.value).extent == Extent::at_rest)
          << name.name;
    }
  // Constructions are known there as well; only derivatives take their time for them with the motions.
  const CornerPlan wishbones = prepare_suspension(corner_sample("2RS-US").suspension);
  const WheelParameters drawn = wheel_parameters(wishbones, reference_position(wishbones));
  EXPECT_TRUE(std::isfinite(value_of(drawn, WheelQuantity::geometric_caster)));
  EXPECT_EQ(row_of(WheelQuantity::geometric_caster).extent, Extent::all);
}

// A number that is left out of a list would have no derivative: by the design, by travel and by rack.
TEST(WheelQuantities, WhatHasAValueHasItsDerivatives) {
  for (const CornerSample& sample : corner_samples()) {
    const DerivativePlan plan = prepare_derivatives(sample.suspension, hard_points(sample.suspension));
    const CornerPosition at =
        solve_position(plan.plan, Driver::wheel_centre_z, {0.03, 0.02}, reference_position(plan.plan));
    const WheelParameters values = wheel_parameters(plan.plan, at);
    const WheelDerivatives by_points = wheel_derivatives(plan, at);
    const InputDerivatives by_inputs = input_derivatives(plan, at);
    for (const auto& name : names(WheelQuantity{})) {
      const double value = value_of(values, name.value);
      EXPECT_EQ(std::isfinite(value_of(by_points.parameters, name.value)), std::isfinite(value)) << name.name;
      if (!std::isfinite(value)) continue;
      for (const WheelParameters& by : by_points.by)
        EXPECT_TRUE(std::isfinite(value_of(by, name.value))) << sample.name << " " << name.name;
      EXPECT_TRUE(std::isfinite(value_of(by_inputs.by_travel, name.value)))
          << sample.name << " " << name.name;
      EXPECT_TRUE(std::isfinite(value_of(by_inputs.by_rack, name.value))) << sample.name << " " << name.name;
      if (row_of(name.value).extent != Extent::at_rest) continue;
      const WheelDerivatives rest = wheel_derivatives(plan, at, Extent::at_rest);
      EXPECT_TRUE(std::isfinite(value_of(rest.by.at(0), name.value))) << sample.name << " " << name.name;
    }
  }
}

}  // namespace
}  // namespace linkwright::suspension
