// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/general.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "planar/linkage_changes.h"
#include "planar/linkages.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

// From poses that are off by centimetres Newton's method finds the same place as from near ones, to rounding.
TEST(LinkageGeneral, FindsThePlaceFromAfar) {
  const LinkageSample& s = linkage_sample("triad");
  const LinkagePlan p = planned(s.linkage);
  LinkageMotion near(p), far(p);
  const std::vector<InputMotion> in{{0, 1, 0}};
  for (std::size_t k = 2; k < far.parts.size(); ++k) {
    far.parts[k].origin = far.parts[k].origin + math::Vec2{0.03, -0.02};
    far.parts[k].direction = math::unit(angle_of(far.parts[k].direction) + 0.2);
  }
  solve_position(p, in, near);
  solve_position(p, in, far);
  ASSERT_EQ(near.status, Status::done);
  ASSERT_EQ(far.status, Status::done);
  for (std::size_t k = 0; k < near.parts.size(); ++k) {
    EXPECT_LE(norm(near.parts[k].origin - far.parts[k].origin), 1e-14);
    EXPECT_LE(norm(near.parts[k].direction - far.parts[k].direction), 1e-14);
  }
  EXPECT_EQ(determinant_sign(*near.general[1]), determinant_sign(*far.general[1]));
  EXPECT_GT(conditioning(*near.general[1]), 0.1);
  EXPECT_LT(conditioning(*near.general[1]), 1);
}

// Far from the origin the places are as good as their coordinates are.
TEST(LinkageGeneral, WorksFarFromTheOrigin) {
  const LinkageSample& s = linkage_sample("triad");
  const LinkageSample far = apply(Change{0, {1e4, -2e4}, false}, s);
  const LinkagePlan p = planned(s.linkage), q = planned(far.linkage);
  LinkageMotion m(p), n(q);
  ASSERT_NO_FATAL_FAILURE(go_to(s, p, 0, 0.4, m));
  ASSERT_NO_FATAL_FAILURE(go_to(far, q, 0, 0.4, n));
  for (std::size_t k = 0; k < m.parts.size(); ++k)
    EXPECT_LE(norm(m.parts[k].direction - n.parts[k].direction), 64 * 2.3e-16 * 2.3e4 / 0.1);
}

// Both branches of a four-bar, solved all at once, have determinants of opposite signs.
TEST(LinkageGeneral, TellsBranchesApartByTheSignOfTheDeterminant) {
  Linkage l = linkage_sample("four_bar").linkage;
  const LinkagePlan along = planned(l), at_once = planned(l, PlanRoute::all_at_once);
  ASSERT_EQ(at_once.groups.size(), 1u);
  EXPECT_TRUE(at_once.groups[0].as<GeneralGroup>());
  double signs[2];
  const std::vector<InputMotion> in{{1, 1, 0}};
  for (int k = 0; k < 2; ++k) {
    LinkageMotion m(along), n(at_once);
    m.modes[1] = k ? 1 : -1;
    solve_position(along, in, m);
    n.parts = m.parts;
    solve_position(at_once, in, n);
    ASSERT_EQ(n.status, Status::done);
    signs[k] = determinant_sign(*n.general[0]);
    for (std::size_t i = 0; i < m.parts.size(); ++i)
      EXPECT_LE(norm(n.parts[i].origin - m.parts[i].origin), 1e-14);
  }
  EXPECT_EQ(signs[0], -signs[1]);
}

// A drive between two moving bodies: the length of a cylinder lifts a boom.
TEST(LinkageGeneral, DrivesACylinderBetweenMovingBodies) {
  Linkage l = grounded({{"O", {0, 0}}, {"C", {0.4, -0.3}}});
  add_bar(l, "boom", "O", "B", 1.0);
  add_body(l, "barrel", {{"C", {0, 0}}});
  add_body(l, "piston", {{"B", {0, 0}}});
  add_pin(l, "O", "ground.O", "boom.O");
  add_pin(l, "C", "ground.C", "barrel.C");
  add_pin(l, "B", "boom.B", "piston.B");
  add_slide(l, "cylinder", "barrel.C", "piston.B");
  add_drive(l, "cylinder");
  set_start(l, "boom", 0, 0.3);
  set_start(l, "barrel", {0.4, -0.3}, 0.8);
  set_start(l, "piston", {0.95, 0.3}, 0.8);
  set_uniform(l, "boom", 10);
  l.bodies[2].mass = l.bodies[3].mass = BodyMass{};
  l.gravity = {0, -10};
  const LinkagePlan p = planned(l);
  ASSERT_EQ(p.groups.size(), 1u);
  EXPECT_TRUE(p.groups[0].as<Triangle>());
  EXPECT_FALSE(p.rotary[0]);
  LinkageMotion m(p);
  LinkageForces f;
  const double length = 0.8;
  const std::vector<InputMotion> in{{length, 0.1, 0}};
  solve_motion(p, in, m);
  ASSERT_EQ(m.status, Status::done);
  EXPECT_LE(open_joints(l, p, m), 1e-14);
  const PartState<double> boom = body_state(p, m, 1);
  const math::Vec2 b = boom.direction, c{0.4, -0.3};
  EXPECT_NEAR(norm(b - c), length, 1e-15);
  const double lever = cross(b, (1 / length) * (b - c));  // lever of the cylinder's force about O
  EXPECT_NEAR(boom.speed, 0.1 / lever, 1e-13);
  solve_forces(l, p, m, 0, 0, f);
  // Half of the boom's length is the lever of its weight; inertia m l^2 / 3.
  EXPECT_NEAR(f.drives[0], (10 * 10 * 0.5 * b.x + 10.0 / 3 * boom.angular_acceleration) / lever, 1e-11);
  EXPECT_LE(unbalance(l, p, m, f), 1e-11);
  EXPECT_NEAR(f.drive_power + f.weight_power, f.kinetic_power, 1e-12);
  const LinkagePlan q = planned(l, PlanRoute::all_at_once);
  EXPECT_EQ(q.groups.size(), 1u);
}

// No place near the start: a status and how far the joints stand open, in metres.
TEST(LinkageGeneral, TellsThatItCannotBeAssembled) {
  Linkage l = linkage_sample("stephenson_2").linkage;
  l.bodies[index(body_index(l, "bar 1"))].points[1].at += 5.0;
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const std::vector<InputMotion> in{{0, 1, 0}};
  solve_motion(p, in, m);
  EXPECT_EQ(m.status, Status::not_converged);
  EXPECT_EQ(m.failed_group, 1);
  EXPECT_GT(m.gap, 0.1);
  EXPECT_TRUE(std::isfinite(m.gap));
  // The places stay finite, so that the next search can start from them.
  solve_motion(p, in, m);
  EXPECT_EQ(m.status, Status::not_converged);
}
TEST(LinkageGeneral, IsSingularAtADeadPoint) {
  Linkage l = grounded({{"O", {0, 0}}, {"B0", {2, 0}}});
  add_bar(l, "crank", "O", "A", 1);
  add_bar(l, "coupler", "A", "B", 1.5);
  add_bar(l, "rocker", "B0", "B", 1.5);
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "B0", "ground.B0", "rocker.B0");
  add_drive(l, "O");
  set_start(l, "crank", 0, pi);
  set_start(l, "coupler", -1.0, 0);
  set_start(l, "rocker", 2.0, pi);
  const LinkagePlan p = planned(l, PlanRoute::all_at_once);
  LinkageMotion m(p);
  const std::vector<InputMotion> in{{pi, 1, 0}};
  solve_motion(p, in, m);
  EXPECT_EQ(m.status, Status::singular);
  EXPECT_TRUE(std::isnan(m.parts[1].speed));
}

}  // namespace
}  // namespace linkwright::planar
