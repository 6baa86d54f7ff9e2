// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/parallel/serial_arm/serial_arm.h"

/// Workspace of a serial arm of two Pi-joints: which places of its tool meet conditions, and how good they
/// are there.
namespace linkwright::parallel {

/// The conditions that a place must meet. The defaults ask only that the arms reach and the drives are within
/// their travel.
struct SerialConditions {
  SerialPiArm arm;
  int mode = 1;
  double min_elbow = 0;               ///< angle between the arms at their joint: 0 = folded (rad)
  double max_elbow = pi;              ///< pi = stretched (rad)
  double min_drive_transmission = 0;  ///< least transmission index of the drives, sin(mu) of a Pi-joint
  double min_conditioning = 0;        ///< 1 / condition
};

/// The first condition that a place does not meet, in this order.
enum class SerialCriterion : std::uint8_t {
  none,
  reach,
  travel,
  elbow,
  drive_transmission,
  conditioning,
  open,
};
inline constexpr std::size_t serial_criterion_count = 7;
constexpr std::array<EnumName<SerialCriterion>, serial_criterion_count> names(SerialCriterion) {
  using enum SerialCriterion;
  return {{{none, "none", "meets all conditions"},
           {reach, "reach", "the arms do not reach, or leave the angle of the first one open"},
           {travel, "travel", "a drive is beyond its travel"},
           {elbow, "elbow", "the angle between the arms is beyond its limits"},
           {drive_transmission, "drive_transmission", "a Pi-joint transmits too badly"},
           {conditioning, "conditioning", "1 / condition below its limit"},
           {open, "open", "not looked at: the computation was stopped"}}};
}

/// Indices of a place.
enum class SerialIndex {
  conditioning,        ///< least over largest singular value of J
  sine,                ///< abs sin(q2 - q1)
  manipulability,      ///< abs det J (m2)
  drive_transmission,  ///< least sin(mu), 1 for motors; NaN where a Pi-joint cannot be
};
inline constexpr std::size_t serial_index_count = 4;
constexpr std::array<EnumName<SerialIndex>, serial_index_count> names(SerialIndex) {
  using enum SerialIndex;
  return {{{conditioning, "conditioning", "least over largest singular value of the Jacobian (LCI)"},
           {sine, "sine", "sine of the angle between the arms"},
           {manipulability, "manipulability", "product of the singular values"},
           {drive_transmission, "drive_transmission", "least transmission of the drives"}}};
}

/// A place looked at.
struct SerialPlace {
  SerialCriterion criterion = SerialCriterion::open;
  std::array<double, serial_index_count> index{};  ///< by SerialIndex; NaN out of reach

  double operator[](SerialIndex i) const { return index[static_cast<std::size_t>(i)]; }
};
/// The conditions' mode must be 1 or -1 (ContractError). Allocates nothing.
SerialPlace look_at(const SerialConditions& conditions, const math::Vec2& point);

/// Angle between the arms at their joint: 0 = folded, pi = stretched (rad).
double elbow_angle(const PerArm& angles);

/// Nodes low + step i in a rectangle, ends included.
struct SerialGrid {
  math::Vec2 low{}, high{};  ///< m
  double step = 0;           ///< > 0 (m)
};
struct SerialMap {
  Status status = Status::done;  ///< cancelled or deadline: some places are open
  SerialGrid grid;
  std::array<std::size_t, 2> nodes{};  ///< along x, y
  std::vector<SerialPlace> place;      ///< x changes fastest

  math::Vec2 position(std::size_t node) const;           ///< m
  double cell() const { return grid.step * grid.step; }  ///< m2
  std::size_t count(SerialCriterion criterion) const;    ///< nodes that stop at it; none: those that pass
};
/// Looks at every node. Throws ContractError for a grid without sense or of more than 1e8 nodes.
SerialMap workspace(const SerialConditions& conditions, const SerialGrid& grid, const RunContext& context);

/// The smallest grid with a node in the middle of the reachable annulus that holds all of it.
SerialGrid whole_reach(const SerialPiArm& arm, double step);

}  // namespace linkwright::parallel
