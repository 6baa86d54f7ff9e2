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
