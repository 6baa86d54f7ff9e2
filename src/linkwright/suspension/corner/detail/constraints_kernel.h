// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "linkwright/math/scalar.h"
#include "linkwright/suspension/corner/detail/rockers_kernel.h"
#include "linkwright/suspension/corner/detail/wheel_kernel.h"
#include "linkwright/suspension/corner/position.h"

/// The equations of a wheel suspension, written once for numbers and for numbers with derivatives.
namespace linkwright::suspension::kernel {

template <class T>
struct Writer {
  BasicCornerEquations<T>& out;
  int next = 0;
  Row<T> row(const T& residual) {
    out.residual[next] = residual;
    out.jacobian[next] = {};
    out.by_rack[next] = 0;
    Row<T> made{out.jacobian[next], out.by_rack[next]};
    ++next;
    return made;
  }
};

/// Residual of a distance that should be `length`, and the weight on the end that moves.
template <class T>
T distance_residual(const Vector3<T>& d, const T& length) {
  return (dot(d, d) - length * length) / (2 * length);
}

template <class T>
LINKWRIGHT_KERNEL void write_distance(const Placed<T>& placed, const BasicLinkConstants<T>& link, int body,
                                      int carrier, int which, Writer<T>& to) {
  const Vector3<T> r = placed.offset(link.offset[carrier]);
  const Vector3<T> d = placed.point(r) - placed.body(link, body);
  const T length = link.length[which];
  Row<T> row = to.row(distance_residual(d, length));
  const Vector3<T> weight = (1 / length) * d;
  row.point(weight, r);
  row.by_rack = -placed.by_rack(link, body, weight);
}

template <class T>
void write_meeting(const Placed<T>& placed, const BasicLinkConstants<T>& link, const Vector3<T>& r,
                   const Vector3<T>& target, Writer<T>& to) {
  const Vector3<T> miss = placed.point(r) - target;
  const std::array<T, 3> residual{miss.x, miss.y, miss.z};
  for (int k = 0; k < 3; ++k) {
    Row<T> row = to.row(residual[k]);
    row.point(axes[k], r);
    row.by_rack = -placed.by_rack(link, 0, axes[k]);
  }
}

template <class T>
LINKWRIGHT_KERNEL void write_link(const Placed<T>& placed, const BasicLinkConstants<T>& link, Writer<T>& to) {
  switch (link.type) {
    case LinkType::US:
    case LinkType::SS:
      write_distance(placed, link, 0, 0, 0, to);
      return;
    case LinkType::RS:
      write_distance(placed, link, 0, 0, 0, to);
      write_distance(placed, link, 1, 0, 1, to);
      return;
    case LinkType::SR:
      write_distance(placed, link, 0, 0, 0, to);
      write_distance(placed, link, 0, 1, 1, to);
      return;
    case LinkType::SP: {
      const Vector3<T> r = placed.offset(link.offset[0]), d = placed.point(r) - placed.body(link, 0);
      for (const Vector3<T>& normal : link.across) {
        const Vector3<T> n = placed.offset(normal);
        Row<T> row = to.row(dot(d, n));
        row.point(n, r);
        row.turn(cross(n, d));
        row.by_rack = -placed.by_rack(link, 0, n);
      }
      return;
    }
    case LinkType::S:
      write_meeting(placed, link, placed.offset(link.offset[0]), placed.body(link, 0), to);
      return;
    case LinkType::R: {
      write_meeting(placed, link, placed.offset(link.offset[0]), placed.body(link, 0), to);
      const Vector3<T> w = placed.offset(link.carrier_axis);
      for (const Vector3<T>& normal : link.across) to.row(dot(w, normal)).turn(cross(w, normal));
      return;
    }
    case LinkType::RR: {
      const Vector3<T> p0 = placed.body(link, 0);
      const Matrix3<T> arm = math::turn_about(placed.at.arm * link.axis);
      const Vector3<T> reach = arm * (placed.plan.wheel.centre + link.offset[0] - link.body[0]);
      const int first = to.next;
      write_meeting(placed, link, placed.offset(link.offset[0]), p0 + reach, to);
      const Vector3<T> by_arm = cross(link.axis, reach);
      to.out.jacobian[first][6] = -by_arm.x;
      to.out.jacobian[first + 1][6] = -by_arm.y;
      to.out.jacobian[first + 2][6] = -by_arm.z;
      const Vector3<T> w = placed.offset(link.carrier_axis);
      for (const Vector3<T>& normal : link.across) {
        const Vector3<T> n = arm * normal;
        Row<T> row = to.row(dot(w, n));
        row.turn(cross(w, n));
        row.of[6] = dot(w, cross(link.axis, n));
      }
      return;
    }
  }
}

template <class T>
struct CouplerEnds {
  LinkPoint<T> first, second;
  Vector3<T> between;
};

template <class T>
CouplerEnds<T> ends(const Placed<T>& placed, const BasicCouplerConstants<T>& coupler) {
  CouplerEnds<T> out{rod_point(placed, placed.plan.links[coupler.first], coupler.begin),
                     frame_point(placed, placed.plan.links[coupler.second], coupler.point),
                     {}};
  out.between = out.second.at - out.first.at;
  return out;
}

template <class T>
void write_coupler(const Placed<T>& placed, const BasicCouplerConstants<T>& coupler, Writer<T>& to) {
  const CouplerEnds<T> at = ends(placed, coupler);
  Row<T> row = to.row(distance_residual(at.between, coupler.length));
  const Vector3<T> weight = (1 / coupler.length) * at.between;
  add_point(placed, at.second, weight, row);
  add_point(placed, at.first, -weight, row);
}

/// Length of the spring; adds its derivatives to the row.
template <class T>
T spring_length(const Placed<T>& placed, Row<T>& row) {
  const BasicSpringConstants<T>& spring = *placed.plan.spring;
  return part_distance(placed, spring.first, spring.second, row);
}

/// Value of the driver's coordinate; its derivatives go to the row, which starts as zeros.
template <class T>
T write_driver(const Placed<T>& placed, Driver driver, Row<T>& row) {
  using std::cos;
  using std::sqrt;
  const BasicCornerWheel<T>& wheel = placed.plan.wheel;
  const T rise = placed.at.carrier.centre.z - wheel.centre.z;
  switch (driver) {
    case Driver::wheel_centre_z:
      row.of[2] = 1;
      return rise;
    case Driver::contact_z: {
      const Vector3<T> u = placed.offset(placed.plan.wheel_axis);
      const double radius = wheel.tyre_diameter / 2;
      const T cosine = sqrt(1 - u.z * u.z);
      row.add(Vec3{0, 0, 1}, (radius * u.z / cosine) * cross(u, Vec3{0, 0, 1}));
      return rise - radius * (cosine - cos(wheel.camber));
    }
    case Driver::spring:
      return spring_length(placed, row) - placed.plan.spring->length;
  }
  return T(0);
}

/// `prepare_suspension` for a suspension that has been checked, without labels.
template <class T>
BasicCornerPlan<T> prepare(const BasicSuspension<T>& suspension) {
  BasicCornerPlan<T> plan{
      .side = suspension.side,
      .wheel = suspension.wheel,
      .wheel_axis = wheel_axis(suspension.side, suspension.wheel.toe, suspension.wheel.camber),
      .rack_direction = suspension.rack_direction,
      .steering_linkage = suspension.steering_linkage,
      .construction = construction_of(suspension.links)};
  const Vector3<T>& centre = suspension.wheel.centre;
  plan.contact =
      centre + contact_offset(suspension.side, suspension.wheel.tyre_diameter,
                              BasicWheelAngles<T>{suspension.wheel.toe, suspension.wheel.camber, T(0)});
  for (const BasicCornerLink<T>& from : suspension.links) {
    BasicLinkConstants<T> link{.type = from.type, .moved_by_rack = from.moved_by_rack};
    for (std::size_t k = 0; k < from.body.size(); ++k) link.body[k] = from.body[k];
    for (std::size_t k = 0; k < from.carrier.size(); ++k) link.offset[k] = from.carrier[k] - centre;
    if (from.body.size() == 2) link.axis = unit(from.body[1] - from.body[0]);
    switch (from.type) {
      case LinkType::US:
      case LinkType::SS:
        link.length[0] = from.length.value_or(norm(from.carrier[0] - from.body[0]));
        if (from.type == LinkType::US)
          link.standing_axis = standing_axis(from.cross_axis, from.carrier[0] - from.body[0]);
        break;
      case LinkType::RS:
        for (int k = 0; k < 2; ++k)
          link.length[k] = from.made ? (*from.made)[k] : norm(from.carrier[0] - from.body[k]);
        break;
      case LinkType::SR:
        for (int k = 0; k < 2; ++k)
          link.length[k] = from.made ? (*from.made)[k] : norm(from.carrier[k] - from.body[0]);
        break;
      case LinkType::SP:
        link.axis = unit(from.carrier[0] - from.body[0]);
        link.across = math::across(link.axis);
        break;
      case LinkType::S:
        link.offset[0] = from.body[0] - centre;
        break;
      case LinkType::R:
        link.offset[0] = from.body[0] - centre;
        link.carrier_axis = link.axis;
        link.across = math::across(link.axis);
        break;
      case LinkType::RR:
        link.carrier_axis = unit(from.carrier[1] - from.carrier[0]);
        link.across = math::across(link.carrier_axis);
        plan.unknowns = 7;
        break;
    }
    plan.links.push_back(link);
  }
  for (const BasicCoupler<T>& from : suspension.couplers) {
    const BasicCornerLink<T>&rod = suspension.links[from.first], &second = suspension.links[from.second];
    BasicCouplerConstants<T> coupler{.first = from.first, .second = from.second};
    coupler.begin.along = from.fraction;
    if (from.begin)
      coupler.begin = rod_point_of(*from.begin, rod.body[0], rod.carrier[0], rod.type,
                                   plan.links[from.first].standing_axis);
    coupler.point = affine_of(from.point, second.carrier[0], second.body[0], second.carrier[1]);
    coupler.length =
        norm(from.point -
             (from.begin ? *from.begin : rod.body[0] + from.fraction * (rod.carrier[0] - rod.body[0])));
    plan.couplers.push_back(coupler);
  }
  for (const BasicRocker<T>& rocker : suspension.rockers)
    plan.rockers.push_back(rocker_of(suspension, plan, rocker));
  for (const BasicCornerElement<T>& element : suspension.elements)
    plan.elements.push_back(element_of(suspension, plan, element));
  if (suspension.spring) {
    const BasicCornerSpring<T>& from = *suspension.spring;
    plan.spring = {part_point_of(suspension, plan, BasicFixedPoint<T>{from.body, from.body_part}),
                   part_point_of(suspension, plan, BasicFixedPoint<T>{from.moving, moving_part(from)}),
                   norm(from.moving - from.body)};
  }
  return plan;
}

template <class T>
void evaluate(const BasicCornerPlan<T>& plan, const BasicCornerPlace<T>& place, const T& rack, Driver driver,
              const T& value, BasicCornerEquations<T>& out) {
  const Placed<T> placed{plan, place, rack};
  Writer<T> to{out};
  for (const BasicLinkConstants<T>& link : plan.links) write_link(placed, link, to);
  for (const BasicCouplerConstants<T>& coupler : plan.couplers) write_coupler(placed, coupler, to);
  const int last = to.next;
  Row<T> row = to.row(T(0));
  out.residual[last] = write_driver(placed, driver, row) - value;
}

template <class T>
T driver_value(const BasicCornerPlan<T>& plan, const BasicCornerPlace<T>& place, const T& rack,
               Driver driver) {
  std::array<T, max_unknowns> unused{};
  T by_rack(0);
  Row<T> row{unused, by_rack};
  return write_driver(Placed<T>{plan, place, rack}, driver, row);
}

template <class T>
T driver_rate(const BasicCornerPlan<T>& plan, const BasicCornerPlace<T>& place, const T& rack, Driver driver,
              const BasicTwist<T>& twist, double rack_rate) {
  std::array<T, max_unknowns> by{};
  T by_rack(0);
  Row<T> row{by, by_rack};
  write_driver(Placed<T>{plan, place, rack}, driver, row);
  return rate_of(row, twist, rack_rate);
}

}  // namespace linkwright::suspension::kernel
