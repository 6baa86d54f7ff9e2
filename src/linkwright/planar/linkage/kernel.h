// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>

#include "linkwright/math/scalar.h"
#include "linkwright/math/sincos.h"
#include "linkwright/math/vector2.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/plan.h"

// Position, velocity, acceleration and joint forces of drivers and dyads, each formula once for `double` and
// SIMD batches.
//
// A dyad is a chain of three joints between known parts: before -1- first -2- second -3- after. Its joints
// are planar screws. About a point R where one of its pins sits, that pin moves nothing, so the two others
// obey 2 x 2 equations; the same matrix serves velocities, accelerations and, transposed, the joint forces.
namespace linkwright::planar {

/// The joints of a dyad by its type: which are slides, and which one, counted from 0, is the pin at R
/// (`zero`) and which are the other two.
struct DyadLayout {
  bool slide1, slide2, slide3;
  int zero, x, y;
  constexpr bool slide(int joint) const { return joint == 0 ? slide1 : joint == 1 ? slide2 : slide3; }
};
constexpr DyadLayout layout(DyadType type) {
  switch (type) {
    case DyadType::rrr:
      return {false, false, false, 1, 0, 2};
    case DyadType::rrp:
      return {false, false, true, 1, 0, 2};
    case DyadType::rpr:
      return {false, true, false, 0, 1, 2};
    case DyadType::prp:
      return {true, false, true, 1, 0, 2};
    case DyadType::rpp:
      return {false, true, true, 0, 1, 2};
  }
  return {};
}

/// A dyad's type as a type, so that its code has no branches: for_dyad(type, f) calls f(DyadTag<type>()).
template <DyadType type>
using DyadTag = std::integral_constant<DyadType, type>;
template <class F>
LINKWRIGHT_KERNEL void for_dyad(DyadType type, F&& f) {
  switch (type) {
    case DyadType::rrr:
      return f(DyadTag<DyadType::rrr>());
    case DyadType::rrp:
      return f(DyadTag<DyadType::rrp>());
    case DyadType::rpr:
      return f(DyadTag<DyadType::rpr>());
    case DyadType::prp:
      return f(DyadTag<DyadType::prp>());
    case DyadType::rpp:
      return f(DyadTag<DyadType::rpp>());
  }
}

template <class T>
LINKWRIGHT_KERNEL math::Vector2<T> point_on(const PartState<T>& part, const math::Vec2& at) {
  return part.origin + rotate(part.direction, math::broadcast<T>(at));
}
template <class T>
LINKWRIGHT_KERNEL math::Vector2<T> velocity_at(const PartState<T>& part, const math::Vector2<T>& point) {
  return part.velocity + part.speed * perpendicular(point - part.origin);
}
template <class T>
LINKWRIGHT_KERNEL math::Vector2<T> acceleration_at(const PartState<T>& part, const math::Vector2<T>& point) {
  const math::Vector2<T> arm = point - part.origin;
  return part.acceleration + part.angular_acceleration * perpendicular(arm) - (part.speed * part.speed) * arm;
}

// The same for a part by number: the ground, part 0, is at rest in the global frame, and nothing is
// computed for it.
template <class T>
LINKWRIGHT_KERNEL math::Vector2<T> point_on(const PartState<T>* parts, const PartPoint& p) {
  if (p.part == 0) return math::broadcast<T>(p.at);
  return point_on(parts[p.part], p.at);
}
template <class T>
LINKWRIGHT_KERNEL math::Vector2<T> direction_on(const PartState<T>* parts, const PartPoint& p) {
  if (p.part == 0) return math::broadcast<T>(p.direction);
  return rotate(parts[p.part].direction, math::broadcast<T>(p.direction));
}
template <class T>
LINKWRIGHT_KERNEL math::Vector2<T> velocity_at(const PartState<T>* parts, int part,
                                               const math::Vector2<T>& point) {
  if (part == 0) return {T(0), T(0)};
  return velocity_at(parts[part], point);
}
template <class T>
LINKWRIGHT_KERNEL math::Vector2<T> acceleration_at(const PartState<T>* parts, int part,
                                                   const math::Vector2<T>& point) {
  if (part == 0) return {T(0), T(0)};
  return acceleration_at(parts[part], point);
}

// ---- position
// -----------------------------------------------------------------------------------------------

template <class T>
LINKWRIGHT_KERNEL void place_driver(const Group& g, const T& value, PartState<T>* parts) {
  const PlanJoint& j = g.joints[0];
  PartState<T>& moved = parts[j.after.part];
  const math::Vector2<T> pivot = point_on(parts, j.before);
  const T way = j.reversed ? -value : value;
  if (j.slide) {
    const math::Vector2<T> along = direction_on(parts, j.before);
    moved.direction = rotate(along, math::broadcast<T>({j.after.direction.x, -j.after.direction.y}));
    moved.origin = pivot + way * along - rotate(moved.direction, math::broadcast<T>(j.after.at));
  } else {
    math::Vector2<T> rotation;
    math::sincos(way, rotation.y, rotation.x);
    const math::Vector2<T> turned = rotate(direction_on(parts, j.before), rotation);
    moved.direction =
        renormalised(rotate(turned, math::broadcast<T>({j.after.direction.x, -j.after.direction.y})));
    moved.origin = pivot - rotate(moved.direction, math::broadcast<T>(j.after.at));
  }
}

// Each places both parts and gives R and the columns of the 2 x 2 equations; `per_length` is one
// over the product of the columns' lengths.
template <class T>
LINKWRIGHT_KERNEL void place_rrr(const Group& g, const Dyad& dyad, const T& mode, PartState<T>* parts,
                                 GroupState<T>& state, T& per_length) {
  using std::sqrt;
  const PlanJoint &j1 = g.joints[0], &j3 = g.joints[2];
  PartState<T>&first = parts[j1.after.part], &second = parts[j3.before.part];
  const math::Vector2<T> a = point_on(parts, j1.before);
  const math::Vector2<T> b = point_on(parts, j3.after);
  const math::Vector2<T> d = b - a;
  const T d2 = dot(d, d);
  const double reach = dyad.first.length + dyad.second.length, fold = dyad.first.length - dyad.second.length;
  state.radicand = (T(reach * reach) - d2) * (d2 - T(fold * fold));
  const T root = mode * sqrt(math::Scalar<T>::positive_part(state.radicand));
  const T scale = T(0.5) / d2;
  const T along = T(reach * fold) + d2;
  const math::Vector2<T> arm1 = scale * rotate(math::Vector2<T>{along, root}, d);              // a -> c
  const math::Vector2<T> arm2 = scale * rotate(math::Vector2<T>{along - T(2) * d2, root}, d);  // b -> c
  first.direction = renormalised(rotate(arm1, math::broadcast<T>(dyad.first.inverse)));
  second.direction = renormalised(rotate(arm2, math::broadcast<T>(dyad.second.inverse)));
  first.origin = a - rotate(first.direction, math::broadcast<T>(j1.after.at));
  second.origin = b - rotate(second.direction, math::broadcast<T>(j3.before.at));
  state.reference = a + arm1;
  state.column_x = perpendicular(arm1);
  state.column_y = perpendicular(arm2);
  per_length = T(dyad.per_length);
}

template <class T>
LINKWRIGHT_KERNEL void place_rrp(const Group& g, const Dyad& dyad, const T& mode, PartState<T>* parts,
                                 GroupState<T>& state, T& per_length) {
  using std::sqrt;
  const PlanJoint &j1 = g.joints[0], &j2 = g.joints[1], &j3 = g.joints[2];
  PartState<T>&first = parts[j1.after.part], &second = parts[j3.before.part];
  const math::Vector2<T> a = point_on(parts, j1.before);
  const math::Vector2<T> e = direction_on(parts, j3.after);
  second.direction = rotate(e, math::broadcast<T>({j3.before.direction.x, -j3.before.direction.y}));
  // The inner pin runs along e through `start`.
  const math::Vector2<T> start =
      point_on(parts, j3.after) + rotate(second.direction, math::broadcast<T>(dyad.second.vector));
  const math::Vector2<T> m = a - start;
  const T across = cross(e, m);
  state.radicand = T(dyad.first.square) - across * across;
  const T t = dot(m, e) + mode * sqrt(math::Scalar<T>::positive_part(state.radicand));
  const math::Vector2<T> arm = t * e - m;
  first.direction = renormalised(rotate(arm, math::broadcast<T>(dyad.first.inverse)));
  first.origin = a - rotate(first.direction, math::broadcast<T>(j1.after.at));
  second.origin = start + t * e - rotate(second.direction, math::broadcast<T>(j2.after.at));
  state.reference = a + arm;
  state.column_x = perpendicular(arm);
  state.column_y = e;
  per_length = T(dyad.per_length);
}

template <class T>
LINKWRIGHT_KERNEL void place_rpr(const Group& g, const Dyad& dyad, const T& mode, PartState<T>* parts,
                                 GroupState<T>& state, T& per_length) {
  using std::sqrt;
  const PlanJoint &j1 = g.joints[0], &j2 = g.joints[1], &j3 = g.joints[2];
  PartState<T>&first = parts[j1.after.part], &second = parts[j3.before.part];
  const math::Vector2<T> a = point_on(parts, j1.before);
  const math::Vector2<T> b = point_on(parts, j3.after);
  const math::Vector2<T> d = b - a;
  const T d2 = dot(d, d);
  const double offset = dyad.first.vector.y - dyad.second.vector.y;  // links seen from the slide direction
  state.radicand = d2 - T(offset * offset);
  const T way = mode * sqrt(math::Scalar<T>::positive_part(state.radicand));
  const T scale = T(1) / d2;
  const math::Vector2<T> e = renormalised(scale * rotate(math::Vector2<T>{way, T(-offset)}, d));
  first.direction = rotate(e, math::broadcast<T>({j2.before.direction.x, -j2.before.direction.y}));
  second.direction = rotate(e, math::broadcast<T>({j2.after.direction.x, -j2.after.direction.y}));
  first.origin = a - rotate(first.direction, math::broadcast<T>(j1.after.at));
  second.origin = b - rotate(second.direction, math::broadcast<T>(j3.before.at));
  state.reference = a;
  state.column_x = e;
  state.column_y = -perpendicular(d);
  per_length = scale * sqrt(d2);
}

template <class T>
LINKWRIGHT_KERNEL void place_prp(const Group& g, const Dyad& dyad, PartState<T>* parts,
                                 GroupState<T>& state) {
  const PlanJoint &j1 = g.joints[0], &j2 = g.joints[1], &j3 = g.joints[2];
  PartState<T>&first = parts[j1.after.part], &second = parts[j3.before.part];
  const math::Vector2<T> e1 = direction_on(parts, j1.before);
  const math::Vector2<T> e3 = direction_on(parts, j3.after);
  first.direction = rotate(e1, math::broadcast<T>({j1.after.direction.x, -j1.after.direction.y}));
  second.direction = rotate(e3, math::broadcast<T>({j3.before.direction.x, -j3.before.direction.y}));
  const math::Vector2<T> start1 =
      point_on(parts, j1.before) + rotate(first.direction, math::broadcast<T>(dyad.first.vector));
  const math::Vector2<T> start3 =
      point_on(parts, j3.after) + rotate(second.direction, math::broadcast<T>(dyad.second.vector));
  const math::Vector2<T> pin = start1 + (cross(start3 - start1, e3) / cross(e1, e3)) * e1;
  first.origin = pin - rotate(first.direction, math::broadcast<T>(j2.before.at));
  second.origin = pin - rotate(second.direction, math::broadcast<T>(j2.after.at));
  state.reference = pin;
  state.column_x = e1;
  state.column_y = e3;
}

template <class T>
LINKWRIGHT_KERNEL void place_rpp(const Group& g, const Dyad& dyad, PartState<T>* parts,
                                 GroupState<T>& state) {
  const PlanJoint &j1 = g.joints[0], &j2 = g.joints[1], &j3 = g.joints[2];
  PartState<T>&first = parts[j1.after.part], &second = parts[j3.before.part];
  const math::Vector2<T> e3 = direction_on(parts, j3.after);
  second.direction = rotate(e3, math::broadcast<T>({j3.before.direction.x, -j3.before.direction.y}));
  const math::Vector2<T> e2 = rotate(second.direction, math::broadcast<T>(j2.after.direction));
  first.direction = rotate(e2, math::broadcast<T>({j2.before.direction.x, -j2.before.direction.y}));
  const math::Vector2<T> a = point_on(parts, j1.before);
  first.origin = a - rotate(first.direction, math::broadcast<T>(j1.after.at));
  const math::Vector2<T> start2 = point_on(first, j2.before.at);
  // The second part's inner point runs along e2 through start2 and along e3 through start3.
  const math::Vector2<T> start3 =
      point_on(parts, j3.after) + rotate(second.direction, math::broadcast<T>(dyad.second.vector));
  const math::Vector2<T> meet = start2 + (cross(start3 - start2, e3) / cross(e2, e3)) * e2;
  second.origin = meet - rotate(second.direction, math::broadcast<T>(j2.after.at));
  state.reference = a;
  state.column_x = e2;
  state.column_y = e3;
}

template <DyadType type, class T>
LINKWRIGHT_KERNEL void place_dyad(DyadTag<type>, const Group& g, const Dyad& dyad, const T& mode,
                                  PartState<T>* parts, GroupState<T>& state) {
  T per_length(1);
  state.radicand = T(1);
  if constexpr (type == DyadType::rrr)
    place_rrr(g, dyad, mode, parts, state, per_length);
  else if constexpr (type == DyadType::rrp)
    place_rrp(g, dyad, mode, parts, state, per_length);
  else if constexpr (type == DyadType::rpr)
    place_rpr(g, dyad, mode, parts, state, per_length);
  else if constexpr (type == DyadType::prp)
    place_prp(g, dyad, parts, state);
  else {
    static_assert(type == DyadType::rpp);
    place_rpp(g, dyad, parts, state);
  }
  const T determinant = cross(state.column_x, state.column_y);
  state.inverse = T(1) / determinant;
  state.sine = determinant * per_length;
}

/// The assembly mode that places show, by its sign; 0 where both modes meet and of groups with one mode.
/// `point` and `direction` give those of a PartPoint in the global frame.
template <class Point, class Direction>
double mode_side(const Group& g, Point point, Direction direction) {
  const math::Vec2 a = point(g.joints.front().before), b = point(g.joints.back().after);
  const auto beside = [&](const PlanJoint& pin) { return cross(b - a, point(pin.before) - a); };
  return by_kind(
      g, [](const Driver&) { return 0.0; }, [](const GearTrain&) { return 0.0; },
      [](const Follower&) { return 0.0; },
      [&](const Dyad& dyad) {
        switch (dyad.type) {
          case DyadType::rrr:
            return beside(g.joints[1]);
          case DyadType::rrp:
            return dot(direction(g.joints[2].after), point(g.joints[1].before) - a);
          case DyadType::rpr:
            return dot(direction(g.joints[1].before), b - a);
          case DyadType::prp:
          case DyadType::rpp:
            break;
        }
        return 0.0;
      },
      [&](const Triangle&) { return beside(g.joints[2]); }, [](const GeneralGroup&) { return 0.0; });
}

// ---- rates
// --------------------------------------------------------------------------------------------------

template <class T>
LINKWRIGHT_KERNEL void drive_velocity(const Group& g, const T& rate, PartState<T>* parts) {
  const PlanJoint& j = g.joints[0];
  const PartState<T>& base = parts[j.before.part];
  PartState<T>& moved = parts[j.after.part];
  const T way = j.reversed ? -rate : rate;
  if (j.slide) {
    moved.speed = base.speed;
    moved.velocity = velocity_at(parts, j.before.part, moved.origin) + way * direction_on(parts, j.before);
  } else {
    const math::Vector2<T> pivot = point_on(parts, j.before);
    moved.speed = base.speed + way;
    moved.velocity =
        velocity_at(parts, j.before.part, pivot) - moved.speed * perpendicular(pivot - moved.origin);
  }
}
template <class T>
LINKWRIGHT_KERNEL void drive_acceleration(const Group& g, const T& rate, const T& acceleration,
                                          PartState<T>* parts) {
  const PlanJoint& j = g.joints[0];
  const PartState<T>& base = parts[j.before.part];
  PartState<T>& moved = parts[j.after.part];
  const T way = j.reversed ? -acceleration : acceleration;
  if (j.slide) {
    const math::Vector2<T> along = direction_on(parts, j.before);
    const T sliding = j.reversed ? -rate : rate;
    moved.angular_acceleration = base.angular_acceleration;
    moved.acceleration = acceleration_at(parts, j.before.part, moved.origin) + way * along +
                         (T(2) * base.speed * sliding) * perpendicular(along);
  } else {
    const math::Vector2<T> pivot = point_on(parts, j.before);
    const math::Vector2<T> arm = pivot - moved.origin;
    moved.angular_acceleration = base.angular_acceleration + way;
    moved.acceleration = acceleration_at(parts, j.before.part, pivot) -
                         moved.angular_acceleration * perpendicular(arm) + (moved.speed * moved.speed) * arm;
  }
}

/// Rates of the joints from the jump between the known parts at R, and motion of both parts.
template <DyadType type, class T>
LINKWRIGHT_KERNEL void dyad_velocity(DyadTag<type>, const Group& g, PartState<T>* parts, GroupState<T>& s) {
  const PlanJoint &j1 = g.joints[0], &j3 = g.joints[2];
  const PartState<T>&before = parts[j1.before.part], &after = parts[j3.after.part];
  PartState<T>&first = parts[j1.after.part], &second = parts[j3.before.part];
  constexpr DyadLayout at = layout(type);
  const math::Vector2<T> jump =
      velocity_at(parts, j3.after.part, s.reference) - velocity_at(parts, j1.before.part, s.reference);
  s.rate_x = cross(jump, s.column_y) * s.inverse;
  s.rate_y = cross(s.column_x, jump) * s.inverse;
  constexpr bool turns_x = !at.slide(at.x), turns_y = !at.slide(at.y);
  s.rate_zero = after.speed - before.speed;
  if (turns_x) s.rate_zero = s.rate_zero - s.rate_x;
  if (turns_y) s.rate_zero = s.rate_zero - s.rate_y;
  const T rate1 = at.zero == 0 ? s.rate_zero : s.rate_x;
  first.speed = at.slide1 ? before.speed : before.speed + rate1;
  second.speed = at.slide3 ? after.speed : after.speed - s.rate_y;
  const math::Vector2<T> at_first = velocity_at(parts, j1.before.part, s.reference) +
                                    (at.zero == 0 ? math::Vector2<T>{T(0), T(0)} : s.rate_x * s.column_x);
  const math::Vector2<T> at_second = velocity_at(parts, j3.after.part, s.reference) - s.rate_y * s.column_y;
  first.velocity = at_first - first.speed * perpendicular(s.reference - first.origin);
  second.velocity = at_second - second.speed * perpendicular(s.reference - second.origin);
}

/// The acceleration that a joint adds at R beyond the acceleration of its own rate: centripetal of a pin,
/// Coriolis of a slide.
template <class T>
LINKWRIGHT_KERNEL math::Vector2<T> joint_bias(bool slide, const math::Vector2<T>& column, const T& rate,
                                              const T& speed_before, const T& speed_after) {
  if (slide) return (T(2) * speed_before * rate) * perpendicular(column);
  // column = perpendicular(R - P), so R - P = -perpendicular(column)
  return (speed_after * speed_after - speed_before * speed_before) * perpendicular(column);
}

template <DyadType type, class T>
LINKWRIGHT_KERNEL void dyad_acceleration(DyadTag<type>, const Group& g, PartState<T>* parts,
                                         const GroupState<T>& s) {
  const PlanJoint &j1 = g.joints[0], &j3 = g.joints[2];
  const PartState<T>&before = parts[j1.before.part], &after = parts[j3.after.part];
  PartState<T>&first = parts[j1.after.part], &second = parts[j3.before.part];
  constexpr DyadLayout at = layout(type);
  const math::Vector2<T> from_before = acceleration_at(parts, j1.before.part, s.reference),
                         from_after = acceleration_at(parts, j3.after.part, s.reference);
  const math::Vector2<T> bias_x =
      at.zero == 0 ? joint_bias(at.slide(at.x), s.column_x, s.rate_x, first.speed, second.speed)
                   : joint_bias(at.slide(at.x), s.column_x, s.rate_x, before.speed, first.speed);
  const math::Vector2<T> bias_y = joint_bias(at.slide(at.y), s.column_y, s.rate_y, second.speed, after.speed);
  const math::Vector2<T> jump = from_after - from_before - bias_x - bias_y;
  const T change_x = cross(jump, s.column_y) * s.inverse;
  const T change_y = cross(s.column_x, jump) * s.inverse;
  T change_zero = after.angular_acceleration - before.angular_acceleration;
  if (!at.slide(at.x)) change_zero = change_zero - change_x;
  if (!at.slide(at.y)) change_zero = change_zero - change_y;
  const T change1 = at.zero == 0 ? change_zero : change_x;
  first.angular_acceleration =
      at.slide1 ? before.angular_acceleration : before.angular_acceleration + change1;
  second.angular_acceleration =
      at.slide3 ? after.angular_acceleration : after.angular_acceleration - change_y;
  const math::Vector2<T> at_first = at.zero == 0 ? from_before : from_before + change_x * s.column_x + bias_x;
  const math::Vector2<T> at_second = from_after - change_y * s.column_y - bias_y;
  const auto to_origin = [&](PartState<T> & part, const math::Vector2<T>& there)
      __attribute__((always_inline)) {
    const math::Vector2<T> arm = s.reference - part.origin;
    part.acceleration =
        there - part.angular_acceleration * perpendicular(arm) + (part.speed * part.speed) * arm;
  };
  to_origin(first, at_first);
  to_origin(second, at_second);
}

// ---- forces
// -------------------------------------------------------------------------------------------------

template <class T>
LINKWRIGHT_KERNEL Wrench<T> operator+(const Wrench<T>& a, const Wrench<T>& b) {
  return {a.force + b.force, a.moment + b.moment};
}
template <class T>
LINKWRIGHT_KERNEL Wrench<T> operator-(const Wrench<T>& a, const Wrench<T>& b) {
  return {a.force - b.force, a.moment - b.moment};
}
/// The same wrench about another point; `way` leads from the new point to the old one.
template <class T>
LINKWRIGHT_KERNEL Wrench<T> shifted(const Wrench<T>& w, const math::Vector2<T>& way) {
  return {w.force, w.moment + cross(way, w.force)};
}

/// Inertia and weight of a part: the wrench about its origin that its motion needs.
template <class T>
LINKWRIGHT_KERNEL Wrench<T> needed_wrench(const PartMass& m, const PartState<T>& part,
                                          const math::Vector2<T>& gravity) {
  const math::Vector2<T> arm = rotate(part.direction, math::broadcast<T>(m.moment));
  const math::Vector2<T> lifted = part.acceleration - gravity;
  return {
      T(m.mass) * lifted + part.angular_acceleration * perpendicular(arm) - (part.speed * part.speed) * arm,
      T(m.inertia) * part.angular_acceleration + cross(arm, lifted)};
}

/// Joint wrenches of a dyad about its R, of the part before on the part after each joint; `needed` holds, per
/// part about its origin, what the part needs beyond the joints solved so far, and takes the loads that the
/// dyad puts on its neighbours. The joints are free of torque and friction.
template <DyadType type, class T>
LINKWRIGHT_KERNEL void dyad_forces(DyadTag<type>, const Group& g, const PartState<T>* parts,
                                   const GroupState<T>& s, Wrench<T>* needed, Wrench<T>* joints) {
  const PlanJoint &j1 = g.joints[0], &j3 = g.joints[2];
  const int first = j1.after.part, second = j3.before.part;
  constexpr DyadLayout at = layout(type);
  constexpr bool turns_x = !at.slide(at.x), turns_y = !at.slide(at.y);
  const Wrench<T> n1 = shifted(needed[first], parts[first].origin - s.reference);
  const Wrench<T> n2 = shifted(needed[second], parts[second].origin - s.reference);
  // Force f of the pin at R: no joint takes power along its freedom.
  T bx, by;
  if (at.zero == 0) {
    bx = dot(s.column_x, n1.force);
    by = dot(s.column_y, n1.force + n2.force);
    if (turns_x) bx = bx + n1.moment;
    if (turns_y) by = by + n1.moment + n2.moment;
  } else {
    bx = -dot(s.column_x, n1.force);
    by = dot(s.column_y, n2.force);
    if (turns_x) bx = bx - n1.moment;
    if (turns_y) by = by + n2.moment;
  }
  const math::Vector2<T> f = s.inverse * math::Vector2<T>{bx * s.column_y.y - by * s.column_x.y,
                                                          by * s.column_x.x - bx * s.column_y.x};
  const Wrench<T> pin{f, T(0)};
  if (at.zero == 0) {
    joints[0] = pin;
    joints[1] = pin - n1;
  } else {
    joints[0] = pin + n1;
    joints[1] = pin;
  }
  joints[2] = joints[1] - n2;
  const int before = j1.before.part, after = j3.after.part;
  needed[before] = needed[before] + shifted(joints[0], s.reference - parts[before].origin);
  needed[after] = needed[after] - shifted(joints[2], s.reference - parts[after].origin);
}

/// Wrench on the driven part about its joint point; its neighbour takes the opposite.
template <class T>
LINKWRIGHT_KERNEL Wrench<T> driver_force(const Group& g, const PartState<T>* parts, Wrench<T>* needed) {
  const PlanJoint& j = g.joints[0];
  const int moved = j.after.part, base = j.before.part;
  const math::Vector2<T> pivot = point_on(parts[moved], j.after.at);
  const Wrench<T> w = shifted(needed[moved], parts[moved].origin - pivot);
  needed[base] = needed[base] + shifted(w, pivot - parts[base].origin);
  return w;
}

}  // namespace linkwright::planar
