// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/inscribed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/parallel/workspace/rays.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

struct Setting {
  WorkspaceTask task;
  WorkspaceMap map;
  explicit Setting(const WorkspaceTask& t) : task(t), map(workspace(t, RunContext())) {}
  Inscribed run(InscribedTask shape, const RunContext& context = RunContext()) const {
    shape.conditions = task.conditions;
    return inscribed(map, passing(map), shape, context);
  }
};
const Setting& five_bar() {
  static const Setting out(
      {.conditions = {.robot = reference_five_bar()}, .grid = {{-0.7, -0.7, 0}, {0.7, 0.7, 0}, 0.02}});
  return out;
}
const Setting& delta_setting() {
  static const Setting out({.conditions = {.robot = reference_delta(),
                                           .drives = reference_drives(),
                                           .assembly = -1,
                                           .min_transmission = 0.5},
                            .grid = {{-0.7, -0.7, -1.2}, {0.7, 0.7, -0.2}, 0.04}});
  return out;
}

// Everything in the body passes: points drawn at random. `shrink`: how much of the body, less than what the
// search may have missed between its points.
void passes(const Setting& s, InscribedShape shape, const Inscribed& found, double shrink) {
  RandomStream random({.seed = 9});
  int failed = 0;
  for (int n = 0; n < 20000; ++n) {
    Vec3 d{random.uniform(-1, 1), random.uniform(-1, 1), found.half.z > 0 ? random.uniform(-1, 1) : 0};
    const double across = d.x * d.x + d.y * d.y;
    if (shape == InscribedShape::cylinder && across > 1) continue;
    if (shape == InscribedShape::ball && across + d.z * d.z > 1) continue;
    d = shrink * d;
    failed += check_pose(s.task.conditions, {found.centre + Vec3{d.x * found.half.x, d.y * found.half.y,
                                                                 d.z * found.half.z}}) != Criterion::none;
  }
  EXPECT_EQ(failed, 0);
}

TEST(WorkspaceInscribed, CircleOfTheFiveBar) {
  const Inscribed found = five_bar().run({.shape = InscribedShape::ball});
  EXPECT_EQ(found.status, Status::done);
  // The body is as wide as the rings, 0.1 to 0.6 about the pivots, and touching all four circles: centre 0.35
  // from both pivots, which are 0.15 from the middle. Two thirds of a step of the search, 1e-4 grid steps,
  // and the points on the circle, half a degree apart, are what is missing.
  EXPECT_NEAR(found.half.x, 0.25, 5e-6);
  EXPECT_NEAR(found.centre.x, 0, 2e-5);
  EXPECT_NEAR(std::abs(found.centre.y), std::sqrt(0.35 * 0.35 - 0.15 * 0.15), 2e-5);
  EXPECT_EQ(found.half.z, 0);
  EXPECT_DOUBLE_EQ(found.measure, pi * found.half.x * found.half.x);
  EXPECT_LT(found.on_grid, found.measure);
  EXPECT_GT(found.on_grid, 0.6 * found.measure);
  passes(five_bar(), InscribedShape::ball, found, 1 - 1e-3);
}

TEST(WorkspaceInscribed, RectangleOfTheFiveBar) {
  const Inscribed found = five_bar().run({.shape = InscribedShape::box});
  EXPECT_EQ(found.status, Status::done);
  EXPECT_GE(found.measure, found.on_grid);
  passes(five_bar(), InscribedShape::box, found, 1 - 1e-3);
  // Above both holes (centres at +-0.15, radius 0.1) it would stand on them, y >= 0.1, and its upper corners
  // on the arcs of radius 0.6: the best of those is the second route.
  double best = 0;
  for (int i = 1; i < 40000; ++i) {
    const double x = 0.45 * i / 40000, top = std::sqrt(0.36 - (x + 0.15) * (x + 0.15));
    const double bottom = x >= 0.15 ? 0.1 : std::sqrt(std::max(0.0, 0.01 - (0.15 - x) * (0.15 - x)));
    best = std::max(best, 2 * x * (top - bottom));
  }
  EXPECT_NEAR(found.measure, best, 1e-3 * best);
}

TEST(WorkspaceInscribed, CylinderOfGivenHeightOnTheAxis) {
  const double height = 0.2;
  const Inscribed found = delta_setting().run({.axis = Vec3{0, 0, 0}, .height = height});
  EXPECT_EQ(found.status, Status::done);
  EXPECT_EQ(found.centre.x, 0);
  EXPECT_EQ(found.centre.y, 0);
  EXPECT_DOUBLE_EQ(2 * found.half.z, height);
  EXPECT_DOUBLE_EQ(found.measure, pi * found.half.x * found.half.x * height);
  passes(delta_setting(), InscribedShape::cylinder, found, 1 - 1e-3);
  // The other route: how far rays get from the axis at each height; the least of a window, the largest of
  // those.
  const double step = 0.005;
  std::vector<double> reach;
  for (double z = -1.1; z < -0.3; z += step) {
    const Rays rays = position_rays(delta_setting().task.conditions, {{0, 0, z}}, directions_around(72),
                                    {.longest = 0.8, .step = 0.02, .tolerance = 1e-7}, RunContext());
    double least = 1;
    for (const Ray& ray : rays.ray) least = std::min(least, ray.reach());
    reach.push_back(least);
  }
  double best = 0;
  const auto window = static_cast<std::ptrdiff_t>(std::lround(height / step)) + 1;
  for (auto first = reach.begin(); reach.end() - first >= window; ++first)
    best = std::max(best, *std::min_element(first, first + window));
  // Windows begin at whole steps: the best one may be half a step off, on boundaries at 45 deg or steeper.
  EXPECT_NEAR(found.half.x, best, step);
  EXPECT_GT(found.half.x, best - 1e-4);
}

// The former best design for the mean index has its constraint singularity within the cylinder it was made
// for.
TEST(WorkspaceInscribed, TheConstraintMakesCylindersSmaller) {
  const Value& expected =
      test::at(computed("delta-constraint-workspace"), "cylinder_height_250_top_at_0_29446465");
  const Robot robot = delta_of(test::at(inputs("delta-constraint-workspace"), "robots.mean"));
  const double top = -0.29446465;
  const auto widest = [&](double least) {
    const Setting s(
        {.conditions = {.robot = robot, .assembly = -1, .constraint = 1, .least_constraint = least},
         .grid = {{-0.4, -0.4, top - 0.25}, {0.4, 0.4, top}, 0.025}});
    return s.run({.axis = Vec3{0, 0, 0}, .height = 0.25});
  };
  for (const auto& [key, least] : {std::pair{"index>=0.1", 0.1}, {"index>=0.2", 0.2}}) {
    const Inscribed found = widest(least);
    EXPECT_NEAR(2 * found.half.x, test::number_at(*expected.find(key), "largest_diameter_m"), 1e-5);
    EXPECT_TRUE(found.proven);
  }
  // By the sign alone the body touches the singularity; what can be proven keeps away from it by the floor.
  const Inscribed by_sign = widest(0);
  const double diameter = test::number_at(*expected.find("index>=0"), "largest_diameter_m");
  EXPECT_TRUE(by_sign.proven);
  EXPECT_LT(2 * by_sign.half.x, diameter);
  EXPECT_NEAR(2 * by_sign.half.x, diameter, 1e-3);
  // The index is 0 on the upper rim, in the direction of a leg.
  const auto index = [&](double radius) {
    const RegularAt there = regular_at(robot, {{radius, 0, top}}, all_positive, 1);
    return there.constraint * there.marks.constraint;
  };
  double low = 0.2, high = 0.4;
  for (int k = 0; k < 60; ++k) (index(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  EXPECT_NEAR(2 * low, diameter, 1e-5);
}

TEST(WorkspaceInscribed, CylindersAnywhere) {
  const Inscribed on_axis = delta_setting().run({.axis = Vec3{0, 0, 0}});
  const Inscribed anywhere = delta_setting().run({});
  const Inscribed flat = delta_setting().run({.ratio = 0.25});
  for (const Inscribed& found : {on_axis, anywhere, flat}) {
    EXPECT_EQ(found.status, Status::done);
    EXPECT_EQ(found.half.x, found.half.y);
    EXPECT_GT(found.measure, found.on_grid);
    passes(delta_setting(), InscribedShape::cylinder, found, 1 - 1e-3);
  }
  EXPECT_GT(anywhere.measure, 0.999 * on_axis.measure);
  EXPECT_NEAR(flat.half.z / flat.half.x, 0.25, 1e-12);
  EXPECT_LE(flat.measure, 1.001 * anywhere.measure);
}

TEST(WorkspaceInscribed, BallAndBoxOfTheDelta) {
  const Inscribed ball = delta_setting().run({.shape = InscribedShape::ball});
  const Inscribed box = delta_setting().run({.shape = InscribedShape::box});
  passes(delta_setting(), InscribedShape::ball, ball, 1 - 1e-3);
  passes(delta_setting(), InscribedShape::box, box, 1 - 1e-3);
  EXPECT_NEAR(ball.measure, 4 * pi / 3 * std::pow(ball.half.x, 3), 1e-12);
  EXPECT_NEAR(box.measure, 8 * box.half.x * box.half.y * box.half.z, 1e-12);
  // The ball holds a box, the box a ball.
  EXPECT_GT(box.measure, 8 * std::pow(ball.half.x / std::sqrt(3), 3));
  EXPECT_GT(ball.half.x, 0.999 * std::min({box.half.x, box.half.y, box.half.z}));
}

TEST(WorkspaceInscribed, NothingFitsInNothing) {
  const Setting& s = five_bar();
  const Inscribed found =
      inscribed(s.map, NodeSet(s.map.count()),
                {.conditions = s.task.conditions, .shape = InscribedShape::box}, RunContext());
  EXPECT_EQ(found.status, Status::infeasible);
  EXPECT_EQ(found.measure, 0);
  EXPECT_EQ(delta_setting().run({.height = 2}).status, Status::infeasible);
}

TEST(WorkspaceInscribed, StaysInItsSet) {
  // The half of the plane above the pivots is one set, the half below another.
  const Setting& s = five_bar();
  NodeSet below = passing(s.map);
  for (std::size_t n = 0; n < below.size(); ++n) below[n] &= s.map.position(n).y < 0.01;
  const Inscribed found =
      inscribed(s.map, below, {.conditions = s.task.conditions, .shape = InscribedShape::ball}, RunContext());
  EXPECT_NEAR(found.half.x, 0.25, 5e-6);
  EXPECT_LT(found.centre.y, -0.3);
}

TEST(WorkspaceInscribed, StopsWithTheBestSoFar) {
  RunContext context;
  context.cancel();
  const Inscribed found = five_bar().run({.shape = InscribedShape::ball}, context);
  EXPECT_EQ(found.status, Status::cancelled);
  EXPECT_GT(found.measure, found.on_grid);
}

TEST(WorkspaceInscribed, RefusesTasksWithoutSense) {
  EXPECT_THROW(five_bar().run({}), ContractError);  // a cylinder in the plane
  EXPECT_THROW(delta_setting().run({.height = 0.2, .ratio = 1}), ContractError);
  EXPECT_THROW(delta_setting().run({.shape = InscribedShape::ball, .height = 0.2}), ContractError);
  EXPECT_THROW(
      inscribed(delta_setting().map, {}, {.conditions = delta_setting().task.conditions}, RunContext()),
      ContractError);
}

}  // namespace
}  // namespace linkwright::parallel
