// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/springs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "linkwright/suspension/corner/samples.h"
#include "linkwright/suspension/wheel/derivatives.h"
#include "linkwright/suspension/wheel/parameters.h"
#include "support/message.h"

namespace linkwright::suspension {
namespace {

// The slope of the wheel force over positions solved anew.
TEST(WheelRate, AgainstForcesOfOtherPositions) {
  const SpringLaw law{28000, 5200};
  for (const CornerSample& sample : corner_samples().first(12))
    for (double travel : {-0.05, 0.0, 0.06}) {
      SCOPED_TRACE(sample.name);
      const Suspension& suspension = sample.suspension;
      const CornerPlan plan = prepare_suspension(suspension);
      const double rack = 0.01;
      const CornerPosition here =
          solve_position(plan, Driver::wheel_centre_z, {travel, rack}, reference_position(plan));
      const auto at = [&](double z) {
        return wheel_rate(suspension, plan, solve_position(plan, Driver::wheel_centre_z, {z, rack}, here),
                          law);
      };
      const double step = 1e-4;
      const WheelRate found = at(travel), more = at(travel + step), less = at(travel - step);
      ASSERT_EQ(found.status, Status::done);
      // The rate is some 1e4 N/m: truncation step^2 / 6 times a third derivative of some 1e5 N/m^3, rounding
      // 1e-12 / step.
      EXPECT_NEAR(found.rate, (more.wheel_force - less.wheel_force) / (2 * step), 0.01);
      EXPECT_NEAR(found.motion_ratio_by_travel, (more.motion_ratio - less.motion_ratio) / (2 * step), 1e-6);
      const WheelParameters wheel = wheel_parameters(plan, here);
      EXPECT_NEAR(found.motion_ratio, wheel.motion_ratio, 1e-13);
      EXPECT_NEAR(found.spring_force, 5200 + 28000 * (plan.spring->length - wheel.spring_length), 1e-9);
      EXPECT_EQ(found.rate, found.by_stiffness + found.by_motion_ratio);
    }
}

// A spring off the line of a rod that turns about it as its U joint says: against other positions, and
// against the second derivatives of the position.
TEST(WheelRate, SpringOffTheLineOfARod) {
  const SpringLaw law{28000, 5200};
  for (const int link : {0, 1, 2})
    for (const std::optional<Vec3>& axis :
         {std::optional<Vec3>{}, std::optional<Vec3>{Vec3{0.8, 0.5, 0.6}}}) {
      Suspension suspension = corner_sample("5US").suspension;
      suspension.spring->link = link;
      suspension.links[link].cross_axis = axis;
      const DerivativePlan plan = prepare_derivatives(suspension, {});
      const CornerPosition reference = reference_position(plan.plan);
      for (const double travel : {-0.05, 0.06}) {
        const auto position = [&](double z) {
          return solve_position(plan.plan, Driver::wheel_centre_z, {z, 0.01}, reference);
        };
        const WheelRate found = wheel_rate(suspension, plan.plan, position(travel), law);
        ASSERT_EQ(found.status, Status::done);
        const double step = 1e-4;
        const WheelParameters more = wheel_parameters(plan.plan, position(travel + step)),
                              less = wheel_parameters(plan.plan, position(travel - step));
        EXPECT_NEAR(found.motion_ratio, (less.spring_length - more.spring_length) / (2 * step), 1e-6);
        EXPECT_NEAR(found.motion_ratio_by_travel, (more.motion_ratio - less.motion_ratio) / (2 * step), 1e-6);
        EXPECT_NEAR(found.motion_ratio_by_travel,
                    input_derivatives(plan, position(travel)).by_travel.motion_ratio, 1e-8);
      }
    }
}

// A level arm: its end moves straight up to second order, so that an upright spring is compressed in
// proportion to the travel.
TEST(WheelRate, LevelArmUnderAnUprightSpring) {
  Suspension suspension{.wheel = {{0, 0.8, 0}, 0, 0, 0.6}};
  suspension.links.push_back({.type = LinkType::R, .body = {{-0.1, 0.3, 0}, {0.1, 0.3, 0}}});
  suspension.spring = {{0, 0.7, 0.4}, {0, 0.7, 0}, -1};
  const CornerPlan plan = prepare_suspension(suspension);
  const WheelRate found = wheel_rate(suspension, plan, reference_position(plan), {10000, 3000});
  EXPECT_NEAR(found.motion_ratio, 0.8, 1e-14);  // 0.4 m of 0.5 m
  EXPECT_NEAR(found.wheel_force, 2400, 1e-10);
  EXPECT_NEAR(found.by_stiffness, 6400, 1e-9);
  // Both ends of the arm rise by its sine, and the spring's end moves across the spring by its versine.
  EXPECT_NEAR(found.motion_ratio_by_travel, 0, 1e-10);
}

TEST(WheelRate, Contract) {
  Suspension suspension = corner_sample("5US").suspension;
  const CornerPlan plan = prepare_suspension(suspension);
  EXPECT_THAT(test::message([&] {
                wheel_rate(suspension, plan, reference_position(plan), {-1, 0});
              }),
              ::testing::StartsWith("wheel_rate: stiffness -1 N/m"));
  suspension.spring.reset();
  EXPECT_THAT(test::message([&] {
                const CornerPlan bare = prepare_suspension(suspension);
                wheel_rate(suspension, bare, reference_position(bare), {1, 0});
              }),
              ::testing::StartsWith("wheel_rate: the suspension has no spring"));
}

}  // namespace
}  // namespace linkwright::suspension
