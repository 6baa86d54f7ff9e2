// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/axle.h"
#include "support/message.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

constexpr std::array steered{"2RS-US", "RS-SP-US", "RS-3US", "SP-3US", "5US"};

// Lever arms by the moment about the screw axis: turning times the moment of the force about the axis, pitch
// times its share along it.
TEST(Steering, LeverArmsByTheScrewAxis) {
  for (const char* name : steered)
    for (const Suspension& suspension :
         {corner_sample(name).suspension, mirrored(corner_sample(name).suspension)})
      for (Driver lock : {Driver::spring, Driver::wheel_centre_z, Driver::contact_z}) {
        SCOPED_TRACE(name);
        const CornerPlan plan = prepare_suspension(suspension);
        const CornerPosition here = solve(plan, 0.02, 0.03);
        const auto found = steering_parameters(plan, here, lock);
        ASSERT_TRUE(found);
        const CornerRates rates = solve_rates(plan, here, Driver::wheel_centre_z);
        const Twist twist = steering_twist(plan, here, rates, lock);
        const WheelParameters wheel = wheel_parameters(plan, here);
        const auto axis = steering_axis(suspension.side, here.place.carrier.centre, wheel.contact,
                                        wheel.angles.toe, twist, lock);
        ASSERT_TRUE(axis);
        const double rate = dot(twist.turning, axis->direction) / found->toe_by_rack;
        const double outboard = suspension.side == Side::left ? 1 : -1;
        const double pitch = outboard * axis->pitch;  // pitch of a right wheel is given as in the mirror
        const auto arm = [&](const Vec3& force, const Vec3& at) {
          return rate *
                 (dot(axis->direction, cross(at - axis->point, force)) + pitch * dot(axis->direction, force));
        };
        EXPECT_NEAR(found->brake_arm, arm({1, 0, 0}, wheel.contact), 1e-12);
        EXPECT_NEAR(found->lateral_arm, arm({0, outboard, 0}, wheel.contact), 1e-12);
        EXPECT_NEAR(found->load_arm, arm({0, 0, 1}, wheel.contact), 1e-12);
        // The wheel free to turn: the force without its moment about the wheel's axis, but for the turn of
        // that axis in its own plane (toe and camber together).
        const Vec3 carrier_pitch = wheel_axis(suspension.side, wheel.angles.toe, wheel.angles.camber);
        const double torque =
            dot(cross(wheel.contact - here.place.carrier.centre, Vec3{1, 0, 0}), carrier_pitch);
        const double share = rate * dot(axis->direction, carrier_pitch);
        const double cant =
            suspension.wheel.tyre_diameter / 2 * std::sin(wheel.angles.camber) * std::cos(wheel.angles.toe);
        EXPECT_NEAR(found->drive_arm, arm({1, 0, 0}, wheel.contact) - torque * share - cant, 1e-12);
      }
}

// Straight ahead a force along the wheel has nearly the scrub radius as its arm: the axis is upright but for
// caster and inclination.
TEST(Steering, SignsOfTheArms) {
  const CornerPlan plan = prepare_suspension(corner_sample("2RS-US").suspension);
  const CornerPosition here = reference_position(plan);
  const auto found = steering_parameters(plan, here, Driver::spring);
  const WheelParameters wheel = wheel_parameters(plan, here);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->brake_arm, wheel.axis_at_spring->scrub, 0.1 * wheel.axis_at_spring->scrub);
  EXPECT_NEAR(found->lateral_arm, wheel.axis_at_spring->trail, 0.1 * wheel.axis_at_spring->trail);
  // The drive shaft pulls with the arm at the height of the wheel centre.
  EXPECT_GT(found->drive_arm, found->brake_arm);
  EXPECT_EQ(found->steer_by_rack, -found->toe_by_rack);
}

TEST(Steering, AgainstPositionsWithTheSpringHeld) {
  for (const char* name : steered) {
    SCOPED_TRACE(name);
    const CornerPlan plan = prepare_suspension(corner_sample(name).suspension);
    const CornerPosition start = solve(plan, 0.03, 0.02);
    const double length = driver_value(plan, start.place, 0.02, Driver::spring);
    const auto at_rack = [&](double rack) {
      return wheel_parameters(plan, solve_position(plan, Driver::spring, {length, rack}, start));
    };
    const double step = 1e-5;
    const WheelParameters more = at_rack(0.02 + step), less = at_rack(0.02 - step);
    const auto found = steering_parameters(plan, start, Driver::spring);
    ASSERT_TRUE(found);
    // Truncation step^2 times some 100, rounding 1e-15 / step.
    const double toe = (more.angles.toe - less.angles.toe) / (2 * step);
    EXPECT_NEAR(found->toe_by_rack, toe, 1e-7);
    EXPECT_NEAR(found->camber_by_toe * toe, (more.angles.camber - less.angles.camber) / (2 * step), 1e-7);
    EXPECT_NEAR(found->carrier_pitch_by_toe * toe,
                (more.angles.carrier_pitch - less.angles.carrier_pitch) / (2 * step), 1e-7);
    EXPECT_NEAR(found->contact_rise_by_rack, (more.contact.z - less.contact.z) / (2 * step), 1e-8);
    EXPECT_NEAR(found->load_arm * found->toe_by_rack, found->contact_rise_by_rack, 1e-14);
    EXPECT_NEAR(found->drive_arm * toe, (more.contact.x - less.contact.x) / (2 * step), 1e-7);
  }
}

TEST(Steering, MirroredWheel) {
  const Suspension& suspension = corner_sample("5US").suspension;
  const CornerPlan left = prepare_suspension(suspension), right = prepare_suspension(mirrored(suspension));
  const auto a = steering_parameters(left, solve(left, 0.01, 0.02), Driver::spring);
  const auto b = steering_parameters(right, solve(right, 0.01, -0.02), Driver::spring);
  ASSERT_TRUE(a && b);
  for (auto member : {&SteeringParameters::brake_arm, &SteeringParameters::drive_arm,
                      &SteeringParameters::lateral_arm, &SteeringParameters::load_arm,
                      &SteeringParameters::camber_by_toe, &SteeringParameters::steer_by_rack})
    EXPECT_NEAR((*a).*member, (*b).*member, 1e-12);
  EXPECT_NEAR(a->toe_by_rack, -b->toe_by_rack, 1e-12);
}

TEST(Steering, Ratio) {
  // 50 mm of rack a turn and 6.25 rad/m: 0.3125 rad a turn.
  EXPECT_NEAR(steering_ratio(-6.25, 0.05), 2 * pi / 0.3125, 1e-13);
  EXPECT_THAT(test::message([] { steering_ratio(6, 0); }),
              ::testing::StartsWith("steering_ratio: rack travel by a turn of the pinion 0 m"));
}

TEST(Steering, NothingToSteer) {
  Suspension suspension = corner_sample("SR-3US").suspension;
  const CornerPlan plan = prepare_suspension(suspension);
  EXPECT_FALSE(is_steered(plan));
  EXPECT_FALSE(steering_parameters(plan, reference_position(plan), Driver::spring));
  suspension.spring.reset();
  EXPECT_THAT(test::message([&] {
                const CornerPlan bare = prepare_suspension(suspension);
                steering_parameters(bare, reference_position(bare), Driver::spring);
              }),
              ::testing::StartsWith("steering_parameters: the spring is held, and the suspension has none"));
}

}  // namespace
}  // namespace linkwright::suspension
