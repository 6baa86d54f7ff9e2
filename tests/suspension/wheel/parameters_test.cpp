// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "linkwright/math/angles.h"
#include "linkwright/suspension/corner/suspension.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

using test::at;
using test::number_at;

// The acceptance of the reference is 1e-9 m and rad, and 1e-7 relative for rates; both sides are exact
// formulas, so what is left is rounding times the condition of the equations.
constexpr double close_value = 1e-11;
void expect_rate(double found, const Value& row, const char* key) {
  const double expected = number_at(row, key);
  EXPECT_NEAR(found, expected, 1e-9 * std::max(1.0, std::abs(expected))) << key;
}

void expect_axis(const std::optional<SteeringAxis>& axis, const Value& row) {
  ASSERT_TRUE(axis);
  EXPECT_NEAR(axis->caster, number_at(row, "caster_rad"), close_value);
  EXPECT_NEAR(axis->inclination, number_at(row, "inclination_rad"), close_value);
  EXPECT_NEAR(axis->trail, number_at(row, "trail_m"), close_value);
  EXPECT_NEAR(axis->scrub, number_at(row, "scrub_m"), close_value);
  EXPECT_NEAR(axis->wheel_trail, number_at(row, "trail_wheel_frame_m"), close_value);
  EXPECT_NEAR(axis->wheel_scrub, number_at(row, "scrub_wheel_frame_m"), close_value);
  EXPECT_NEAR(axis->caster_offset, number_at(row, "caster_offset_wheel_centre_m"), close_value);
  EXPECT_NEAR(axis->kingpin_offset, number_at(row, "kingpin_offset_wheel_centre_m"), close_value);
  EXPECT_NEAR(axis->pitch, number_at(row, "screw_pitch_m_per_rad"), close_value);
}

void expect_row(const CornerPlan& plan, const Value& row) {
  const CornerPosition position = solve(plan, number_at(row, "travel_m"), number_at(row, "rack_m"));
  ASSERT_EQ(position.status, Status::done) << position.reason;
  const WheelParameters found = wheel_parameters(plan, position);
  ASSERT_EQ(found.status, Status::done);
  EXPECT_LT(distance(position.place.carrier.centre, point(at(row, "wheel_centre_m"))), close_value);
  EXPECT_NEAR(found.angles.toe, number_at(row, "toe_rad"), close_value);
  EXPECT_NEAR(found.angles.camber, number_at(row, "camber_rad"), close_value);
  EXPECT_NEAR(found.angles.carrier_pitch, number_at(row, "carrier_spin_rad"), close_value);
  EXPECT_LT(distance(found.contact, point(at(row, "contact_m"))), close_value);
  expect_rate(found.toe_by_travel, row, "dtoe_dz_rad_per_m");
  expect_rate(found.camber_by_travel, row, "dcamber_dz_rad_per_m");
  expect_rate(found.roll_centre_height, row, "roll_centre_height_m");
  expect_rate(found.roll_centre_height_geometric, row, "roll_centre_height_geometric_contact_m");
  expect_rate(found.anti_pitch_tangent, row, "tan_support_carrier_fixed");
  expect_rate(found.anti_pitch_tangent_free, row, "tan_support_wheel_free");
  EXPECT_EQ(row.find("motion_ratio") != nullptr, plan.spring.has_value());
  if (plan.spring) {
    expect_rate(found.motion_ratio, row, "motion_ratio");
    EXPECT_NEAR(found.spring_length, number_at(row, "spring_length_m"), close_value);
  }
  const Value* axis = row.find("kingpin_lock_wheel_centre_z");
  EXPECT_EQ(found.axis_at_height.has_value(), axis != nullptr);
  if (!axis) return;
  expect_rate(found.toe_by_rack, row, "dtoe_drack_rad_per_m");
  expect_axis(found.axis_at_height, *axis);
  if (const Value* at_spring = row.find("kingpin_lock_spring")) expect_axis(found.axis_at_spring, *at_spring);
}

TEST(WheelParameters, CurvesOfAllMechanisms) {
  for (const CornerSample& sample : corner_samples().first(12)) {
    SCOPED_TRACE(sample.name);
    const CornerPlan plan = prepare_suspension(sample.suspension);
    const Value& computed = at(published("mechanism-" + sample.name), "computed");
    for (const char* curve : {"wheel_travel", "rack_travel", "combined"})
      if (const Value* rows = computed.find(curve))
        for (const Value& row : rows->as_array()) expect_row(plan, row);
  }
}

TEST(WheelParameters, ExamplesOfTheSource) {
  for (const char* id : {"derived-ex1", "derived-ex2"}) {
    SCOPED_TRACE(id);
    const CornerPlan plan = prepare_suspension(corner_from(at(published(id), "inputs.mechanism")));
    for (const Value& row : at(published(id), "computed.points").as_array()) expect_row(plan, row);
  }
}

// Tables of the source, five decimals in degrees; half a unit of the last place and what rounding of points
// leaves.
TEST(WheelParameters, PublishedTables) {
  for (const auto& [id, angles] : {std::pair{"ex1-forward", 1e-12},
                                   {"ex2-forward", 1e-10},
                                   {"ex3-forward", 1e-10},
                                   {"ex4-forward", 1e-10}}) {
    SCOPED_TRACE(id);
    const CornerPlan plan = prepare_suspension(corner_from(at(published(id), "inputs.mechanism")));
    const auto& rows = at(published(id), "published.rows").as_array();
    const auto& positions = at(published(id), "computed.positions").as_array();
    ASSERT_EQ(rows.size(), positions.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Value& row = positions[i];
      const CornerPosition position = solve(plan, number_at(row, "travel_m"), number_at(row, "rack_m"));
      const WheelParameters found = wheel_parameters(plan, position);
      EXPECT_NEAR(found.angles.toe, number_at(row, "toe_rad"), angles);
      EXPECT_NEAR(found.angles.camber, number_at(row, "camber_rad"), angles);
      EXPECT_NEAR(found.angles.carrier_pitch, number_at(row, "carrier_spin_rad"), angles);
      const auto table = test::numbers(rows[i]);
      const auto& columns = at(published(id), "published.columns").as_array();
      const std::map<std::string, double> ours{{"x_m", position.place.carrier.centre.x},
                                               {"y_m", position.place.carrier.centre.y},
                                               {"z_m", position.place.carrier.centre.z},
                                               {"toe_deg", math::degrees(found.angles.toe)},
                                               {"camber_deg", math::degrees(found.angles.camber)},
                                               {"spin_deg", math::degrees(found.angles.carrier_pitch)}};
      for (std::size_t k = 3; k < columns.size(); ++k)  // after index, travel and rack
        EXPECT_NEAR(ours.at(columns[k].as_string()), table[k], 5.6e-6) << columns[k].as_string() << " " << i;
      EXPECT_GE(columns.size(), 7u);
    }
  }
}

// Example 5 at its optimum: three lengths are prescribed and the points given are no position.
TEST(WheelParameters, PositionsWithPrescribedLengths) {
  const Value& in = at(published("ex5-targets"), "inputs");
  const Value& computed = at(published("ex5-minmax-optimum"), "computed");
  const Vec3 axis = point(at(in, "wheel_axis"));
  Suspension suspension{.wheel = {point(at(in, "wheel_centre_m")), std::atan2(axis.x, axis.y),
                                  -std::asin(axis.z), number_at(in, "tyre_diameter_m")}};
  const auto lengths = test::numbers(at(in, "lengths_1_to_5_m"));
  const auto& carrier = at(in, "carrier_points_11_to_15_m").as_array();
  for (int i = 0; i < 5; ++i) {
    const Value& body = i < 2 ? at(in, "body_points_01_02_m").as_array()[i]
                              : at(computed, "points_03_04_05_m").as_array()[i - 2];
    suspension.links.push_back({.type = LinkType::US,
                                .body = {point(body)},
                                .carrier = {point(carrier[i])},
                                .length = lengths[i],
                                .moved_by_rack = i == 2});
  }
  const CornerPlan plan = prepare_suspension(suspension);
  const auto travels = test::numbers(at(in, "dz_m")), racks = test::numbers(at(in, "rack_m"));
  for (std::size_t i = 0; i < travels.size(); ++i) {
    const Value& row = at(computed, "positions").as_array()[i];
    const CornerPosition position = solve(plan, travels[i], racks[i]);
    ASSERT_EQ(position.status, Status::done) << position.reason;
    const WheelParameters found = wheel_parameters(plan, position);
    // The body points are given to 1e-12 m.
    EXPECT_LT(distance(position.place.carrier.centre, point(at(row, "wheel_centre_m"))), 1e-10);
    EXPECT_NEAR(found.angles.toe, number_at(row, "toe_rad"), 1e-10);
    EXPECT_NEAR(found.angles.camber, number_at(row, "camber_rad"), 1e-10);
  }
}

TEST(WheelParameters, BothContactVelocities) {
  const Value& reference = published("contact-velocity-definitions");
  const Value& computed = at(reference, "computed");
  const CornerPlan plan = prepare_suspension(corner_sample("front_5US").suspension);
  const CornerPosition position =
      solve(plan, number_at(reference, "inputs.travel_m"), number_at(reference, "inputs.rack_m"));
  const WheelParameters found = wheel_parameters(plan, position);
  const auto near = [](const Vec3& a, const Value& b) { EXPECT_LT(distance(a, point(b)), 1e-10); };
  near(found.velocity, at(computed, "v_wheel_centre_m_s"));
  near(found.turning, at(computed, "omega_rad_s"));
  near(found.contact_velocity.on_carrier, at(computed, "v_contact_carrier_fixed_m_s"));
  near(found.contact_velocity.geometric, at(computed, "v_contact_geometric_m_s"));
  const CornerRates rates = solve_rates(plan, position, Driver::wheel_centre_z);
  near(rates.steer.velocity, at(computed, "v_steer_m_s"));
  near(rates.steer.turning, at(computed, "omega_steer_rad_s"));
  near(found.axis_at_height->point, at(computed, "axis_point_m"));
}

TEST(WheelParameters, RatesAreDifferencesOfValues) {
  constexpr double h = 1e-5;
  for (const CornerSample& sample : corner_samples().first(12)) {
    SCOPED_TRACE(sample.name);
    const CornerPlan plan = prepare_suspension(sample.suspension);
    const auto there = [&](double travel) { return wheel_parameters(plan, solve(plan, travel)); };
    const WheelParameters here = there(0.03), more = there(0.03 + h), less = there(0.03 - h);
    // Truncation h^2 times third derivatives of some 100 /m2, rounding 1e-14 / h.
    const auto slope = [&](double up, double down) { return (up - down) / (2 * h); };
    EXPECT_NEAR(here.toe_by_travel, slope(more.angles.toe, less.angles.toe), 2e-8);
    EXPECT_NEAR(here.camber_by_travel, slope(more.angles.camber, less.angles.camber), 2e-8);
    EXPECT_NEAR(here.contact_velocity.geometric.x, slope(more.wheelbase_change, less.wheelbase_change), 2e-8);
    EXPECT_NEAR(here.contact_velocity.geometric.y, slope(more.half_track_change, less.half_track_change),
                2e-8);
    EXPECT_NEAR(here.velocity.x, -slope(more.recession, less.recession), 2e-8);
    EXPECT_NEAR(here.motion_ratio, -slope(more.spring_length, less.spring_length), 2e-8);
  }
}

// The lower arm is at rest with the spring held, so that the wheel turns about the line through both ball
// joints.
TEST(WheelParameters, SteeringAxisPassesThroughBothBallJoints) {
  for (const char* name : {"2RS-US", "RS-SP-US"})
    for (double travel : {-0.06, 0.0, 0.05})
      for (double rack : {-0.04, 0.0, 0.05}) {
        SCOPED_TRACE(name);
        const Suspension& suspension = corner_sample(name).suspension;
        const CornerPlan plan = prepare_suspension(suspension);
        const CornerPosition position = solve(plan, travel, rack);
        const SteeringAxis axis = *wheel_parameters(plan, position).axis_at_spring;
        const Vec3 lower =
            place(position.place.carrier, suspension.links[0].carrier[0], suspension.wheel.centre);
        const Vec3 upper =
            suspension.links[1].type == LinkType::SP
                ? suspension.links[1].body[0]
                : place(position.place.carrier, suspension.links[1].carrier[0], suspension.wheel.centre);
        EXPECT_LT(norm(cross(lower - axis.point, axis.direction)), 1e-12);
        EXPECT_LT(norm(cross(upper - axis.point, axis.direction)), 1e-12);
        EXPECT_LT(std::abs(axis.pitch), 1e-12);
        // Construction of the ground point from the joints.
        const double contact = wheel_parameters(plan, position).contact.z;
        const Vec3 ground = lower + (contact - lower.z) / (upper.z - lower.z) * (upper - lower);
        EXPECT_LT(distance(ground, axis.ground), 1e-12);
      }
}

// The same motion from equations with the spring as driver, and from those with the height: a second exact
// route.
TEST(WheelParameters, SteeringMotionByTwoRoutes) {
  const CornerPlan plan = prepare_suspension(corner_sample("5US").suspension);
  const CornerPosition position = solve(plan, 0.04, 0.03);
  const CornerRates at_height = solve_rates(plan, position, Driver::wheel_centre_z);
  for (Driver lock : {Driver::spring, Driver::contact_z}) {
    const Twist one = solve_rates(plan, position, lock).steer,
                other = steering_twist(plan, position, at_height, lock);
    EXPECT_LT(distance(one.velocity, other.velocity), 1e-13);
    EXPECT_LT(distance(one.turning, other.turning), 1e-13);
  }
}

TEST(WheelParameters, RightWheelHasTheNumbersOfTheLeftAtTheOppositeRack) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  const CornerPlan left = prepare_suspension(suspension), right = prepare_suspension(mirrored(suspension));
  const WheelParameters a = wheel_parameters(left, solve(left, 0.05, -0.03));
  const WheelParameters b = wheel_parameters(right, solve(right, 0.05, 0.03));
  const auto same = [](double x, double y) { EXPECT_NEAR(x, y, 1e-13); };
  same(a.angles.toe, b.angles.toe);
  same(a.angles.camber, b.angles.camber);
  same(a.angles.carrier_pitch, b.angles.carrier_pitch);
  same(a.half_track_change, b.half_track_change);
  same(a.wheelbase_change, b.wheelbase_change);
  same(a.toe_by_travel, b.toe_by_travel);
  same(a.camber_by_travel, b.camber_by_travel);
  same(a.roll_centre_height, b.roll_centre_height);
  same(a.anti_pitch_tangent_free, b.anti_pitch_tangent_free);
  same(a.motion_ratio, b.motion_ratio);
  same(a.toe_by_rack, -b.toe_by_rack);
  same(a.side_swing_arm, b.side_swing_arm);
  EXPECT_LT(distance(math::mirrored(a.contact), b.contact), 1e-13);
  EXPECT_NEAR(a.front_centre[0], -b.front_centre[0], 1e-13);
  for (auto axis : {&WheelParameters::axis_at_height, &WheelParameters::axis_at_spring}) {
    const SteeringAxis &x = *(a.*axis), &y = *(b.*axis);
    same(x.caster, y.caster);
    same(x.inclination, y.inclination);
    same(x.trail, y.trail);
    same(x.scrub, y.scrub);
    same(x.wheel_trail, y.wheel_trail);
    same(x.kingpin_offset, y.kingpin_offset);
    EXPECT_LT(distance(math::mirrored(x.ground), y.ground), 1e-13);
  }
}

// By the equations with the contact point's height as driver: another exact route.
TEST(WheelParameters, SteeringAxisWithTheContactHeld) {
  for (const char* name : {"2RS-US", "5US", "SP-3US"}) {
    const CornerPlan plan = prepare_suspension(corner_sample(name).suspension);
    const CornerPosition position = solve(plan, 0.03, -0.025);
    const WheelParameters found = wheel_parameters(plan, position);
    const SteeringAxis axis = *found.axis_at_contact;
    EXPECT_EQ(axis.lock, Driver::contact_z);
    const Twist twist = solve_rates(plan, position, Driver::contact_z).steer;
    const SteeringAxis wanted = *steering_axis(plan.side, position.place.carrier.centre, found.contact,
                                               found.angles.toe, twist, Driver::contact_z);
    EXPECT_NEAR(axis.caster, wanted.caster, 1e-12) << name;
    EXPECT_NEAR(axis.scrub, wanted.scrub, 1e-12) << name;
    EXPECT_NEAR(axis.pitch, wanted.pitch, 1e-12) << name;
    // The contact point keeps its height, to the second order of the step, when the wheel is steered like
    // that.
    EXPECT_NEAR(
        contact_velocity(plan.side, plan.wheel.tyre_diameter, found.angles, twist.velocity, twist.turning)
            .geometric.z,
        0, 1e-12)
        << name;
  }
}

// Points of a screw move along it by its pitch times the turning.
TEST(WheelParameters, PitchOfTheTravelScrew) {
  for (const CornerSample& sample : corner_samples().first(12)) {
    const CornerPlan plan = prepare_suspension(sample.suspension);
    const CornerPosition position = solve(plan, 0.05);
    const WheelParameters found = wheel_parameters(plan, position);
    const Vec3 w = found.turning;
    const Vec3 point = position.place.carrier.centre + 1 / dot(w, w) * cross(w, found.velocity);
    const Vec3 there = found.velocity + cross(w, point - position.place.carrier.centre);
    EXPECT_LT(distance(there, found.screw_pitch * w), 1e-13) << sample.name;
  }
}

// The trace of the wheel's plane in a transverse plane against the vertical.
TEST(WheelParameters, CamberInTheFrontView) {
  const CornerPlan plan = prepare_suspension(corner_sample("2RS-US").suspension);
  for (double rack : {-0.06, 0.0, 0.06}) {
    const CornerPosition position = solve(plan, -0.05, rack);
    const WheelParameters found = wheel_parameters(plan, position);
    const Vec3 trace = cross(wheel_axis(plan.side, found.angles.toe, found.angles.camber), Vec3{1, 0, 0});
    EXPECT_NEAR(found.front_view_camber, std::atan(trace.y / trace.z), 1e-15);
    EXPECT_NEAR(std::tan(found.front_view_camber), std::tan(found.angles.camber) / std::cos(found.angles.toe),
                1e-15);
  }
}

// A trailing arm with its hinge along y turns about the hinge in the side view: arm and angle by
// construction.
TEST(WheelParameters, SwingArmsOfATrailingArm) {
  Suspension suspension{.wheel = {{0, 0.7, 0}, 0, 0, 0.6}};
  suspension.links.push_back({.type = LinkType::R, .body = {{0.5, 0.3, 0.1}, {0.5, 0.6, 0.1}}});
  const CornerPlan plan = prepare_suspension(suspension);
  const WheelParameters found = wheel_parameters(plan, reference_position(plan));
  EXPECT_NEAR(found.side_centre[0], 0.5, 1e-15);
  EXPECT_NEAR(found.side_centre[1], 0.1, 1e-15);
  EXPECT_NEAR(found.side_swing_arm, std::hypot(0.5, 0.4), 1e-15);
  EXPECT_NEAR(found.side_swing_angle, std::atan2(0.4, 0.5), 1e-15);
  EXPECT_NEAR(found.anti_pitch_tangent, -0.4 / 0.5, 1e-15);
  EXPECT_GT(found.front_swing_arm, 1e12);
  EXPECT_NEAR(found.roll_centre_height, 0, 1e-15);
  // The front view turns if the hinge lies along x.
  suspension.links[0].body = {{-0.2, 0.2, 0.05}, {0.2, 0.2, 0.05}};
  const CornerPlan swing = prepare_suspension(suspension);
  const WheelParameters across = wheel_parameters(swing, reference_position(swing));
  EXPECT_NEAR(across.front_centre[0], 0.2, 1e-15);
  EXPECT_NEAR(across.front_centre[1], 0.05, 1e-15);
  EXPECT_NEAR(across.front_swing_arm, std::hypot(0.5, 0.35), 1e-15);
  EXPECT_NEAR(across.roll_centre_height, 0.7 * 0.35 / 0.5, 1e-15);
  EXPECT_NEAR(across.camber_by_travel, -1 / 0.5, 1e-15);  // top inboard in bump
}

TEST(WheelParameters, WithoutSpringOrRackNumbersAreMissing) {
  Suspension suspension = corner_sample("R").suspension;
  suspension.spring.reset();
  const CornerPlan plan = prepare_suspension(suspension);
  const WheelParameters found = wheel_parameters(plan, solve(plan, 0.02));
  EXPECT_TRUE(std::isnan(found.motion_ratio));
  EXPECT_TRUE(std::isnan(found.spring_length));
  EXPECT_TRUE(std::isnan(found.toe_by_rack));
  EXPECT_FALSE(found.axis_at_height);
  EXPECT_FALSE(found.axis_at_spring);
}

TEST(WheelParameters, ArmsOfAWheelThatOnlyShiftsAreInfinite) {
  // Parallel links of equal length: the carrier does not turn.
  Suspension suspension{.wheel = {{0, 0.7, 0}, 0, 0, 0.6}};
  for (const Vec3& at :
       {Vec3{0.1, 0.6, -0.1}, Vec3{-0.1, 0.6, -0.1}, Vec3{0.1, 0.6, 0.2}, Vec3{-0.1, 0.6, 0.2}})
    suspension.links.push_back({.type = LinkType::US, .body = {at - Vec3{0, 0.3, 0.01}}, .carrier = {at}});
  suspension.links.push_back({.type = LinkType::US, .body = {{-0.5, 0.6, 0}}, .carrier = {{-0.1, 0.6, 0}}});
  const CornerPlan plan = prepare_suspension(suspension);
  const WheelParameters found = wheel_parameters(plan, reference_position(plan));
  ASSERT_EQ(found.status, Status::done);
  EXPECT_GT(found.front_swing_arm, 1e12);
  EXPECT_GT(found.side_swing_arm, 1e12);
  EXPECT_NEAR(found.camber_by_travel, 0, 1e-14);
}

}  // namespace
}  // namespace linkwright::suspension
