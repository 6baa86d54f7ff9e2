// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "linkwright/suspension/corner/detail/points_kernel.h"

/// Rockers, and lengths and angles between the parts of a suspension, written once for numbers and for
/// numbers with derivatives.
namespace linkwright::suspension::kernel {

/// A rocker in a pose. The rod's length l gives, with d from the axis to its far end, e from the axis to its
/// joint on the rocker (p along the axis k, the rest e' across it) and the angle w,
///     a cos w + b sin w = c,  a = e'.d, b = (k x e').d, c = (e.e + d.d - l l) / 2 - p k.d.
/// Its derivative by w, the moment s = b cos w - a sin w, keeps its sign between the toggles, where the rod
/// lies in line with the rocker's arm and s is 0: s = +- sqrt(a a + b b - c c), and no angle has to be
/// guessed.
template <class T>
struct RockerPose {
  T cosine{1}, sine{0};
  T moment{0};      ///< s, m2
  T reach{0};       ///< a a + b b, m4: the rod reaches as long as moment^2 is above 0
  T clearance{0};   ///< a a + b b - c c, m4: below 0 the rod does not reach
  Vector3<T> pull;  ///< from the rod's joint on the rocker to its far end, m
};

template <class T>
Vector3<T> turned(const BasicRockerConstants<T>& rocker, const RockerPose<T>& pose, const Vector3<T>& arm) {
  const Vector3<T> along = dot(arm, rocker.axis) * rocker.axis, across = arm - along;
  return along + pose.cosine * across + pose.sine * cross(rocker.axis, across);
}

template <class T>
Vector3<T> part_point(const Placed<T>& placed, const BasicPartPoint<T>& point);

template <class T>
RockerPose<T> rocker_pose(const Placed<T>& placed, const BasicRockerConstants<T>& rocker) {
  using std::sqrt;
  const Vector3<T> d = part_point(placed, rocker.driver) - rocker.at;
  const T along = dot(rocker.rod, rocker.axis);
  const Vector3<T> across = rocker.rod - along * rocker.axis;
  const T a = dot(across, d), b = dot(cross(rocker.axis, across), d);
  const T c = (dot(rocker.rod, rocker.rod) + dot(d, d) - rocker.length * rocker.length) / 2 -
              along * dot(rocker.axis, d);
  RockerPose<T> out;
  out.reach = a * a + b * b;
  out.clearance = out.reach - c * c;
  out.moment = sqrt(out.clearance);
  if (!rocker.positive) out.moment = -out.moment;
  out.cosine = (a * c + b * out.moment) / out.reach;
  out.sine = (b * c - a * out.moment) / out.reach;
  out.pull = d - turned(rocker, out, rocker.rod);
  return out;
}

/// Angle of a rocker (rad, from the drawing, within half a turn).
template <class T>
T rocker_angle(const Placed<T>& placed, const BasicRockerConstants<T>& rocker) {
  using std::atan2;
  const RockerPose<T> pose = rocker_pose(placed, rocker);
  return atan2(pose.sine, pose.cosine);
}

template <class T>
bool is_rod(const BasicLinkConstants<T>& link) {
  return link.type == LinkType::US || link.type == LinkType::SS;
}

template <class T>
LinkPoint<T> link_point(const Placed<T>& placed, const BasicPartPoint<T>& point) {
  const BasicLinkConstants<T>& link = placed.plan.links[point.part.index];
  return is_rod(link) ? rod_point(placed, link, point.on_rod) : frame_point(placed, link, point.point);
}

/// Place of a point.
template <class T>
Vector3<T> part_point(const Placed<T>& placed, const BasicPartPoint<T>& point) {
  switch (point.part.kind) {
    case PartKind::body:
      return point.at;
    case PartKind::carrier:
      return placed.point(placed.offset(point.at));
    case PartKind::link: {
      const BasicLinkConstants<T>& link = placed.plan.links[point.part.index];
      if (link.type == LinkType::RR)
        return placed.body(link, 0) + math::turn_about(placed.at.arm * link.axis) * point.at;
      return link_point(placed, point).at;
    }
    case PartKind::rocker: {
      const BasicRockerConstants<T>& rocker = placed.plan.rockers[point.part.index];
      return rocker.at + turned(rocker, rocker_pose(placed, rocker), point.at);
    }
  }
  return {};
}

template <class T>
void add_part_point(const Placed<T>& placed, const BasicPartPoint<T>& point, const Vector3<T>& weight,
                    Row<T>& row);

/// Adds weight (change of the rocker's angle) to a row.
template <class T>
void add_rocker_angle(const Placed<T>& placed, const BasicRockerConstants<T>& rocker,
                      const RockerPose<T>& pose, const T& weight, Row<T>& row) {
  add_part_point(placed, rocker.driver, (weight / pose.moment) * pose.pull, row);
}

/// Adds weight . (shift of the point) to a row.
template <class T>
void add_part_point(const Placed<T>& placed, const BasicPartPoint<T>& point, const Vector3<T>& weight,
                    Row<T>& row) {
  switch (point.part.kind) {
    case PartKind::body:
      return;
    case PartKind::carrier:
      row.point(weight, placed.offset(point.at));
      return;
    case PartKind::link: {
      const BasicLinkConstants<T>& link = placed.plan.links[point.part.index];
      if (link.type == LinkType::RR) {
        const Vector3<T> reach = math::turn_about(placed.at.arm * link.axis) * point.at;
        row.of[6] += dot(weight, cross(link.axis, reach));
        row.by_rack += placed.by_rack(link, 0, weight);
      } else {
        add_point(placed, link_point(placed, point), weight, row);
      }
      return;
    }
    case PartKind::rocker: {
      const BasicRockerConstants<T>& rocker = placed.plan.rockers[point.part.index];
      const RockerPose<T> pose = rocker_pose(placed, rocker);
      const T torque = dot(weight, cross(rocker.axis, turned(rocker, pose, point.at)));
      add_rocker_angle(placed, rocker, pose, torque, row);
      return;
    }
  }
}

/// A force on a part that is no rocker.
template <class T>
struct PassedForce {
  CornerPart part;
  Vector3<T> at, force;  ///< m, N
};

/// The force at a point as it arrives on the carrier, a link or the body: rockers pass it on by their rods.
template <class T>
PassedForce<T> passed_force(const Placed<T>& placed, const BasicPartPoint<T>& point,
                            const Vector3<T>& force) {
  if (point.part.kind != PartKind::rocker) return {point.part, part_point(placed, point), force};
  const BasicRockerConstants<T>& rocker = placed.plan.rockers[point.part.index];
  const RockerPose<T> pose = rocker_pose(placed, rocker);
  const T torque = dot(force, cross(rocker.axis, turned(rocker, pose, point.at)));
  return passed_force(placed, rocker.driver, (torque / pose.moment) * pose.pull);
}

/// Distance of two points; adds its derivatives to the row.
template <class T>
T part_distance(const Placed<T>& placed, const BasicPartPoint<T>& first, const BasicPartPoint<T>& second,
                Row<T>& row) {
  const Vector3<T> d = part_point(placed, second) - part_point(placed, first), weight = unit(d);
  add_part_point(placed, second, weight, row);
  if (first.part.kind != PartKind::body) add_part_point(placed, first, -weight, row);
  return norm(d);
}

/// Angle of a part about its hinge or its axis; adds its derivatives to the row.
template <class T>
T part_angle(const Placed<T>& placed, const BasicElementConstants<T>& element, Row<T>& row) {
  using std::atan2;
  if (element.turn->kind == PartKind::rocker) {
    const BasicRockerConstants<T>& rocker = placed.plan.rockers[element.turn->index];
    const RockerPose<T> pose = rocker_pose(placed, rocker);
    add_rocker_angle(placed, rocker, pose, T(1), row);
    return atan2(pose.sine, pose.cosine);
  }
  const BasicLinkConstants<T>& link = placed.plan.links[element.turn->index];
  const double sign = placed.plan.side == Side::left ? 1 : -1;
  const Vector3<T> axis = sign * link.axis, side = cross(axis, element.mark);
  if (link.type == LinkType::RR) {
    row.of[6] += sign;
    return sign * placed.at.arm;
  }
  if (link.type == LinkType::R) {
    const Vector3<T> now = placed.offset(element.mark);
    row.turn(axis);
    return atan2(dot(now, side), dot(now, element.mark));
  }
  const Vector3<T> r = placed.offset(link.offset[0]), arm = placed.point(r) - placed.body(link, 0);
  const Vector3<T> across = arm - dot(arm, axis) * axis;
  const Vector3<T> weight = (1 / dot(across, across)) * cross(axis, across);
  row.point(weight, r);
  row.by_rack -= placed.by_rack(link, 0, weight);
  return atan2(dot(across, side), dot(across, element.mark));
}

/// Distance of a point from its mirror image beyond the middle plane of the vehicle; adds its derivatives to
/// the row.
template <class T>
T distance_across(const Placed<T>& placed, const BasicPartPoint<T>& point, Row<T>& row) {
  const T y = part_point(placed, point).y;
  const T twice(y < T(0) ? -2.0 : 2.0);
  add_part_point(placed, point, Vector3<T>{T(0), twice, T(0)}, row);
  return twice * y;
}

/// Length or angle of an element; adds its derivatives to the row.
template <class T>
T element_value(const Placed<T>& placed, const BasicElementConstants<T>& element, Row<T>& row) {
  if (element.across) return distance_across(placed, element.second, row);
  return element.turn ? part_angle(placed, element, row)
                      : part_distance(placed, element.first, element.second, row);
}

/// The constants of a point that is fixed to a part; those of links and of rockers before it are known.
template <class T>
BasicPartPoint<T> part_point_of(const BasicSuspension<T>& suspension, const BasicCornerPlan<T>& plan,
                                const BasicFixedPoint<T>& point) {
  BasicPartPoint<T> out{.part = point.part, .at = point.at};
  if (point.part.kind == PartKind::carrier) out.at = point.at - suspension.wheel.centre;
  if (point.part.kind == PartKind::rocker) out.at = point.at - plan.rockers[point.part.index].at;
  if (point.part.kind != PartKind::link) return out;
  const BasicCornerLink<T>& link = suspension.links[point.part.index];
  if (link.type == LinkType::RR)
    out.at = point.at - link.body[0];
  else if (link.type == LinkType::RS)
    out.point = affine_of(point.at, link.body[0], link.body[1], link.carrier[0]);
  else if (link.type == LinkType::SR)
    out.point = affine_of(point.at, link.carrier[0], link.body[0], link.carrier[1]);
  else
    out.on_rod = rod_point_of(point.at, link.body[0], link.carrier[0], link.type,
                              plan.links[point.part.index].standing_axis);
  return out;
}

/// The constants of a rocker.
template <class T>
BasicRockerConstants<T> rocker_of(const BasicSuspension<T>& suspension, const BasicCornerPlan<T>& plan,
                                  const BasicRocker<T>& from) {
  BasicRockerConstants<T> out{.at = from.axis[0], .axis = unit(from.axis[1] - from.axis[0])};
  if (suspension.side == Side::right) out.axis = -out.axis;
  out.rod = from.rod - out.at;
  out.driver = part_point_of(suspension, plan, from.driven_by);
  out.length = from.length.value_or(norm(from.rod - from.driven_by.at));
  out.positive = dot(cross(out.axis, out.rod), from.driven_by.at - out.at) > 0;
  return out;
}

/// The constants of an element.
template <class T>
BasicElementConstants<T> element_of(const BasicSuspension<T>& suspension, const BasicCornerPlan<T>& plan,
                                    const BasicCornerElement<T>& from) {
  BasicElementConstants<T> out{.turn = from.turn, .across = from.across};
  if (!from.turn) {
    out.first = part_point_of(suspension, plan, from.first);
    out.second = part_point_of(suspension, plan, from.second);
  } else if (from.turn->kind == PartKind::link) {
    const BasicCornerLink<T>& link = suspension.links[from.turn->index];
    const Vector3<T> axis = unit(link.body[1] - link.body[0]);
    out.mark = math::across(axis)[0];
    if (link.type == LinkType::RS) {
      const Vector3<T> arm = link.carrier[0] - link.body[0];
      out.mark = unit(arm - dot(arm, axis) * axis);
    }
  }
  return out;
}

}  // namespace linkwright::suspension::kernel
