// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/link_fit_motion.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::suspension {

int error_count(LinkType type) {
  switch (type) {
    case LinkType::US:
    case LinkType::SS:
    case LinkType::SP:
    case LinkType::S:
      return 1;
    case LinkType::RS:
    case LinkType::SR:
    case LinkType::R:
      return 2;
    case LinkType::RR:
      return 4;
  }
  return 0;
}

double largest_distance(const CornerLink& a, const CornerLink& b) {
  LINKWRIGHT_REQUIRE(a.body.size() == b.body.size() && a.carrier.size() == b.carrier.size(),
                     "links of {} + {} and {} + {} points", a.body.size(), a.carrier.size(), b.body.size(),
                     b.carrier.size());
  double distance = 0;
  for (std::size_t i = 0; i < a.body.size(); ++i) distance = std::max(distance, norm(a.body[i] - b.body[i]));
  for (std::size_t i = 0; i < a.carrier.size(); ++i)
    distance = std::max(distance, norm(a.carrier[i] - b.carrier[i]));
  return distance;
}

LinkMotion link_motion(const CarrierTargets& targets, bool moved_by_rack, const Vec3& origin) {
  LinkMotion motion;
  motion.rotation.reserve(targets.poses.size());
  motion.shift.reserve(targets.poses.size());
  for (const CarrierTarget& pose : targets.poses) {
    const Mat3 rotation = target_rotation(targets, pose);
    Vec3 shift = pose.centre - origin - rotation * (targets.wheel.centre - origin);
    const Mat3 identity;
    double turned = 0;
    for (int k = 0; k < 3; ++k) turned = std::max(turned, norm(rotation.row[k] - identity.row[k]));
    const bool reference =
        pose.rack == 0 && norm(pose.centre - targets.wheel.centre) < 1e-12 && turned < 1e-12;
    if (reference) continue;
    if (moved_by_rack) shift = shift - pose.rack * targets.rack_direction;
    motion.rotation.push_back(rotation);
    motion.shift.push_back(shift);
  }
  return motion;
}

LinkMotion inverse(const LinkMotion& motion) {
  LinkMotion seen = motion;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    seen.rotation[i] = transposed(motion.rotation[i]);
    seen.shift[i] = -(seen.rotation[i] * motion.shift[i]);
  }
  return seen;
}

}  // namespace linkwright::suspension
