// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "linkwright/suspension/corner/position.h"

/// Poses of the links for a given pose of the carrier.
namespace linkwright::suspension {

/// Displacement of a link from the reference as a rigid body: its point that was at `from` is at `at`.
struct LinkPose {
  Vec3 from, at;
  Mat3 rotation;
};

/// Place of a point of the link that is at `reference` when the suspension is at the reference.
constexpr Vec3 placed(const LinkPose& pose, const Vec3& reference) {
  return pose.at + pose.rotation * (reference - pose.from);
}

/// Body point and carrier point of a link in the present position, the body point moved by the rack (m) if it
/// is on it.
Vec3 body_point(const Suspension& suspension, int link, int point, double rack);
Vec3 carrier_point(const Suspension& suspension, int link, int point, const CarrierPose& carrier);
/// The derivative by the rack displacement of a body point of a link, which is now at `now`; zero for a link
/// that the rack does not move.
Vec3 by_rack(const Suspension& suspension, int link, const Vec3& now, double rack);

/// All links at a position of the carrier, `from` and `at` at the first body point. US links turn about their
/// line as their U joint makes them, SS links do not, struts turn with the carrier, R and S are joints
/// without a link and follow the carrier. Nothing is solved, so a suspension with any number of links
/// will do; the links are taken to fit.
std::vector<LinkPose> link_poses(const Suspension& suspension, const CornerPlace& place, double rack);

/// The axes of a US link's U joint in the present position, unit: the one that is fixed in the body and the
/// one that turns with the rod.
std::array<Vec3, 2> cross_axes(const Suspension& suspension, int link, const CarrierPose& carrier,
                               double rack);

/// The begin of a coupler on its first link.
Vec3 coupler_begin(const Suspension& suspension, const Coupler& coupler, const CornerPlace& place,
                   double rack);

/// The end of the spring that moves, at a position of the carrier. The suspension has to have a spring.
Vec3 spring_end(const Suspension& suspension, const CornerPlace& place, double rack);

}  // namespace linkwright::suspension
