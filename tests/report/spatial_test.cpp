// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/spatial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/report/sample_spatial.h"

namespace linkwright::report {
namespace {

study::Scene wheel(double axis_x, double axis_y, double axis_z) {
  study::Scene scene;
  scene.input = {0};
  scene.points = {{"C", {1}, {2}, {3}}, {"A", {1 + axis_x}, {2 + axis_y}, {3 + axis_z}}};
  scene.discs = {{"wheel", 0, 1, 0.3, 0.2}};
  return scene;
}

TEST(Spatial, ViewpointsAreRightHandedAndAlignTheViews) {
  for (const Viewpoint& v : viewpoints) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      EXPECT_EQ(v.right[a] * v.up[b] - v.right[b] * v.up[a], v.back[k]) << v.name;
    }
  }
  // The rear and the side view share what is up, the rear and the top view what is right.
  EXPECT_EQ(viewpoints[0].up, viewpoints[1].up);
  EXPECT_EQ(viewpoints[0].right, viewpoints[2].right);
}

TEST(Spatial, SeenFromBehindTheLeftIsLeft) {
  study::Scene scene;
  scene.input = {0, 1};
  scene.points = {{"A", {1}, {2, 5}, {3}}, {"B", {1}, {2}}};
  scene.vectors = {{"f", study::Scene::Quantity::force, "N", 0, {0}, {0}, "", {7, 8}}};
  const study::Scene rear = seen_from(scene, viewpoints[0]);
  const Place a = place(rear, 0, 1);
  EXPECT_EQ(a.x, -5);
  EXPECT_EQ(a.y, 3);
  EXPECT_EQ(a.z, -1);  // in front of the sheet is behind the car
  EXPECT_EQ(place(rear, 1, 0).y, 0);
  EXPECT_EQ(rear.vectors[0].y, (std::vector<double>{7, 8}));
}

TEST(Spatial, RowOfTakesTheSamplesOfOneSecondInput) {
  study::Scene scene;
  scene.input = {0, 1, 2};
  scene.second = {-1, 1};
  scene.status = {"done", "done", "done", "done", "no_assembly", "done"};
  scene.points = {{"A", {0, 1, 2, 3, 4, 5}, {9}, {0, 10, 20, 30, 40, 50}}};
  scene.moments = {{"m", "N m", 0, {0, 1, 2, 3, 4, 5}}};
  EXPECT_EQ(scene.samples(), 6u);
  const study::Scene row = row_of(scene, 1);
  EXPECT_EQ(row.samples(), 3u);
  EXPECT_EQ(row.points[0].x, (std::vector<double>{3, 4, 5}));
  EXPECT_EQ(row.points[0].y, (std::vector<double>{9}));
  EXPECT_EQ(row.points[0].z, (std::vector<double>{30, 40, 50}));
  EXPECT_EQ(row.moments[0].value, (std::vector<double>{3, 4, 5}));
  EXPECT_EQ(row.status[1], "no_assembly");
}

TEST(Spatial, WheelsAreRectanglesEdgeOnAndCirclesFromTheSide) {
  const study::Scene edge = seen_from(wheel(0, -1, 0), viewpoints[0]);
  Box box;
  for (const Place& p : wheel_outline(edge, edge.discs[0], 0)) box.add(p.x, p.y);
  // Circles of 48 places have one at each end of the diameters.
  EXPECT_NEAR(box.width(), 0.2, 1e-12);
  EXPECT_NEAR(box.height(), 0.6, 1e-12);
  EXPECT_NEAR(box.x_min, -2.1, 1e-12);
  const study::Scene side = seen_from(wheel(0, -1, 0), viewpoints[1]);
  for (const Place& p : wheel_outline(side, side.discs[0], 0))
    EXPECT_NEAR(std::hypot(p.x + 1, p.y - 3), 0.3, 1e-12);
  const Box around = bounds(wheel(0, -1, 0));
  EXPECT_NEAR(around.width(), 0.6, 1e-12);
  EXPECT_NEAR(around.height(), 1.1, 1e-12);  // the point on the axis lies 1 m from the centre
  EXPECT_NEAR(extent(wheel(0, -0.01, 0)), 0.6, 1e-12);
}

TEST(Spatial, WheelsWithoutAnAxisAreLeftOut) {
  const study::Scene scene = wheel(0, 0, 0);
  EXPECT_TRUE(wheel_circle(scene, scene.discs[0], 0, 1, 0, 48).empty());
  EXPECT_TRUE(wheel_outline(scene, scene.discs[0], 0).empty());
}

TEST(Spatial, HelixWindsAboutItsLine) {
  const Place a{1, 0, 0}, b{1, 0, 2};
  const auto wire = helix(a, b, 0.1);
  EXPECT_EQ(wire.front().z, 0);
  EXPECT_EQ(wire.back().z, 2);
  for (std::size_t i = 1; i + 1 < wire.size(); ++i)
    EXPECT_NEAR(std::hypot(wire[i].x - 1, wire[i].y), 0.05, 1e-12);
  EXPECT_TRUE(helix(a, a, 0.1).empty());
}

TEST(Spatial, AxesRunOnAtBothEnds) {
  const auto line = beyond({{0, 0, 0}, {0, 0, 2}});
  EXPECT_DOUBLE_EQ(line.front().z, -0.3);
  EXPECT_DOUBLE_EQ(line.back().z, 2.3);
}

TEST(Spatial, TheReferenceOfAGridIsItsMiddle) {
  const auto result = test::sample_spatial();
  const study::Scene& scene = result.scenes[0];
  ASSERT_TRUE(scene.spatial());
  const std::size_t sample = reference_sample(scene);
  EXPECT_NEAR(scene.input[sample % scene.input.size()], 0, 1e-15);
  EXPECT_NEAR(scene.second[sample / scene.input.size()], 0, 1e-15);
}

TEST(Spatial, MarksWithoutAPlaceDoNotTakeTheMechanismApart) {
  auto scene = test::sample_spatial().scenes[0];
  scene.points.push_back({"roll centre", {NAN}, {0}, {0}});
  EXPECT_TRUE(assembled(scene, 0));
  EXPECT_GT(reference_sample(scene), 0u);
  scene.status[0] = "no_assembly";
  EXPECT_FALSE(assembled(scene, 0));
  scene.status.clear();
  EXPECT_FALSE(assembled(scene, 0));
}

}  // namespace
}  // namespace linkwright::report
