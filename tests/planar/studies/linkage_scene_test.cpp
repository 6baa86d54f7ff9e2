#include "linkwright/planar/studies/linkage_scene.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/planar/linkage/samples.h"

namespace linkwright::planar {
namespace {

study::Scene scene_of(const LinkageSample& sample) {
  const LinkagePlan p = plan_linkage(sample.linkage).plan;
  LinkageMotion motion(p);
  LinkageForces forces;
  std::vector<LinkageRecord> records;
  for (int i = 0; i <= 36; ++i) {
    const double value = sample.from[0] + (sample.to[0] - sample.from[0]) * i / 36;
    solve_motion(p, std::vector<InputMotion>{{value, sample.speed, 0}}, motion);
    solve_forces(sample.linkage, p, motion, 0, value, forces);
    records.push_back(record_of(sample.linkage, p, motion, &forces, value));
  }
  return linkage_scene(sample.linkage, p, records, sample.traces, "O_angle_rad", "O angle");
}

TEST(LinkageScene, DrawsBodiesJointsTracesAndArrows) {
  const study::Scene s = scene_of(four_bar_sample());
  EXPECT_EQ(s.samples(), 37u);
  ASSERT_EQ(s.bodies.size(), 4u);
  EXPECT_EQ(s.bodies[0].style, study::Scene::BodyStyle::ground);
  EXPECT_EQ(s.bodies[1].style, study::Scene::BodyStyle::bar);
  EXPECT_EQ(s.bodies[2].style, study::Scene::BodyStyle::plate);  // coupler with its point
  EXPECT_EQ(s.traces.size(), 1u);
  EXPECT_TRUE(s.traces[0].closed);
  std::size_t forces = 0;
  for (const auto& v : s.vectors) {
    EXPECT_TRUE(v.x.size() == 37 || v.x.size() == 1);
    forces += v.quantity == study::Scene::Quantity::force;
  }
  EXPECT_EQ(forces, 5u);  // of the joints, and the shaking force
  ASSERT_EQ(s.moments.size(), 1u);
  // Bodies are rigid: the drawn coupler keeps its length.
  const auto& points = s.bodies[2].points;
  const auto length = [&](std::size_t i) {
    const auto &a = s.points[static_cast<std::size_t>(points[0])],
               &b = s.points[static_cast<std::size_t>(points[1])];
    return std::hypot(a.x[i] - b.x[i], a.y[i] - b.y[i]);
  };
  for (std::size_t i = 1; i < 37; ++i) EXPECT_NEAR(length(i), length(0), 1e-14);
}

TEST(LinkageScene, DrawsSlidersAsBlocksOnTheirGuides) {
  const study::Scene s = scene_of(slider_crank_sample());
  int guides = 0, blocks = 0;
  for (const auto& body : s.bodies) {
    guides += body.style == study::Scene::BodyStyle::guide;
    blocks += body.name == "slider" && body.points.size() == 4;
  }
  EXPECT_EQ(guides, 1);
  EXPECT_EQ(blocks, 1);
}

}  // namespace
}  // namespace linkwright::planar
