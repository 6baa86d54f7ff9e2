// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/core/looks.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/axle.h"
#include "support/message.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

using test::at;
using test::number_at;
using test::numbers;

AxleParameters parameters(const AxlePlan& plan, const AxlePosition& position) {
  EXPECT_EQ(position.status, Status::done) << position.reason;
  return axle_parameters(plan, position);
}

TEST(AxleSweep, ParallelTravelIsThatOfOneWheelTwice) {
  for (const CornerSample& sample : corner_samples().first(12)) {
    SCOPED_TRACE(sample.name);
    const AxlePlan plan = prepare_axle(mirrored(sample.suspension));  // from either wheel
    const std::array values{-0.06, 0.0, 0.06};
    for (const AxleRow& row :
         sweep_axle(plan, AxleMotion::parallel, values, {.driver = Driver::wheel_centre_z})) {
      ASSERT_EQ(row.position.status, Status::done);
      const WheelParameters one = wheel_parameters(
          plan.left,
          solve_position(plan.left, Driver::wheel_centre_z, {row.value, 0}, reference_position(plan.left)));
      const AxleParameters& both = row.parameters;
      EXPECT_NEAR(both.left.angles.toe, one.angles.toe, 1e-12);
      EXPECT_NEAR(both.right.angles.toe, one.angles.toe, 1e-12);
      EXPECT_NEAR(both.steer, 0, 1e-12);
      EXPECT_NEAR(both.road_angle, 0, 1e-13);
      EXPECT_NEAR(both.road_camber_right, one.angles.camber, 1e-12);
      EXPECT_NEAR(both.track, 2 * one.contact.y, 1e-12);
      EXPECT_NEAR(both.track_change, 2 * one.half_track_change, 1e-12);
      EXPECT_NEAR(both.roll_centre_height, one.roll_centre_height, 1e-9);
      EXPECT_NEAR(both.roll_centre_offset, 0, 1e-9);
    }
  }
}

TEST(AxleSweep, RollCentreOfUnequalTravel) {
  for (const CornerSample& sample : corner_samples().first(12)) {
    const AxlePlan plan = prepare_axle(sample.suspension);
    const AxlePosition leaned =
        solve_axle(plan, {Driver::wheel_centre_z, 0.04, -0.04, 0}, reference_position(plan));
    const AxleParameters found = parameters(plan, leaned);
    const auto expected = numbers(
        at(published("mechanism-" + sample.name), "computed.roll_centre_left_plus40_right_minus40_mm_yz_m"));
    ASSERT_TRUE(found.roll_centre);
    EXPECT_NEAR((*found.roll_centre)[0], expected[0], 1e-9);
    EXPECT_NEAR((*found.roll_centre)[1], expected[1], 1e-9);
    // Against the road by turning the picture until the road is level.
    const Vec3 &p = found.left.contact, &q = found.right.contact;
    const Mat3 level = math::turn_x(-found.road_angle);
    const Vec3 centre = level * Vec3{0, (*found.roll_centre)[0], (*found.roll_centre)[1]};
    const Vec3 middle = level * (0.5 * (p + q));
    EXPECT_NEAR((level * p).z, (level * q).z, 1e-14);
    EXPECT_NEAR(found.roll_centre_height, centre.z - middle.z, 1e-12);
    EXPECT_NEAR(found.roll_centre_offset, centre.y - middle.y, 1e-12);
  }
}

// Roll stands both wheels on a plane road; its rates against differences, and at rest against the gains of a
// wheel.
TEST(AxleSweep, Roll) {
  for (const char* name : {"2RS-US", "SR-3US", "R", "5US"}) {
    SCOPED_TRACE(name);
    const Suspension& suspension = corner_sample(name).suspension;
    const AxlePlan plan = prepare_axle(suspension);
    const AxlePosition start = reference_position(plan);
    for (double roll : {-0.05, 0.0, 0.03}) {
      const AxlePosition here = solve_roll(plan, roll, 0.01, 0, start);
      const AxleParameters found = parameters(plan, here);
      EXPECT_NEAR(found.road_angle, roll, 1e-14);
      EXPECT_NEAR(here.left.input.value + here.right.input.value, 0.02, 1e-15);
      EXPECT_NEAR(found.left.contact.z - plan.left.contact.z, here.left.input.value, 1e-13);
      const double step = 1e-5;
      const AxleParameters more = parameters(plan, solve_roll(plan, roll + step, 0.01, 0, here));
      const AxleParameters less = parameters(plan, solve_roll(plan, roll - step, 0.01, 0, here));
      // Truncation step^2 times some 10, rounding 1e-14 / step.
      EXPECT_NEAR(found.roll_steer, (more.steer - less.steer) / (2 * step), 1e-8);
      EXPECT_NEAR(found.roll_toe_left, (more.left.angles.toe - less.left.angles.toe) / (2 * step), 1e-8);
      EXPECT_NEAR(found.roll_toe_right, (more.right.angles.toe - less.right.angles.toe) / (2 * step), 1e-8);
      EXPECT_NEAR(found.roll_camber_left, (more.road_camber_left - less.road_camber_left) / (2 * step), 1e-8);
      EXPECT_NEAR(found.roll_camber_right, (more.road_camber_right - less.road_camber_right) / (2 * step),
                  1e-8);
    }
    const AxleParameters rest = parameters(plan, start);
    const RollGains gains = roll_gains(rest.left);
    EXPECT_NEAR(rest.roll_toe_left, gains.toe, 1e-12);
    EXPECT_NEAR(rest.roll_toe_right, -gains.toe, 1e-12);
    EXPECT_NEAR(rest.roll_steer, -gains.toe, 1e-12);
    // The gains take camber as it is, not through the inclined normal: toe squared.
    EXPECT_NEAR(rest.roll_camber_left, gains.camber, 1e-5);
    EXPECT_NEAR(rest.roll_camber_right, -gains.camber, 1e-5);
  }
}

// A wheel that stands fixed to the body leans with it.
TEST(AxleSweep, CamberAgainstTheRoad) {
  const AxlePlan plan = prepare_axle(corner_sample("2RS-US").suspension);
  const AxlePosition here = solve_roll(plan, 0.04, 0, 0, reference_position(plan));
  const AxleParameters found = parameters(plan, here);
  // Toe is small, so that camber and roll add.
  EXPECT_NEAR(found.road_camber_left, found.left.angles.camber + 0.04, 1e-5);
  EXPECT_NEAR(found.road_camber_right, found.right.angles.camber - 0.04, 1e-5);
}

TEST(AxleSweep, LeaningToTheOtherSideIsTheMirrorImage) {
  const AxlePlan plan = prepare_axle(corner_sample("RS-SP-US").suspension);
  const AxlePosition start = reference_position(plan);
  const AxleParameters one = parameters(plan, solve_roll(plan, 0.03, 0.01, 0.02, start));
  const AxleParameters other = parameters(plan, solve_roll(plan, -0.03, 0.01, -0.02, start));
  EXPECT_NEAR(one.left.angles.toe, other.right.angles.toe, 1e-12);
  EXPECT_NEAR(one.left.angles.camber, other.right.angles.camber, 1e-12);
  EXPECT_NEAR(one.steer, -other.steer, 1e-12);
  EXPECT_NEAR(one.roll_steer, other.roll_steer, 1e-11);
  EXPECT_NEAR(one.roll_centre_height, other.roll_centre_height, 1e-11);
  EXPECT_NEAR(one.roll_centre_offset, -other.roll_centre_offset, 1e-11);
  ASSERT_TRUE(one.steering_left && other.steering_right);
  EXPECT_NEAR(one.steering_left->brake_arm, other.steering_right->brake_arm, 1e-12);
  EXPECT_NEAR(one.steering_left->steer_by_rack, other.steering_right->steer_by_rack, 1e-11);
}

TEST(AxleSweep, AckermannOverTheRack) {
  for (const char* name : {"2RS-US", "RS-SP-US", "RS-3US", "SP-3US", "5US"}) {
    SCOPED_TRACE(name);
    const AxlePlan plan = prepare_axle(corner_sample(name).suspension);
    const Value& reference = at(published(std::string("mechanism-") + name), "computed.ackermann");
    const AxleParameters straight = parameters(plan, reference_position(plan));
    const double track = straight.left.axis_at_spring->ground.y - straight.right.axis_at_spring->ground.y;
    const double wheelbase = number_at(reference, "wheelbase_m");
    EXPECT_FALSE(axle_ackermann(straight, straight, wheelbase, track));
    for (const Value& row : at(reference, "rows").as_array()) {
      const double rack = number_at(row, "rack_m");
      const std::array values{rack, -rack};
      const auto rows = sweep_axle(plan, AxleMotion::rack, values, {.driver = Driver::wheel_centre_z});
      for (const AxleRow& turned : rows) {
        const auto found = axle_ackermann(straight, turned.parameters, wheelbase, track);
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->inner, number_at(row, "inner_rad"), 1e-11);
        EXPECT_NEAR(found->outer, number_at(row, "outer_rad"), 1e-11);
        EXPECT_NEAR(found->ideal_inner, number_at(row, "ideal_inner_rad"), 1e-10);
        EXPECT_NEAR(found->percent, number_at(row, "ackermann_percent"), 1e-7);
        EXPECT_NEAR(found->error, found->inner - found->ideal_inner, 1e-16);
        // The mean steer angle has the sign of the turn.
        EXPECT_GT(turned.parameters.steer * turned.value * straight.steering_left->steer_by_rack, 0);
      }
    }
  }
}

TEST(AxleSweep, ALimitOfOneWheelIsToldAndTheRestGoesOn) {
  const AxlePlan plan = prepare_axle(corner_sample("2RS-US").suspension);
  const std::array values{0.0, 0.6, 0.05};
  const auto rows = sweep_axle(plan, AxleMotion::parallel, values, {.driver = Driver::wheel_centre_z});
  EXPECT_EQ(rows[1].position.status, Status::no_assembly);
  EXPECT_THAT(rows[1].position.reason,
              ::testing::StartsWith("left wheel: the height of the wheel centre cannot pass"));
  EXPECT_TRUE(std::isnan(rows[1].parameters.roll_steer));
  EXPECT_EQ(rows[2].position.status, Status::done);
  EXPECT_NEAR(rows[2].position.left.place.carrier.centre.z - plan.left.wheel.centre.z, 0.05, 1e-14);
}

TEST(AxleSweep, InterruptedGivesTheRowsSoFar) {
  const AxlePlan plan = prepare_axle(corner_sample("2RS-US").suspension);
  std::vector<double> rolls;
  for (int i = 0; i < 10000; ++i) rolls.push_back(1e-6 * i);
  const RunContext context;
  const LooksAllowed looks(2);  // one at every 64th row
  const auto rows = sweep_axle(plan, AxleMotion::roll, rolls, {}, &context);
  ASSERT_EQ(rows.size(), 128U);
  EXPECT_EQ(rows.back().position.status, Status::done);
  EXPECT_EQ(looks.made(), 3);
}

TEST(AxleSweep, Contract) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  EXPECT_THAT(test::message([&] { prepare_axle(suspension, suspension); }),
              ::testing::StartsWith("prepare_axle: the first wheel is left, the second left"));
  EXPECT_THAT(test::message([&] {
                const AxlePlan plan = prepare_axle(suspension);
                solve_roll(plan, 1.2, 0, 0, reference_position(plan));
              }),
              ::testing::StartsWith("solve_roll: roll 1.2 rad"));
}

TEST(AxleSweep, AGridHasTheSinglePositionsWhateverItsSpacing) {
  const AxlePlan plan = prepare_axle(corner_sample("2RS-US").suspension);
  const std::vector heaves{-0.04, 0.01, 0.05}, rolls{-0.05, 0.02}, racks{-0.03, 0.0, 0.04};
  const AxleGrid grid = solve_axle_grid(plan, heaves, rolls, racks);
  ASSERT_EQ(grid.rows.size(), 18U);
  std::size_t i = 0;
  for (const double rack : racks)
    for (const double heave : heaves)
      for (const double roll : rolls) {
        EXPECT_EQ(grid.rack[i], rack);
        EXPECT_EQ(grid.heave[i], heave);
        EXPECT_EQ(grid.roll[i], roll);
        const AxleParameters alone =
            parameters(plan, solve_roll(plan, roll, heave, rack, reference_position(plan)));
        const AxleParameters& found = grid.rows[i++].parameters;
        EXPECT_NEAR(found.road_angle, roll, 1e-12);
        EXPECT_NEAR(found.steer_left, alone.steer_left, 1e-11);
        EXPECT_NEAR(found.steer_right, alone.steer_right, 1e-11);
        EXPECT_NEAR(found.roll_steer, alone.roll_steer, 1e-9);
        EXPECT_NEAR(found.roll_centre_height, alone.roll_centre_height, 1e-8);
      }
}

TEST(AxleSweep, SingleTravelLeavesTheOtherWheelAlone) {
  const AxlePlan plan = prepare_axle(corner_sample("2RS-US").suspension);
  const std::array values{-0.05, 0.05};
  const AxlePosition still = reference_position(plan);
  for (const AxleRow& row : sweep_axle(plan, AxleMotion::single, values)) {
    ASSERT_EQ(row.position.status, Status::done);
    EXPECT_NEAR(row.parameters.left.contact.z - parameters(plan, still).left.contact.z, row.value, 1e-12);
    EXPECT_NEAR(row.parameters.right.angles.toe, parameters(plan, still).right.angles.toe, 1e-13);
  }
}

}  // namespace
}  // namespace linkwright::suspension
