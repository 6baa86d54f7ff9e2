// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/parameters.h"
#include "tests/suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

using ::testing::HasSubstr;

WheelParameters at(const Suspension& suspension, double travel = 0, double rack = 0) {
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition position =
      solve_position(plan, Driver::wheel_centre_z, {travel, rack}, reference_position(plan));
  EXPECT_EQ(position.status, Status::done) << position.reason;
  return wheel_parameters(plan, position);
}

/// The lower wishbone as two rods that share the ball joint, or the body point of the trailing blade.
Suspension with_rods(const Suspension& suspension, int link) {
  Suspension out = suspension;
  const CornerLink arm = suspension.links[link];
  out.links.erase(out.links.begin() + link);
  for (int k : {0, 1}) {
    CornerLink rod{.name = "rod " + std::to_string(k), .type = LinkType::US};
    rod.body = {arm.type == LinkType::RS ? arm.body[k] : arm.body[0]};
    rod.carrier = {arm.type == LinkType::RS ? arm.carrier[0] : arm.carrier[k]};
    out.links.push_back(rod);
  }
  if (out.spring && out.spring->link >= 0) out.spring->link = -1;
  return out;
}

TEST(Constructions, KnowWhichOfTheTwelveMechanismsHaveThem) {
  const std::map<std::string, std::pair<bool, bool>> wanted{
      {"R", {false, true}},       {"RR-US", {false, false}},  {"S-2US", {false, false}},
      {"2RS-US", {true, true}},   {"RS-SR-US", {true, true}}, {"RS-SP-US", {true, true}},
      {"2SR-US", {true, true}},   {"SR-SP-US", {true, true}}, {"RS-3US", {false, false}},
      {"SR-3US", {false, false}}, {"SP-3US", {false, false}}, {"5US", {false, false}}};
  for (const auto& [name, has] : wanted) {
    const Suspension& suspension = corner_sample(name).suspension;
    const CornerConstruction found = construction_of(suspension);
    EXPECT_EQ(found.has_axis(), has.first) << name;
    EXPECT_EQ(found.has_planes(), has.second) << name;
    EXPECT_EQ(why_no_axis(suspension).empty(), has.first) << name;
    EXPECT_EQ(why_no_planes(suspension).empty(), has.second) << name;
    const WheelParameters wheel = at(suspension);
    EXPECT_EQ(wheel.geometric_axis.has_value(), has.first) << name;
    EXPECT_EQ(std::isfinite(wheel.arms.roll_centre_height), has.second) << name;
  }
  EXPECT_THAT(why_no_axis(corner_sample("RS-3US").suspension),
              HasSubstr("one ball joint holds the carrier ("));
  EXPECT_THAT(why_no_axis(corner_sample("5US").suspension), HasSubstr("no ball joint holds the carrier"));
  EXPECT_THAT(why_no_planes(corner_sample("5US").suspension), HasSubstr("no link is an arm with a plane"));
}

// Numbers by intersection of projected lines, made outside of this program.
TEST(Constructions, OfADoubleWishboneAreThoseOfTheDrawingBoard) {
  const WheelParameters wheel = at(corner_sample("2RS-US").suspension);
  ASSERT_TRUE(wheel.geometric_axis);
  const SteeringAxis& axis = *wheel.geometric_axis;
  constexpr double rounding = 1e-13;
  EXPECT_NEAR(axis.caster, 0.0867383386759851, rounding);
  EXPECT_NEAR(axis.inclination, 0.143925449388216, rounding);
  EXPECT_NEAR(axis.trail, 0.0245158057839262, rounding);
  EXPECT_NEAR(axis.scrub, 0.0202580211090944, rounding);
  EXPECT_NEAR(axis.wheel_trail, 0.0245511253431068, rounding);
  EXPECT_NEAR(axis.wheel_scrub, 0.0202152021231241, rounding);
  EXPECT_NEAR(axis.caster_offset, -0.00319292001861518, rounding);
  EXPECT_NEAR(axis.kingpin_offset, 0.0638462496473979, rounding);
  EXPECT_TRUE(std::isnan(axis.pitch));
  EXPECT_NEAR(wheel.arms.front[0], -0.370007316861838, 1e-12);
  EXPECT_NEAR(wheel.arms.front[1], -0.0514172769934974, 1e-12);
  EXPECT_NEAR(wheel.arms.side[0], -4.33392350533862, 1e-11);
  EXPECT_NEAR(wheel.arms.side[1], -0.0091947321456043, 1e-11);
  EXPECT_NEAR(wheel.arms.roll_centre_height, 0.180847126051839, 1e-12);
  EXPECT_NEAR(wheel.arms.front_swing_arm, 1.16420167065663, 1e-12);
  EXPECT_NEAR(wheel.arms.side_swing_arm, 4.34505782886885, 1e-11);
  EXPECT_NEAR(wheel.arms.side_swing_angle, 0.0715890842506078, 1e-12);
  EXPECT_NEAR(wheel.front_view_camber, -0.00872665955075606, 1e-15);
}

// The axis with the spring held passes through both ball joints, too: another route, by the steering motion.
TEST(Constructions, GeometricAxisIsTheOneWithTheSpringHeld) {
  for (const char* name : {"2RS-US", "RS-SP-US"})
    for (double travel : {-0.06, 0.0, 0.05})
      for (double rack : {-0.04, 0.0, 0.05}) {
        const WheelParameters wheel = at(corner_sample(name).suspension, travel, rack);
        const SteeringAxis &one = *wheel.geometric_axis, &other = *wheel.axis_at_spring;
        EXPECT_NEAR(one.caster, other.caster, 1e-12);
        EXPECT_NEAR(one.inclination, other.inclination, 1e-12);
        EXPECT_NEAR(one.trail, other.trail, 1e-12);
        EXPECT_NEAR(one.scrub, other.scrub, 1e-12);
        EXPECT_NEAR(one.wheel_trail, other.wheel_trail, 1e-12);
        EXPECT_NEAR(one.wheel_scrub, other.wheel_scrub, 1e-12);
        EXPECT_NEAR(one.caster_offset, other.caster_offset, 1e-12);
        EXPECT_NEAR(one.kingpin_offset, other.kingpin_offset, 1e-12);
        EXPECT_LT(distance(one.point, other.point), 1e-12);
        EXPECT_LT(distance(one.direction, other.direction), 1e-12);
      }
}

// The lower ball joint yields with a height held.
TEST(Constructions, GeometricAxisIsNotTheOneWithAHeightHeld) {
  const WheelParameters wheel = at(corner_sample("2RS-US").suspension);
  EXPECT_GT(std::abs(wheel.axis_at_contact->caster - wheel.geometric_axis->caster), 1e-3);
  EXPECT_GT(std::abs(wheel.axis_at_height->caster - wheel.geometric_axis->caster), 1e-3);
}

// Two rods that share an end are the arm, with the same axis and the same planes.
TEST(Constructions, RodsThatShareAnEndAreAnArm) {
  for (const auto& [name, link] : {std::pair{"2RS-US", 0}, {"2RS-US", 1}, {"RS-SR-US", 1}, {"2SR-US", 0}}) {
    const Suspension& suspension = corner_sample(name).suspension;
    const Suspension rods = with_rods(suspension, link);
    const bool blade = suspension.links[link].type == LinkType::SR;
    const WheelParameters one = at(suspension, 0.04), other = at(rods, 0.04);
    // A blade as two rods from one body point keeps its plane, but the carrier turns about no ball joint
    // there that a second look at the rods would show.
    EXPECT_EQ(other.geometric_axis.has_value(), !blade) << name;
    if (!blade) {
      EXPECT_NEAR(one.geometric_axis->caster, other.geometric_axis->caster, 1e-12);
    }
    EXPECT_NEAR(one.arms.roll_centre_height, other.arms.roll_centre_height, 1e-11) << name;
    EXPECT_NEAR(one.arms.side_swing_angle, other.arms.side_swing_angle, 1e-11) << name;
  }
  // A third rod at the ball joint holds a point, but lies in no plane with the others.
  Suspension rods = with_rods(corner_sample("2RS-US").suspension, 0);
  CornerLink third = rods.links.back();
  third.name = "third";
  third.body[0].z += 0.1;
  rods.links.push_back(third);
  EXPECT_EQ(construction_of(rods).balls.size(), 2u);
  EXPECT_EQ(construction_of(rods).arms.size(), 1u);
  EXPECT_THAT(why_no_planes(rods), HasSubstr("one arm has a plane (upper wishbone)"));
  // The tie rod is none of them.
  rods.links.pop_back();
  rods.links.back().moved_by_rack = true;
  EXPECT_FALSE(construction_of(rods).has_axis());
}

// The tie rod's line meets the axis in which the planes meet: the wheel turns about that axis as it travels:
// the construction and the motion agree, and there is neither bump steer nor pitch.
TEST(Constructions, AgreeWithTheMotionWhereTheTieRodAgrees) {
  for (const char* name : {"2RS-US", "RS-SP-US"}) {
    Suspension suspension = corner_sample(name).suspension;
    suspension.wheel.toe = 0;  // the contact point then lies in the transverse plane of the wheel centre
    const WheelParameters before = at(suspension);
    EXPECT_GT(std::abs(before.arms.roll_centre_height - before.roll_centre_height), 1e-4) << name;
    // Any point of the axis, through front and side centre.
    const Vec3 c = suspension.wheel.centre, front{c.x, before.arms.front[0], before.arms.front[1]},
               side{before.arms.side[0], c.y, before.arms.side[1]};
    CornerLink& rod = suspension.links[2];
    ASSERT_TRUE(rod.moved_by_rack);
    const double share = (rod.carrier[0].x - front.x) / (side.x - front.x);
    const Vec3 on_axis = front + share * (side - front);
    const double length = norm(rod.carrier[0] - rod.body[0]);
    rod.body[0] = rod.carrier[0] + length * math::unit(on_axis - rod.carrier[0]);
    const WheelParameters wheel = at(suspension);
    EXPECT_NEAR(wheel.front_centre[0], wheel.arms.front[0], 1e-9) << name;
    EXPECT_NEAR(wheel.front_centre[1], wheel.arms.front[1], 1e-9) << name;
    EXPECT_NEAR(wheel.side_centre[0], wheel.arms.side[0], 1e-8 * std::abs(wheel.arms.side[0])) << name;
    EXPECT_NEAR(wheel.side_centre[1], wheel.arms.side[1], 1e-8) << name;
    EXPECT_NEAR(wheel.roll_centre_height, wheel.arms.roll_centre_height, 1e-10) << name;
    EXPECT_NEAR(wheel.front_swing_arm, wheel.arms.front_swing_arm, 1e-9) << name;
    EXPECT_NEAR(wheel.side_swing_angle, wheel.arms.side_swing_angle, 1e-9) << name;
    EXPECT_NEAR(wheel.screw_pitch, 0, 1e-10) << name;
  }
}

TEST(Constructions, OfAHingeAreItsMotion) {
  const Suspension& suspension = corner_sample("R").suspension;
  const WheelParameters wheel = at(suspension, 0.05);
  EXPECT_NEAR(wheel.front_centre[0], wheel.arms.front[0], 1e-10);
  EXPECT_NEAR(wheel.front_centre[1], wheel.arms.front[1], 1e-10);
  EXPECT_NEAR(wheel.side_centre[0], wheel.arms.side[0], 1e-10);
  EXPECT_NEAR(wheel.side_centre[1], wheel.arms.side[1], 1e-10);
  // The motion takes the velocity at the contact point, the drawing the transverse plane of the wheel centre:
  // with toe and camber they are a little apart.
  EXPECT_NEAR(wheel.roll_centre_height, wheel.arms.roll_centre_height, 1e-5);
  Suspension straight = suspension;
  straight.wheel.toe = 0;
  EXPECT_NEAR(at(straight).roll_centre_height, at(straight).arms.roll_centre_height, 1e-13);
  EXPECT_NEAR(wheel.side_swing_angle, wheel.arms.side_swing_angle, 1e-12);
  EXPECT_NEAR(wheel.screw_pitch, 0, 1e-13);
}

// Hinges along x, arms level: the centre lies at infinity, the roll centre on the ground; arms that slope
// alike lift it along their slope.
TEST(Constructions, ParallelArmsHaveARollCentre) {
  Suspension suspension{.wheel = {{0, 0.75, 0}, 0, 0, 0.6}};
  const auto build = [&](double slope) {
    suspension.links.clear();
    for (double z : {-0.1, 0.2})
      suspension.links.push_back({.type = LinkType::RS,
                                  .body = {{-0.2, 0.35, z}, {0.2, 0.35, z}},
                                  .carrier = {{0, 0.7, z + 0.35 * slope}}});
    suspension.links.push_back(
        {.type = LinkType::US, .body = {{-0.15, 0.35, 0}}, .carrier = {{-0.15, 0.7, 0.35 * slope}}});
    return at(suspension);
  };
  const WheelParameters level = build(0);
  EXPECT_EQ(level.arms.roll_centre_height, 0);
  EXPECT_GT(level.arms.front_swing_arm, 1e12);
  EXPECT_EQ(level.arms.side_swing_angle, 0);
  const WheelParameters sloping = build(-0.1);
  EXPECT_NEAR(sloping.arms.roll_centre_height, 0.075, 1e-15);
  EXPECT_NEAR(sloping.roll_centre_height, 0.075, 1e-12);
}

TEST(Constructions, RightWheelsAreTheMirrorImage) {
  for (const char* name : {"2RS-US", "RS-SP-US", "SR-SP-US", "R"}) {
    const Suspension& suspension = corner_sample(name).suspension;
    const double rack = name == std::string("2RS-US") ? 0.03 : 0;
    const WheelParameters a = at(suspension, 0.04, rack), b = at(mirrored(suspension), 0.04, -rack);
    EXPECT_NEAR(a.front_view_camber, b.front_view_camber, 1e-13);
    EXPECT_NEAR(a.arms.roll_centre_height, b.arms.roll_centre_height, 1e-12) << name;
    EXPECT_NEAR(a.arms.front[0], -b.arms.front[0], 1e-11) << name;
    EXPECT_NEAR(a.arms.front[1], b.arms.front[1], 1e-11) << name;
    EXPECT_NEAR(a.arms.side[0], b.arms.side[0], 1e-10 * (1 + std::abs(a.arms.side[0]))) << name;
    EXPECT_NEAR(a.arms.side_swing_angle, b.arms.side_swing_angle, 1e-12) << name;
    ASSERT_EQ(a.geometric_axis.has_value(), b.geometric_axis.has_value());
    if (!a.geometric_axis) continue;
    EXPECT_NEAR(a.geometric_axis->caster, b.geometric_axis->caster, 1e-13) << name;
    EXPECT_NEAR(a.geometric_axis->scrub, b.geometric_axis->scrub, 1e-13) << name;
    EXPECT_NEAR(a.geometric_axis->wheel_trail, b.geometric_axis->wheel_trail, 1e-13) << name;
    EXPECT_LT(distance(math::mirrored(a.geometric_axis->ground), b.geometric_axis->ground), 1e-13) << name;
  }
}

}  // namespace
}  // namespace linkwright::suspension
