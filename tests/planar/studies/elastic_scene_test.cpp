// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/elastic_scene.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "linkwright/planar/linkage/kernel.h"
#include "planar/elastic_bodies.h"

namespace linkwright::planar {
namespace {

using namespace test;

struct Bent {
  Linkage rigid = four_bar();
  ElasticLinkage elastic = made(rigid, {strip(2, 4)}, {{0.7, 10, 0}});
  LinkageMotion motion{elastic.plan};
  std::vector<InputMotion> inputs{{0.7, 10, 0}};
  Bent() {
    for (const InputDrive& c : elastic.free) inputs.push_back({c.value, c.rate, 0});
    inputs[2] = {0.02, 0.6, 8};
    inputs[3] = {0.01, -0.4, -30};
  }
  // At a time later, along the Taylor series of the inputs.
  PartState<double> line(double later) {
    std::vector<InputMotion> now = inputs;
    for (InputMotion& i : now) {
      i.value += later * i.rate + later * later * i.acceleration / 2;
      i.rate += later * i.acceleration;
    }
    solve_motion(elastic.plan, now, motion);
    return chord_state(elastic, elastic.pieces[0], motion);
  }
};

TEST(LinkageElasticScene, LineOfABentBodyMovesAsItsEnds) {
  Bent b;
  const double h = 1e-5;  // differences: h^2 = 1e-10 of the third derivatives, and rounding over h^2
  const PartState<double> before = b.line(-h), after = b.line(h), now = b.line(0);
  EXPECT_NEAR(norm(now.direction), 1, 1e-14);
  const math::Vec2 end = point_on(now, {0.4, 0});
  const math::Vec2 there =
      point_motion(b.elastic.plan, b.motion, b.elastic.pieces[0].bodies.back(), 0.4).position;
  EXPECT_NEAR(cross(now.direction, there - now.origin), 0, 1e-15);
  EXPECT_LT(norm(end - there), 1e-3);  // it is shorter by the square of the bend
  EXPECT_GT(norm(end - there), 1e-7);
  const double angles[3] = {angle_of(before.direction), angle_of(now.direction), angle_of(after.direction)};
  EXPECT_NEAR(now.speed, (angles[2] - angles[0]) / (2 * h), 1e-6);
  EXPECT_NEAR(now.angular_acceleration, (after.speed - before.speed) / (2 * h),
              1e-5 * std::abs(now.angular_acceleration));
  EXPECT_LT(norm(now.velocity - (1 / (2 * h)) * (after.origin - before.origin)), 1e-7);
  EXPECT_LT(norm(now.acceleration - (1 / (2 * h)) * (after.velocity - before.velocity)), 1e-5);
}

TEST(LinkageElasticScene, TakesARoundScaleThatKeepsDeflectionsInThePicture) {
  Bent b;
  b.line(0);
  const ElasticRecord record = elastic_record(b.rigid, b.elastic, b.motion, nullptr, 0);
  ASSERT_EQ(record.record.bodies.size(), b.rigid.bodies.size());
  const LinkagePlan rigid = plan_linkage(b.rigid).plan;
  const BentBody bent = bent_body(b.elastic, b.elastic.pieces[0], b.motion);
  const study::Scene scene = elastic_scene(b.rigid, rigid, b.elastic.pieces, {record, record}, {}, {});
  const std::string title = to_string(scene.title);
  const double scale = std::stod(title.substr(title.find("drawn ") + 6));
  EXPECT_LE(scale * std::abs(bent.largest), 0.05 * rigid.size * (1 + 1e-9));
  EXPECT_GT(2.5 * scale * std::abs(bent.largest), 0.05 * rigid.size);  // the next one of 1, 2, 5, 10 does not
  // One line through the nodes in the place of the bar, beside the unbent one.
  EXPECT_EQ(std::count_if(scene.bodies.begin(), scene.bodies.end(),
                          [](const study::Scene::Body& s) { return s.name == "coupler"; }),
            4);
  EXPECT_EQ(std::count_if(scene.bodies.begin(), scene.bodies.end(),
                          [](const study::Scene::Body& s) { return s.name == "coupler, unbent"; }),
            1);
}

// A point off the beam hangs on its nearest node, and points that nothing is known of are not drawn.
TEST(LinkageElasticScene, DrawsPointsBesideTheBeam) {
  Bent b;
  b.rigid.bodies[2].points.push_back({"P", {0.3, 0.1}});
  b.elastic = made(b.rigid, {strip(2, 4)}, {{0.7, 10, 0}});
  b.line(0);
  ElasticRecord record = elastic_record(b.rigid, b.elastic, b.motion, nullptr, 0), unknown = record;
  unknown.record.bodies.clear();
  unknown.away.clear();
  const study::Scene scene =
      elastic_scene(b.rigid, plan_linkage(b.rigid).plan, b.elastic.pieces, {record, unknown}, {{2, 2}}, 1.0);
  EXPECT_EQ(scene.title, "");  // nothing is enlarged
  int first = 0;
  for (int k = 0; k < 2; ++k)
    first += static_cast<int>(b.rigid.bodies[static_cast<std::size_t>(k)].points.size());
  const study::Scene::Point& p = scene.points[static_cast<std::size_t>(first) + 2];
  const math::Vec2 there =
      point_motion(b.elastic.plan, b.motion, b.elastic.pieces[0].bodies[3], {0.3, 0.1}).position;
  EXPECT_NEAR(p.x[0], there.x, 1e-14);
  EXPECT_NEAR(p.y[0], there.y, 1e-14);
  EXPECT_TRUE(std::isnan(p.x[1]));
  bool hangs = false;
  for (const study::Scene::Body& s : scene.bodies)
    hangs = hangs || (s.name == "coupler" && s.points.size() == 2 && s.points[1] == first + 2);
  EXPECT_TRUE(hangs);
}

}  // namespace
}  // namespace linkwright::planar
