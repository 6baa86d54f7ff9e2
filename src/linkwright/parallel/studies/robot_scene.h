// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string>

#include "linkwright/parallel/robot/drives.h"
#include "linkwright/parallel/tool/path.h"
#include "linkwright/study/scene.h"

namespace linkwright::parallel {

/// A place of a robot to draw.
struct RobotSample {
  Status status = Status::done;  ///< not drawn unless done
  Pose pose;
  std::array<double, max_legs> angle{};  ///< angles of the arms (rad)
  Vec3 velocity{};                       ///< velocity of the platform point (m/s)
};

/// The input over which the samples are taken.
struct SceneInput {
  std::string name, title;  ///< "motion", "motion along the path"
  std::string key, label;   ///< "time_s", "time"
};
/// A scene over samples with a status, without anything in it.
template <class Sample>
study::Scene scene_over(const SceneInput& input, std::span<const double> values,
                        std::span<const Sample> samples) {
  study::Scene scene;
  scene.name = input.name;
  scene.title = input.title;
  scene.input_key = input.key;
  scene.input_label = input.label;
  scene.input.assign(values.begin(), values.end());
  for (const Sample& s : samples) scene.status.emplace_back(to_string(s.status));
  return scene;
}

/// A robot over samples: base, arms, rods (those of a DELTA as parallelograms), platform, the path of its
/// point with its velocity, and of Pi-joints parallelogram and screw. Planar robots give a planar scene.
study::Scene robot_scene(const Robot& robot, const Drives& drives, const SceneInput& input,
                         std::span<const double> values, std::span<const RobotSample> samples);

/// A place of the tool that the study gives.
struct ToolPlace {
  std::string name;  ///< "step 2"
  std::string key;   ///< "motion.step[1].to_m"
  Coordinates at{};  ///< m
};
/// Marks them as fixed joints, which can be dragged.
void add_places(study::Scene& scene, const Robot& robot, std::span<const ToolPlace> places);

}  // namespace linkwright::parallel
