// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "linkwright/planar/dyads/dyad.h"

namespace linkwright::planar {

/// The accuracy asked for in a pose.
struct PoseDemand {
  double weight = 1;   ///< weight of its errors, > 0
  bool angle = true;   ///< false: a point that the origin of the body is to pass, at any rotation
  bool exact = false;  ///< met exactly, whatever the others need; not of a point
};

/// Two dyads near poses, and where they hold the body next to each pose.
struct PoseFit {
  GuidingDyad first, second;
  std::vector<BodyPose> reached;
  /// Sum of (|d - d_j| / length)^2 + (angle - angle_j)^2 over the poses, each times its weight; of points
  /// without the angles.
  double cost = 0;
  bool converged = false;
};

/// The pair of the least cost next to a given one, by damped Gauss-Newton steps (Levenberg-Marquardt) over
/// the numbers of both dyads; the place of the linkage at each pose is eliminated: it is the nearest one.
/// `length` (m) is what a rotation of one radian counts as. `demands`: one for each pose, or none; the angle
/// of a point is where the search for its rotation begins. Poses that are met exactly weigh a million times
/// as much, and the numbers are then moved as little as can be until they are met.
///
/// Throws ContractError for fewer than three poses, a length or a weight that is not positive, or another
/// number of demands.
PoseFit fit_pair(std::span<const BodyPose> poses, const GuidingDyad& first, const GuidingDyad& second,
                 double length, std::span<const PoseDemand> demands = {});

/// Gap of a dyad and its derivatives: by x, y and the angle of the pose, and by the numbers of the dyad - RR:
/// G, W and length; PR: W, angle of the normal and offset; RP: G, likewise.
struct GapSlopes {
  double gap = 0;
  std::array<double, 3> pose{};
  std::array<double, 5> dyad{};
};
GapSlopes gap_slopes(const GuidingDyad& dyad, const BodyPose& pose);

}  // namespace linkwright::planar
