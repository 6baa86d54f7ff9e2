// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/math/vector3.h"

/// A region that a robot must serve, and points that represent it.
namespace linkwright::parallel {

enum class RegionShape { cylinder, box, circle, rectangle };
constexpr std::array<EnumName<RegionShape>, 4> names(RegionShape) {
  return {{{RegionShape::cylinder, "cylinder", "about the axis of the robot, below it"},
           {RegionShape::box, "box", "about the axis of the robot, below it"},
           {RegionShape::circle, "circle", "in a plane, ahead of the base"},
           {RegionShape::rectangle, "rectangle", "in a plane, ahead of the base"}}};
}

/// Places are local: from the middle of the side that is nearest to the base. A cylinder or box reaches from
/// z = 0 down to -height and lies about the z axis; a circle or rectangle from y = 0 up, about the y axis.
/// Each is run through by coordinates:
///
///     cylinder    radius, azimuth, depth          box        x, y, depth
///     circle      radius, direction from x        rectangle  x, y
struct PrescribedRegion {
  RegionShape shape = RegionShape::cylinder;
  double width = 0;   ///< diameter, or extent along x (m)
  double length = 0;  ///< extent along y of a box (m)
  double height = 0;  ///< extent away from the base; not of a circle (m)
  /// Only the part that the symmetry of a robot repeats: of a cylinder the azimuths 0 ... 60 deg (DELTA,
  /// level HEXA), of circle and rectangle the half x >= 0 (five-bar). Else all of it. Not for a box.
  bool symmetric = true;
  /// Points along each coordinate, ends included, where the indices are looked at. Points that coincide on an
  /// axis count once.
  std::array<int, 3> nodes{5, 61, 5};
  /// Cells along each coordinate of the midpoint rule for mean values; weights are proportional to the volume
  /// of the cells.
  std::array<int, 3> cells{8, 12, 5};
};

/// Says what keeps it from being a region, with the value; empty if it is one.
std::string problem(const PrescribedRegion& region);

bool is_planar(RegionShape shape);
/// Coordinates of the shape: 3, or 2 in a plane.
int coordinates(RegionShape shape);

/// Bounds of coordinate k, of the part that counts.
struct CoordinateRange {
  double lower = 0, upper = 0;
};
CoordinateRange coordinate_range(const PrescribedRegion& region, int k);

/// Local place of coordinates (m).
math::Vec3 place(const PrescribedRegion& region, const std::array<double, 3>& at);

/// Its middle (m).
math::Vec3 middle_of(const PrescribedRegion& region);

struct RegionPoint {
  std::array<double, 3> at{};  ///< coordinates
  math::Vec3 place{};          ///< local (m)
  double weight = 0;           ///< weight in the mean; the sum of all is 1
};
std::vector<RegionPoint> region_nodes(const PrescribedRegion& region);
std::vector<RegionPoint> region_cells(const PrescribedRegion& region);

}  // namespace linkwright::parallel
