// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/design_numbers.h"

#include <fmt/core.h>

#include <array>

#include "linkwright/core/check.h"
#include "linkwright/math/dual.h"
#include "linkwright/math/mixed_dual.h"

namespace linkwright::suspension {
namespace {

constexpr std::array axes{"x", "y", "z"};

/// T is double, const double or a dual number, Suspension the suspension that has such numbers.
template <class T, class Point>
T* coordinate(Point& point, int axis) {
  return axis == 0 ? &point.x : axis == 1 ? &point.y : axis == 2 ? &point.z : nullptr;
}

template <class List>
auto* entry(List& list, int index) {
  return index >= 0 && index < static_cast<int>(list.size()) ? &list[index] : nullptr;
}

template <class T, class Suspension>
T* find(Suspension& suspension, const DesignNumber& number) {
  switch (number.kind) {
    case DesignKind::body:
    case DesignKind::carrier: {
      auto* link = entry(suspension.links, number.index);
      if (!link) return nullptr;
      auto* point = entry(number.kind == DesignKind::body ? link->body : link->carrier, number.point);
      return point ? coordinate<T>(*point, number.axis) : nullptr;
    }
    case DesignKind::length: {
      auto* link = entry(suspension.links, number.index);
      if (!link || number.point < 0 || number.point > 1) return nullptr;
      if (link->made) return &(*link->made)[static_cast<std::size_t>(number.point)];
      return link->length && number.point == 0 ? &*link->length : nullptr;
    }
    case DesignKind::coupler_point: {
      auto* coupler = entry(suspension.couplers, number.index);
      return coupler ? coordinate<T>(coupler->point, number.axis) : nullptr;
    }
    case DesignKind::coupler_fraction: {
      auto* coupler = entry(suspension.couplers, number.index);
      return coupler ? &coupler->fraction : nullptr;
    }
    case DesignKind::coupler_begin: {
      auto* coupler = entry(suspension.couplers, number.index);
      return coupler && coupler->begin ? coordinate<T>(*coupler->begin, number.axis) : nullptr;
    }
    case DesignKind::spring_body:
      return suspension.spring ? coordinate<T>(suspension.spring->body, number.axis) : nullptr;
    case DesignKind::spring_moving:
      return suspension.spring ? coordinate<T>(suspension.spring->moving, number.axis) : nullptr;
    case DesignKind::rocker_axis: {
      auto* rocker = entry(suspension.rockers, number.index);
      return rocker && (number.point == 0 || number.point == 1)
                 ? coordinate<T>(rocker->axis[static_cast<std::size_t>(number.point)], number.axis)
                 : nullptr;
    }
    case DesignKind::rocker_rod: {
      auto* rocker = entry(suspension.rockers, number.index);
      if (!rocker || number.point < 0 || number.point > 1) return nullptr;
      return coordinate<T>(number.point == 0 ? rocker->driven_by.at : rocker->rod, number.axis);
    }
    case DesignKind::rocker_length: {
      auto* rocker = entry(suspension.rockers, number.index);
      return rocker && rocker->length ? &*rocker->length : nullptr;
    }
    case DesignKind::element_first:
    case DesignKind::element_second: {
      auto* element = entry(suspension.elements, number.index);
      if (!element || element->turn) return nullptr;
      return coordinate<T>(number.kind == DesignKind::element_first ? element->first.at : element->second.at,
                           number.axis);
    }
    case DesignKind::wheel_centre:
      return coordinate<T>(suspension.wheel.centre, number.axis);
    case DesignKind::wheel_toe:
      return &suspension.wheel.toe;
    case DesignKind::wheel_camber:
      return &suspension.wheel.camber;
  }
  return nullptr;
}

template <class T, class Suspension>
T& found(Suspension& suspension, const DesignNumber& number) {
  T* place = find<T>(suspension, number);
  LINKWRIGHT_REQUIRE(place, "the suspension has no number {}, index {}, point {}, axis {}",
                     name_of(number.kind), number.index, number.point, number.axis);
  return *place;
}

}  // namespace

template <class T>
T& design_value(BasicSuspension<T>& suspension, const DesignNumber& number) {
  return found<T>(suspension, number);
}
template double& design_value(Suspension&, const DesignNumber&);
template math::Dual<4>& design_value(BasicSuspension<math::Dual<4>>&, const DesignNumber&);
template math::MixedDual<4>& design_value(BasicSuspension<math::MixedDual<4>>&, const DesignNumber&);

double design_value(const Suspension& suspension, const DesignNumber& number) {
  return found<const double>(suspension, number);
}

std::string label(const Suspension& suspension, const DesignNumber& number) {
  design_value(suspension, number);  // checks that it exists
  const auto link_point = [&](const char* where, std::size_t points) {
    const std::string which = points > 1 ? fmt::format("{}_", number.point + 1) : "";
    return fmt::format("{}.{}_{}{}", link_label(suspension, number.index), where, which, axes[number.axis]);
  };
  const auto coupler = [&](const std::string& what) {
    const std::string& name = suspension.couplers[number.index].name;
    return (name.empty() ? fmt::format("coupler {}", number.index + 1) : name) + "." + what;
  };
  switch (number.kind) {
    case DesignKind::body:
      return link_point("body", suspension.links[number.index].body.size());
    case DesignKind::carrier:
      return link_point("carrier", suspension.links[number.index].carrier.size());
    case DesignKind::length:
      return link_label(suspension, number.index) + ".length" +
             (suspension.links[number.index].made ? fmt::format("_{}", number.point + 1) : "");
    case DesignKind::coupler_point:
      return coupler(fmt::format("point_{}", axes[number.axis]));
    case DesignKind::coupler_fraction:
      return coupler("fraction");
    case DesignKind::coupler_begin:
      return coupler(fmt::format("first_point_{}", axes[number.axis]));
    case DesignKind::spring_body:
      return fmt::format("spring.body_{}", axes[number.axis]);
    case DesignKind::spring_moving:
      return fmt::format("spring.moving_{}", axes[number.axis]);
    case DesignKind::rocker_axis:
    case DesignKind::rocker_rod:
      return fmt::format("{}.{}_{}_{}", rocker_label(suspension, number.index),
                         number.kind == DesignKind::rocker_axis ? "axis" : "rod", number.point + 1,
                         axes[number.axis]);
    case DesignKind::rocker_length:
      return rocker_label(suspension, number.index) + ".rod_length";
    case DesignKind::element_first:
    case DesignKind::element_second:
      return fmt::format("{}.{}_{}", suspension.elements.at(static_cast<std::size_t>(number.index)).name,
                         number.kind == DesignKind::element_first ? "body" : "moving", axes[number.axis]);
    case DesignKind::wheel_centre:
      return fmt::format("wheel.centre_{}", axes[number.axis]);
    case DesignKind::wheel_toe:
      return "wheel.toe";
    case DesignKind::wheel_camber:
      return "wheel.camber";
  }
  return {};
}

Suspension as_built(const Suspension& suspension) {
  LINKWRIGHT_REQUIRE(suspension.couplers.empty(), "{} couplers", suspension.couplers.size());
  Suspension out = suspension;
  for (CornerLink& link : out.links) {
    if (link.type == LinkType::US || link.type == LinkType::SS)
      link.length = link.length.value_or(norm(link.carrier[0] - link.body[0]));
    if (link.type == LinkType::RS)
      link.made = {norm(link.carrier[0] - link.body[0]), norm(link.carrier[0] - link.body[1])};
    if (link.type == LinkType::SR)
      link.made = {norm(link.carrier[0] - link.body[0]), norm(link.carrier[1] - link.body[0])};
  }
  for (Rocker& rocker : out.rockers)
    rocker.length = rocker.length.value_or(norm(rocker.rod - rocker.driven_by.at));
  return out;
}

std::vector<DesignNumber> hard_points(const Suspension& suspension) {
  std::vector<DesignNumber> out;
  const auto point = [&](DesignKind kind, int index, int which) {
    for (int axis = 0; axis < 3; ++axis) out.push_back({kind, index, which, axis});
  };
  for (int i = 0; i < static_cast<int>(suspension.links.size()); ++i) {
    const CornerLink& link = suspension.links[i];
    for (int k = 0; k < static_cast<int>(link.body.size()); ++k) point(DesignKind::body, i, k);
    for (int k = 0; k < static_cast<int>(link.carrier.size()); ++k) point(DesignKind::carrier, i, k);
    if (link.length) out.push_back({DesignKind::length, i});
    if (link.made)
      for (const int which : {0, 1}) out.push_back({DesignKind::length, i, which});
  }
  for (int i = 0; i < static_cast<int>(suspension.couplers.size()); ++i) {
    point(DesignKind::coupler_point, i, 0);
    if (suspension.couplers[i].begin)
      point(DesignKind::coupler_begin, i, 0);
    else
      out.push_back({DesignKind::coupler_fraction, i});
  }
  for (int i = 0; i < static_cast<int>(suspension.rockers.size()); ++i) {
    for (const DesignKind kind : {DesignKind::rocker_axis, DesignKind::rocker_rod})
      for (const int which : {0, 1}) point(kind, i, which);
    if (suspension.rockers[i].length) out.push_back({DesignKind::rocker_length, i});
  }
  if (suspension.spring) {
    point(DesignKind::spring_body, 0, 0);
    point(DesignKind::spring_moving, 0, 0);
  }
  return out;
}

}  // namespace linkwright::suspension
