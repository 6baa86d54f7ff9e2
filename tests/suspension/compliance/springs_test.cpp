// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/springs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "linkwright/suspension/compliance/statics.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/derivatives.h"
#include "linkwright/suspension/wheel/parameters.h"
#include "support/message.h"
#include "suspension/pushrod_corner.h"

namespace linkwright::suspension {
namespace {

// The slope of the wheel force over positions solved anew.
TEST(WheelRate, AgainstForcesOfOtherPositions) {
  const SpringLaw law{28000, 5200};
  for (const CornerSample& sample : corner_samples().first(12))
    for (double travel : {-0.05, 0.0, 0.06}) {
      SCOPED_TRACE(sample.name);
      const Suspension& suspension = sample.suspension;
      const DerivativePlan all = prepare_derivatives(suspension, {});
      const CornerPlan& plan = all.plan;
      const double rack = 0.01;
      const CornerPosition here =
          solve_position(plan, Driver::wheel_centre_z, {travel, rack}, reference_position(plan));
      const auto at = [&](double z) {
        return wheel_rate(all, solve_position(plan, Driver::wheel_centre_z, {z, rack}, here), law);
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
        const WheelRate found = wheel_rate(plan, position(travel), law);
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
  const DerivativePlan plan = prepare_derivatives(suspension, {});
  const WheelRate found = wheel_rate(plan, reference_position(plan.plan), {10000, 3000});
  EXPECT_NEAR(found.motion_ratio, 0.8, 1e-14);  // 0.4 m of 0.5 m
  EXPECT_NEAR(found.wheel_force, 2400, 1e-10);
  EXPECT_NEAR(found.by_stiffness, 6400, 1e-9);
  // Both ends of the arm rise by its sine, and the spring's end moves across the spring by its versine.
  EXPECT_NEAR(found.motion_ratio_by_travel, 0, 1e-10);
}

// Lengths and angles by distances and Newton, rates by differences of fourth order, forces by energies.
TEST(WheelRate, PushrodAndRocker) {
  struct Row {
    double travel, rocker, spring, bar, ratio, rocker_ratio, force, wheel_force, rate, toe, camber;
  };
  constexpr std::array rows{
      Row{-30, 16.02459413, 219.60986226, 4.05208776, -0.78000531, -0.55848785, 74.4583, 58.077905, 21.2968,
          0.006066, 2.374566},
      Row{-15, 7.86616291, 207.88074331, 2.18048543, -0.78527214, -0.53202107, 484.9775, 380.839326, 21.8725,
          0.008008, 1.956621},
      Row{0, 0, 196.02295784, 0, -0.79637970, -0.51851420, 900, 716.741727, 22.9575, 0, 1.5},
      Row{15, -7.73292094, 183.97910092, -2.48802876, -0.80955548, -0.51380856, 1321.5350, 1069.855897,
          24.1001, -0.018851, 1.002955},
      Row{30, -15.44882070, 171.74143566, -5.29470877, -0.82168077, -0.51605199, 1749.8533, 1437.820795,
          24.8499, -0.049677, 0.463096}};
  constexpr double degrees = 180 / std::numbers::pi, digit8 = 5.1e-9, digit6 = 5.1e-7, digit4 = 5.1e-5;
  // The rates of the table were found by differences, to a unit of their last digit.
  constexpr double rate_digit = 1.5e-4;
  const Suspension left = pushrod_corner();
  for (const Suspension& suspension : {left, mirrored(left)}) {
    SCOPED_TRACE(name_of(suspension.side));
    const DerivativePlan plan = prepare_derivatives(suspension, {});
    const CornerPosition reference = reference_position(plan.plan);
    for (const Row& row : rows) {
      SCOPED_TRACE(row.travel);
      const CornerPosition position =
          solve_position(plan.plan, Driver::wheel_centre_z, {1e-3 * row.travel, 0}, reference);
      ASSERT_EQ(position.status, Status::done) << position.reason;
      const CornerMotions found = corner_motions(plan, position);
      EXPECT_NEAR(found.rockers[0].value * degrees, row.rocker, digit8);
      EXPECT_NEAR(found.rockers[0].ratio * degrees * 1e-3, row.rocker_ratio, digit8);
      EXPECT_NEAR(found.rockers[1].value * degrees, row.bar, digit8);
      EXPECT_NEAR(found.spring->value * 1e3, row.spring, digit8);
      EXPECT_NEAR(found.spring->ratio, row.ratio, digit8);
      const WheelRate wheel = wheel_rate(plan, position, {35e3, 900});
      EXPECT_NEAR(wheel.spring_force, row.force, digit4);
      EXPECT_NEAR(wheel.wheel_force, row.wheel_force, digit6);
      EXPECT_NEAR(wheel.rate * 1e-3, row.rate, rate_digit);
      const WheelParameters shown = wheel_parameters(plan.plan, position);
      EXPECT_NEAR(shown.angles.toe * degrees, row.toe, digit6);
      EXPECT_NEAR(shown.angles.camber * degrees, row.camber, digit6);
    }
  }
}

// The rate is the second derivative of the energy of the spring, here by central differences of fourth order;
// the force at the wheel is its first, and that which the transposed equations balance.
TEST(WheelRate, EnergyAndVirtualWorkWithARocker) {
  const SpringLaw law{35e3, 900};
  const Suspension suspension = pushrod_corner();
  const DerivativePlan plan = prepare_derivatives(suspension, {});
  const CornerPosition reference = reference_position(plan.plan);
  for (const double travel : {-0.07, -0.03, 0.0, 0.02, 0.06, 0.12})
    for (const double rack : {0.0, 0.02}) {
      SCOPED_TRACE(travel);
      const auto position = [&](double z) {
        return solve_position(plan.plan, Driver::wheel_centre_z, {z, rack}, reference);
      };
      const auto energy = [&](double z) {
        const double force = wheel_rate(plan, position(z), law).spring_force;
        return force * force / (2 * law.stiffness);
      };
      const WheelRate found = wheel_rate(plan, position(travel), law);
      const double step = 1e-3, e0 = energy(travel), p1 = energy(travel + step), m1 = energy(travel - step),
                   p2 = energy(travel + 2 * step), m2 = energy(travel - 2 * step),
                   p3 = energy(travel + 3 * step), m3 = energy(travel - 3 * step);
      const double second =
          (270 * (p1 + m1) - 27 * (p2 + m2) + 2 * (p3 + m3) - 490 * e0) / (180 * step * step);
      EXPECT_NEAR(found.rate, second, 1e-6 * std::abs(found.rate));
      const WheelLoad load{{0, 0, found.wheel_force}, {}};
      const CornerForces forces =
          solve_forces(suspension, plan.plan, position(travel), load, Support::spring);
      ASSERT_EQ(forces.status, Status::done);
      EXPECT_NEAR(forces.support, found.spring_force, 1e-9 * std::abs(found.spring_force));
    }
}

// What the wishbone passes to its hinge and to the carrier, and the pushrod on it, balance.
TEST(WheelRate, ForcesOfAWishboneWithAPushrod) {
  const Suspension suspension = pushrod_corner();
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition position =
      solve_position(plan, Driver::wheel_centre_z, {0.02, 0}, reference_position(plan));
  const CornerForces forces =
      solve_forces(suspension, plan, position, {{100, -300, 1000}, {}}, Support::spring);
  ASSERT_EQ(forces.joints.size(), 6U);
  Vec3 sum{100, -300, 1000};
  for (const JointForce& joint : forces.joints)
    if (joint.at_carrier) sum += joint.force;
  EXPECT_NEAR(norm(sum), 0, 1e-9);
  const RockerConstants& rocker = plan.rockers[0];
  const PartPoint inner{{PartKind::rocker, 0}, rocker.rod};
  const Vec3 outer = place_of(plan, rocker.driver, position.place, 0),
             along = unit(outer - place_of(plan, inner, position.place, 0));
  const Vec3 on_wishbone =
      forces.joints[3].force - forces.joints[2].force;  // to the carrier less from the body
  EXPECT_NEAR(norm(cross(on_wishbone, along)), 0, 1e-9 * norm(on_wishbone));
  // Moment of the rod about the rocker's axis against that of the spring.
  const Vec3 axis = rocker.axis, end = place_of(plan, plan.spring->second, position.place, 0),
             spring = forces.support * unit(end - place_of(plan, plan.spring->first, position.place, 0));
  EXPECT_NEAR(dot(axis, cross(end - rocker.at, spring)) - dot(axis, cross(outer - rocker.at, on_wishbone)), 0,
              1e-9 * norm(spring));
}

TEST(WheelRate, Contract) {
  Suspension suspension = corner_sample("5US").suspension;
  const DerivativePlan plan = prepare_derivatives(suspension, {});
  EXPECT_THAT(test::message([&] {
                wheel_rate(plan, reference_position(plan.plan), {-1, 0});
              }),
              ::testing::StartsWith("force_of: stiffness -1 N/m"));
  suspension.spring.reset();
  EXPECT_THAT(test::message([&] {
                const DerivativePlan bare = prepare_derivatives(suspension, {});
                wheel_rate(bare, reference_position(bare.plan), {1, 0});
              }),
              ::testing::StartsWith("wheel_rate: the suspension has no spring"));
}

}  // namespace
}  // namespace linkwright::suspension
