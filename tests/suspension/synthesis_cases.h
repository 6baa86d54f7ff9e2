// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/suspension/corner/carrier_poses.h"
#include "linkwright/suspension/indirect/link_fit.h"
#include "support/published.h"
#include "tests/suspension/suspensions.h"

namespace linkwright::test {}
namespace linkwright::suspension::test {
using namespace linkwright::test;  // shared by the tests of all modules

/// A mechanism of the published figures, and the positions that its carrier takes.
struct Example {
  CarrierTargets targets;
  Suspension suspension;
  std::vector<CornerLink> links;  ///< links of the suspension, with names
};

inline Example published_example(std::string_view id) {
  using test::at, test::number_at;
  const Value& given = published(id);
  Example e;
  e.suspension = corner_from(at(given, "inputs.mechanism"));
  e.targets.wheel = e.suspension.wheel;
  e.targets.rack_direction = e.suspension.rack_direction;
  for (const char* key : {"positions", "wheel_travel", "rack_travel", "combined"}) {
    const Value* positions = at(given, "computed").find(key);
    if (!positions) continue;
    for (const Value& pose : positions->as_array())
      e.targets.poses.push_back(
          {number_at(pose, "rack_m"),
           point(at(pose, "wheel_centre_m")),
           {number_at(pose, "toe_rad"), number_at(pose, "camber_rad"), number_at(pose, "carrier_spin_rad")}});
  }
  for (CornerLink& link : e.suspension.links) {
    link.name = "link " + std::to_string(e.links.size() + 1);
    e.links.push_back(link);
  }
  return e;
}

/// The task whose solution is `link`: boxes of `edge`, placed at random around its points. The coordinate of
/// the largest component of every axis is given, and that of a strut's point.
inline LinkTask random_task(const CornerLink& link, double edge, RandomStream& random) {
  LinkTask task{.name = link.name, .type = link.type, .moved_by_rack = link.moved_by_rack};
  const auto place = [&](const Vec3& p) {
    const auto shift = [&] { return random.uniform(-edge / 2, edge / 2); };
    const double x = shift(), y = shift(), z = shift();
    return box_around(p + Vec3{x, y, z}, edge);
  };
  for (const Vec3& p : link.body) task.body.push_back(place(p));
  for (const Vec3& p : link.carrier) task.carrier.push_back(place(p));
  const auto fix = [](PointBox& box, const Vec3& p, const Vec3& axis) {
    const double x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
    if (x >= y && x >= z)
      box.lower.x = box.upper.x = p.x;
    else if (y >= z)
      box.lower.y = box.upper.y = p.y;
    else
      box.lower.z = box.upper.z = p.z;
  };
  if (link.body.size() == 2)
    for (int k = 0; k < 2; ++k) fix(task.body[k], link.body[k], link.body[1] - link.body[0]);
  if (link.carrier.size() == 2)
    for (int k = 0; k < 2; ++k) fix(task.carrier[k], link.carrier[k], link.carrier[1] - link.carrier[0]);
  if (link.type == LinkType::SP) fix(task.carrier[0], link.carrier[0], link.carrier[0] - link.body[0]);
  return task;
}

}  // namespace linkwright::suspension::test
