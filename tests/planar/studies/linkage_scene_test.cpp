// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/linkage_scene.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/planar/linkage/samples.h"
#include "planar/studies.h"

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
  EXPECT_EQ(forces, 5u);  // arrows of the joints, and of the shaking force
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

TEST(LinkageScene, DrawsLoadsAsTheyAct) {
  LinkageSample sample = four_bar_sample();
  Linkage& l = sample.linkage;
  const int crank = l.joints[static_cast<std::size_t>(l.driven[0])].second.body;
  const BodyPoint tip{crank, 1};
  l.springs.push_back({.name = "spring", .first = {0, 0}, .second = tip, .stiffness = 100});
  l.forces.push_back({.name = "push", .point = tip, .force = {3, 4}});
  l.forces.push_back({.name = "thrust", .point = tip, .force = {0, 2}, .turns_with_body = true});
  l.torques.push_back({.name = "brake", .body = crank, .torque = -0.5});
  const study::Scene s = scene_of(sample);
  const auto vector = [&](std::string_view name) {
    const auto found = std::ranges::find(s.vectors, name, &study::Scene::Vector::name);
    return found == s.vectors.end() ? study::Scene::Vector{} : *found;
  };
  const std::string on = ", load on " + l.bodies[static_cast<std::size_t>(crank)].name;
  const study::Scene::Vector push = vector("push" + on), thrust = vector("thrust" + on);
  ASSERT_EQ(push.x.size(), 37u);
  ASSERT_EQ(thrust.x.size(), 37u);
  const study::Scene::Frame& frame = s.frames[static_cast<std::size_t>(crank)];
  for (std::size_t i = 0; i < 37; ++i) {
    EXPECT_EQ(push.x[i], 3);
    EXPECT_EQ(push.y[i], 4);
    EXPECT_NEAR(thrust.x[i], -2 * std::sin(frame.angle[i]), 1e-15);
    EXPECT_NEAR(thrust.y[i], 2 * std::cos(frame.angle[i]), 1e-15);
  }
  const auto brake = std::ranges::find(s.moments, "brake" + on, &study::Scene::Moment::name);
  ASSERT_NE(brake, s.moments.end());
  EXPECT_EQ(brake->value, std::vector<double>(37, -0.5));
}

TEST(LinkageScene, DrawsWhatDoesNotCloseWithItsGap) {
  const study::Result r = test::run_text(R"(schema = 1
kind = "analysis"
[mechanism]
type = "planar.four_bar"
[mechanism.parameters]
crank_mm   = 100
coupler_mm = 80
rocker_mm  = 90
ground_mm  = 400
[drive]
speed_rpm = 60
[sweep.crank_angle]
from_deg = 0
to_deg   = 90
samples  = 4
[output]
quantities = ["position"]
)");
  EXPECT_EQ(to_string(r.headline),
            "The linkage assembles nowhere in the sweep: coupler + rocker cannot close, a gap of 130 mm is "
            "left at 0°.");
  const study::Scene& s = r.scenes.at(0);
  ASSERT_EQ(s.bodies.back().style, study::Scene::BodyStyle::gap);
  EXPECT_EQ(s.bodies.back().name, "coupler + rocker cannot close");
  const auto there = [&](int point, std::size_t i) {
    const auto& p = s.points[static_cast<std::size_t>(point)];
    return std::complex<double>(p.x[p.x.size() == 1 ? 0 : i], p.y[p.y.size() == 1 ? 0 : i]);
  };
  const std::vector<int>& ends = s.bodies.back().points;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(s.status[i], "no_assembly");
    const double apart = std::abs(std::polar(0.1, static_cast<double>(i) * pi / 6) - 0.4);
    EXPECT_NEAR(std::abs(there(ends[0], i) - there(ends[1], i)), apart - 0.17, 1e-15);
  }
  // Each body ends at its side of the gap.
  for (const study::Scene::Body& b : s.bodies)
    if (b.name == "coupler") {
      EXPECT_LE(std::abs(there(b.points[1], 1) - there(ends[0], 1)), 1e-15);
    }
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
