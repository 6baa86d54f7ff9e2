// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/flat_parts.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/report/flat_scene.h"

namespace linkwright::report {
namespace {

using test::parallel_crank, test::sizes, test::Scene;

TEST(FlatParts, LieInLayersInWhichTheyPassEachOther) {
  const FlatMechanism mechanism = flat_parts(parallel_crank(), 0, sizes);
  ASSERT_EQ(mechanism.parts.size(), 4U);
  std::map<std::string, int> layers;
  for (const FlatPart& part : mechanism.parts) layers[part.name] = part.layer;
  EXPECT_EQ(layers, (std::map<std::string, int>{{"ground", 0}, {"crank", 1}, {"coupler", 2}, {"rocker", 1}}));
  EXPECT_TRUE(mechanism.crossed.empty());
  ASSERT_EQ(mechanism.pins.size(), 4U);
  EXPECT_EQ(mechanism.pins[0].first, 0);
  EXPECT_EQ(mechanism.pins[0].last, 1);
  EXPECT_EQ(mechanism.pins[1].first, 1);
  EXPECT_EQ(mechanism.pins[1].last, 2);
}

TEST(FlatParts, MeetAtPinsWhereEachHasAPointOfItsOwn) {
  Scene scene = parallel_crank();
  const int own = static_cast<int>(scene.points.size());
  scene.points.push_back(scene.points[1]);  // the end of the coupler, where the crank is
  scene.bodies[1].points[0] = own;
  const FlatMechanism mechanism = flat_parts(scene, 0, sizes);
  ASSERT_EQ(mechanism.pins.size(), 4U);
  EXPECT_EQ(mechanism.pins[1].first, 1);
  EXPECT_EQ(mechanism.pins[1].last, 2);
  EXPECT_EQ(mechanism.parts[2].holes.size(), 2U);
}

TEST(FlatParts, ContoursWithoutNamesAreNoLinks) {
  Scene scene = parallel_crank();
  const int corner = static_cast<int>(scene.points.size());
  for (const double x : {0.01, 0.02, 0.03}) scene.points.push_back({"", {x}, {x * x}});
  scene.bodies.push_back({"cam", {corner, corner + 1, corner + 2}, Scene::BodyStyle::plate});
  EXPECT_EQ(flat_parts(scene, 0, sizes).parts.size(), 4U);
}

TEST(FlatParts, PinsWithinAPlateAreItsHoles) {
  // The coupler is a plate around the pin A, which is none of its corners.
  Scene scene = parallel_crank();
  const int corner = static_cast<int>(scene.points.size());
  const std::vector<double> x = scene.points[1].x, y = scene.points[1].y;
  for (const auto& [dx, dy] : {std::pair(-0.02, -0.02), std::pair(0.1, 0.0), std::pair(-0.02, 0.02)}) {
    Scene::Point p{"corner", x, y};
    for (double& value : p.x) value += dx;
    for (double& value : p.y) value += dy;
    scene.points.push_back(std::move(p));
  }
  scene.bodies[1] = {"coupler", {corner, corner + 1, corner + 2}, Scene::BodyStyle::plate};
  const FlatMechanism mechanism = flat_parts(scene, 0, sizes);
  EXPECT_EQ(mechanism.parts[2].holes.size(), 2U);  // A, and B at a corner
  EXPECT_EQ(mechanism.parts[1].holes.size(), 2U);
  EXPECT_EQ(mechanism.parts[3].holes.size(), 2U);
}

TEST(FlatParts, TakeTheSizeOfTheMechanismWhereNothingIsGiven) {
  const FlatMechanism mechanism = flat_parts(parallel_crank(), 0, {});
  EXPECT_NEAR(mechanism.parts[0].radius, 0.025 * 0.16, 1e-12);  // it is 160 mm long
  EXPECT_NEAR(mechanism.thickness, 0.02 * 0.16, 1e-12);
}

}  // namespace
}  // namespace linkwright::report
