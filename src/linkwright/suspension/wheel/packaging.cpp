// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/packaging.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/minimum.h"
#include "linkwright/suspension/corner/detail/rockers_kernel.h"

namespace linkwright::suspension {
namespace {

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

/// Of two directions without a sense.
double acute_angle(const Vec3& a, const Vec3& b) {
  const double angle = angle_between(a, b);
  return std::min(angle, pi - angle);
}

/// A point of the carrier, given at the reference.
Vec3 carried(const CornerPlan& plan, const CornerPosition& position, const Vec3& at) {
  const CarrierPose& carrier = position.place.carrier;
  return carrier.centre + carrier.rotation * (at - plan.wheel.centre);
}

double distance_to_circle(const Vec3& point, const Vec3& centre, const Vec3& axis, double radius) {
  const Vec3 d = point - centre;
  const double along = dot(d, axis), across = norm(d - along * axis);
  return std::hypot(along, across - radius);
}

double distance_to_box(const Vec3& point, const Box& box) {
  const auto beyond = [](double at, double lower, double upper) {
    return std::max({lower - at, 0.0, at - upper});
  };
  return norm(Vec3{beyond(point.x, box.lower.x, box.upper.x), beyond(point.y, box.lower.y, box.upper.y),
                   beyond(point.z, box.lower.z, box.upper.z)});
}

/// The least value of a function between two arguments where it has one minimum, by golden sections.
template <class Function>
double least_between(double low, double high, Function&& value) {
  math::GoldenSection section{value, low, high};
  for (int i = 0; i < 60; ++i) section.narrow();
  return std::min(section.at_left, section.at_right);
}

/// The least value of a function between 0 and 1 that may have several minima: the least of a row of points
/// begins the search.
template <class Function>
double least_of_all(int points, Function&& value) {
  int best = 0;
  for (int i = 1; i <= points; ++i)
    if (value(static_cast<double>(i) / points) < value(static_cast<double>(best) / points)) best = i;
  return least_between(std::max(0, best - 1) / static_cast<double>(points),
                       std::min(points, best + 1) / static_cast<double>(points), value);
}

}  // namespace

HalfShaftState half_shaft(const CornerPlan& plan, const HalfShaft& shaft, const CornerPosition& position) {
  const Vec3 axis = unit(shaft.inner_axis), line = carried(plan, position, shaft.outer) - shaft.inner;
  HalfShaftState out;
  out.inner_angle = acute_angle(line, axis);
  out.outer_angle = acute_angle(line, position.place.carrier.rotation * plan.wheel_axis);
  out.length = norm(line);
  out.plunge = std::abs(dot(line, axis)) - std::abs(dot(shaft.outer - shaft.inner, axis));
  return out;
}

double ball_joint_angle(const Suspension& suspension, const CornerPlan& plan, const BallJoint& joint,
                        const CornerPosition& position) {
  const CornerLink& link = suspension.links.at(static_cast<std::size_t>(joint.link));
  const std::vector<Vec3>& points = joint.at_carrier ? link.carrier : link.body;
  LINKWRIGHT_REQUIRE(!points.empty(), "link {} has no joint at its {}", joint.link,
                     joint.at_carrier ? "carrier" : "body");
  // A tenth of a metre along the stud, as the link carries it.
  const Vec3 stud = 0.1 * unit(joint.stud);
  const kernel::Placed<double> placed{plan, position.place, position.input.rack};
  const auto on_link = [&](const Vec3& at) {
    const FixedPoint fixed{at, {PartKind::link, joint.link}};
    return kernel::part_point(placed, kernel::part_point_of(suspension, plan, fixed));
  };
  const Vec3 of_link = on_link(points[0] + stud) - on_link(points[0]);
  return angle_between(of_link, joint.at_carrier ? position.place.carrier.rotation * stud : stud);
}

double distance(const Segment& a, const Segment& b) {
  const Vec3 u = a.to - a.from, v = b.to - b.from, w = a.from - b.from;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const auto part = [](double numerator, double denominator) {
    return denominator > 0 ? std::clamp(numerator / denominator, 0.0, 1.0) : 0.0;
  };
  // The nearest points of the lines, then each in turn brought onto its own segment. For parallel lines any
  // point of the first will do.
  double s = part(uv * vw - vv * uw, uu * vv - uv * uv);
  const double t = part(s * uv + vw, vv);
  s = part(t * uv - uw, uu);
  return norm(w + s * u - part(s * uv + vw, vv) * v);
}

double distance(const Segment& line, const Vec3& centre, const Vec3& axis, double radius) {
  const auto at = [&](double s) {
    return distance_to_circle(line.from + s * (line.to - line.from), centre, axis, radius);
  };
  return least_of_all(48, at);
}

double distance(const Segment& line, const Box& box) {
  // The distance from a box is convex along a line; at the ends no section comes to rest exactly.
  const auto at = [&](double s) { return distance_to_box(line.from + s * (line.to - line.from), box); };
  return std::min({at(0), at(1), least_between(0, 1, at)});
}

double distance(const TyreCircle& tyre, const Box& box) {
  const std::array<Vec3, 2> across = math::across(tyre.axis);
  return least_of_all(96, [&](double turn) {
    const double angle = 2 * pi * turn;
    return distance_to_box(
        tyre.centre + tyre.radius * (std::cos(angle) * across[0] + std::sin(angle) * across[1]), box);
  });
}

std::vector<Segment> lines_of(const CornerPlan& plan, int link, const CornerPosition& position) {
  const LinkConstants& of = plan.links[static_cast<std::size_t>(link)];
  const kernel::Placed<double> placed{plan, position.place, position.input.rack};
  const auto outer = [&](int i) { return placed.point(placed.offset(of.offset[i])); };
  switch (of.type) {
    case LinkType::US:
    case LinkType::SS:
    case LinkType::SP:
    case LinkType::RR:
      return {{placed.body(of, 0), outer(0)}};
    case LinkType::RS:
      return {{placed.body(of, 0), outer(0)}, {placed.body(of, 1), outer(0)}};
    case LinkType::SR:
      return {{placed.body(of, 0), outer(0)}, {placed.body(of, 0), outer(1)}};
    case LinkType::R:
    case LinkType::S:
      break;
  }
  return {};
}

TyreCircle tyre_circle(const CornerPlan& plan, double width, const CornerPosition& position) {
  return {position.place.carrier.centre, position.place.carrier.rotation * plan.wheel_axis,
          (plan.wheel.tyre_diameter - width) / 2};
}

}  // namespace linkwright::suspension
