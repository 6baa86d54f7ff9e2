// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linkwright/suspension/corner/design_numbers.h"
#include "linkwright/suspension/studies/corner.h"

// Points of rockers, springs, dampers and bars as design variables.
namespace linkwright::suspension {

/// A point that is on no link.
struct OtherPoint {
  std::string name;  ///< "rocker.rod_2", "spring.moving"
  Vec3 at;           ///< m
  DesignKind kind = DesignKind::rocker_axis;
  int index = 0, point = 0;
};

/// All of them: axes and rods of rockers and of the arms of bars, ends of springs and dampers. The axis of a
/// T bar and the ends of a heave spring's counterpart follow from others and are none.
std::vector<OtherPoint> other_points(const CornerDescription& description);
/// The one of this name; nothing if there is none.
std::optional<OtherPoint> other_point(const CornerDescription& description, const std::string& name);

/// The rocker of this name, whose rod may have a length to design; nothing if there is none. The droplink of
/// a bar is not one of them.
std::optional<int> designed_rod(const CornerDescription& description, const std::string& name);

}  // namespace linkwright::suspension
