// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/elimination.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/planar/linkage/samples.h"
#include "planar/elastic_bodies.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;
using namespace test;

// Accelerations of the free inputs and the power of the drives by both routes.
void expect_same(const Linkage& l, const LinkagePlan& p, const std::vector<bool>& free,
                 std::vector<InputMotion> inputs, double tolerance) {
  LinkageDynamics masses(l, p, free), forces(l, p, free, AccelerationRoute::joint_forces);
  std::vector<InputMotion> others = inputs;
  ASSERT_EQ(masses.solve(0.1, inputs), Status::done);
  ASSERT_EQ(forces.solve(0.1, others), Status::done);
  double largest = 0;
  for (const InputMotion& i : inputs) largest = std::max(largest, std::abs(i.acceleration));
  for (std::size_t k = 0; k < inputs.size(); ++k)
    EXPECT_NEAR(others[k].acceleration, inputs[k].acceleration, tolerance * largest) << k;
  EXPECT_NEAR(forces.power, masses.power, tolerance * (1 + std::abs(masses.power)));
  EXPECT_TRUE(forces.inertia().empty());
}

// Pieces of a beam are alike, so the mass matrix of n of them has a condition of order n^4: 2e7 for 64.
TEST(LinkageElimination, AgreesWithTheMassMatrixOnElasticBodies) {
  for (const int n : {1, 4, 16, 64}) {
    SCOPED_TRACE(n);
    const double tolerance = 1e-11 + 100 * 2.2e-16 * std::pow(n, 4);
    ElasticBody rod = strip(2, n);
    rod.damping = 1e-5;
    Linkage l = slider_crank();
    l.gravity = {0, -9.81};
    const ElasticLinkage e = made(l, {rod}, {{0.6, 100, 0}});
    std::vector<InputMotion> inputs{{0.6, 100, 30}};
    for (std::size_t k = 0; k < e.free.size(); ++k) {
      const double wave = std::sin(1.0 + 2.0 * static_cast<double>(k)) / n;
      inputs.push_back({e.free[k].value + 0.02 * wave, e.free[k].rate + wave, 0});
    }
    std::vector<bool> free(inputs.size(), true);
    free[0] = false;
    expect_same(e.linkage, e.plan, free, inputs, tolerance);
    free[0] = true;
    inputs[0].acceleration = 0;
    expect_same(e.linkage, e.plan, free, inputs, tolerance);
  }
}

TEST(LinkageElimination, AgreesOnTwoElasticBodiesOfAFourBar) {
  const ElasticLinkage e = made(four_bar(), {strip(2, 5), strip(3, 3)}, {{0.7, 20, 0}});
  std::vector<InputMotion> inputs{{0.7, 20, -4}};
  for (const InputDrive& c : e.free) inputs.push_back({c.value + 0.01, c.rate + 0.1, 0});
  std::vector<bool> free(inputs.size(), true);
  free[0] = false;
  expect_same(e.linkage, e.plan, free, inputs, 1e-11);
}

// Slides, slots, general groups, several loops, points without mass.
TEST(LinkageElimination, AgreesOnEveryKindOfJoint) {
  int compared = 0;
  for (const LinkageSample& s : linkage_samples()) {
    SCOPED_TRACE(s.name);
    Linkage l = s.linkage;
    set_uniform_all(l, 1);
    for (std::size_t b = 1; b < l.bodies.size(); ++b)
      if (l.bodies[b].points.size() == 1 && l.joints.size() > 1) l.bodies[b].mass = BodyMass{0.4, 0, 0};
    const LinkagePlan p = plan_linkage(l).plan;
    if (!LinkageElimination::takes(p) || !p.has_masses || p.inputs() == 0) continue;
    std::vector<InputMotion> inputs;
    for (const double value : s.from) inputs.push_back({value + 0.1, 1.5, 0});
    LinkageDynamics masses(l, p, std::vector<bool>(p.inputs(), true));
    std::vector<InputMotion> copy = inputs;
    if (masses.solve(0, copy) != Status::done) continue;
    expect_same(l, p, std::vector<bool>(p.inputs(), true), inputs, 1e-9);
    ++compared;
  }
  EXPECT_GT(compared, 10);
}

TEST(LinkageElimination, IsTakenWhereItIsCheaper) {
  const ElasticLinkage few = made(slider_crank(), {strip(2, 3)}, {{0.6, 1, 0}}),
                       many = made(slider_crank(), {strip(2, 12)}, {{0.6, 1, 0}});
  EXPECT_EQ(cheaper_route(few.linkage, few.plan, 3), AccelerationRoute::mass_matrix);
  EXPECT_EQ(cheaper_route(many.linkage, many.plan, 12), AccelerationRoute::joint_forces);
  Linkage rough = many.linkage;
  rough.joints[0].friction = 0.1;
  EXPECT_EQ(cheaper_route(rough, many.plan, 12), AccelerationRoute::mass_matrix);
  EXPECT_THAT(message([&] {
                LinkageDynamics(rough, many.plan, std::vector<bool>(13, true),
                                AccelerationRoute::joint_forces);
              }),
              HasSubstr("joint forces are wanted of a linkage with friction"));
  Linkage geared = grounded({{"O", {0, 0}}, {"P", {1, 0}}});
  add_body(geared, "one", {{"O", {0, 0}}});
  add_body(geared, "two", {{"P", {0, 0}}});
  add_pin(geared, "O", "ground.O", "one.O");
  add_pin(geared, "P", "ground.P", "two.P");
  add_gear(geared, "mesh", "one", "two", -2, 0);
  add_drive(geared, "O");
  set_uniform_all(geared, 1);
  const LinkagePlan p = plan_linkage(geared).plan;
  EXPECT_EQ(cheaper_route(geared, p, 12), AccelerationRoute::mass_matrix);
  EXPECT_THAT(message([&] { LinkageElimination(p, {true}); }), HasSubstr("the linkage has gears"));
}

TEST(LinkageElimination, TellsFreeInputsThatMoveNoMass) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "arm", "O", "A", 1);
  add_pin(l, "O", "ground.O", "arm.O");
  add_drive(l, "O");
  l.bodies[1].mass = BodyMass{0, 0, 0};
  const LinkagePlan p = plan_linkage(l).plan;
  std::vector<InputMotion> inputs{{0.3, 1, 0}};
  LinkageDynamics dynamics(l, p, {true}, AccelerationRoute::joint_forces);
  EXPECT_EQ(dynamics.solve(0, inputs), Status::singular);
  EXPECT_TRUE(std::isnan(inputs[0].acceleration));
}

}  // namespace
}  // namespace linkwright::planar
