// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/rest_positions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/build.h"
#include "planar/linkages.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

const Value& published_rows(const char* id) {
  return at(published_case("planar-machines.json", id), "computed.rows");
}

// A uniform rod on the ground, with a place on it for a spring.
Linkage rod(double length, double mass) {
  Linkage l = grounded({{"O", 0}, {"S", {0, 1.2}}});
  l.bodies.push_back({.name = "rod", .points = {{"O", 0}, {"A", length}}});
  l.joints.push_back({.name = "O", .first = {0, 0}, .second = {1, 0}});
  l.bodies[1].mass = BodyMass{mass, mass * length * length / 12, length / 2};
  l.driven = {0};
  return l;
}

void expect_rows(const RestPositions& found, const Value& rows, double frequency_tolerance) {
  ASSERT_EQ(found.positions.size(), rows.as_array().size());
  for (std::size_t i = 0; i < found.positions.size(); ++i) {
    const Value::Array& row = rows.as_array()[i].as_array();
    const RestPosition& p = found.positions[i];
    EXPECT_NEAR(math::degrees(p.value), row[0].as_number(), 1e-7);
    EXPECT_NEAR(p.stiffness, row[1].as_number(), 1e-6);
    EXPECT_EQ(p.kind, row[1].as_number() > 0 ? RestKind::stable : RestKind::unstable);
    if (row.back().is_number()) {
      EXPECT_NEAR(p.frequency(), row.back().as_number(), frequency_tolerance);
    } else {
      EXPECT_TRUE(std::isnan(p.frequency()));
    }
  }
}

// A toggle clamp, 40 and 60 mm: a work piece presses its crank onto a stop 3 degrees past the dead centre.
TEST(RestPositions, AToggleClampStandsOnItsStop) {
  for (const double side : {1.0, -1.0}) {
    Linkage l = grounded({{"O", 0}});
    l.bodies.push_back({.name = "crank", .points = {{"O", 0}, {"A", 0.04}}});
    l.bodies.push_back({.name = "rod", .points = {{"A", 0}, {"B", 0.06}}});
    l.bodies.push_back({.name = "plunger", .points = {{"B", 0}}});
    for (std::size_t b = 1; b < 4; ++b) l.bodies[b].mass = BodyMass{};
    l.joints.push_back({.name = "O", .first = {0, 0}, .second = {1, 0}});
    l.joints.push_back({.name = "A", .first = {1, 1}, .second = {2, 0}});
    l.joints.push_back({.name = "B", .first = {2, 1}, .second = {3, 0}});
    l.joints.push_back({.name = "guide", .type = JointType::prismatic, .first = {0, 0}, .second = {3, 0}});
    l.driven = {0};
    set_mode(l, "rod", "plunger", AssemblyMode::plus);
    l.forces.push_back({.name = "work piece", .point = {3, 0}, .force = -800});
    l.stops.push_back({.joint = 0, .limit = side * math::radians(3), .side = -side, .arm = 0.03});
    const LinkagePlan plan = planned(l);
    const RestPositions found = rest_positions(l, plan, {.inputs = {0}, .range = {{-0.5, 0.5}}});
    const auto on_stop = std::find_if(found.positions.begin(), found.positions.end(),
                                      [](const RestPosition& p) { return p.stop >= 0; });
    ASSERT_NE(on_stop, found.positions.end());
    EXPECT_EQ(on_stop->kind, RestKind::at_end);
    EXPECT_EQ(on_stop->value, side * math::radians(3));
    EXPECT_NEAR(on_stop->stop_effort, 2.7904001530881977, 1e-11);
    EXPECT_NEAR(on_stop->stop_effort / l.stops[0].arm, 93.01333843627326, 1e-9);
    // The same by a stop of the plunger, 0.09135 mm below its dead centre: 800 N.
    l.stops[0] = {.joint = 3, .limit = 0.1 - 9.135042881022737e-05};
    const RestPositions other =
        rest_positions(l, plan_linkage(l).plan, {.inputs = {0}, .range = {{-0.5, 0.5}}});
    ASSERT_EQ(other.positions.size(), 3u);  // on it at either side, and unstable at the dead centre
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
      EXPECT_NEAR(std::abs(other.positions[i].value), math::radians(3), 1e-9);
      EXPECT_NEAR(other.positions[i].stop_effort, 800, 1e-8);
    }
  }
}

TEST(RestPositions, RodWithASpringHasThePublishedFour) {
  Linkage l = rod(1, 5);
  l.springs.push_back({"spring", {0, 1}, {1, 1}, 200, 0.3, 0});
  const LinkagePlan plan = planned(l);
  const RestPositions found = rest_positions(l, plan, {.inputs = {0}});
  ASSERT_EQ(found.status, Status::done);
  ASSERT_EQ(found.ranges.size(), 1u);
  EXPECT_TRUE(found.ranges[0].full_turn);
  expect_rows(found, published_rows("rest-rod-with-spring"), 1e-9);
}

TEST(RestPositions, FourBarHasThePublishedTwo) {
  Linkage l = grounded({{"O", 0}, {"C", 0.4}, {"S", {0.05, 0.3}}});
  const double lengths[] = {0.15, 0.35, 0.3}, masses[] = {0.6, 1.4, 1.2};
  const char* names[] = {"crank", "coupler", "rocker"};
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = lengths[i];
    l.bodies.push_back({.name = names[i], .points = {{"A", 0}, {"B", a}, {"M", a / 2}}});
    l.bodies.back().mass = BodyMass{masses[i], masses[i] * a * a / 12, a / 2};
  }
  l.joints.push_back({.name = "O", .first = {0, 0}, .second = {1, 0}});
  l.joints.push_back({.name = "A", .first = {1, 1}, .second = {2, 0}});
  l.joints.push_back({.name = "B", .first = {2, 1}, .second = {3, 1}});
  l.joints.push_back({.name = "C", .first = {0, 1}, .second = {3, 0}});
  l.driven = {0};
  // The open branch has B to the left of the line from A to C.
  set_mode(l, "coupler", "rocker", AssemblyMode::plus);
  l.springs.push_back({"spring", {0, 2}, {2, 2}, 300, 0.22, 0});
  const LinkagePlan plan = planned(l);
  const RestPositions found = rest_positions(l, plan, {.inputs = {0}});
  expect_rows(found, published_rows("rest-four-bar"), 1e-6);
  const std::vector<double> first =
      numbers(Value(Value::Array(published_rows("rest-four-bar").as_array()[0].as_array().begin(),
                                 published_rows("rest-four-bar").as_array()[0].as_array().begin() + 3)));
  EXPECT_NEAR(found.positions[0].mass, first[2], 1e-9);
  // The other mode has ranges and positions of its own.
  const RestPositions all = rest_positions(l, plan, {.inputs = {0}, .all_modes = true});
  EXPECT_EQ(all.ranges.size(), 2u);
  EXPECT_GT(all.positions.size(), found.positions.size());
}

TEST(RestPositions, GearedPendulumsHaveThePublishedTwo) {
  Linkage l = grounded({{"A", 0}, {"B", 1}});
  l.bodies.push_back({.name = "a", .points = {{"A", 0}}});
  l.bodies.push_back({.name = "b", .points = {{"B", 0}}});
  l.bodies[1].mass = BodyMass{2, 0.01, 0.15};
  l.bodies[2].mass = BodyMass{1.2, 0.004, 0.1};
  l.joints.push_back({.name = "A", .first = {0, 0}, .second = {1, 0}});
  l.joints.push_back({.name = "B", .first = {0, 1}, .second = {2, 0}});
  l.joints.push_back({.name = "gear",
                      .type = JointType::gear,
                      .first = {1, 0},
                      .second = {2, 0},
                      .ratio = -2,
                      .phase = 0.4});
  l.driven = {0};
  const RestPositions found = rest_positions(l, planned(l), {.inputs = {0}});
  expect_rows(found, published_rows("rest-geared-pendulums"), 1e-9);
}

TEST(RestPositions, BonnetRestsWhereItsGasSpringCarriesIt) {
  const Value& bonnet = published_case("planar-machines.json", "bonnet-gas-spring");
  Linkage l = grounded({{"O", 0}, {"P", {0.02, -0.06}}});
  l.bodies.push_back({.name = "bonnet", .points = {{"O", 0}, {"Q", {0.3, -0.06}}}});
  l.bodies[1].mass = BodyMass{15, 2, std::polar(0.62, 8 * pi / 180)};
  l.joints.push_back({.name = "O", .first = {0, 0}, .second = {1, 0}});
  l.driven = {0};
  l.struts.push_back(
      {.name = "lift", .first = {0, 1}, .second = {1, 1}, .gas = GasSpring{900, 0.356, 0.08, 1.35}});
  const LinkagePlan plan = planned(l);
  const RestPositions found = rest_positions(l, plan, {.inputs = {0}, .range = {{0, 75 * pi / 180}}});
  ASSERT_EQ(found.positions.size(), 3u);
  EXPECT_NEAR(math::degrees(found.positions[1].value), numbers(at(bonnet, "computed.rest_positions_deg"))[0],
              1e-8);
  EXPECT_EQ(found.positions[1].kind, RestKind::unstable);
  // Pressed shut and pressed open, at the ends of the range.
  for (const std::size_t i : {0u, 2u}) EXPECT_EQ(found.positions[i].kind, RestKind::at_end);
  EXPECT_NEAR(found.positions[0].force, number_at(bonnet, "computed.torque_at_0_N_m"), 1e-9);
  EXPECT_NEAR(found.positions[2].force, number_at(bonnet, "computed.torque_at_75_N_m"), 1e-9);
  // With friction of its hinge it stays where it is left, in a band about the unstable position.
  Linkage rubs = l;
  rubs.joints[0].friction_effort = number_at(bonnet, "inputs.pivot_friction_N_m");
  const std::vector<RestBand> bands = rest_bands(rubs, plan, found);
  ASSERT_EQ(bands.size(), 1u);
  const std::vector<double> edges = numbers(at(bonnet, "computed.hold_band_edges_deg"));
  EXPECT_NEAR(math::degrees(bands[0].from), edges[0], 1e-8);
  EXPECT_NEAR(math::degrees(bands[0].to), edges[1], 1e-8);
  // Without friction a band is the position itself.
  const std::vector<RestBand> none = rest_bands(l, plan, found);
  EXPECT_TRUE(none.empty() || none[0].to - none[0].from < 1e-9);
  // Without a range the strokes of the gas spring end it; one of the pieces holds that of the car.
  const RestPositions whole = rest_positions(l, plan, {.inputs = {0}});
  ASSERT_EQ(whole.status, Status::done);
  for (const RestRange& range : whole.ranges) {
    EXPECT_TRUE(range.stop_below || range.dead_below || range.full_turn || range.from == -pi);
    for (const double end : {range.value.front(), range.value.back()}) {
      const double length =
          std::abs(std::polar(1.0, end) * std::complex(0.3, -0.06) - std::complex(0.02, -0.06));
      EXPECT_TRUE(length > 0.276 - 1e-9 && length < 0.356 + 1e-9) << length;
    }
  }
}

// A spring of zero free length with k a b = m g l balances an arm at every angle (Carwardine).
TEST(RestPositions, BalancedArmRestsAnywhere) {
  const Value& arm = published_case("planar-machines.json", "counterbalance-arm");
  const double mass = number_at(arm, "inputs.mass_kg"), where = number_at(arm, "inputs.at_m");
  Linkage l = grounded({{"O", 0}, {"S", {0, number_at(arm, "inputs.anchor_above_pivot_m")}}});
  l.bodies.push_back({.name = "arm", .points = {{"O", 0}, {"A", number_at(arm, "inputs.eye_on_arm_m")}}});
  l.bodies[1].mass = BodyMass{mass, 0, where};
  l.joints.push_back({.name = "O", .first = {0, 0}, .second = {1, 0}});
  l.driven = {0};
  l.springs.push_back(
      {"spring", {0, 1}, {1, 1}, number_at(arm, "computed.zero_free_length_stiffness_N_per_m"), 0, 0});
  const RestPositions found = rest_positions(l, planned(l), {.inputs = {0}});
  ASSERT_EQ(found.ranges.size(), 1u);
  EXPECT_TRUE(found.ranges[0].balanced);
  EXPECT_TRUE(found.positions.empty());
}

// A shallow truss: a spring of the length 0.5 m from (0.4, 0) to a block on a vertical slide. Pressed down,
// it snaps where the length is the cube root of 0.5 m (0.4 m)^2.
TEST(RestPositions, ALoadThatGrowsSnapsATruss) {
  constexpr double side = 0.4, free = 0.5, stiffness = 2000;
  Linkage l = grounded({{"O", 0}, {"S", side}});
  l.gravity = 0;
  l.bodies.push_back({.name = "block", .points = {{"B", 0}}});
  l.bodies[1].mass = BodyMass{1, 0.01, 0};
  l.joints.push_back({.name = "slide",
                      .type = JointType::prismatic,
                      .first = {0, 0},
                      .second = {1, 0},
                      .slide_first = pi / 2,
                      .slide_second = pi / 2});
  l.driven = {0};
  l.springs.push_back({"spring", {0, 1}, {1, 0}, stiffness, free, 0});
  const Linkage unloaded = l;
  const double length = std::cbrt(free * side * side), height = std::sqrt(length * length - side * side),
               critical = stiffness * (free / length - 1) * height;
  const RestSearch search{.inputs = {0}, .range = {{-0.5, 0.5}}};
  const auto path = [&](double load) {
    l.forces = {{.name = "load", .point = {1, 0}, .force = {0, -load}}};
    const LinkagePlan plan = planned(l);
    const std::vector<LoadPath> all = load_paths(l, unloaded, plan, search, rest_positions(l, plan, search));
    EXPECT_EQ(all.size(), 1u);
    return all[0];
  };
  const double top = std::sqrt(free * free - side * side);
  const LoadPath snaps = path(2 * critical);
  ASSERT_EQ(snaps.ways.size(), 2u);
  EXPECT_NEAR(snaps.ways[1].from, top, 1e-10);
  EXPECT_TRUE(snaps.ways[1].snaps);
  EXPECT_NEAR(snaps.ways[1].to, height, 1e-7);
  EXPECT_NEAR(snaps.ways[1].factor, 0.5, 1e-12);
  // From below it is pressed on without a fold.
  EXPECT_NEAR(snaps.ways[0].from, -top, 1e-10);
  EXPECT_FALSE(snaps.ways[0].snaps);
  const LoadPath stays = path(0.5 * critical);
  ASSERT_EQ(stays.ways.size(), 2u);
  EXPECT_FALSE(stays.ways[1].snaps || stays.ways[1].leaves);
  const double y = stays.ways[1].to;
  EXPECT_NEAR(stiffness * (free / std::hypot(side, y) - 1) * y, 0.5 * critical, 1e-9);
  EXPECT_GT(y, height);
}

// A torque that just carries a level rod: it touches zero there, and the rod falls to one side alone.
TEST(RestPositions, ForceThatTouchesZeroIsMarginal) {
  Linkage l = rod(1, 2);
  l.torques.push_back({.name = "lift", .body = 1, .from = 0, .torque = 2 * 9.81 * 0.5});
  const RestPositions found = rest_positions(l, planned(l), {.inputs = {0}, .range = {{-1, 1.3}}});
  ASSERT_EQ(found.positions.size(), 2u);
  EXPECT_EQ(found.positions[0].kind, RestKind::marginal);
  EXPECT_NEAR(found.positions[0].value, 0, 1e-6);
  EXPECT_EQ(found.positions[1].kind, RestKind::at_end);
}

// A hanging rod with a damper at a distance r from its hinge: c r^2 over 2 sqrt(k m) of the rotation.
TEST(RestPositions, DampersGiveTheDampingRatio) {
  Linkage l = rod(1, 3);
  l.bodies[0].points.push_back({"D", {1, -0.4}});
  l.bodies[1].points.push_back({"D", 0.4});
  l.springs.push_back({"damper", {0, 2}, {1, 2}, 0, 0, 7});
  const RestPositions found = rest_positions(l, planned(l), {.inputs = {0}});
  ASSERT_EQ(found.positions.size(), 2u);
  const RestPosition& p = found.positions[0];
  const double stiffness = 3 * 9.81 * 0.5, inertia = 3 * (1 / 12.0 + 0.25), damping = 7 * 0.4 * 0.4;
  EXPECT_NEAR(p.value, -pi / 2, 1e-12);
  EXPECT_NEAR(p.damping, damping, 1e-9);
  EXPECT_NEAR(p.damping_ratio(), damping / (2 * std::sqrt(stiffness * inertia)), 1e-9);
  EXPECT_NEAR(p.frequency(), std::sqrt(stiffness / inertia) / (2 * pi), 1e-9);
}

}  // namespace
}  // namespace linkwright::planar
