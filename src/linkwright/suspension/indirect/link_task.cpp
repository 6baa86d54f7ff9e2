// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/link_task.h"

#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::suspension {
namespace {

constexpr double in_box = 1e-9;  // m: a point this far outside is at the bound

template <class Link>
auto& point_of(Link& link, int place) {
  const std::size_t point = static_cast<std::size_t>(place) / 3;
  return point < link.body.size() ? link.body[point] : link.carrier[point - link.body.size()];
}

}  // namespace

LinkTask given_link(const CornerLink& link) {
  LinkTask task;
  task.name = link.name;
  task.type = link.type;
  task.moved_by_rack = link.moved_by_rack;
  for (const Vec3& p : link.body) task.body.push_back({p, p});
  for (const Vec3& p : link.carrier) task.carrier.push_back({p, p});
  return task;
}

LinkCoordinates::LinkCoordinates(const LinkTask& task, const Vec3& origin) {
  LINKWRIGHT_REQUIRE(static_cast<int>(task.body.size()) == body_points(task.type) &&
                         static_cast<int>(task.carrier.size()) == carrier_points(task.type),
                     "link '{}' of type {} needs {} points on the body and {} on the carrier, got {} and {}",
                     task.name, name_of(task.type), body_points(task.type), carrier_points(task.type),
                     task.body.size(), task.carrier.size());
  middle_.name = task.name;
  middle_.type = task.type;
  middle_.moved_by_rack = task.moved_by_rack;
  for (const bool body : {true, false})
    for (const PointBox& box : body ? task.body : task.carrier) {
      Vec3 middle = 0.5 * (box.lower + box.upper);
      for (int k = 0; k < 3; ++k) {
        const double low = component(box.lower, k), high = component(box.upper, k);
        LINKWRIGHT_REQUIRE(std::isfinite(low) && std::isfinite(high) && low <= high,
                           "link '{}': box from {} to {} m", task.name, low, high);
        columns_.push_back(low < high ? static_cast<int>(free_.size()) : -1);
        if (low < high) free_.push_back(static_cast<int>(lower_.size()));
        lower_.push_back(low - component(origin, k));
        upper_.push_back(high - component(origin, k));
      }
      (body ? middle_.body : middle_.carrier).push_back(middle - origin);
    }
}

double LinkCoordinates::get(const CornerLink& link, int place) {
  return component(point_of(link, place), place % 3);
}

void LinkCoordinates::set(CornerLink& link, int place, double value) {
  Vec3& p = point_of(link, place);
  (place % 3 == 0 ? p.x : place % 3 == 1 ? p.y : p.z) = value;
}

bool LinkCoordinates::inside(const CornerLink& link) const {
  for (int i = 0; i < static_cast<int>(lower_.size()); ++i) {
    const double value = get(link, i);
    if (!(value >= lower(i) - in_box && value <= upper(i) + in_box)) return false;
  }
  return true;
}

CornerLink shifted(CornerLink link, const Vec3& by) {
  for (Vec3& p : link.body) p += by;
  for (Vec3& p : link.carrier) p += by;
  return link;
}

}  // namespace linkwright::suspension
