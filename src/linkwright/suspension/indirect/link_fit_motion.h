// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/suspension/corner/carrier_poses.h"
#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {

/// Structural errors that a position adds to a link: distances that do not change (US, RS, SR, RR), the
/// distance of the body point from the line of a strut (SP), distances of points from where they were (S, R).
int error_count(LinkType type);

/// Largest distance of two corresponding points of links of one type.
double largest_distance(const CornerLink& a, const CornerLink& b);

/// Motion of the carrier as the body's points of a link see it: a point x of the carrier (reference
/// coordinates) comes to shift + rotation x. The reference pose, identity, is not among the positions.
struct LinkMotion {
  std::vector<Mat3> rotation;
  std::vector<Vec3> shift;

  std::size_t size() const { return rotation.size(); }
  Vec3 moved(std::size_t i, const Vec3& x) const { return shift[i] + rotation[i] * x; }
};

/// The motion of prescribed positions, against the rack if it moves the link's points on the body. Positions
/// that are the reference pose to rounding are left out. Coordinates are taken from `origin`.
LinkMotion link_motion(const CarrierTargets& targets, bool moved_by_rack, const Vec3& origin = {});

/// The body seen from the carrier.
LinkMotion inverse(const LinkMotion& motion);

}  // namespace linkwright::suspension
