// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/suspension.h"

#include <fmt/core.h>

#include <cmath>
#include <set>
#include <string_view>

#include "linkwright/suspension/corner/detail/wheel_kernel.h"

namespace linkwright::suspension {
namespace {

/// Points nearer than this (m) do not make a length.
constexpr double no_length = 1e-6;
/// Sine of the angle between a rocker's rod and arm below which they lie in line.
constexpr double toggle = 1e-6;

struct CornerFindings {
  Diagnostics list;
  void add(std::string key, std::string message, std::string hint = {}) {
    list.push_back({.key = std::move(key), .message = std::move(message), .hint = std::move(hint)});
  }
};

double off_line(const Vec3& point, const Vec3& from, const Vec3& to) {
  return norm(cross(point - from, unit(to - from)));
}

void check_link(const Suspension& suspension, int index, CornerFindings& found) {
  const CornerLink& link = suspension.links[index];
  const std::string key = "link." + link_label(suspension, index);
  const std::string_view type = name_of(link.type);
  const auto count = [&](const char* where, std::size_t has, int needs) {
    if (static_cast<int>(has) == needs) return true;
    if (needs == 0)
      found.add(
          key,
          fmt::format("{} has {} carrier points, {} takes none", link_label(suspension, index), has, type),
          "its joint holds the carrier where the body points are");
    else
      found.add(key, fmt::format("{} has {} {} points, {} takes {}", link_label(suspension, index), has,
                                 where, type, needs));
    return false;
  };
  const bool body = count("body", link.body.size(), body_points(link.type));
  const bool carrier = count("carrier", link.carrier.size(), carrier_points(link.type));
  if (!body || !carrier) return;
  for (const auto& points : {link.body, link.carrier})
    for (const Vec3& point : points)
      if (!finite(point)) return found.add(key, "a coordinate is not a finite number");
  const auto axis = [&](const std::vector<Vec3>& points, const char* where) {
    if (points.size() < 2 || norm(points[1] - points[0]) >= no_length) return true;
    found.add(key, fmt::format("the two {} points of its axis are the same", where),
              "set them apart along the axis");
    return false;
  };
  if (!axis(link.body, "body") || !axis(link.carrier, "carrier")) return;
  if (!link.carrier.empty()) {
    if (norm(link.carrier[0] - link.body[0]) < no_length)
      return found.add(key, "body and carrier point are the same: a link needs a length",
                       "join body and carrier directly by an S joint");
    if (link.type == LinkType::RS && off_line(link.carrier[0], link.body[0], link.body[1]) < no_length)
      found.add(key, "the ball joint lies on the axis of the hinge: the arm moves nothing");
    if (link.type == LinkType::SR && off_line(link.body[0], link.carrier[0], link.carrier[1]) < no_length)
      found.add(key, "the ball joint lies on the axis of the hinge: the link holds nothing across it");
    if (link.type == LinkType::RR && off_line(link.carrier[0], link.body[0], link.body[1]) < no_length &&
        off_line(link.carrier[1], link.body[0], link.body[1]) < no_length)
      found.add(key, "both hinges have the same axis: the arm moves nothing");
  }
  if (link.cross_axis) {
    if (link.type != LinkType::US)
      found.add(key,
                fmt::format("the axis of a universal joint can be given to US links only, this is {}", type));
    else if (!finite(*link.cross_axis) || !(norm(*link.cross_axis) > 1e-9))
      found.add(key, "the axis of its U joint has no direction");
    else if (norm(cross(unit(*link.cross_axis), unit(link.carrier[0] - link.body[0]))) < 1e-3)
      found.add(key, "the axis of its U joint lies along the rod, which then could not swing",
                "give one across the rod");
  }
  if (link.length) {
    if (link.type != LinkType::US && link.type != LinkType::SS)
      found.add(key, fmt::format("a length can be given to US and SS links only, this is {}", type));
    else if (!(*link.length >= no_length) || !std::isfinite(*link.length))
      found.add(key, fmt::format("length {} m, needs a positive number", *link.length));
  }
  if (link.made && link.type != LinkType::RS && link.type != LinkType::SR)
    found.add(key, fmt::format("two lengths can be given to RS and SR links only, this is {}", type));
  else if (link.made && !((*link.made)[0] >= no_length && (*link.made)[1] >= no_length))
    found.add(key, fmt::format("lengths {} and {} m, need to be positive", (*link.made)[0], (*link.made)[1]));
}

/// A rocker whose axis, arm and rod are as they must be; the rod's far end by `check_point`.
template <class CheckPoint>
void check_rocker(const Suspension& suspension, std::size_t index, const CheckPoint& check_point,
                  CornerFindings& found) {
  const Rocker& rocker = suspension.rockers[index];
  const std::string key = "rocker." + rocker_label(suspension, static_cast<int>(index));
  for (const Vec3& at : {rocker.axis[0], rocker.axis[1], rocker.rod, rocker.driven_by.at})
    if (!finite(at)) return found.add(key, "a coordinate is not a finite number");
  if (norm(rocker.axis[1] - rocker.axis[0]) < no_length)
    return found.add(key, "the two points of its axis are the same", "set them apart along the axis");
  if (off_line(rocker.rod, rocker.axis[0], rocker.axis[1]) < no_length)
    return found.add(key, "the joint of its rod lies on its axis: the rod cannot turn it");
  if (rocker.driven_by.part.kind == PartKind::body)
    return found.add(key, "its rod is fixed to the body at both ends", "fix it to a link or the carrier");
  check_point(key, "the end of its rod", rocker.driven_by, index);
  const Vec3 axis = unit(rocker.axis[1] - rocker.axis[0]), arm = rocker.rod - rocker.axis[0],
             d = rocker.driven_by.at - rocker.axis[0];
  const double drawn = norm(rocker.driven_by.at - rocker.rod), length = rocker.length.value_or(drawn);
  if (!(length >= no_length) || !std::isfinite(length))
    return found.add(key, fmt::format("its rod has a length of {:.6g} mm", 1e3 * length),
                     "set the ends of the rod apart");
  // Nearest and furthest place of the joint on its circle, seen from the far end.
  const double along = dot(arm, axis) - dot(d, axis), arm_radius = norm(cross(arm, axis)),
               radius = norm(cross(d, axis)), least = std::hypot(along, radius - arm_radius),
               most = std::hypot(along, radius + arm_radius);
  if (rocker.length && !(length > least && length < most))
    return found.add(
        key,
        fmt::format("its rod of {:.6g} mm does not reach: its ends are between {:.6g} and {:.6g} mm "
                    "apart as the rocker turns",
                    1e3 * length, 1e3 * least, 1e3 * most),
        fmt::format("as drawn it is {:.6g} mm long", 1e3 * drawn));
  if (std::abs(dot(cross(axis, arm), d)) < toggle * arm_radius * radius)
    found.add(
        key,
        "its rod lies in line with the rocker's arm as drawn (toggle): it turns the rocker to either side",
        "move the axis or the joint of the rod off that line");
}

}  // namespace

Vec3 wheel_axis(Side side, double toe, double camber) { return kernel::wheel_axis(side, toe, camber); }

Suspension mirrored(const Suspension& suspension) {
  Suspension out = suspension;
  out.side = suspension.side == Side::left ? Side::right : Side::left;
  out.wheel.centre = math::mirrored(suspension.wheel.centre);
  for (CornerLink& link : out.links)
    for (auto* points : {&link.body, &link.carrier})
      for (Vec3& point : *points) point = math::mirrored(point);
  for (CornerLink& link : out.links)
    if (link.cross_axis) link.cross_axis = math::mirrored(*link.cross_axis);
  for (Coupler& coupler : out.couplers) {
    coupler.point = math::mirrored(coupler.point);
    if (coupler.begin) coupler.begin = math::mirrored(*coupler.begin);
  }
  // The same rack pulls one wheel and pushes the other; a steering linkage is the same for both wheels.
  out.rack_direction = -math::mirrored(suspension.rack_direction);
  if (out.spring) {
    out.spring->body = math::mirrored(out.spring->body);
    out.spring->moving = math::mirrored(out.spring->moving);
  }
  for (Rocker& rocker : out.rockers)
    for (Vec3* at : {&rocker.axis[0], &rocker.axis[1], &rocker.rod, &rocker.driven_by.at})
      *at = math::mirrored(*at);
  for (CornerElement& element : out.elements)
    for (Vec3* at : {&element.first.at, &element.second.at}) *at = math::mirrored(*at);
  return out;
}

int body_points(LinkType type) {
  return type == LinkType::R || type == LinkType::RR || type == LinkType::RS ? 2 : 1;
}

int carrier_points(LinkType type) {
  switch (type) {
    case LinkType::R:
    case LinkType::S:
      return 0;
    case LinkType::RR:
    case LinkType::SR:
      return 2;
    default:
      return 1;
  }
}

std::string link_label(const Suspension& suspension, int link) {
  const CornerLink& asked = suspension.links.at(link);
  return asked.name.empty() ? fmt::format("link {} ({})", link + 1, name_of(asked.type)) : asked.name;
}

std::string rocker_label(const Suspension& suspension, int rocker) {
  const std::string& name = suspension.rockers.at(rocker).name;
  return name.empty() ? fmt::format("rocker {}", rocker + 1) : name;
}

namespace {

void check_wheel(const Suspension& suspension, CornerFindings& found) {
  const CornerWheel& wheel = suspension.wheel;
  if (!finite(wheel.centre) || !std::isfinite(wheel.toe) || !std::isfinite(wheel.camber))
    found.add("wheel", "a number is not finite");
  else if (suspension.side == Side::left ? !(wheel.centre.y >= 0) : !(wheel.centre.y <= 0))
    found.add(
        "wheel",
        fmt::format("y of the wheel centre is {} m on the {} side", wheel.centre.y, name_of(suspension.side)),
        "y points to the left");
  if (!(wheel.tyre_diameter > 0) || !std::isfinite(wheel.tyre_diameter))
    found.add("wheel", fmt::format("tyre diameter {} m, needs a positive number", wheel.tyre_diameter));
  // At pi/2 toe is not determined; beyond, top and bottom of the wheel change places.
  if (!(std::abs(wheel.camber) < 1.5))
    found.add("wheel", fmt::format("camber {} rad lies beyond 1.5", wheel.camber));
}

// A point fixed to a rod off its line needs a joint that holds the rod's spin.
void check_rod_point(const Suspension& suspension, const std::string& key, const char* what, int link,
                     const Vec3& point, CornerFindings& found) {
  const CornerLink& rod = suspension.links[link];
  const double off = off_line(point, rod.body[0], rod.carrier[0]);
  if (!(off > no_length)) return;
  if (rod.type == LinkType::SS)
    found.add(key,
              fmt::format("{} lies {:.3g} mm off the line of {}, which may turn about it", what, off * 1e3,
                          link_label(suspension, link)),
              "a US link cannot turn about its line: its universal joint holds it");
  else if (!rod.cross_axis && is_upright(rod.carrier[0] - rod.body[0]))
    found.add(key,
              fmt::format(
                  "{} lies {:.3g} mm off the line of {}, which is vertical, so that no axis of its universal "
                  "joint can be taken for granted",
                  what, off * 1e3, link_label(suspension, link)),
              "give the link cross_axis = [x, y, z]");
}

/// Arms and centre link have lengths, the loop is not at a dead centre, and the Pitman arm moves its joint
/// sideways; only rods are joined to the centre link.
void check_steering_linkage(const Suspension& suspension, bool moved, CornerFindings& found) {
  const SteeringLinkage& l = *suspension.steering_linkage;
  const auto add = [&](std::string text, std::string help) {
    found.add("steering_linkage", std::move(text), std::move(help));
  };
  if (!moved)
    return add("moves no link", "write moved_by = \"rack\" in the tie rod's table, or leave it out");
  for (int i = 0; i < static_cast<int>(suspension.links.size()); ++i) {
    const CornerLink& link = suspension.links[static_cast<std::size_t>(i)];
    if (link.moved_by_rack && link.type != LinkType::US && link.type != LinkType::SS)
      return add(fmt::format("{} is a {} link, and only rods (US, SS) are joined to a centre link",
                             link_label(suspension, i), name_of(link.type)),
                 "make it a rod, or steer by a rack");
  }
  if (!(norm(l.axis) > 1e-9)) return add("axis has no length", "for example [0, 0, 1]");
  const Vec3 axis = unit(l.axis);
  const auto across = [&](const Vec3& from, const Vec3& to) {
    const Vec3 d = to - from;
    return d - dot(axis, d) * axis;
  };
  const Vec3 pitman = across(l.pitman_pivot, l.pitman_joint), idler = across(l.idler_pivot, l.idler_joint),
             link = across(l.pitman_joint, l.idler_joint);
  for (const auto& [part, name] :
       {std::pair{&pitman, "the Pitman arm"}, {&idler, "the idler arm"}, {&link, "the centre link"}})
    if (!(norm(*part) > 1e-4))
      return add(fmt::format("{} is {:.4g} mm long across the axis", name, 1e3 * norm(*part)),
                 "move its joints apart");
  constexpr double least_sine = 0.05;
  if (!(std::abs(cross(axis, unit(pitman)).y) > least_sine))
    return add("the Pitman arm lies across the vehicle, and its joint would not move sideways",
               "let it point forward or backward");
  if (!(norm(cross(unit(idler), unit(link))) > least_sine))
    return add("the idler arm is in line with the centre link, and could turn either way",
               "move the pivot of the idler arm");
}

}  // namespace

Diagnostics check(const Suspension& suspension) {
  CornerFindings found;
  check_wheel(suspension, found);

  std::set<std::string> seen;
  for (int i = 0; i < static_cast<int>(suspension.links.size()); ++i) {
    check_link(suspension, i, found);
    if (!suspension.links[i].name.empty() && !seen.insert(suspension.links[i].name).second)
      found.add("link." + suspension.links[i].name,
                fmt::format("two links are called '{}'", suspension.links[i].name));
  }
  bool moved = false;
  for (const CornerLink& link : suspension.links) moved = moved || link.moved_by_rack;
  if (moved && !suspension.steering_linkage && !(std::abs(norm(suspension.rack_direction) - 1) < 1e-9))
    found.add("rack",
              fmt::format("direction of length {}, needs a unit vector", norm(suspension.rack_direction)));
  if (suspension.steering_linkage) check_steering_linkage(suspension, moved, found);
  if (!found.list.empty()) return found.list;  // the following checks look at the links

  const int links = static_cast<int>(suspension.links.size());
  const auto check_hold = [&](const std::string& key, const char* what, int link, const Vec3& point) {
    check_rod_point(suspension, key, what, link, point, found);
  };
  const auto is = [&](int link, std::initializer_list<LinkType> types) {
    for (LinkType type : types)
      if (link >= 0 && link < links && suspension.links[link].type == type) return true;
    return false;
  };
  for (std::size_t i = 0; i < suspension.couplers.size(); ++i) {
    const Coupler& coupler = suspension.couplers[i];
    const std::string key = "coupler." + (coupler.name.empty() ? std::to_string(i + 1) : coupler.name);
    if (!is(coupler.first, {LinkType::US, LinkType::SS}))
      found.add(key, "its first link has to be a US link");
    else if (suspension.links[coupler.first].length)
      found.add(key, "its US link has a length of its own: the coupler's length would not be known");
    if (!is(coupler.second, {LinkType::SR})) found.add(key, "its second link has to be an SR link");
    if (!finite(coupler.point) || !std::isfinite(coupler.fraction) ||
        (coupler.begin && !finite(*coupler.begin)))
      found.add(key, "a number is not finite");
    else if (coupler.begin && is(coupler.first, {LinkType::US, LinkType::SS}))
      check_hold(key, "its beginning", coupler.first, *coupler.begin);
  }
  // A point on a part: the carrier, a link that can hold it, or one of the first `rockers` rockers.
  const auto check_point = [&](const std::string& key, const char* what, const FixedPoint& point,
                               std::size_t rockers) {
    const auto [kind, index] = point.part;
    if (kind == PartKind::link) {
      if (!is(index, {LinkType::US, LinkType::SS, LinkType::RS, LinkType::SR, LinkType::RR}))
        found.add(key,
                  index < 0 || index >= links
                      ? fmt::format("there is no link {}", index)
                      : fmt::format("{} cannot hold it", link_label(suspension, index)),
                  "fix it to the carrier, or to a US, RS, SR or RR link");
      else if (is(index, {LinkType::US, LinkType::SS}))
        check_hold(key, what, index, point.at);
    }
    if (kind == PartKind::rocker && (index < 0 || index >= static_cast<int>(rockers)))
      found.add(key, fmt::format("there is no rocker {} before it", index),
                "a rocker is driven by the carrier, a link or a rocker that stands before it");
  };
  for (std::size_t i = 0; i < suspension.rockers.size(); ++i) check_rocker(suspension, i, check_point, found);
  for (const CornerElement& element : suspension.elements) {
    const std::string& key = element.name;
    if (element.turn) {
      const auto [kind, index] = *element.turn;
      const bool rocker = kind == PartKind::rocker && index >= 0 &&
                          index < static_cast<int>(suspension.rockers.size()),
                 link = kind == PartKind::link && is(index, {LinkType::R, LinkType::RS, LinkType::RR});
      if (!rocker && !link)
        found.add(key, "it is twisted by no part that turns about an axis of the body",
                  "take a rocker, or a link of type RS, RR or R");
      continue;
    }
    if (!finite(element.first.at) || !finite(element.second.at))
      found.add(key, "a coordinate is not a finite number");
    else if (norm(element.second.at - element.first.at) < no_length)
      found.add(key, "both ends are the same point");
    else
      for (const FixedPoint* point : {&element.first, &element.second})
        check_point(key, "its end", *point, suspension.rockers.size());
  }
  if (suspension.spring) {
    const CornerSpring& spring = *suspension.spring;
    if (!finite(spring.body) || !finite(spring.moving)) {
      found.add("spring", "a coordinate is not a finite number");
    } else if (norm(spring.moving - spring.body) < no_length) {
      found.add("spring", "both ends are the same point");
    } else {
      const CornerPart part =
          spring.link < -1 ? CornerPart{PartKind::link, spring.link} : moving_part(spring);
      check_point("spring", "its moving end", {spring.moving, part}, suspension.rockers.size());
      check_point("spring", "its first end", {spring.body, spring.body_part}, suspension.rockers.size());
    }
  }
  return found.list;
}

}  // namespace linkwright::suspension
