// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/linkage.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/samples.h"

namespace linkwright::planar {
namespace {

// "key: message; hint" of every problem.
std::vector<std::string> told(const Linkage& l) {
  std::vector<std::string> out;
  for (const Diagnostic& d : check(l)) out.push_back(to_string(d.key + ": " + d.message + "; " + d.hint));
  return out;
}
// The messages for the four-bar sample after a change.
template <class Change>
std::vector<std::string> after(Change&& change) {
  Linkage l = four_bar_sample().linkage;
  change(l);
  return told(l);
}
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(LinkageCheck, FindsNothingWrongWithTheSamples) {
  for (const LinkageSample& s : linkage_samples()) EXPECT_THAT(told(s.linkage), IsEmpty()) << s.name;
}
TEST(LinkageCheck, WantsAGround) {
  EXPECT_THAT(told({}), ElementsAre("body: the linkage has no bodies, not even a ground; the first body is "
                                    "the ground"));
}
TEST(LinkageCheck, WantsNamesOnce) {
  EXPECT_THAT(after([](Linkage& l) { l.bodies[2].name = "crank"; }),
              ElementsAre("body.crank: the name 'crank' is given twice; give every one a name of its own"));
  EXPECT_THAT(after([](Linkage& l) { l.joints[2].name = "A"; }),
              ElementsAre("joint.A: the name 'A' is given twice; give every one a name of its own"));
  EXPECT_THAT(after([](Linkage& l) { l.joints[2].name.clear(); }),
              ElementsAre("joint: has no name; give every one a name of its own"));
  EXPECT_THAT(after([](Linkage& l) { l.bodies[2].points[2].name = "A"; }),
              ElementsAre("body.coupler.point.A: the name 'A' is given twice; give every one a name of its "
                          "own"));
  EXPECT_THAT(after([](Linkage& l) {
                l.torques.push_back({.name = "t", .body = 1});
                l.torques.push_back({.name = "t", .body = 2});
              }),
              ElementsAre("torque.t: the name 't' is given twice; give every one a name of its own"));
}
TEST(LinkageCheck, WantsFiniteNumbers) {
  EXPECT_THAT(after([](Linkage& l) { l.bodies[2].points[1].at = infinity; }),
              ElementsAre("body.coupler.point.B: its coordinates are not finite; "));
  EXPECT_THAT(after([](Linkage& l) { l.bodies[1].mass->inertia = -1; }),
              ElementsAre("body.crank.mass: mass 0.2 and inertia -1 must be finite and not negative; "));
  EXPECT_THAT(after([](Linkage& l) {
                l.bodies[1].attached.push_back({"weight", infinity, 0});
              }),
              ElementsAre("body.crank.attached.weight: mass inf must be finite and not negative; "));
  EXPECT_THAT(after([](Linkage& l) { l.gravity = std::nan(""); }),
              ElementsAre("environment.gravity: is not finite; "));
  EXPECT_THAT(after([](Linkage& l) { l.joints[1].slide_first = std::nan(""); }),
              ElementsAre("joint.A: its angles and ratio must be finite; "));
}
TEST(LinkageCheck, WantsJointsBetweenTwoBodies) {
  EXPECT_THAT(after([](Linkage& l) { l.joints[1].second.body = 9; }),
              ElementsAre("joint.A: refers to a body or point that does not exist; "));
  EXPECT_THAT(after([](Linkage& l) { l.joints[1].second.point = 3; }),
              ElementsAre("joint.A: refers to a body or point that does not exist; "));
  EXPECT_THAT(after([](Linkage& l) {
                l.joints[1].first = {2, 1};
              }),
              Contains("joint.A: joins body 'coupler' to itself; a joint needs two bodies"));
}
TEST(LinkageCheck, WantsFrictionThatCanAct) {
  EXPECT_THAT(after([](Linkage& l) { l.joints[1].friction = 0.1; }),
              ElementsAre("joint.A: has friction but no pin radius: its torque would be zero; give the "
                          "radius of the pin, or a friction torque"));
  EXPECT_THAT(after([](Linkage& l) {
                l.joints[1].friction = 0.3, l.joints[1].friction_static = 0.2, l.joints[1].pin_radius = 0.01;
              }),
              ElementsAre("joint.A: its friction at rest, 0.2, is below its friction in motion, 0.3; "
                          "friction_static is the larger of the two"));
  EXPECT_THAT(after([](Linkage& l) { l.joints[1].friction_effort = 2, l.joints[1].friction_speed = 0.1; }),
              ElementsAre("joint.A: its friction falls with the speed, but has no value at rest; give "
                          "friction_static"));
  EXPECT_THAT(
      after([](Linkage& l) { l.joints[1].friction = -0.1; }),
      ElementsAre("joint.A: friction, pin radius and guide length must be finite and not negative; "));
  EXPECT_THAT(after([](Linkage& l) {
                add_gear(l, "g", "crank", "rocker", 2);
                l.joints.back().friction = 0.1;
              }),
              ElementsAre("joint.g: a gear joint has no friction; "));
}
TEST(LinkageCheck, WantsAGearToTurn) {
  EXPECT_THAT(after([](Linkage& l) { add_gear(l, "g", "crank", "rocker", 0); }),
              ElementsAre("joint.g: its ratio is 0; a gear at rest is a `fixed` joint to its carrier"));
}
TEST(LinkageCheck, WantsDrivesOnPinsAndSlides) {
  EXPECT_THAT(after([](Linkage& l) { l.driven.push_back(9); }),
              ElementsAre("drive: joint number 9 does not exist; "));
  EXPECT_THAT(after([](Linkage& l) { l.driven.push_back(0); }),
              ElementsAre("drive: joint 'O' has two drives; one [[drive]] a joint is enough"));
  EXPECT_THAT(
      after([](Linkage& l) { l.joints[0].type = JointType::fixed; }),
      ElementsAre("drive: joint 'O' is of type fixed: only revolute and prismatic joints take a drive; "));
}
TEST(LinkageCheck, WantsLinksOfSomeLength) {
  EXPECT_THAT(after([](Linkage& l) { l.bodies[3].points[1].at = 0; }),
              ElementsAre("body.rocker: has no length: its joints B and B0 lie in one point; move one of the "
                          "points, or leave the body out"));
  EXPECT_THAT(after([](Linkage& l) { l.bodies[1].points[1].at = 1e-12; }),
              ElementsAre("body.crank: has no length: its joints O and A lie in one point; move one of the "
                          "points, or leave the body out"));
}
TEST(LinkageCheck, WantsLoadsThatDoSomething) {
  const auto spring = [](LinearSpring s) { return after([&](Linkage& l) { l.springs.push_back(s); }); };
  EXPECT_THAT(spring({"s", {1, 0}, {1, 1}, 5, 0, 0}),
              ElementsAre("spring.s: both ends are on body 'crank'; it would do nothing"));
  EXPECT_THAT(spring({"s", {1, 0}, {7, 1}, 5, 0, 0}),
              ElementsAre("spring.s: refers to a body or point that does not exist; "));
  EXPECT_THAT(spring({"s", {1, 0}, {2, 1}, 5, -1, 0}),
              ElementsAre("spring.s: stiffness, damping and free length must be finite and not negative; "));
  const auto torsion = [](TorsionSpring s) {
    return after([&](Linkage& l) { l.torsion_springs.push_back(s); });
  };
  EXPECT_THAT(torsion({"s", 1, 1, 5, 0, 0}),
              ElementsAre("torsion_spring.s: both ends are on body 'crank'; it would do nothing"));
  EXPECT_THAT(torsion({"s", 1, 8, 5, 0, 0}),
              ElementsAre("torsion_spring.s: refers to a body that does not exist; "));
  EXPECT_THAT(torsion({"s", 1, 2, -5, 0, 0}),
              ElementsAre("torsion_spring.s: stiffness and damping must be finite and not negative, the free "
                          "angle finite; "));
  EXPECT_THAT(
      after([](Linkage& l) {
        l.forces.push_back({.name = "f", .point = {2, 5}, .force = infinity});
      }),
      ElementsAre("force.f: refers to a body or point that does not exist; ", "force.f: is not finite; "));
  const auto torque = [](BodyTorque t) { return after([&](Linkage& l) { l.torques.push_back(t); }); };
  EXPECT_THAT(torque({.name = "t", .body = 1, .from = 1}),
              ElementsAre("torque.t: body 'crank' exerts it on itself; "));
  EXPECT_THAT(torque({.name = "t", .body = 8}),
              ElementsAre("torque.t: refers to a body that does not exist; "));
  EXPECT_THAT(torque({.name = "t", .body = 1, .torque = infinity}), ElementsAre("torque.t: is not finite; "));
  EXPECT_THAT(
      torque({.name = "t", .body = 1, .factor = {LoadArgument::x, {0, 1}, {0, 1}}}),
      ElementsAre("torque.t: a torque has no point: its table cannot go by x or y; use input or time"));
  const auto table = [&](std::vector<double> arguments, std::vector<double> factors) {
    return torque({.name = "t", .body = 1, .factor = {LoadArgument::time, arguments, factors}});
  };
  EXPECT_THAT(table({0}, {1}),
              ElementsAre("torque.t: its table has 1 arguments and 1 factors; give at least two, and as many "
                          "of both"));
  EXPECT_THAT(table({0, 1}, {1}),
              ElementsAre("torque.t: its table has 2 arguments and 1 factors; give at least two, and as many "
                          "of both"));
  EXPECT_THAT(table({0, 0}, {1, 2}),
              ElementsAre("torque.t: the arguments of its table do not rise; sort them, each once"));
  EXPECT_THAT(table({0, 1}, {1, infinity}),
              ElementsAre("torque.t: its table holds numbers that are not finite; "));
}
TEST(LinkageSize, IsTheLargestDistanceOfJoints) {
  EXPECT_DOUBLE_EQ(size_of(four_bar_sample().linkage), 0.6);  // the ground
  EXPECT_EQ(size_of(Linkage{}), 1);
}

}  // namespace
}  // namespace linkwright::planar
