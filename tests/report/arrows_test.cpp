// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/arrows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"

namespace linkwright::report {
namespace {

using study::Scene;

// A scene 2 m wide in which one force grows from 100 N to 400 N and another stays.
Scene pulled() {
  Scene scene;
  scene.input = {0, 1, 2, 3};
  scene.points = {{"A", {0}, {0}}, {"B", {2}, {1}}};
  scene.vectors = {{"pull", Scene::Quantity::force, "N", 0, {60, 120, 180, 240}, {80, 160, 240, 320}},
                   {"weight", Scene::Quantity::force, "N", 1, {0}, {-50}},
                   {"speed", Scene::Quantity::velocity, "m/s", 1, {nan, 3, 3, 3}, {0, 4, 4, 4}}};
  scene.moments = {{"torque", "N m", 0, {1, -4, nan, 2}}};
  return scene;
}

TEST(Arrows, TheLargestIsAQuarterOfTheScene) {
  const Scene scene = pulled();
  const ArrowScale force = arrow_scale(scene, Scene::Quantity::force);
  EXPECT_DOUBLE_EQ(force.metres_per_unit * 400, 0.5);
  EXPECT_EQ(force.key_value, 200);
  EXPECT_EQ(force.unit, "N");
  const ArrowScale speed = arrow_scale(scene, Scene::Quantity::velocity);
  EXPECT_DOUBLE_EQ(speed.metres_per_unit * 5, 0.5);
  EXPECT_EQ(speed.key_value, 5);
  EXPECT_EQ(arrow_scale(scene, Scene::Quantity::acceleration).metres_per_unit, 0);
}

TEST(Arrows, ASampleThatStandsOutDoesNotMakeTheOthersVanish) {
  Scene scene = pulled();
  scene.vectors[0].x = {30, 30, 30, 1e9};
  scene.vectors[0].y = {40, 40, 40, 0};
  // The median of the largest of each sample is 50 N.
  EXPECT_DOUBLE_EQ(arrow_scale(scene, Scene::Quantity::force).metres_per_unit * 150, 0.5);
}

TEST(Arrows, NothingKnownIsNothingToDraw) {
  Scene scene = pulled();
  scene.vectors = {{"unknown", Scene::Quantity::force, "N", 0, {nan}, {nan}},
                   {"none", Scene::Quantity::force, "N", 0, {0}, {0}}};
  EXPECT_EQ(arrow_scale(scene, Scene::Quantity::force).metres_per_unit, 0);
  scene = pulled();
  scene.points.clear();
  EXPECT_EQ(arrow_scale(scene, Scene::Quantity::force).metres_per_unit, 0);
}

TEST(Arrows, TipsLieAlongTheComponents) {
  const Scene scene = pulled();
  const ArrowScale scale = arrow_scale(scene, Scene::Quantity::force);
  const Place end = tip(scene, scene.vectors[0], 3, scale);
  EXPECT_DOUBLE_EQ(end.x, 0.3);
  EXPECT_DOUBLE_EQ(end.y, 0.4);
  // A constant vector has its value at every sample.
  EXPECT_DOUBLE_EQ(tip(scene, scene.vectors[1], 2, scale).y, 1 - 50 * scale.metres_per_unit);
  EXPECT_FALSE(tip(scene, scene.vectors[2], 0, scale).finite());
  EXPECT_FALSE(tip(scene, scene.vectors[0], 9, scale).finite());
}

TEST(Arrows, ArcsTellSizeAndSign) {
  const Scene scene = pulled();
  EXPECT_EQ(largest_moment(scene), 4);
  EXPECT_EQ(value(scene.moments[0], 1), -4);
  EXPECT_TRUE(std::isnan(value(scene.moments[0], 2)));
  EXPECT_EQ(arc_turn(0), 0);
  EXPECT_DOUBLE_EQ(arc_turn(1), 2 * pi * 5 / 6);
  EXPECT_DOUBLE_EQ(arc_turn(-1), -arc_turn(1));
  EXPECT_GT(arc_turn(1e-9), pi / 7);
}

}  // namespace
}  // namespace linkwright::report
