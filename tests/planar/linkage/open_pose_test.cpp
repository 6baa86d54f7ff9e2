// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/open_pose.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/kernel.h"
#include "planar/linkage_changes.h"
#include "planar/linkages.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;
using namespace linkwright::planar::test;

// The bodies of a group that does not close stay on what holds them and keep their size, and come as near as
// the gap says.
void expect_laid_open(const Linkage& l, double value, double gap) {
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const std::vector<InputMotion> in{{value, 1, 0}};
  solve_motion(p, in, m);
  ASSERT_EQ(m.status, Status::no_assembly);
  EXPECT_NEAR(m.gap, gap, 1e-12);
  const auto ends = lay_open(p, in, m);
  ASSERT_TRUE(ends);
  EXPECT_NEAR(norm((*ends)[1] - (*ends)[0]), gap, 1e-12);
  const Group& g = p.groups[at(m.failed_group)];
  for (const int part : g.parts) EXPECT_NEAR(norm(m.parts[at(part)].direction), 1, 1e-15);
  for (const PlanJoint* j : {&g.joints.front(), &g.joints.back()}) {
    if (j->slide) continue;
    const auto end = [&](const PartPoint& q) { return point_on(m.parts[at(q.part)], q.at); };
    EXPECT_LE(norm(end(j->before) - end(j->after)), 1e-14);
  }
  EXPECT_EQ(m.status, Status::no_assembly);
  EXPECT_TRUE(std::isnan(m.parts[at(g.parts[0])].speed));
}

TEST(LinkageOpenPose, OfADyadOfThreePins) {
  expect_laid_open(linkage_of({.ground = 2, .crank = 1, .coupler = 1.2, .rocker = 1.3}), pi, 3 - 2.5);
  // One link longer than all the rest, either of the two.
  const double apart = std::hypot(2 - std::cos(0.3), std::sin(0.3));
  expect_laid_open(linkage_of({.ground = 2, .crank = 1, .coupler = 1.2, .rocker = 5}), 0.3, 3.8 - apart);
  expect_laid_open(linkage_of({.ground = 2, .crank = 1, .coupler = 5, .rocker = 1.2}), 0.3, 3.8 - apart);
  expect_laid_open(linkage_of({.ground = 100, .crank = 1, .coupler = 1, .rocker = 2}), 0, 96);
}

TEST(LinkageOpenPose, OfASliderThatIsTooFarAway) {
  for (const double height : {0.5, -0.5}) {
    Linkage l = grounded({{"O", {0, 0}}, {"guide", {0, height}}});
    add_bar(l, "crank", "O", "A", 0.3);
    add_bar(l, "rod", "A", "B", 0.4);
    add_body(l, "slider", {{"B", {0, 0}}});
    add_pin(l, "O", "ground.O", "crank.O");
    add_pin(l, "A", "crank.A", "rod.A");
    add_pin(l, "B", "rod.B", "slider.B");
    add_slide(l, "guide", "ground.guide", "slider.B");
    add_drive(l, "O");
    expect_laid_open(l, height > 0 ? -pi / 2 : pi / 2, 0.4);
  }
}

TEST(LinkageOpenPose, OfASleeveWhosePinsAreTooNear) {
  for (const double offset : {0.2, -0.2}) {
    Linkage l = grounded({{"O", {0, 0}}, {"B0", {0.35, 0}}});
    add_bar(l, "crank", "O", "A", 0.3);
    add_body(l, "rod", {{"A", {0, 0}}});
    add_body(l, "sleeve", {{"B0", {0, 0}}, {"slide", {0, offset}}});
    add_pin(l, "O", "ground.O", "crank.O");
    add_pin(l, "A", "crank.A", "rod.A");
    add_slide(l, "slide", "rod.A", "sleeve.slide");
    add_pin(l, "B0", "ground.B0", "sleeve.B0");
    add_drive(l, "O");
    expect_laid_open(l, 0, 0.2 - 0.05);
  }
}

// An arm that a cylinder raises.
TEST(LinkageOpenPose, OfATriangle) {
  Linkage l = grounded({{"O", {0, 0}}, {"C", {1, 0}}});
  add_body(l, "barrel", {{"C", {0, 0}}});
  add_body(l, "rod", {{"D", {0, 0}}});
  add_bar(l, "arm", "O", "D", 0.8);
  add_pin(l, "C", "ground.C", "barrel.C");
  add_slide(l, "cylinder", "barrel.C", "rod.D");
  add_pin(l, "D", "rod.D", "arm.D");
  add_pin(l, "O", "ground.O", "arm.O");
  add_drive(l, "cylinder");
  expect_laid_open(l, 2.5, 0.7);
  expect_laid_open(l, 0.1, 0.1);
}

TEST(LinkageOpenPose, IsOnlyOfWhatDoesNotClose) {
  const LinkagePlan p = planned(linkage_of({.ground = 2, .crank = 1, .coupler = 2.5, .rocker = 2.6}));
  LinkageMotion m(p);
  const std::vector<InputMotion> in{{0.3, 1, 0}};
  solve_motion(p, in, m);
  EXPECT_EQ(m.status, Status::done);
  EXPECT_FALSE(lay_open(p, in, m));
  EXPECT_THAT(test::message([&] { lay_open(p, {}, m); }), HasSubstr("the linkage has 1 inputs, got 0"));
}

}  // namespace
}  // namespace linkwright::planar
