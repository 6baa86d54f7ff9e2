// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/form.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/plan.h"
#include "linkwright/planar/linkage/samples.h"

namespace linkwright::planar {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(LinkageForm, HoldsEverySampleWithoutLoss) {
  for (const LinkageSample& sample : linkage_samples()) {
    SCOPED_TRACE(sample.name);
    std::vector<FormProblem> problems;
    Linkage back = linkage_of(form_of(sample.linkage), problems);
    EXPECT_THAT(problems, IsEmpty());
    ASSERT_EQ(back.bodies.size(), sample.linkage.bodies.size());
    for (std::size_t b = 0; b < back.bodies.size(); ++b) {
      EXPECT_EQ(back.bodies[b].name, sample.linkage.bodies[b].name);
      ASSERT_EQ(back.bodies[b].mass.has_value(), sample.linkage.bodies[b].mass.has_value());
      if (back.bodies[b].mass) {
        EXPECT_EQ(back.bodies[b].mass->mass, sample.linkage.bodies[b].mass->mass);
        EXPECT_EQ(back.bodies[b].mass->inertia, sample.linkage.bodies[b].mass->inertia);
        EXPECT_EQ(back.bodies[b].mass->centre, sample.linkage.bodies[b].mass->centre);
      }
    }
    ASSERT_EQ(back.joints.size(), sample.linkage.joints.size());
    for (std::size_t j = 0; j < back.joints.size(); ++j) {
      EXPECT_EQ(back.joints[j].type, sample.linkage.joints[j].type);
      EXPECT_EQ(back.joints[j].first.body, sample.linkage.joints[j].first.body);
      EXPECT_EQ(back.joints[j].second.point, sample.linkage.joints[j].second.point);
      EXPECT_EQ(back.joints[j].slide_first, sample.linkage.joints[j].slide_first);
    }
    EXPECT_EQ(back.modes.size(), sample.linkage.modes.size());
    EXPECT_EQ(back.springs.size(), sample.linkage.springs.size());
    EXPECT_EQ(back.forces.size(), sample.linkage.forces.size());
    EXPECT_EQ(back.torques.size(), sample.linkage.torques.size());
  }
}

// A four-bar as it is drawn at a crank angle of 60 degrees, crossed: the drawing gives mode and lengths.
TEST(LinkageForm, TakesTheModeFromADrawing) {
  LinkageForm form;
  form.drawn = true;
  const Place o{0, 0}, a{1, 1.7320508075688772}, b{5, -2}, b0{4, 0};
  form.bodies = {{.name = "ground", .points = {{"O", o}, {"B0", b0}}},
                 {.name = "crank", .points = {{"O", o}, {"A", a}}},
                 {.name = "coupler", .points = {{"A", a}, {"B", b}}},
                 {.name = "rocker", .points = {{"B0", b0}, {"B", b}}}};
  form.joints = {{.name = "O", .first = "ground.O", .second = "crank.O"},
                 {.name = "A", .first = "crank.A", .second = "coupler.A"},
                 {.name = "B", .first = "coupler.B", .second = "rocker.B"},
                 {.name = "B0", .first = "ground.B0", .second = "rocker.B0"}};
  std::vector<FormProblem> problems;
  Linkage l = linkage_of(form, problems);
  ASSERT_THAT(problems, IsEmpty());
  l.driven = {0};
  const PlanResult planned = plan_linkage(l);
  ASSERT_THAT(planned.problems, IsEmpty());
  LinkageMotion motion(planned.plan);
  solve_position(planned.plan, std::vector<InputMotion>{{0, 0, 0}}, motion);  // pose as drawn
  for (int body = 1; body < 4; ++body) {
    const PartState<double> s = body_state(planned.plan, motion, body);
    EXPECT_NEAR(norm(s.origin), 0, 1e-14) << body;
    EXPECT_NEAR(angle_of(s.direction), 0, 1e-14) << body;
  }
}

TEST(LinkageForm, TakesUniformBarsWhereOnlyAMassIsGiven) {
  LinkageForm form;
  form.bodies = {{.name = "ground", .points = {{"O", Place{0, 0}}}},
                 {.name = "bar", .points = {{"O", Place{0, 0}}, {"A", Place{0.6, 0}}}, .mass = 2.0}};
  std::vector<FormProblem> problems;
  const Linkage l = linkage_of(form, problems);
  EXPECT_NEAR(l.bodies[1].mass->inertia, 2.0 * 0.36 / 12, 1e-17);
  EXPECT_EQ(l.bodies[1].mass->centre, std::complex<double>(0.3, 0));
}

// An epicyclic train by its teeth: the carriers are found.
LinkageForm epicyclic_form() {
  LinkageForm form;
  const Place o{0, 0}, p{0.05, 0};
  form.bodies = {{.name = "ground", .points = {{"O", o}}},
                 {.name = "sun", .points = {{"O", o}}},
                 {.name = "arm", .points = {{"O", o}, {"P", p}}},
                 {.name = "planet", .points = {{"P", o}}}};
  form.joints = {{.name = "sun axle", .first = "ground.O", .second = "sun.O"},
                 {.name = "arm axle", .first = "ground.O", .second = "arm.O"},
                 {.name = "planet axle", .first = "arm.P", .second = "planet.P"}};
  JointForm sun{.name = "sun gear", .type = JointType::gear, .first = "sun.O", .second = "planet.P"};
  sun.teeth = {20, 30};
  JointForm ring{.name = "ring gear", .type = JointType::gear, .first = "planet", .second = "ground"};
  ring.teeth = {30, 80};
  ring.internal = InternalWheel::second;
  form.joints.insert(form.joints.end(), {sun, ring});
  return form;
}
std::vector<std::string> form_problems(const LinkageForm& form) {
  std::vector<FormProblem> problems;
  linkage_of(form, problems);
  std::vector<std::string> out;
  for (const FormProblem& p : problems)
    out.push_back(p.list + "." + std::to_string(p.index) + "." + p.key + ": " + p.message + "; " + p.hint);
  return out;
}

TEST(LinkageForm, TakesTeethAndFindsCarriers) {
  std::vector<FormProblem> problems;
  Linkage l = linkage_of(epicyclic_form(), problems);
  ASSERT_THAT(problems, IsEmpty());
  EXPECT_EQ(l.joints[3].ratio, -20.0 / 30);
  EXPECT_EQ(l.joints[4].ratio, 30.0 / 80);
  EXPECT_EQ(l.joints[3].carrier, 2);
  EXPECT_EQ(l.joints[4].carrier, 2);
  l.driven = {0};
  const PlanResult planned = plan_linkage(l);
  ASSERT_THAT(planned.problems, IsEmpty());
  LinkageMotion motion(planned.plan);
  solve_motion(planned.plan, std::vector<InputMotion>{{0.3, 1, 0}}, motion);
  EXPECT_NEAR(body_state(planned.plan, motion, 2).speed, 0.2, 1e-15);
  EXPECT_NEAR(body_state(planned.plan, motion, 3).speed, -1.0 / 3, 1e-15);
}

// Profile-shifted wheels of 21, 43 and 108 teeth on one distance (University of Ljubljana, LECAD, a planetary
// transmission): each mesh works at a pressure angle of its own.
TEST(LinkageForm, TakesThePressureAngleFromTheModule) {
  LinkageForm form = epicyclic_form();
  form.bodies[2].points[1].second = {0.0568, 0};
  form.joints[3].teeth = {21, 43};
  form.joints[4].teeth = {43, 108};
  form.joints[3].module = form.joints[4].module = 0.00175;
  std::vector<FormProblem> problems;
  const Linkage l = linkage_of(form, problems);
  ASSERT_THAT(problems, IsEmpty());
  constexpr double degree = std::numbers::pi / 180;
  EXPECT_NEAR(l.joints[3].pressure_angle / degree, 22.11082806319108, 1e-11);
  EXPECT_NEAR(l.joints[4].pressure_angle / degree, 19.791093759784818, 1e-11);

  form = epicyclic_form();
  form.bodies[2].points[1].second = {0.044, 0};
  form.joints[3].module = 0.002;
  EXPECT_THAT(
      form_problems(form),
      ElementsAre("joint.3.module_mm: wheels of 20 and 30 teeth, module 2, need 50 mm, the centres are 44 mm "
                  "apart: the teeth would overlap; move the centres, or take module 1.76"));
}

TEST(LinkageForm, TakesPitchRadii) {
  LinkageForm form = epicyclic_form();
  form.joints[3].teeth.reset(), form.joints[4].teeth.reset();
  form.joints[3].pitch_radii = {0.02, 0.03};
  form.joints[4].pitch_radii = {0.03, 0.08};
  std::vector<FormProblem> problems;
  const Linkage l = linkage_of(form, problems);
  ASSERT_THAT(problems, IsEmpty());
  EXPECT_EQ(l.joints[3].ratio, -0.02 / 0.03);
  EXPECT_EQ(l.joints[4].ratio, 0.03 / 0.08);
  form.joints[3].pitch_radii = {0.018, 0.03};
  EXPECT_THAT(form_problems(form),
              ElementsAre("joint.3.pitch_radii: the pitch circles of gear 'sun gear' touch at 48 mm, its "
                          "centres are 50 mm apart; move the centres, or change the radii; teeth or ratio "
                          "take any distance"));
  form.joints[3].pitch_radii = {0.02};
  EXPECT_THAT(form_problems(form), ElementsAre("joint.3.pitch_radii: gear 'sun gear' has no two pitch radii "
                                               "above 0; write two, that of the first wheel first"));
  form.joints[3].pitch_radii = {0.02, 0.03};
  form.joints[3].ratio = -0.5;
  EXPECT_THAT(form_problems(form),
              ElementsAre("joint.3.pitch_radii: gear 'sun gear' has ratio and pitch radii; leave one"));
}

TEST(LinkageForm, NamesWhatIsWrongWithGears) {
  LinkageForm form = epicyclic_form();
  form.joints[3].ratio = -2.0 / 3;
  EXPECT_THAT(form_problems(form),
              ElementsAre("joint.3.ratio: gear 'sun gear' has teeth and ratio; leave one"));
  form = epicyclic_form();
  form.joints[4].internal = InternalWheel::first;
  EXPECT_THAT(form_problems(form),
              ElementsAre("joint.4.internal: internal wheel 'planet' has 30 teeth, its pinion 80; the "
                          "ring needs more: swap `internal`"));
  form = epicyclic_form();
  form.joints[3].teeth = {20};
  EXPECT_THAT(form_problems(form),
              ElementsAre("joint.3.teeth: gear 'sun gear' has 1 numbers of teeth; write two, that of "
                          "the first wheel first"));
  form = epicyclic_form();
  form.joints[4].teeth.reset();
  form.joints[4].ratio = 0.375;
  EXPECT_THAT(form_problems(form),
              ElementsAre("joint.4.internal: gear 'ring gear' has a ring but no teeth; write the teeth "
                          "or the pitch radii of both wheels; a ratio of a ring is positive by itself"));
  form = epicyclic_form();
  form.joints.erase(form.joints.begin() + 2);
  EXPECT_THAT(form_problems(form),
              ElementsAre("joint.2.carrier: no body carries both 'sun.O' and 'planet.P'; name the "
                          "`carrier`, or join both wheels to one body by pins"));
  // Two links from the sun's axle to that of the planet.
  form = epicyclic_form();
  form.bodies.push_back({.name = "frame", .points = {{"O", Place{0, 0}}, {"P", Place{0.05, 0}}}});
  form.joints.push_back({.name = "frame axle", .first = "ground.O", .second = "frame.O"});
  form.joints.push_back({.name = "frame pin", .first = "frame.P", .second = "planet.P"});
  EXPECT_THAT(form_problems(form),
              ElementsAre("joint.3.carrier: both 'arm' and 'frame' carry the wheels; name one as `carrier`",
                          "joint.4.carrier: both 'arm' and 'frame' carry the wheels; name one as "
                          "`carrier`"));
}

// Three pulleys of 50 mm on the frame, at the corners of a triangle that are listed counter-clockwise.
LinkageForm pulleys_form() {
  LinkageForm form;
  const Place centres[] = {{0, 0}, {0.4, 0}, {0, 0.3}};
  form.bodies.push_back({.name = "frame"});
  BeltForm belt{.name = "belt", .length = 1.2 + full_turn * 0.05};
  for (int i = 0; i < 3; ++i) {
    const std::string point(1, static_cast<char>('A' + i)), name = "pulley " + point;
    form.bodies[0].points.emplace_back(point, centres[i]);
    form.bodies.push_back({.name = name, .points = {{point, Place{0, 0}}}});
    form.joints.push_back({.name = point, .first = "frame." + point, .second = name + "." + point});
    belt.wheels.push_back({name + "." + point, 0.05, BeltSide::inside, {}});
  }
  form.belts.push_back(std::move(belt));
  return form;
}
TEST(LinkageForm, BeltsRunRoundTheirWheelsInEitherOrder) {
  for (const bool backwards : {false, true}) {
    LinkageForm form = pulleys_form();
    if (backwards) std::reverse(form.belts[0].wheels.begin(), form.belts[0].wheels.end());
    EXPECT_THAT(form_problems(form), IsEmpty());
    std::vector<FormProblem> problems;
    const Linkage l = linkage_of(form, problems);
    ASSERT_EQ(l.belts.size(), 1u);
    EXPECT_EQ(l.belts[0].carrier, 0);
    for (const BeltWheel& wheel : l.belts[0].wheels) EXPECT_EQ(wheel.side, backwards ? -1 : 1);
  }
  LinkageForm form = pulleys_form();
  form.belts[0].length = 1.5;
  EXPECT_THAT(
      form_problems(form),
      ElementsAre("belt.0.length_mm: belt 'belt' is 1514.159 mm long over its wheels, not 1500 mm; move a "
                  "wheel, or leave the length out"));
}

// A pinion on the frame and a rack beneath it.
LinkageForm rack_form() {
  LinkageForm form;
  form.bodies = {{.name = "frame", .points = {{"O", Place{0, 0}}, {"L", Place{0.1, -0.03}}}},
                 {.name = "pinion", .points = {{"O", Place{0, 0}}}},
                 {.name = "bar", .points = {{"L", Place{0.1, -0.03}}}}};
  form.joints = {{.name = "O", .first = "frame.O", .second = "pinion.O"},
                 {.name = "way", .type = JointType::prismatic, .first = "frame.L", .second = "bar.L"},
                 {.name = "teeth", .type = JointType::rack, .first = "pinion.O", .second = "bar.L"}};
  form.drawn = true;
  return form;
}
TEST(LinkageForm, RacksHaveTheRadiusOfTheirDrawing) {
  LinkageForm form = rack_form();
  std::vector<FormProblem> problems;
  const LinkageJoint rack = linkage_of(form, problems).joints[2];
  EXPECT_TRUE(problems.empty());
  EXPECT_NEAR(rack.radius, 0.03, 1e-16);
  // The pinion stands as it is drawn, 100 mm before the point of the rack.
  EXPECT_NEAR(rack.phase, -0.1 / 0.03, 1e-14);
  form.joints[2].direction = pi;
  EXPECT_NEAR(linkage_of(form, problems).joints[2].radius, -0.03, 1e-16);
  form.joints[2].radius = 0.025;
  EXPECT_THAT(
      form_problems(form),
      ElementsAre("joint.2.radius_mm: the pinion of rack 'teeth' has a radius of 25 mm and is drawn 30 mm "
                  "from the pitch line; move the point of the rack or the pinion, or leave the radius out"));
  form.drawn = false;
  form.joints[2].radius.reset();
  EXPECT_THAT(
      form_problems(form),
      ElementsAre("joint.2.radius_mm: the pinion of rack 'teeth' has no radius; give it, negative where the "
                  "centre lies to the right of the direction of the rack"));
}

}  // namespace
}  // namespace linkwright::planar
