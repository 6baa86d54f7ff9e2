// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/design_points.h"

#include "linkwright/suspension/studies/spring_parts.h"

namespace linkwright::suspension {

std::vector<OtherPoint> other_points(const CornerDescription& d) {
  const Suspension& suspension = d.suspension;
  std::vector<OtherPoint> out;
  for (int i = 0; i < static_cast<int>(suspension.rockers.size()); ++i) {
    const Rocker& rocker = suspension.rockers[static_cast<std::size_t>(i)];
    const std::string name = rocker_label(suspension, i);
    if (name != bar_arm || !d.springs.anti_roll_bar->post_top) {
      out.push_back({name + ".axis_1", rocker.axis[0], DesignKind::rocker_axis, i, 0});
      out.push_back({name + ".axis_2", rocker.axis[1], DesignKind::rocker_axis, i, 1});
    }
    out.push_back({name + ".rod_1", rocker.driven_by.at, DesignKind::rocker_rod, i, 0});
    out.push_back({name + ".rod_2", rocker.rod, DesignKind::rocker_rod, i, 1});
  }
  if (suspension.spring) {
    out.push_back({"spring.body", suspension.spring->body, DesignKind::spring_body, 0, 0});
    out.push_back({"spring.moving", suspension.spring->moving, DesignKind::spring_moving, 0, 0});
  }
  for (int i = 0; i < static_cast<int>(suspension.elements.size()); ++i) {
    const CornerElement& element = suspension.elements[static_cast<std::size_t>(i)];
    if (element.turn || element.across) continue;
    out.push_back({element.name + ".body", element.first.at, DesignKind::element_first, i, 0});
    out.push_back({element.name + ".moving", element.second.at, DesignKind::element_second, i, 0});
  }
  return out;
}

std::optional<OtherPoint> other_point(const CornerDescription& d, const std::string& name) {
  for (OtherPoint& point : other_points(d))
    if (point.name == name) return std::move(point);
  return std::nullopt;
}

std::optional<int> designed_rod(const CornerDescription& d, const std::string& name) {
  if (name == bar_arm) return std::nullopt;
  for (int i = 0; i < static_cast<int>(d.suspension.rockers.size()); ++i)
    if (rocker_label(d.suspension, i) == name) return i;
  return std::nullopt;
}

}  // namespace linkwright::suspension
