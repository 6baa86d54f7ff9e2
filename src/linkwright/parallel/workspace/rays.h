// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "linkwright/parallel/workspace/workspace.h"

/// Boundary of what passes, to a tolerance, along rays: places of the platform point from an inner point, or
/// rotations of the platform about one.
namespace linkwright::parallel {

/// The options for following rays.
struct RaySearch {
  double longest = 0;       ///< length of a ray: m, or rad for rotations
  double step = 0;          ///< step of the march: parts that are thinner may be missed
  double tolerance = 1e-9;  ///< tolerance of the ends, by bisection
};

/// A stretch of a ray on which everything passes.
struct RayStretch {
  double from = 0, to = 0;             ///< m or rad
  Criterion before = Criterion::none;  ///< criterion that ends it towards the origin; none: it begins there
  Criterion after = Criterion::none;   ///< criterion that ends it outwards; none: the ray's end
};

/// The stretches of a ray that pass, from the origin outwards.
struct Ray {
  Vec3 direction;  ///< unit
  std::vector<RayStretch> stretch{};

  /// The distance from the origin to the first criterion; 0 where the origin does not pass.
  double reach() const { return stretch.empty() || stretch[0].before != Criterion::none ? 0 : stretch[0].to; }
};

struct Rays {
  Status status = Status::done;  ///< cancelled or deadline: there are no rays
  std::vector<Ray> ray;
};

/// Rays of the platform point from `origin`, whose rotation stays. Directions need not be unit vectors.
Rays position_rays(const PoseConditions& conditions, const Pose& origin, std::span<const Vec3> directions,
                   const RaySearch& search, const RunContext& context);

/// Rays of rotation vectors at `origin`: the platform is turned about each direction (base axes), by up to
/// `search.longest` (at most pi), on top of the rotation of `origin`. Only for robots that turn.
Rays rotation_rays(const PoseConditions& conditions, const Pose& origin, std::span<const Vec3> directions,
                   const RaySearch& search, const RunContext& context);

/// Directions around a circle in the plane of the two unit vectors, `count` of them, from `first` on.
std::vector<Vec3> directions_around(int count, const Vec3& first = {1, 0, 0}, const Vec3& second = {0, 1, 0});
/// Directions all over a sphere, nearly evenly spread (a Fibonacci spiral).
std::vector<Vec3> directions_over_sphere(int count);

/// Area (m2) of all stretches of rays around a circle, directions_around, in a plane slice: holes and outer
/// parts count, too. The error falls with the square of the angle between rays, where a ray touches the
/// boundary with its power 3/2.
double area_of(const Rays& rays);

/// The range of rotations of a platform at a point.
struct RotationRange {
  Status status = Status::done;
  double tilt = 0;          ///< about every horizontal axis of those tried, at least so far (rad)
  double tilt_azimuth = 0;  ///< direction of the axis about which the least rotation is possible (rad from x)
  Criterion tilt_criterion = Criterion::none;
  double min_yaw = 0, max_yaw = 0;  ///< about z, from the rotation of the pose (rad): <= 0, >= 0
  Criterion min_yaw_criterion = Criterion::none, max_yaw_criterion = Criterion::none;
  std::vector<Ray> tilts;  ///< all around, from the axis x on
};
RotationRange rotation_range(const PoseConditions& conditions, const Pose& pose, int axes,
                             const RaySearch& search, const RunContext& context);

/// Area (m2) that a planar robot reaches with any of its working modes, in closed form: the part that two
/// rings share, about A - b of each leg, between abs(l - L) and l + L. Throws ContractError for other robots.
double reachable_area(const Robot& robot);

}  // namespace linkwright::parallel
