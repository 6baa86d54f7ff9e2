// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/robot_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/parallel/robot/robot.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

const study::Scene::Point& named(const study::Scene& scene, std::string_view name) {
  for (const auto& p : scene.points)
    if (p.name == name) return p;
  throw std::runtime_error("no point");
}

study::Scene drawn(const Robot& robot, const Drives& drives, const Pose& pose, const WorkingMode& mode) {
  const RobotSample good{Status::done, pose, inverse(robot, pose, mode).angle, {0.1, 0, 0}};
  RobotSample lost = good;
  lost.status = Status::no_assembly;
  const std::vector<double> times{0, 1};
  const std::vector<RobotSample> samples{good, lost};
  return robot_scene(robot, drives, {"motion", "motion", "time_s", "time"}, times, samples);
}

TEST(RobotScene, JoinsArmsAndRods) {
  const Robot robot = reference_hexa();
  const Pose pose{{0.05, -0.03, -0.5}};
  const auto scene = drawn(robot, Drives{}, pose, all_positive);
  EXPECT_TRUE(scene.spatial());
  EXPECT_EQ(scene.samples(), 2u);
  for (int leg = 1; leg <= 6; ++leg) {
    const auto& end = named(scene, "elbow " + std::to_string(leg));
    const auto& joint = named(scene, "platform joint " + std::to_string(leg));
    EXPECT_NEAR(norm(Vec3{end.x[0] - joint.x[0], end.y[0] - joint.y[0], end.z[0] - joint.z[0]}), 0.55, 1e-12);
    EXPECT_TRUE(std::isnan(end.x[1]));
  }
  EXPECT_EQ(scene.traces.size(), 1u);
  EXPECT_EQ(scene.vectors.size(), 1u);
}

TEST(RobotScene, DrawsPiJointsAsParallelograms) {
  const Robot robot = reference_five_bar();
  const auto scene = drawn(robot, mirrored_drives(), {{0.05, 0.45, 0}}, {-1, 1});
  EXPECT_FALSE(scene.spatial());
  // The screw's length is the diagonal, for a mirrored joint, too.
  const Value& expected = computed("five-bar-pi");
  for (int leg = 1; leg <= 2; ++leg) {
    const auto& end = named(scene, "end of the screw " + std::to_string(leg));
    const auto& pivot = named(scene, "pivot " + std::to_string(leg));
    EXPECT_NEAR(std::hypot(end.x[0] - pivot.x[0], end.y[0] - pivot.y[0]),
                test::numbers(test::at(expected, "d_m"))[static_cast<std::size_t>(leg - 1)], 1e-12);
  }
}

}  // namespace
}  // namespace linkwright::parallel
