// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/parallel/serial_arm/serial_arm.h"
#include "linkwright/parallel/studies/robot_scene.h"

namespace linkwright::parallel {

/// A place of a serial arm to draw.
struct SerialSample {
  Status status = Status::done;  ///< not drawn unless done
  PerArm angle{};                ///< angles of the arms (rad)
  math::Vec2 velocity{};         ///< velocity of the tool point (m/s)
};

/// A serial arm over samples: both parallelograms, the second on the coupler of the first, the screws of
/// Pi-joints, the tool on the second coupler, its path and velocity. The second joint is drawn where the
/// first arm ends: the offset of both couplers is drawn at the tool. The parallelogram beside a motor has no
/// ratio of its own and is drawn with that of its drive.
study::Scene serial_arm_scene(const SerialPiArm& arm, const SceneInput& input, std::span<const double> values,
                              std::span<const SerialSample> samples);

}  // namespace linkwright::parallel
