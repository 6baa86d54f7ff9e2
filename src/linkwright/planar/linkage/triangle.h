// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/planar/linkage/kernel.h"

// A triangle of pins one side of which a drive makes: two bodies with a driven slide between them (a cylinder
// that raises an arm) or with a driven pin (a drive at an inner joint of a four-bar). For a value of the
// drive the two are one link, and the triangle is a dyad of three pins.
namespace linkwright::planar {

/// The side that the drive makes.
struct DrivenSide {
  /// From the outer pin of the first body to the pin of the arm, in the frame of the first, m.
  math::Vec2 way;
  math::Vec2 rate;  ///< its derivative by the input, m/m or m/rad
  math::Vec2 turn;  ///< x axis of the second body in the frame of the first
};
DrivenSide driven_side(const Group& group, double value);

/// Places the three bodies from the known parts; `state` as of a dyad of three pins: radicand (m4), and the
/// sine of the angle at the pin of the arm. Not closed where the radicand is negative.
void place_triangle(const Group& group, const Triangle& triangle, double value, double mode,
                    std::span<PartState<double>> parts, GroupState<double>& state);

/// m: by how much the triangle that was placed cannot close; 0 when it does.
double triangle_gap(const Group& group, const Triangle& triangle, double value,
                    std::span<const PartState<double>> parts);

}  // namespace linkwright::planar
