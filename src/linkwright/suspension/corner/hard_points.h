// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/table.h"
#include "linkwright/suspension/corner/suspension.h"

/// Hard points: the named points of a wheel suspension as lists of other programs and drawings give them, and
/// their conversion into the vehicle's frame (x forward, y to the left, z up, y = 0 in the middle; m).
namespace linkwright::suspension {

struct HardPoint {
  std::string name;
  Vec3 at;  ///< m

  friend bool operator==(const HardPoint&, const HardPoint&) = default;
};

/// The direction of an axis of a list, as seen by the driver.
enum class Direction { forward, rearward, left, right, up, down };
constexpr std::array<EnumName<Direction>, 6> names(Direction) {
  return {{{Direction::forward, "forward"},
           {Direction::rearward, "rearward"},
           {Direction::left, "left"},
           {Direction::right, "right"},
           {Direction::up, "up"},
           {Direction::down, "down"}}};
}

/// The frame that points are given in; by default the vehicle's own. Left-handed frames are mirrored as they
/// must be: only directions count.
struct PointFrame {
  Direction x = Direction::forward, y = Direction::left, z = Direction::up;
  Vec3 origin;  ///< m: its origin in the vehicle's frame
};

/// Empty, or why the three directions span no space ("x and z both lie along forward and rearward").
std::string problem(const PointFrame& frame);

/// A point of the frame (m) in the vehicle's frame, and back.
Vec3 to_vehicle(const PointFrame& frame, const Vec3& at);
Vec3 from_vehicle(const PointFrame& frame, const Vec3& at);

/// The unit of lists that name none.
enum class PointUnit { mm, cm, m, in };
constexpr std::array<EnumName<PointUnit>, 4> names(PointUnit) {
  return {{{PointUnit::mm, "mm"}, {PointUnit::cm, "cm"}, {PointUnit::m, "m"}, {PointUnit::in, "in"}}};
}

/// The points as a table with names and columns x_m, y_m, z_m, which read_hard_points reads back.
Table hard_point_table(const std::vector<HardPoint>& points);

/// The points of a suspension's links, couplers, rockers, damper and spring, by their names: tie_rod_body,
/// lower_wishbone_body_2.
std::vector<HardPoint> points_of(const Suspension& suspension);

/// A name in small letters, digits and _.
std::string plain_name(std::string_view name);

}  // namespace linkwright::suspension
