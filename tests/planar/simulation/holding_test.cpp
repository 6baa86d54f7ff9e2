// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/holding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/zero.h"
#include "linkwright/planar/linkage/build.h"
#include "planar/linkages.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

const Value& published(const char* id) { return published_case("planar-machines.json", id); }

// The slider-crank without masses, whose piston is pushed towards the crank.
Linkage pushed_slider_crank() {
  Linkage l = grounded({{"O", 0}});
  l.bodies.push_back({.name = "crank", .points = {{"O", 0}, {"A", 0.05}}});
  l.bodies.push_back({.name = "rod", .points = {{"A", 0}, {"B", 0.15}}});
  l.bodies.push_back({.name = "piston", .points = {{"B", 0}}});
  for (std::size_t b = 1; b < 4; ++b) l.bodies[b].mass = BodyMass{};
  const auto pin = [&](const char* name, BodyPoint first, BodyPoint second, double radius) {
    l.joints.push_back(
        {.name = name, .first = first, .second = second, .friction = 0.1, .pin_radius = radius});
  };
  pin("O", {0, 0}, {1, 0}, 0.015);
  pin("A", {1, 1}, {2, 0}, 0.012);
  pin("B", {2, 1}, {3, 0}, 0.008);
  l.joints.push_back(
      {.name = "guide", .type = JointType::prismatic, .first = {0, 0}, .second = {3, 0}, .friction = 0.1});
  l.driven = {0};
  set_mode(l, "rod", "piston", AssemblyMode::plus);
  l.forces.push_back({.name = "push", .point = {3, 0}, .force = -1000});
  l.gravity = 0;
  return l;
}

TEST(HoldingForces, SliderCrankHoldsThePublishedRange) {
  const Value& wanted = at(published("slider-crank-holding-range"), "computed");
  const Linkage l = pushed_slider_crank();
  const LinkagePlan plan = planned(l);
  HoldingForces holding(l, plan);
  const LinkageMotion modes(plan);
  for (const Value& entry : at(wanted, "rows").as_array()) {
    const std::vector<double> row = numbers(entry);
    const HoldingRange r = holding.range(row[0] * pi / 180, modes, 0);
    ASSERT_EQ(r.status, Status::done);
    EXPECT_NEAR(r.without_friction, row[1], 1e-8);
    EXPECT_NEAR(r.least, row[2], 1e-8);
    EXPECT_NEAR(r.greatest, row[3], 1e-8);
  }
  // About the outer dead centre the piston cannot turn the crank.
  const auto locks = [&](double angle) { return holding.self_locking_margin(angle, modes, 0) >= 1; };
  const double edge = math::bisect(locks, 0.0, 0.2, {.relative = 1e-12}).inside;
  EXPECT_NEAR(edge * 180 / pi,
              number_at(wanted, "piston_cannot_turn_the_crank_within_deg_of_outer_dead_centre"), 1e-6);
}

TEST(HoldingForces, BellCrankHoldsThePublishedEfforts) {
  const Value& bell = published("bell-crank-pin-friction");
  Linkage l = grounded({{"O", 0}});
  l.bodies.push_back({.name = "lever", .points = {{"O", 0}, {"L", 0.08}, {"E", {0, 0.3}}}});
  l.bodies[1].mass = BodyMass{};
  l.joints.push_back({.name = "O", .first = {0, 0}, .second = {1, 0}, .friction = 0.25, .pin_radius = 0.02});
  l.driven = {0};
  l.forces.push_back({.name = "load", .point = {1, 1}, .force = {0, -1000}});
  l.forces.push_back({.name = "effort", .point = {1, 2}, .force = -1});
  l.gravity = 0;
  const LinkagePlan plan = planned(l);
  HoldingForces holding(l, plan, 1);
  const HoldingRange r = holding.range(0, LinkageMotion(plan), 0);
  const std::vector<double> wanted = numbers(at(bell, "computed.holding_effort_N"));
  ASSERT_EQ(r.status, Status::done);
  EXPECT_NEAR(r.without_friction, number_at(bell, "computed.without_friction_N"), 1e-9);
  EXPECT_NEAR(r.least, wanted[0], 1e-8);
  EXPECT_NEAR(r.greatest, wanted[1], 1e-8);
}

// A block on an incline locks with the margin mu / tan; at exactly 1 it holds.
TEST(HoldingForces, InclineHasTheMarginOfItsAngle) {
  for (const double slope : {0.2, 0.3, 0.45}) {
    Linkage l = grounded({{"O", 0}});
    l.bodies.push_back({.name = "block", .points = {{"B", 0}}});
    l.bodies[1].mass = BodyMass{2, 0.01, 0};
    l.joints.push_back({.name = "slide",
                        .type = JointType::prismatic,
                        .first = {0, 0},
                        .second = {1, 0},
                        .slide_first = std::atan(slope),
                        .slide_second = std::atan(slope),
                        .friction = 0.3});
    l.driven = {0};
    const LinkagePlan plan = planned(l);
    HoldingForces holding(l, plan);
    const double margin = holding.self_locking_margin(0.1, LinkageMotion(plan), 0);
    EXPECT_NEAR(margin, 0.3 / slope, 1e-9);
    const double weight = 2 * 9.81, angle = std::atan(slope);
    const HoldingRange r = holding.range(0.1, LinkageMotion(plan), 0);
    EXPECT_NEAR(r.least, weight * (std::sin(angle) - 0.3 * std::cos(angle)), 1e-10);
    EXPECT_NEAR(r.greatest, weight * (std::sin(angle) + 0.3 * std::cos(angle)), 1e-10);
  }
}

// Two bars, 0.5 m of 2 kg at 40 deg and 0.4 m of 1.5 kg at -20 deg, held by brakes of 18 and 6 N m: the load
// at the tip that they hold, and which brake gives way. Beside it by moments: of the elbow about its pin, and
// of the whole arm about the shoulder.
Linkage braked_arm() {
  Linkage l = grounded({{"O", 0}});
  l.bodies.push_back({.name = "upper", .points = {{"O", 0}, {"A", 0.5}}});
  l.bodies.push_back({.name = "fore", .points = {{"A", 0}, {"tip", 0.4}}});
  l.joints.push_back({.name = "shoulder", .first = {0, 0}, .second = {1, 0}, .friction_effort = 18});
  l.joints.push_back({.name = "elbow", .first = {1, 1}, .second = {2, 0}, .friction_effort = 6});
  l.driven = {0, 1};
  set_uniform(l, "upper", 2), set_uniform(l, "fore", 1.5);
  l.forces.push_back({.name = "W", .point = {2, 1}, .force = {0, -1}});
  return l;
}
constexpr double arm_angles[] = {40 * pi / 180, -60 * pi / 180};

TEST(HeldLoad, TwoBrakesHoldALoad) {
  const Linkage l = braked_arm();
  const LinkagePlan plan = planned(l);
  const HeldLoad held = held_load(l, plan, 0, arm_angles, LinkageMotion(plan), 0);
  ASSERT_EQ(held.status, Status::done);
  EXPECT_NEAR(held.least, -23.32016658713868, 1e-9);
  EXPECT_NEAR(held.greatest, 7.696495259840608, 1e-9);
  EXPECT_NEAR(held.margin, 1.48036841906272, 1e-9);
  EXPECT_EQ(l.joints[static_cast<std::size_t>(held.least_slips)].name, "elbow");
  EXPECT_EQ(l.joints[static_cast<std::size_t>(held.greatest_slips)].name, "shoulder");
  const double fore = 0.4 * std::cos(20 * pi / 180), upper = 0.5 * std::cos(40 * pi / 180), g = 9.81;
  EXPECT_NEAR(held.least, (-6 - 1.5 * g * fore / 2) / fore, 1e-9);
  EXPECT_NEAR(held.greatest, (18 - 2 * g * upper / 2 - 1.5 * g * (upper + fore / 2)) / (upper + fore), 1e-9);
}

TEST(HeldLoad, AFreeJointHoldsNothing) {
  Linkage l = braked_arm();
  l.joints[1].friction_effort = 0;
  const LinkagePlan plan = planned(l);
  EXPECT_EQ(held_load(l, plan, 0, arm_angles, LinkageMotion(plan), 0).status, Status::infeasible);
}

// A load through both pins turns nothing, however large.
TEST(HeldLoad, ALoadThroughThePinsIsHeldHoweverLarge) {
  Linkage l = braked_arm();
  l.gravity = 0;
  l.forces[0].force = {1, 0};
  const LinkagePlan plan = planned(l);
  const double straight[] = {0, 0};
  const HeldLoad held = held_load(l, plan, 0, straight, LinkageMotion(plan), 0);
  EXPECT_EQ(held.least, -infinity);
  EXPECT_EQ(held.greatest, infinity);
  EXPECT_EQ(held.margin, infinity);
}

// With one input it is what HoldingForces says, friction by the joint force included.
TEST(HeldLoad, OneInputIsAsHoldingForcesHaveIt) {
  Linkage l = braked_arm();
  l.joints[0].friction_effort = 3, l.joints[0].friction = 0.3, l.joints[0].pin_radius = 0.02;
  l.joints[1].type = JointType::fixed;
  l.joints[1].friction_effort = 0;
  l.driven = {0};
  const LinkagePlan plan = planned(l);
  const double value[] = {1.1};
  HoldingForces forces(l, plan, 0);
  const HoldingRange range = forces.range(value[0], LinkageMotion(plan), 0);
  const HeldLoad held = held_load(l, plan, 0, value, LinkageMotion(plan), 0);
  ASSERT_EQ(held.status, Status::done);
  EXPECT_NEAR(held.least, range.least, 1e-9);
  EXPECT_NEAR(held.greatest, range.greatest, 1e-9);
  EXPECT_NEAR(held.margin, forces.self_locking_margin(value[0], LinkageMotion(plan), 0), 1e-9);
}

// A block of 100 N on an incline of 30 deg, friction 0.2: what holds it along the incline, and level.
TEST(HoldingForces, AnInclineHoldsThePublishedRanges) {
  for (const bool level : {false, true}) {
    const double angle = pi / 6;
    Linkage l = grounded({{"O", 0}});
    l.bodies.push_back({.name = "block", .points = {{"B", 0}}});
    l.bodies[1].mass = BodyMass{100 / 9.81, 0, 0};
    l.joints.push_back({.name = "slide",
                        .type = JointType::prismatic,
                        .first = {0, 0},
                        .second = {1, 0},
                        .slide_first = angle,
                        .slide_second = angle,
                        .friction = 0.2});
    l.driven = {0};
    l.forces.push_back({.name = "push", .point = {1, 0}, .force = std::polar(1.0, level ? 0 : angle)});
    const LinkagePlan plan = planned(l);
    HoldingForces holding(l, plan, 0);
    const HoldingRange r = holding.range(0.1, LinkageMotion(plan), 0);
    ASSERT_EQ(r.status, Status::done);
    EXPECT_NEAR(r.least, level ? 33.82881215782542 : 32.67949192431122, 1e-8);
    EXPECT_NEAR(r.greatest, level ? 87.88286621187947 : 67.32050807568876, 1e-8);
    EXPECT_NEAR(holding.self_locking_margin(0.1, LinkageMotion(plan), 0), 0.3464101615137755, 1e-9);
  }
}

// A drawer of 0.3 m in its guides, friction 0.25, against 1 N: a pull at an offset e opens it unless e
// reaches L / (2 mu) = 0.6 m. Its size by moments is 1 / (1 - 2 mu e / L).
TEST(HoldingForces, ADrawerJamsFromItsOffsetOn) {
  for (const double offset : {0.2, 0.55, 0.65}) {
    Linkage l = grounded({{"O", 0}});
    l.bodies.push_back({.name = "drawer", .points = {{"B", 0}, {"pull", {0, offset}}}});
    l.bodies[1].mass = BodyMass{};
    l.joints.push_back({.name = "guide",
                        .type = JointType::prismatic,
                        .first = {0, 0},
                        .second = {1, 0},
                        .friction = 0.25,
                        .guide_length = 0.3});
    l.driven = {0};
    l.gravity = 0;
    l.forces.push_back({.name = "pull", .point = {1, 1}, .force = 1});
    l.forces.push_back({.name = "spring", .point = {1, 0}, .force = -1});
    const LinkagePlan plan = planned(l);
    HoldingForces holding(l, plan, 0);
    const HoldingRange r = holding.range(0, LinkageMotion(plan), 0);
    const double share = 2 * 0.25 * offset / 0.3;
    EXPECT_NEAR(r.least, 1 / (1 + share), 1e-9);
    if (share < 1)
      EXPECT_NEAR(r.greatest, 1 / (1 - share), 1e-8);
    else
      EXPECT_EQ(r.greatest, infinity);
  }
}

TEST(HoldingForces, WithoutFrictionNothingIsHeld) {
  Linkage l = pushed_slider_crank();
  for (LinkageJoint& j : l.joints) j.friction = 0;
  const LinkagePlan plan = planned(l);
  HoldingForces holding(l, plan);
  const HoldingRange r = holding.range(1, LinkageMotion(plan), 0);
  EXPECT_EQ(r.least, r.greatest);
  EXPECT_EQ(holding.self_locking_margin(1, LinkageMotion(plan), 0), 0);
}

}  // namespace
}  // namespace linkwright::planar
