// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/plan.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "planar/linkage_changes.h"
#include "planar/linkages.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> problems_told(const Linkage& l) {
  std::vector<std::string> out;
  for (const Diagnostic& d : plan_linkage(l).problems)
    out.push_back(to_string(d.key + ": " + d.message + "; " + d.hint));
  return out;
}
Linkage four_bar() { return four_bar_sample().linkage; }

TEST(LinkagePlan, KeepsTheOrderOfTheChain) {
  const LinkagePlan p = planned(four_bar());
  EXPECT_TRUE(p.closed_form());
  EXPECT_EQ(p.inputs(), 1u);
  EXPECT_TRUE(p.rotary[0]);
  EXPECT_THAT(p.parts, ElementsAre("ground", "crank", "coupler", "rocker"));
  EXPECT_EQ(p.groups[1].name, "coupler + rocker");
  EXPECT_THAT(p.group_of_part, ElementsAre(-1, 0, 1, 1));
  EXPECT_EQ(p.size, 0.6);
  EXPECT_FALSE(planned(linkage_sample("triad").linkage).closed_form());
}
// The order in which bodies, joints and the ends of joints are listed changes nothing.
TEST(LinkagePlan, DoesNotDependOnHowTheJointsAreListed) {
  for (const LinkageSample& s : linkage_samples()) {
    SCOPED_TRACE(s.name);
    Linkage l = s.linkage;
    std::reverse(l.joints.begin(), l.joints.end());
    for (int& d : l.driven) d = static_cast<int>(l.joints.size()) - 1 - d;
    // Pins turned round; a driven one keeps its sense.
    for (std::size_t k = 0; k < l.joints.size(); ++k) {
      LinkageJoint& j = l.joints[k];
      const bool driven = std::find(l.driven.begin(), l.driven.end(), static_cast<int>(k)) != l.driven.end();
      if (j.type == JointType::revolute && !driven) std::swap(j.first, j.second);
    }
    const LinkagePlan p = planned(s.linkage), q = planned(l);
    LinkageMotion m(p), n(q);
    ASSERT_NO_FATAL_FAILURE(go_to(s, p, 0, 0.4, m));
    ASSERT_NO_FATAL_FAILURE(go_to(s, q, 0, 0.4, n));
    LinkageForces f, g;
    const std::vector<InputMotion> in = inputs_at(s, 0.4, s.speed, 1);
    solve_motion(p, in, m);
    solve_motion(q, in, n);
    solve_forces(s.linkage, p, m, 0, 0, f);
    solve_forces(l, q, n, 0, 0, g);
    const double largest = largest_force(f);
    for (std::size_t k = 0; k < f.joints.size(); ++k) {
      const std::size_t other = l.joints.size() - 1 - k;
      const double side = l.joints[other].first.body == s.linkage.joints[k].first.body ? 1 : -1;
      EXPECT_LE(norm(f.joints[k].force - side * g.joints[other].force), 1e-11 * largest);
    }
    EXPECT_LE(unbalance(l, q, n, g), 1e-10 * largest);
  }
}
// A drive whose second body is the ground turns the other way.
TEST(LinkagePlan, DrivesBackwardsThroughTheSecondBody) {
  Linkage l = four_bar();
  const LinkagePlan p = planned(l);
  std::swap(l.joints[0].first, l.joints[0].second);
  const LinkagePlan q = planned(l);
  LinkageMotion m(p), n(q);
  LinkageForces f, g;
  const std::vector<InputMotion> there{{0.7, 3, 2}}, back{{-0.7, -3, -2}};
  solve_motion(p, there, m);
  solve_motion(q, back, n);
  solve_forces(four_bar(), p, m, 0, 0, f);
  solve_forces(l, q, n, 0, 0, g);
  EXPECT_NEAR(m.parts[3].speed, n.parts[3].speed, 1e-15);
  EXPECT_NEAR(m.parts[3].angular_acceleration, n.parts[3].angular_acceleration, 1e-14);
  EXPECT_NEAR(f.drives[0], -g.drives[0], 1e-13);
  EXPECT_NEAR(f.drive_power, g.drive_power, 1e-12);
  EXPECT_NEAR(f.shaking_moment, g.shaking_moment, 1e-12);
}
TEST(LinkagePlan, DrivesSlidesEitherWay) {
  for (const bool swapped : {false, true}) {
    Linkage l = grounded({{"guide", {0.1, 0.2}}});
    add_body(l, "slider", {{"middle", {0.3, 0}}});
    if (swapped)
      add_slide(l, "guide", "slider.middle", "ground.guide", 0.5, 0.2);
    else
      add_slide(l, "guide", "ground.guide", "slider.middle", 0.2, 0.5);
    add_drive(l, "guide");
    l.bodies[1].mass = BodyMass{2, 0.1, {0, 0}};
    l.gravity = 0;
    const LinkagePlan p = planned(l);
    EXPECT_FALSE(p.rotary[0]);
    LinkageMotion m(p);
    LinkageForces f;
    const std::vector<InputMotion> in{{0.7, 1, 4}};
    solve_motion(p, in, m);
    solve_forces(l, p, m, 0, 0, f);
    const double sign = swapped ? -1 : 1;
    EXPECT_LE(
        norm(place_of(l, p, m, "slider.middle") - (math::Vec2{0.1, 0.2} + sign * 0.7 * math::unit(0.2))),
        1e-15);
    EXPECT_NEAR(angle_of(m.parts[1].direction), -0.3, 1e-15);
    EXPECT_NEAR(f.drives[0], 8, 1e-14);  // force on the second body, along the slide: pushes them apart
    EXPECT_NEAR(f.drive_power, 8, 1e-14);
  }
}
TEST(LinkagePlan, JoinsWeldedBodies) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "a", "O", "end", 1);
  add_bar(l, "b", "start", "end", 1);
  add_bar(l, "c", "start", "end", 1);
  add_pin(l, "O", "ground.O", "a.O");
  add_weld(l, "second", "c.start", "b.end", -pi / 2);  // c is turned by +90 deg from b
  add_weld(l, "first", "a.end", "b.start", pi / 2);
  add_drive(l, "O");
  set_uniform_all(l, 1);
  const LinkagePlan p = planned(l);
  EXPECT_THAT(p.parts, ElementsAre("ground", "a + b + c"));
  LinkageMotion m(p);
  const std::vector<InputMotion> in{{0, 1, 0}};
  solve_motion(p, in, m);
  EXPECT_LE(norm(place_of(l, p, m, "b.end") - math::Vec2{1, 1}), 1e-15);
  EXPECT_LE(norm(place_of(l, p, m, "c.end") - math::Vec2{0, 1}), 1e-15);
  EXPECT_NEAR(p.masses[1].mass, 3, 1e-15);
  EXPECT_LE(norm(p.masses[1].moment - math::Vec2{0.5 + 1 + 0.5, 0.5 + 1}), 1e-15);
  EXPECT_EQ(mobility(l), 1);
}
// A drive counts from the frames of its bodies, also where they are welded to others; along groups, all at
// once, and through a gear.
TEST(LinkagePlan, DrivesFromTheFramesOfWeldedBodies) {
  Linkage l = grounded({{"O", {0, 0}}, {"D", {3, 0}}});
  add_bar(l, "post", "foot", "top", 1);
  add_bar(l, "holder", "start", "end", 0.5);
  add_bar(l, "bar", "start", "end", 1);
  add_body(l, "wheel", {{"D", {0, 0}}, {"rim", {1, 0}}});
  add_weld(l, "post", "ground.O", "post.foot", pi / 2);
  add_weld(l, "bar", "holder.end", "bar.start", 0.4);
  add_pin(l, "pin", "post.top", "bar.start");
  add_pin(l, "D", "ground.D", "wheel.D");
  add_drive(l, "pin");
  for (const bool geared : {true, false}) {
    if (geared) {
      add_gear(l, "gear", "bar", "wheel", 2, 0.1);
    } else {
      l.joints.pop_back();
      l.joints.pop_back();
      l.bodies.pop_back();
      set_start(l, "bar", {0, 1}, pi / 2);
    }
    const LinkagePlan p = planned(l, geared ? PlanRoute::along_groups : PlanRoute::all_at_once);
    LinkageMotion m(p);
    const std::vector<InputMotion> in{{0.3, 2, 0}};
    solve_motion(p, in, m);
    ASSERT_EQ(m.status, Status::done);
    EXPECT_LE(norm(body_state(p, m, 3).direction - math::unit(pi / 2 + 0.3)), 1e-15);
    EXPECT_LE(norm(body_state(p, m, 2).direction - math::unit(pi / 2 + 0.3 - 0.4)), 1e-15);
    EXPECT_LE(open_joints(l, p, m), 1e-14);
    if (geared) {
      EXPECT_LE(norm(body_state(p, m, 4).direction - math::unit(pi + 0.6 + 0.1)), 1e-15);
    }
  }
}
// The wheel listed second drives the first: angle and torques as if they were listed the other way.
TEST(LinkagePlan, FollowsGearsBackwards) {
  const LinkageSample& s = linkage_sample("geared_five_bar");
  Linkage l = s.linkage;
  LinkageJoint& gear = l.joints.back();
  std::swap(gear.first, gear.second);
  gear.ratio = -0.5;  // second - ground = -2 (first - ground) + 0.4 the other way round
  gear.phase = 0.2;
  const LinkagePlan p = planned(s.linkage), q = planned(l);
  LinkageMotion m(p), n(q);
  LinkageForces f, g;
  const std::vector<InputMotion> in{{0.7, 3, 2}};
  solve_motion(p, in, m);
  solve_motion(q, in, n);
  solve_forces(s.linkage, p, m, 0, 0, f);
  solve_forces(l, q, n, 0, 0, g);
  for (std::size_t k = 0; k < m.parts.size(); ++k) {
    EXPECT_LE(norm(m.parts[k].direction - n.parts[k].direction), 1e-14);
    EXPECT_NEAR(m.parts[k].angular_acceleration, n.parts[k].angular_acceleration, 1e-12);
  }
  EXPECT_NEAR(f.drives[0], g.drives[0], 1e-13);
  EXPECT_NEAR(g.joints.back().moment, 2 * f.joints.back().moment, 1e-13);
  EXPECT_LE(unbalance(l, q, n, g), 1e-12);
  EXPECT_LE(open_joints(l, q, n), 1e-14);
}
TEST(LinkagePlan, TakesModesInAnyOrderAndFromStartPoses) {
  Linkage l = four_bar();
  EXPECT_EQ(planned(l).groups[1].mode, 1);
  l.modes[0] = {3, 2, AssemblyMode::plus};  // to the left of the line from the rocker's pin to the coupler's
  EXPECT_EQ(planned(l).groups[1].mode, -1);
  l.modes.clear();
  EXPECT_FALSE(planned(l).groups[1].mode_given);
  set_start(l, "crank", 0, 0);
  set_start(l, "coupler", {0.1, 0}, -0.6);
  set_start(l, "rocker", {0.6, 0}, -2.2);
  EXPECT_EQ(planned(l).groups[1].mode, -1);
  EXPECT_TRUE(planned(l).groups[1].mode_given);
}

TEST(LinkagePlan, TakesTheModesOfSlidesInAnyOrder) {
  for (const auto& [name, swaps] : {std::pair{"slider_crank", false}, {"inverted_slider_crank", true}}) {
    Linkage l = linkage_sample(name).linkage;
    const double mode = planned(l).groups[1].mode;
    std::swap(l.modes[0].first, l.modes[0].second);
    EXPECT_EQ(planned(l).groups[1].mode, swaps ? -mode : mode) << name;
  }
}

// ---- problems

TEST(LinkagePlanProblems, IncludeThoseOfTheDescription) {
  Linkage l = four_bar();
  l.bodies[2].name = "crank";
  EXPECT_THAT(problems_told(l),
              ElementsAre("body.crank: the name 'crank' is given twice; give every one a name of its own"));
}
TEST(LinkagePlanProblems, NameALooseBody) {
  Linkage l = four_bar();
  add_bar(l, "spare", "P", "Q", 1);
  EXPECT_THAT(problems_told(l),
              ElementsAre("body.spare: 'spare' is not joined to anything; join it to another body, or "
                          "leave it out"));
}
TEST(LinkagePlanProblems, NameBodiesOffTheGround) {
  Linkage l = four_bar();
  add_bar(l, "spare", "P", "Q", 1);
  add_bar(l, "second", "P", "Q", 1);
  add_pin(l, "P", "spare.P", "second.P");
  EXPECT_THAT(problems_told(l),
              ElementsAre("body.spare: 'spare' and 'second' are joined to each other but not to the "
                          "ground; join one of them to the ground or to a body that is fixed to it"));
}
TEST(LinkagePlanProblems, NameFreedomsWithoutADrive) {
  Linkage l = four_bar();
  l.driven.clear();
  EXPECT_THAT(problems_told(l),
              ElementsAre("body.crank: 'crank', 'coupler' and 'rocker' keep 1 degree of freedom without a "
                          "drive; the linkage has 1 degree of freedom and 0 drives: drive one more joint, "
                          "or add a joint"));
  Linkage open = grounded({{"O", {0, 0}}});
  add_bar(open, "arm", "O", "A", 1);
  add_pin(open, "O", "ground.O", "arm.O");
  EXPECT_THAT(problems_told(open),
              ElementsAre("body.arm: 'arm' keeps 1 degree of freedom without a drive; the linkage has 1 "
                          "degree of freedom and 0 drives: drive one more joint, or add a joint"));
}
TEST(LinkagePlanProblems, NameDrivesBeyondTheFreedoms) {
  Linkage l = four_bar();
  add_drive(l, "B0");
  EXPECT_THAT(
      problems_told(l),
      ElementsAre("drive: two drives on one degree of freedom: with the drives of 'O' and 'B0' no freedom is "
                  "left for 'coupler'; the linkage has 1 degree of freedom and 2 drives: remove one "
                  "drive"));
  Linkage two = grounded({{"O", {0, 0}}});
  add_bar(two, "arm", "O", "A", 1);
  add_pin(two, "O", "ground.O", "arm.O");
  add_slide(two, "slide", "ground.O", "arm.A");
  add_drive(two, "O");
  add_drive(two, "slide");
  EXPECT_THAT(
      problems_told(two),
      ElementsAre("drive: two drives on one degree of freedom: 'ground' and 'arm', which joint 'slide' would "
                  "drive, are placed by other drives already; the linkage has -1 degrees of freedom "
                  "and 2 drives: remove one drive"));
}
TEST(LinkagePlanProblems, NameRedundantConstraints) {
  Linkage l = four_bar();
  add_bar(l, "brace", "P", "Q", 0.3);
  l.bodies[0].points.push_back({"extra", {0.3, 0.3}});
  add_pin(l, "P", "ground.extra", "brace.P");
  add_pin(l, "Q", "coupler.C", "brace.Q");
  EXPECT_THAT(problems_told(l),
              ElementsAre("body.brace: 'brace' has 1 constraint too many: a rigid or overdetermined "
                          "structure; leave out a joint or a drive"));
  Linkage doubled = four_bar();
  add_pin(doubled, "again", "ground.O", "crank.O");
  EXPECT_THAT(
      problems_told(doubled),
      ElementsAre(
          "joint.again: a redundant constraint: 'ground' and 'crank' are placed by other "
          "joints already, so the linkage closes for special dimensions only; leave the joint out, or one of "
          "the links beside it"));
}
TEST(LinkagePlanProblems, NameAStructure) {
  Linkage l = grounded({{"A", {0, 0}}, {"B", {1, 0}}, {"C", {2, 0}}});
  add_body(l, "plate", {{"A", {0, 0}}, {"B", {1, 0}}});
  add_pin(l, "A", "ground.A", "plate.A");
  add_pin(l, "B", "ground.B", "plate.B");
  EXPECT_THAT(problems_told(l),
              ElementsAre("body.plate: 'plate' has 1 constraint too many: a rigid or overdetermined "
                          "structure; leave out a joint or a drive"));
}
TEST(LinkagePlanProblems, NameWeldsThatCloseALoop) {
  Linkage l = four_bar();
  add_bar(l, "extra", "P", "Q", 1);
  add_weld(l, "w1", "coupler.C", "extra.P");
  add_weld(l, "w2", "extra.Q", "coupler.B");
  EXPECT_THAT(problems_told(l),
              ElementsAre("joint.w2: welds 'extra' and 'coupler', which are welded together already: "
                          "a redundant constraint; leave it out"));
  l.joints.back() = l.joints[0];
  l.joints.back().name = "pin";
  l.joints.back().first = point_named(l, "extra.Q");
  l.joints.back().second = point_named(l, "coupler.B");
  EXPECT_THAT(problems_told(l),
              ElementsAre("joint.pin: joins 'extra' and 'coupler', which are welded together: a "
                          "redundant constraint; leave the joint or the weld out"));
}
TEST(LinkagePlanProblems, NameGearsThatDoNotFollow) {
  Linkage l = four_bar();
  add_gear(l, "gear", "crank", "rocker", -2);
  // The gear turns the rocker, the pins hold the coupler once too often.
  EXPECT_THAT(problems_told(l), ElementsAre("body.coupler: 'coupler' has 1 constraint too many: a rigid or "
                                            "overdetermined structure; leave out a joint or a drive"));
  Linkage loose = grounded({{"A", {0, 0}}, {"B", {1, 0}}});
  add_body(loose, "one", {{"A", {0, 0}}});
  add_body(loose, "two", {{"B", {0, 0}}});
  add_pin(loose, "A", "ground.A", "one.A");
  add_pin(loose, "B", "ground.B", "two.B");
  add_gear(loose, "gear", "one", "two", -2);
  EXPECT_THAT(
      problems_told(loose),
      ElementsAre("body.one: 'one' and 'two' keep 1 degree of freedom without a drive; the linkage has "
                  "1 degree of freedom and 0 drives: drive one more joint, or add a joint"));
  Linkage twice = grounded({{"A", {0, 0}}, {"B", {1, 0}}});
  add_body(twice, "one", {{"A", {0, 0}}});
  add_body(twice, "two", {{"B", {0, 0}}});
  add_pin(twice, "A", "ground.A", "one.A");
  add_pin(twice, "B", "ground.B", "two.B");
  add_drive(twice, "A");
  add_drive(twice, "B");
  add_gear(twice, "gear", "one", "two", -2);
  EXPECT_THAT(problems_told(twice),
              ElementsAre("joint.gear: a redundant constraint: 'one' and 'two' are placed without "
                          "the gear already; leave the gear or a drive out"));
}
TEST(LinkagePlanProblems, NamePairsWithoutModes) {
  Linkage l = four_bar();
  set_mode(l, "crank", "coupler", AssemblyMode::plus);
  EXPECT_THAT(problems_told(l),
              ElementsAre("assembly: 'crank' and 'coupler' are not a pair with two assembly modes; these "
                          "are: coupler + rocker"));
  l.modes.back() = {7, 2, AssemblyMode::plus};
  EXPECT_THAT(problems_told(l),
              ElementsAre("assembly: '7' and 'coupler' are not a pair with two assembly modes; these "
                          "are: coupler + rocker"));
  Linkage arm = arm_sample(2).linkage;
  set_mode(arm, "link 1", "link 2", AssemblyMode::plus);
  EXPECT_THAT(problems_told(arm),
              ElementsAre("assembly: 'link 1' and 'link 2' are not a pair with two assembly modes; "
                          "this linkage has no such pair"));
}
TEST(LinkageMobility, Counts) {
  Linkage l = four_bar();
  EXPECT_EQ(mobility(l), 1);
  add_gear(l, "gear", "crank", "rocker", 2);
  EXPECT_EQ(mobility(l), 0);
  EXPECT_EQ(mobility(linkage_sample("whitworth").linkage), 1);
}

}  // namespace
}  // namespace linkwright::planar
