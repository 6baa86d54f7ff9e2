// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/study/scene.h"
#include "linkwright/suspension/wheel/corner_columns.h"
#include "linkwright/suspension/wheel/packaging.h"

namespace linkwright::suspension {

/// The positions that a scene of a wheel suspension shows: all travels of a grid for each rack.
struct CornerGrid {
  Driver travel = Driver::wheel_centre_z;
  std::span<const double> travels, racks;     ///< m
  std::span<const CornerPosition> positions;  ///< [rack * travels + travel]
  std::span<const WheelParameters> wheels;    ///< likewise
  Driver lock = Driver::wheel_centre_z;       ///< coordinate held for the steering axis that is drawn
  std::optional<HalfShaft> half_shaft = std::nullopt;
  std::vector<Box> boxes = {};  ///< obstacles
};

/// A wheel suspension over a grid of travel and rack: links, couplers, spring, wheel, half-shaft, obstacles,
/// steering axis, and in the middle plane of the vehicle the roll centre of both wheels travelling equally;
/// on the other side the mirrored wheel where the racks hold the opposite displacement.
study::Scene corner_scene(const Suspension& suspension, std::string name, std::string title,
                          const CornerGrid& grid);

}  // namespace linkwright::suspension
