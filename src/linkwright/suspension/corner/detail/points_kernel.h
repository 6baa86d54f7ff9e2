// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "linkwright/math/scalar.h"
#include "linkwright/suspension/corner/detail/steering_kernel.h"
#include "linkwright/suspension/corner/position.h"

/// Points of links and of the carrier in a pose, and how they move.
namespace linkwright::suspension::kernel {

/// One equation: a sum of weights on moving points.
template <class T>
struct Row {
  std::array<T, max_unknowns>& of;
  T& by_rack;

  template <class W>
  void add(const Vector3<W>& weight, const Vector3<T>& turn) {
    of[0] += weight.x;
    of[1] += weight.y;
    of[2] += weight.z;
    of[3] += turn.x;
    of[4] += turn.y;
    of[5] += turn.z;
  }
  /// weight . (shift of the carrier's point at `offset` from the wheel centre)
  template <class W>
  void point(const Vector3<W>& weight, const Vector3<T>& offset) {
    add(weight, cross(offset, weight));
  }
  void turn(const Vector3<T>& weight) { add(Vec3{}, weight); }
};

/// Rate of the sum that a row stands for.
template <class T>
T rate_of(const Row<T>& row, const BasicTwist<T>& twist, double rack_rate) {
  const auto& by = row.of;
  return dot(Vector3<T>{by[0], by[1], by[2]}, twist.velocity) +
         dot(Vector3<T>{by[3], by[4], by[5]}, twist.turning) + by[6] * twist.arm + row.by_rack * rack_rate;
}

inline constexpr std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

/// A place with what many rows use.
template <class T>
struct Placed {
  const BasicCornerPlan<T>& plan;
  const BasicCornerPlace<T>& at;
  T rack;
  std::optional<CentreLink<T>> centre_link;

  Placed(const BasicCornerPlan<T>& of, const BasicCornerPlace<T>& place, const T& displacement)
      : plan(of), at(place), rack(displacement) {
    if (plan.steering_linkage) centre_link = kernel::centre_link(*plan.steering_linkage, rack);
  }

  Vector3<T> offset(const Vector3<T>& reference) const { return at.carrier.rotation * reference; }
  Vector3<T> point(const Vector3<T>& turned) const { return at.carrier.centre + turned; }
  Vector3<T> body(const BasicLinkConstants<T>& link, int i) const {
    if (!link.moved_by_rack) return link.body[i];
    return centre_link ? centre_link->point(link.body[i]) : link.body[i] + rack * plan.rack_direction;
  }
  /// weight . (derivative of a body point by the rack displacement)
  template <class W>
  T by_rack(const BasicLinkConstants<T>& link, int i, const Vector3<W>& weight) const {
    if (!link.moved_by_rack) return T(0);
    return centre_link ? dot(weight, centre_link->speed(body(link, i))) : T(dot(weight, plan.rack_direction));
  }
};

template <class T>
Vector3<T> affine(const BasicAffinePoint<T>& at, const Vector3<T>& p, const Vector3<T>& f1,
                  const Vector3<T>& f2) {
  return p + at.a * f1 + at.b * f2 + at.k * cross(f1, f2);
}

template <class T>
BasicAffinePoint<T> affine_of(const Vector3<T>& point, const Vector3<T>& p, const Vector3<T>& q,
                              const Vector3<T>& s) {
  const Vector3<T> f1 = q - p, f2 = s - p, normal = cross(f1, f2), d = point - p;
  const T area = dot(normal, normal);
  return {dot(cross(d, f2), normal) / area, dot(cross(f1, d), normal) / area, dot(d, normal) / area};
}

/// Weights on f1 and f2 that give weight . (a f1 + b f2 + k f1 x f2) to first order.
template <class T>
std::array<Vector3<T>, 2> affine_weights(const BasicAffinePoint<T>& at, const Vector3<T>& weight,
                                         const Vector3<T>& f1, const Vector3<T>& f2) {
  return {at.a * weight + at.k * cross(f2, weight), at.b * weight + at.k * cross(weight, f1)};
}

/// A point of a link and how it moves: adds weight . (its shift) to a row.
template <class T>
struct LinkPoint {
  Vector3<T> at;
  const BasicLinkConstants<T>* link = nullptr;  ///< null = the carrier
  Vector3<T> offset;                            ///< carrier
  BasicRodPoint<T> rod;                         ///< US, SS
  Vector3<T> line, turning;    ///< US: along the rod, and the U joint's axis that turns with it
  BasicAffinePoint<T> affine;  ///< SR: from the first hinge point; RS: from the first body point
  Vector3<T> f1, f2, r1, r2;
};

template <class T>
LinkPoint<T> rod_point(const Placed<T>& placed, const BasicLinkConstants<T>& link,
                       const BasicRodPoint<T>& rod) {
  LinkPoint<T> out{.link = &link, .rod = rod};
  out.r1 = placed.offset(link.offset[0]);
  const Vector3<T> from = placed.body(link, 0);
  out.line = placed.point(out.r1) - from;
  out.at = from + rod.along * out.line;
  if (!rod.held) return out;
  out.turning = unit(cross(link.standing_axis, out.line));
  out.at += rod.beside * out.turning + (rod.above / link.length[0]) * cross(out.line, out.turning);
  return out;
}

/// Weight on the rod's carrier point that gives weight . (shift of the point) to first order, the body point
/// standing still.
template <class T>
Vector3<T> rod_weight(const LinkPoint<T>& point, const Vector3<T>& weight) {
  const BasicRodPoint<T>& rod = point.rod;
  Vector3<T> out = rod.along * weight;
  if (!rod.held) return out;
  // The rod keeps its length, so that what the offset across both axes turns by is the line and the axis.
  const T above = rod.above / point.link->length[0];
  const Vector3<T>& b = point.turning;
  const Vector3<T> by_axis = rod.beside * weight + above * cross(weight, point.line);
  const T lever = norm(cross(point.link->standing_axis, point.line));
  const Vector3<T> across = (1 / lever) * (by_axis - dot(by_axis, b) * b);
  return out + above * cross(b, weight) + cross(across, point.link->standing_axis);
}

/// The point of a rod that is at `point` when the rod lies between `body` and `carrier`.
template <class T>
BasicRodPoint<T> rod_point_of(const Vector3<T>& point, const Vector3<T>& body, const Vector3<T>& carrier,
                              LinkType type, const Vector3<T>& standing_axis) {
  const Vector3<T> line = carrier - body, from = point - body;
  BasicRodPoint<T> out{.along = dot(from, line) / dot(line, line)};
  if (type != LinkType::US) return out;
  const Vector3<T> turning = unit(cross(standing_axis, line));
  out.held = true;
  out.beside = dot(from, turning);
  out.above = dot(from, cross(unit(line), turning));
  return out;
}

template <class T>
LinkPoint<T> frame_point(const Placed<T>& placed, const BasicLinkConstants<T>& link,
                         const BasicAffinePoint<T>& point) {
  LinkPoint<T> out{.link = &link, .affine = point};
  out.r1 = placed.offset(link.offset[0]);
  if (link.type == LinkType::SR) {  // P, Q, S = hinge point, ball joint at the body, other hinge point
    out.r2 = placed.offset(link.offset[1]);
    const Vector3<T> p = placed.point(out.r1);
    out.f1 = placed.body(link, 0) - p;
    out.f2 = out.r2 - out.r1;
    out.at = affine(point, p, out.f1, out.f2);
  } else {  // RS: hinge point, other hinge point, ball joint at the carrier
    const Vector3<T> p = placed.body(link, 0);
    out.f1 = link.body[1] - link.body[0];
    out.f2 = placed.point(out.r1) - p;
    out.at = affine(point, p, out.f1, out.f2);
  }
  return out;
}

template <class T>
void add_point(const Placed<T>& placed, const LinkPoint<T>& point, const Vector3<T>& weight, Row<T>& row) {
  const BasicLinkConstants<T>& link = *point.link;
  if (link.type == LinkType::SR) {
    const auto [w1, w2] = affine_weights(point.affine, weight, point.f1, point.f2);
    row.point(weight - w1 - w2, point.r1);
    row.point(w2, point.r2);
    row.by_rack += placed.by_rack(link, 0, w1);
  } else if (link.type == LinkType::RS) {
    const Vector3<T> w2 = affine_weights(point.affine, weight, point.f1, point.f2)[1];
    row.point(w2, point.r1);
    row.by_rack += placed.by_rack(link, 0, weight - w2);
  } else {
    const Vector3<T> w1 = rod_weight(point, weight);
    row.point(w1, point.r1);
    row.by_rack += placed.by_rack(link, 0, weight - w1);
  }
}

}  // namespace linkwright::suspension::kernel
