// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/axle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/suspension/corner/suspension.h"
#include "support/message.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

using test::at;
using test::number_at;
using test::numbers;

WheelParameters parameters(const Suspension& suspension, double travel, double rack = 0) {
  const CornerPlan plan = prepare_suspension(suspension);
  return wheel_parameters(
      plan, solve_position(plan, Driver::wheel_centre_z, {travel, rack}, reference_position(plan)));
}

TEST(Axle, ReferenceAxleAndRollCentreOfUnequalTravel) {
  for (const CornerSample& sample : corner_samples().first(12)) {
    SCOPED_TRACE(sample.name);
    const Value& computed = at(published("mechanism-" + sample.name), "computed");
    const Value& axle = at(computed, "reference_axle");
    const WheelParameters here = parameters(sample.suspension, 0);
    // Rates to 1e-9 (see the curves); instant centres lie metres away, which multiplies.
    EXPECT_NEAR(2 * here.contact.y, number_at(axle, "track_m"), 1e-12);
    EXPECT_NEAR(here.roll_centre_height, number_at(axle, "roll_centre_height_m"), 1e-9);
    const auto front = numbers(at(axle, "front_view_instant_centre_yz_m"));
    const auto side = numbers(at(axle, "side_view_instant_centre_xz_m"));
    for (int i : {0, 1}) {
      EXPECT_NEAR(here.front_centre[i], front[i], 1e-9 * std::max(1.0, std::abs(front[i])));
      EXPECT_NEAR(here.side_centre[i], side[i], 1e-9 * std::max(1.0, std::abs(side[i])));
    }
    const auto expected = numbers(at(computed, "roll_centre_left_plus40_right_minus40_mm_yz_m"));
    const auto found =
        roll_centre(parameters(sample.suspension, 0.04), parameters(mirrored(sample.suspension), -0.04));
    ASSERT_TRUE(found);
    EXPECT_NEAR((*found)[0], expected[0], 1e-9);
    EXPECT_NEAR((*found)[1], expected[1], 1e-9);
  }
}

TEST(Axle, RollCentreOfEqualTravelLiesInTheMiddle) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  const WheelParameters left = parameters(suspension, 0.03), right = parameters(mirrored(suspension), 0.03);
  const auto found = roll_centre(left, right);
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found)[0], 0, 1e-13);
  EXPECT_NEAR((*found)[1] - left.contact.z, left.roll_centre_height, 1e-12);
  WheelParameters flat = left;
  flat.contact_velocity.on_carrier = right.contact_velocity.on_carrier;
  EXPECT_FALSE(roll_centre(flat, right));
}

// Against two positions of the contact point, and a wheel that has to lean with the body.
TEST(Axle, RollGains) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  for (const Suspension& one : {suspension, mirrored(suspension)}) {
    const CornerPlan plan = prepare_suspension(one);
    const RollGains found = roll_gains(parameters(one, 0));
    const double roll = 1e-5, rise = std::abs(plan.contact.y) * std::tan(roll);
    const auto angles = [&](double height) {
      return wheel_parameters(plan,
                              solve_position(plan, Driver::contact_z, {height, 0}, reference_position(plan)))
          .angles;
    };
    const WheelAngles up = angles(rise), down = angles(-rise);
    // Truncation roll^2 times some 10, rounding 1e-15 / roll.
    EXPECT_NEAR(found.toe, (up.toe - down.toe) / (2 * roll), 1e-8);
    EXPECT_NEAR(found.camber, 1 + (up.camber - down.camber) / (2 * roll), 1e-8);
  }
  Suspension trailing{.wheel = {{0, 0.7, 0}, 0, 0, 0.6}};
  trailing.links.push_back({.type = LinkType::R, .body = {{0.5, 0.3, 0}, {0.5, 0.6, 0}}});
  EXPECT_NEAR(roll_gains(parameters(trailing, 0)).camber, 1, 1e-15);
  EXPECT_NEAR(roll_gains(parameters(trailing, 0)).toe, 0, 1e-15);
}

TEST(Axle, AckermannOfTheSteeredMechanisms) {
  for (const char* name : {"2RS-US", "RS-SP-US", "RS-3US", "SP-3US", "5US"}) {
    SCOPED_TRACE(name);
    const Suspension& suspension = corner_sample(name).suspension;
    const Value& reference = at(published(std::string("mechanism-") + name), "computed.ackermann");
    const WheelParameters ahead = parameters(suspension, 0);
    const double track = 2 * ahead.axis_at_spring->ground.y;
    EXPECT_NEAR(track, number_at(reference, "kingpin_track_at_ground_m"), 1e-11);
    for (const Value& row : at(reference, "rows").as_array()) {
      const double rack = number_at(row, "rack_m");
      const double plus = parameters(suspension, 0, rack).angles.toe - ahead.angles.toe;
      const double minus = parameters(suspension, 0, -rack).angles.toe - ahead.angles.toe;
      // A wheel that toes out is the inner one.
      const double inner = -std::min(plus, minus), outer = std::max(plus, minus);
      EXPECT_NEAR(inner, number_at(row, "inner_rad"), 1e-11);
      EXPECT_NEAR(outer, number_at(row, "outer_rad"), 1e-11);
      const Ackermann found = ackermann(inner, outer, number_at(reference, "wheelbase_m"), track);
      EXPECT_NEAR(found.ideal_inner, number_at(row, "ideal_inner_rad"), 1e-10);
      EXPECT_NEAR(found.percent, number_at(row, "ackermann_percent"), 1e-7);
    }
  }
}

TEST(Axle, AckermannOfATruePair) {
  // Both wheels on circles about a point 10 m to the side: 100 percent.
  const double inner = std::atan(2.7 / (10 - 0.75)), outer = std::atan(2.7 / (10 + 0.75));
  const Ackermann found = ackermann(inner, outer, 2.7, 1.5);
  EXPECT_NEAR(found.ideal_inner, inner, 1e-15);
  EXPECT_NEAR(found.percent, 100, 1e-11);
  EXPECT_NEAR(ackermann(outer, outer, 2.7, 1.5).percent, 0, 1e-15);
}

TEST(Axle, AntiFeatures) {
  const Value& reference = published("anti-features");
  VehicleLayout layout{number_at(reference, "inputs.wheelbase_m"), number_at(reference, "inputs.cg_height_m"),
                       number_at(reference, "inputs.front_brake_share")};
  for (const Value& row : at(reference, "computed.rows").as_array()) {
    const std::string& name = at(row, "mechanism").as_string();
    SCOPED_TRACE(name);
    const bool front = row.find("anti_dive_percent_front_outboard_brake");
    const AntiFeatures found = anti_features(parameters(corner_sample(name).suspension, 0),
                                             front ? AxlePlace::front : AxlePlace::rear, layout);
    EXPECT_NEAR(found.outboard_brake,
                number_at(row, front ? "anti_dive_percent_front_outboard_brake"
                                     : "anti_lift_percent_rear_outboard_brake"),
                1e-9);
    EXPECT_NEAR(found.inboard_drive,
                number_at(row, front ? "anti_lift_percent_front_drive" : "anti_squat_percent_rear_drive"),
                1e-9);
    EXPECT_NEAR(found.inboard_brake, found.inboard_drive * (front ? 0.65 : 0.35), 1e-12);
  }
}

TEST(Axle, TurnsOnCirclesAboutTheLineOfTheRearAxle) {
  // The centre of the turn lies 2.5 / tan(30 deg) - 0.65 m beside the middle of the rear axle.
  const TurningCircle found = turning_circle(pi / 6, 2.5, 1.3, 0.05, 0.8, 1.7);
  EXPECT_NEAR(found.kerb_to_kerb, 10.1, 1e-12);
  EXPECT_NEAR(found.wall_to_wall, 2 * std::sqrt(3.3 * 3.3 + std::pow(2.5 * std::sqrt(3.0) + 0.2, 2)), 1e-12);
  EXPECT_TRUE(std::isnan(turning_circle(pi / 6, 2.5, 1.3, 0.05).wall_to_wall));
}

TEST(Axle, Contract) {
  EXPECT_THAT(test::message([] { turning_circle(0, 2.5, 1.3, 0.05); }),
              ::testing::StartsWith(
                  "turning_circle: wheelbase 2.5 m, distance of the axes 1.3 m, outer angle 0 rad"));
  EXPECT_THAT(test::message([] { anti_features(WheelParameters{}, AxlePlace::front, {}); }),
              ::testing::StartsWith("anti_features: wheelbase 0 m, height of the mass centre 0 m"));
  EXPECT_THAT(test::message([] {
                anti_features(WheelParameters{}, AxlePlace::front, {2.7, 0.5, 1.5});
              }),
              ::testing::StartsWith("anti_features: shares 1.5 and 1"));
  EXPECT_THAT(
      test::message([] { ackermann(0.1, -0.1, 2.7, 1.5); }),
      ::testing::StartsWith("ackermann: outer angle -0.1 rad: angles are changes from straight ahead, > 0"));
}

}  // namespace
}  // namespace linkwright::suspension
