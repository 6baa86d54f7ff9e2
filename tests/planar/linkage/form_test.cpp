// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/form.h"

#include <gmock/gmock.h>

#include <numbers>

#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/plan.h"
#include "linkwright/planar/linkage/samples.h"

namespace linkwright::planar {
namespace {

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

}  // namespace
}  // namespace linkwright::planar
