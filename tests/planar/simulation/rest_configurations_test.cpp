// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/rest_configurations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"
#include "planar/linkages.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

// Two links of the same length with masses at their ends.
Linkage two_links(double length, double first_mass, double second_mass) {
  Linkage l = grounded({{"O", 0}});
  l.bodies.push_back({.name = "upper", .points = {{"O", 0}, {"A", length}}});
  l.bodies.push_back({.name = "lower", .points = {{"A", 0}, {"B", length}}});
  l.bodies[1].mass = BodyMass{first_mass, 0, length};
  l.bodies[2].mass = BodyMass{second_mass, 0, length};
  l.joints.push_back({.name = "O", .first = {0, 0}, .second = {1, 0}});
  l.joints.push_back({.name = "A", .first = {1, 1}, .second = {2, 0}});
  l.driven = {0, 1};
  return l;
}

TEST(RestConfigurations, DoublePendulumHasThePublishedFour) {
  const Value& wanted = at(published_case("planar-machines.json", "rest-double-pendulum"), "computed");
  const Linkage l = two_links(0.5, 1, 1);
  const LinkagePlan plan = planned(l);
  const RestConfigurations r = rest_configurations(l, plan, {.inputs = {0, 0}, .free = {0, 1}});
  ASSERT_EQ(r.status, Status::done);
  ASSERT_EQ(r.found.size(), 4u);
  const RestConfiguration& lowest = r.found.front();
  EXPECT_EQ(lowest.kind, RestKind::stable);
  EXPECT_NEAR(lowest.values[0], -pi / 2, 1e-9);
  EXPECT_NEAR(lowest.values[1], 0, 1e-9);
  const std::vector<double> frequencies = numbers(at(wanted, "frequency_Hz"));
  ASSERT_EQ(lowest.vibrations.size(), 2u);
  for (const std::size_t i : {0u, 1u})
    EXPECT_NEAR(std::abs(lowest.vibrations[i]) / full_turn, frequencies[i], 1e-9);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(r.found[i].kind, RestKind::unstable);
}

// The upper link lies on a stop at -60 degrees, from which the lower one hangs as a pendulum; with a stop of
// the lower one as well nothing is left to move. Moments about the joints give the efforts of the stops.
TEST(RestConfigurations, StopsHoldFreeJoints) {
  Linkage l = two_links(0.5, 1, 1);
  l.stops.push_back({.joint = 0, .limit = -pi / 3, .side = 1});
  const RestConfigurations r = rest_configurations(l, planned(l), {.inputs = {0, 0}, .free = {0, 1}});
  ASSERT_EQ(r.status, Status::done);
  const RestConfiguration& lowest = r.found.front();
  EXPECT_EQ(lowest.kind, RestKind::stable);
  EXPECT_NEAR(lowest.values[0], -pi / 3, 1e-12);
  EXPECT_NEAR(lowest.values[1], -pi / 6, 1e-9);
  EXPECT_NEAR(lowest.stops[0], 2 * 9.81 * 0.25, 1e-9);
  ASSERT_EQ(lowest.vibrations.size(), 1u);
  EXPECT_NEAR(std::abs(lowest.vibrations[0]), std::sqrt(9.81 / 0.5), 1e-6);
  // Nothing rests beyond the stop, and no stop pulls.
  for (const RestConfiguration& c : r.found) {
    EXPECT_GE(c.values[0], -pi / 3 - 1e-9);
    EXPECT_GE(c.stops[0], 0);
  }
  l.stops.push_back({.joint = 1, .limit = 0, .side = 1});
  const RestConfigurations both = rest_configurations(l, planned(l), {.inputs = {0, 0}, .free = {0, 1}});
  ASSERT_EQ(both.status, Status::done);
  const RestConfiguration& straight = both.found.front();
  EXPECT_EQ(straight.kind, RestKind::at_end);
  EXPECT_NEAR(straight.stops[0], 3 * 9.81 * 0.25, 1e-9);
  EXPECT_NEAR(straight.stops[1], 9.81 * 0.25, 1e-9);
  EXPECT_TRUE(straight.vibrations.empty());
}

// Ziegler's column: masses 2 m and m, equal springs k, lengths l; a force that turns with the upper link
// makes it flutter from (7/2 - sqrt 2) k / l on.
TEST(RestConfigurations, FollowingForceMakesAColumnFlutter) {
  const double critical = 3.5 - std::sqrt(2.0);
  for (const double share : {0.98, 1.02}) {
    Linkage l = two_links(1, 2, 1);
    l.gravity = 0;
    l.torsion_springs.push_back({.name = "s1", .first = 0, .second = 1, .stiffness = 1});
    l.torsion_springs.push_back({.name = "s2", .first = 1, .second = 2, .stiffness = 1});
    l.forces.push_back(
        {.name = "thrust", .point = {2, 1}, .force = -share * critical, .turns_with_body = true});
    const RestConfigurations r = rest_configurations(l, planned(l), {.inputs = {0, 0}, .free = {0, 1}});
    const auto straight = std::find_if(r.found.begin(), r.found.end(), [](const RestConfiguration& c) {
      return std::abs(c.values[0]) < 1e-6 && std::abs(c.values[1]) < 1e-6;
    });
    ASSERT_NE(straight, r.found.end());
    EXPECT_EQ(straight->kind, share < 1 ? RestKind::stable : RestKind::flutter) << share;
  }
}

// Two pendulums that do not touch, one of them damped: each has its own frequency and damping.
TEST(RestConfigurations, DampersGiveEachVibrationItsRatio) {
  Linkage l = grounded({{"A", 0}, {"B", 1}});
  for (const char* name : {"first", "second"}) {
    const double length = *name == 'f' ? 0.3 : 0.7;
    l.bodies.push_back({.name = name, .points = {{"O", 0}}});
    l.bodies.back().mass = BodyMass{2, 0, length};
  }
  l.joints.push_back({.name = "A", .first = {0, 0}, .second = {1, 0}});
  l.joints.push_back({.name = "B", .first = {0, 1}, .second = {2, 0}});
  l.driven = {0, 1};
  l.torsion_springs.push_back({.name = "damper", .first = 0, .second = 2, .damping = 0.4});
  const RestConfigurations r = rest_configurations(l, planned(l), {.inputs = {0, 0}, .free = {0, 1}});
  const auto stable = std::find_if(r.found.begin(), r.found.end(),
                                   [](const RestConfiguration& c) { return c.kind == RestKind::stable; });
  ASSERT_NE(stable, r.found.end());
  ASSERT_EQ(stable->vibrations.size(), 2u);
  const std::complex<double> slow = stable->vibrations[0], fast = stable->vibrations[1];
  EXPECT_NEAR(std::abs(slow), std::sqrt(9.81 / 0.7), 1e-8);
  EXPECT_NEAR(std::abs(fast), std::sqrt(9.81 / 0.3), 1e-8);
  EXPECT_NEAR(-slow.real() / std::abs(slow), 0.4 / (2 * 2 * 0.49 * std::sqrt(9.81 / 0.7)), 1e-8);
  EXPECT_NEAR(fast.real(), 0, 1e-8);
}

}  // namespace
}  // namespace linkwright::planar
