// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/static_forces.h"

#include <gtest/gtest.h>

#include <vector>

#include "linkwright/planar/linkage/build.h"
#include "planar/linkages.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

// The forces are the falling of the potential energy, and the masses those of the kinetic energy.
TEST(StaticForces, AreTheSlopeOfThePotential) {
  Linkage l = grounded({{"O", 0}, {"S", {0, 1.2}}});
  l.bodies.push_back({.name = "upper", .points = {{"O", 0}, {"A", 0.5}}});
  l.bodies[1].mass = BodyMass{1, 0.02, 0.25};
  l.joints.push_back({.name = "O", .first = {0, 0}, .second = {1, 0}});
  l.bodies.push_back({.name = "lower", .points = {{"A", 0}, {"B", 0.4}}});
  l.bodies[2].mass = BodyMass{0.7, 0.01, {0.2, 0.05}};
  l.joints.push_back({.name = "A", .first = {1, 1}, .second = {2, 0}});
  l.driven = {0, 1};
  l.springs.push_back({"spring", {0, 1}, {2, 1}, 80, 0.5, 3});
  l.struts.push_back({.name = "gas", .first = {0, 1}, .second = {1, 1}, .gas = GasSpring{50, 1.8, 1.5, 1.2}});
  const LinkagePlan plan = planned(l);
  StaticForces forces(l, plan, {0, 1});
  const double values[] = {0.3, -0.8};
  ASSERT_EQ(forces.solve(values), Status::done);
  const std::vector<double> force = forces.force, masses = forces.masses(), dampings = forces.dampings();
  EXPECT_NEAR(masses[1], masses[2], 1e-15);
  EXPECT_NEAR(dampings[1], dampings[2], 1e-9);
  EXPECT_GT(dampings[0] * dampings[3] - dampings[1] * dampings[2], -1e-9);
  for (const std::size_t k : {0u, 1u}) {
    constexpr double h = 1e-5;
    double sides[2];
    for (const std::size_t side : {0u, 1u}) {
      double moved[] = {values[0], values[1]};
      moved[k] += side ? h : -h;
      ASSERT_EQ(forces.solve(moved), Status::done);
      sides[side] = forces.potential();
    }
    EXPECT_NEAR(-(sides[1] - sides[0]) / (2 * h), force[k], 1e-6);
  }
}

}  // namespace
}  // namespace linkwright::planar
