// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/triangle.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/motion.h"
#include "planar/linkage_sweeps.h"
#include "tests/planar/linkage_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

SweptLinkage raised_arm(int number) {
  RandomStream random({.seed = 12, .run = static_cast<std::uint32_t>(number)});
  return swept_linkage(SweptKind::raised_arm, random);
}

// Places, rates and forces against the same joints solved all at once, and the drawing at its own input.
TEST(LinkageTriangle, AgreesWithAllJointsAtOnce) {
  for (int i = 0; i < 50; ++i) {
    SweptLinkage s = raised_arm(i);
    set_uniform_all(s.linkage, 2);
    const LinkagePlan p = planned(s.linkage), q = planned(s.linkage, PlanRoute::all_at_once);
    ASSERT_EQ(p.groups.size(), 1u);
    ASSERT_TRUE(p.groups[0].as<Triangle>());
    ASSERT_TRUE(p.closed_form());
    EXPECT_TRUE(p.groups[0].mode_given);
    LinkageMotion m(p), n(q);
    LinkageForces f, g;
    const std::vector<InputMotion> in{{p.drawn_inputs[0] + 1e-3, 0.2, -0.4}};
    solve_motion(p, in, m);
    solve_motion(q, in, n);
    if (n.status != Status::done || m.status != Status::done || std::abs(m.groups[0].sine) < 0.05) continue;
    solve_forces(s.linkage, p, m, 0, in[0].value, f);
    solve_forces(s.linkage, q, n, 0, in[0].value, g);
    for (std::size_t k = 1; k < m.parts.size(); ++k) {
      EXPECT_LE(norm(m.parts[k].origin), 0.2) << i;  // a millimetre away from the drawing
      EXPECT_LE(norm(m.parts[k].origin - n.parts[k].origin), 1e-12);
      EXPECT_LE(norm(m.parts[k].acceleration - n.parts[k].acceleration), 1e-9);
    }
    for (std::size_t k = 0; k < f.joints.size(); ++k)
      EXPECT_LE(norm(f.joints[k].force - g.joints[k].force), 1e-9 * (1 + norm(g.joints[k].force)));
    EXPECT_NEAR(f.drives[0], g.drives[0], 1e-9 * (1 + std::abs(g.drives[0])));
  }
}

// A slide along the line of its pins makes a triangle with the sides b = |O G|, l = arm, and the drive's way:
// its range is |b - l| to b + l, and the arm's angle that of the law of cosines.
TEST(LinkageTriangle, ItsRangeIsThatOfTheTriangle) {
  for (int i = 0; i < 50; ++i) {
    const SweptLinkage s = raised_arm(i);
    const LinkagePlan p = planned(s.linkage);
    const auto ground = [&](int k) { return s.linkage.bodies[0].points[static_cast<std::size_t>(k)].at; };
    const LinkageBody& arm = s.linkage.bodies[static_cast<std::size_t>(body_index(s.linkage, "arm"))];
    const double b = std::abs(ground(0) - ground(1)), l = std::abs(arm.points[0].at - arm.points[1].at);
    const InputLimits limits = input_limits(p, std::vector<double>{0.5}, 0, 1e-4, 3);
    const InputRange* range = range_at(limits, LinkageMotion(p).modes, p.drawn_inputs[0]);
    ASSERT_TRUE(range);
    EXPECT_NEAR(range->from.value, std::abs(b - l), 1e-12);
    EXPECT_NEAR(range->to.value, b + l, 1e-12);
    LinkageMotion m(p);
    for (const double share : {0.1, 0.5, 0.9}) {
      const double way = std::abs(b - l) + share * (b + l - std::abs(b - l));
      solve_position(p, std::vector<InputMotion>{{way, 0, 0}}, m);
      ASSERT_EQ(m.status, Status::done);
      const auto turned = number(m.parts[static_cast<std::size_t>(body_index(s.linkage, "arm"))].direction);
      const double angle =
          std::abs(std::arg(turned * (arm.points[1].at - arm.points[0].at) / (ground(0) - ground(1))));
      EXPECT_NEAR(std::cos(angle), (b * b + l * l - way * way) / (2 * b * l), 1e-12);
    }
    solve_position(p, std::vector<InputMotion>{{b + l + 0.01, 0, 0}}, m);
    EXPECT_EQ(m.status, Status::no_assembly);
    EXPECT_NEAR(m.gap, 0.01, 1e-12);
  }
}

// A four-bar driven at the joint between crank and coupler: two bodies with a driven pin hold the rocker.
TEST(LinkageTriangle, HasADrivenPinAsWell) {
  Linkage l = four_bar_linkage(1, 0.5, 0.8, 0.9);
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const double angle = 0.7;
  solve_position(p, std::vector<InputMotion>{{angle, 1, 0}}, m);
  const double inner = angle_of(rotate_inverse(m.parts[1].direction, m.parts[2].direction));
  Linkage k = l;
  k.driven.clear();
  k.modes.clear();
  add_drive(k, "A");
  set_mode(k, "crank", "rocker", AssemblyMode::plus);
  const LinkagePlan q = planned(k);
  ASSERT_EQ(q.groups.size(), 1u);
  ASSERT_TRUE(q.groups[0].as<Triangle>());
  LinkageMotion n(q);
  solve_position(q, std::vector<InputMotion>{{inner, 1, 0}}, n);
  ASSERT_EQ(n.status, Status::done);
  EXPECT_LE(norm(m.parts[3].direction - n.parts[3].direction), 1e-12);
  EXPECT_LE(norm(m.parts[1].direction - n.parts[1].direction), 1e-12);
  // Named the other way round the sign turns.
  k.modes.clear();
  set_mode(k, "rocker", "coupler", AssemblyMode::minus);
  EXPECT_EQ(planned(k).groups[0].mode, q.groups[0].mode);
}

}  // namespace
}  // namespace linkwright::planar
