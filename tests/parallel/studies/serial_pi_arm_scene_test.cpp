// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/serial_pi_arm_scene.h"

#include <gmock/gmock.h>

#include <cmath>

#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

SerialPiArm arm() {
  SerialPiArm out{.base = {0.1, 0}, .offset = {0.06, -0.02}, .arm = {0.3, 0.25}};
  out.drive[0] = {.type = DriveType::pi_joint, .ratio = 0.4, .mounting = 0.5235987755982988};
  out.drive[1] = {.type = DriveType::pi_joint, .ratio = 0.4, .mounting = 0, .mirror = -1};
  return out;
}

study::Scene drawn(const SerialPiArm& a, const PerArm& angle) {
  const std::vector<double> times{0, 1};
  const std::vector<SerialSample> samples{{Status::done, angle, {0.1, 0}}, {Status::no_assembly, angle, {}}};
  return serial_arm_scene(a, {"motion", "motion", "time_s", "time"}, times, samples);
}

int index(const study::Scene& scene, std::string_view name) {
  for (std::size_t i = 0; i < scene.points.size(); ++i)
    if (scene.points[i].name == name) return static_cast<int>(i);
  ADD_FAILURE() << "no point " << name;
  return 0;
}
double distance(const study::Scene& scene, int from, int to) {
  const auto &a = scene.points[static_cast<std::size_t>(from)],
             &b = scene.points[static_cast<std::size_t>(to)];
  return std::hypot(a.x[0] - b.x[0], a.y[0] - b.y[0]);
}

TEST(SerialArmScene, DrawsBothPiJoints) {
  const SerialPiArm a = arm();
  const PerArm angle{1.2518840494062884, -0.1804704686034535};
  const auto scene = drawn(a, angle);
  EXPECT_FALSE(scene.spatial());
  EXPECT_EQ(scene.samples(), 2u);
  // Screws are as long as the diagonals of the reference.
  const auto d = test::numbers(test::at(test::at(computed("serial-pi-pi"), "-1"), "d_m"));
  EXPECT_NEAR(distance(scene, index(scene, "pivot 1"), index(scene, "end of the screw 1")), d[0], 1e-14);
  EXPECT_NEAR(distance(scene, index(scene, "elbow 1"), index(scene, "end of the screw 2")), d[1], 1e-14);
  // Opposite sides of both parallelograms are equal.
  EXPECT_NEAR(distance(scene, index(scene, "elbow 1"), index(scene, "end of the screw 1")), 0.12, 1e-14);
  EXPECT_NEAR(distance(scene, index(scene, "second pivot 2"), index(scene, "end of the screw 2")), 0.25,
              1e-14);
  const auto& tool = scene.points[static_cast<std::size_t>(index(scene, "tool point"))];
  EXPECT_NEAR(tool.x[0], 0.5, 1e-14);
  EXPECT_NEAR(tool.y[0], 0.22, 1e-14);
  EXPECT_TRUE(std::isnan(tool.x[1]));
  EXPECT_EQ(scene.traces.size(), 1u);
  EXPECT_EQ(scene.vectors.size(), 1u);
  std::vector<std::string> screws;
  for (const auto& body : scene.bodies)
    if (body.style == study::Scene::BodyStyle::damper) screws.push_back(body.name);
  EXPECT_THAT(screws, ::testing::ElementsAre("screw 1", "screw 2"));
}

TEST(SerialArmScene, AMotorHasNoScrew) {
  SerialPiArm a = arm();
  a.drive[1] = {};
  const auto scene = drawn(a, {1.2, -0.2});
  int screws = 0;
  for (const auto& body : scene.bodies) screws += body.style == study::Scene::BodyStyle::damper;
  EXPECT_EQ(screws, 1);
}

}  // namespace
}  // namespace linkwright::parallel
