// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "linkwright/suspension/corner/detail/constraints_kernel.h"
#include "linkwright/suspension/wheel/parameters.h"

/// The wheel parameters, written once for numbers and for numbers with derivatives.
namespace linkwright::suspension::kernel {

/// A steering motion that turns the wheel less than this (rad/m) about the vertical steers nothing.
inline constexpr double no_steering = 1e-9;

template <class T>
BasicTwist<T> steering_twist(const BasicCornerPlan<T>& plan, const BasicCornerPlace<T>& place, const T& rack,
                             const BasicTwist<T>& bump, const BasicTwist<T>& steer, Driver lock) {
  const T by_steering = kernel::driver_rate(plan, place, rack, lock, steer, 1);
  const T by = -by_steering / kernel::driver_rate(plan, place, rack, lock, bump, 0);
  return {steer.velocity + by * bump.velocity, steer.turning + by * bump.turning, steer.arm + by * bump.arm};
}

/// Angles and offsets of an axis through `point` along `up` (unit, upward), both seen on the left like centre
/// and contact.
template <class T>
BasicSteeringAxis<T> axis_along(Side side, const Vector3<T>& centre, const Vector3<T>& contact, const T& toe,
                                const Vector3<T>& point, const Vector3<T>& up) {
  using std::atan;
  using std::cos;
  using std::sin;
  const auto seen = [&](const Vector3<T>& a) { return side == Side::left ? a : math::mirrored(a); };
  const auto at_height = [&](const T& z) { return point + ((z - point.z) / up.z) * up; };
  const Vector3<T> ground = at_height(contact.z), level = at_height(centre.z);
  const T cosine = cos(toe), sine = sin(toe);
  const Vector3<T> forward{cosine, -sine, T(0)}, outboard{sine, cosine, T(0)};
  BasicSteeringAxis<T> out{.point = seen(point), .direction = seen(up), .ground = seen(ground)};
  out.caster = -atan(up.x / up.z);
  out.inclination = -atan(up.y / up.z);
  out.trail = ground.x - contact.x;
  out.scrub = contact.y - ground.y;
  out.wheel_trail = dot(ground - contact, forward);
  out.wheel_scrub = dot(contact - ground, outboard);
  out.caster_offset = dot(level - centre, forward);
  out.kingpin_offset = dot(centre - level, outboard);
  return out;
}

template <class T>
std::optional<BasicSteeringAxis<T>> steering_axis(Side side, const Vector3<T>& wheel_centre,
                                                  const Vector3<T>& contact_point, const T& toe,
                                                  const BasicTwist<T>& steering, Driver lock) {
  using std::abs;
  using std::sqrt;
  // On the left, or in the mirror.
  const bool left = side == Side::left;
  const auto seen = [&](const Vector3<T>& a) { return left ? a : math::mirrored(a); };
  const Vector3<T> centre = seen(wheel_centre), contact = seen(contact_point),
                   velocity = seen(steering.velocity);
  const Vector3<T> turning = left ? steering.turning : -math::mirrored(steering.turning);
  if (!(abs(turning.z) > no_steering)) return std::nullopt;
  const T square = dot(turning, turning);
  const Vector3<T> up = ((turning.z > 0 ? 1.0 : -1.0) / sqrt(square)) * turning;
  const Vector3<T> point = centre + (1 / square) * cross(turning, velocity);
  BasicSteeringAxis<T> out = axis_along(side, centre, contact, toe, point, up);
  out.lock = lock;
  out.pitch = dot(turning, velocity) / square;
  return out;
}

/// A ball joint of the carrier in its present position.
template <class T>
Vector3<T> ball_joint(const Placed<T>& placed, const CarrierBall& ball) {
  const BasicLinkConstants<T>& link = placed.plan.links[ball.link];
  return ball.at_body ? placed.body(link, 0) : placed.point(placed.offset(link.offset[0]));
}

/// Line through both ball joints; nothing where it is level, so that it never meets the ground.
template <class T>
std::optional<BasicSteeringAxis<T>> geometric_axis(const Placed<T>& placed,
                                                   const BasicWheelParameters<T>& at) {
  using std::abs;
  const CornerConstruction& construction = placed.plan.construction;
  if (!construction.has_axis()) return std::nullopt;
  const Side side = placed.plan.side;
  const auto seen = [&](const Vector3<T>& a) { return side == Side::left ? a : math::mirrored(a); };
  const Vector3<T> one = seen(ball_joint(placed, construction.balls[0])),
                   other = seen(ball_joint(placed, construction.balls[1]));
  const Vector3<T> along = unit(other - one);
  if (!(abs(along.z) > 1e-6)) return std::nullopt;
  const Vector3<T> up = along.z > 0 ? along : -along, centre = seen(placed.at.carrier.centre);
  const Vector3<T> point = one + dot(centre - one, up) * up;
  BasicSteeringAxis<T> out = axis_along(side, centre, seen(at.contact), at.angles.toe, point, up);
  out.pitch = BasicWheelParameters<T>::missing;
  return out;
}

/// Points p of normal . p = normal . point.
template <class T>
struct Plane {
  Vector3<T> point, normal;
};

template <class T>
std::array<Plane<T>, 2> arm_planes(const Placed<T>& placed, const CornerConstruction& construction) {
  std::array<Plane<T>, 2> out;
  for (std::size_t i = 0; i < 2; ++i) {
    const Arm& arm = construction.arms[construction.arms.size() == 2 ? i : 0];
    const BasicLinkConstants<T>& link = placed.plan.links[arm.link];
    const auto carrier = [&](const BasicLinkConstants<T>& of, int k) {
      return placed.point(placed.offset(of.offset[k]));
    };
    const Vector3<T> body = placed.body(link, 0);
    switch (arm.kind) {
      case ArmKind::wishbone:
        out[i] = {body, cross(link.body[1] - link.body[0], carrier(link, 0) - body)};
        break;
      case ArmKind::blade:
        out[i] = {body, cross(carrier(link, 1) - carrier(link, 0), body - carrier(link, 0))};
        break;
      case ArmKind::strut:
        out[i] = {body, placed.offset(link.axis)};
        break;
      case ArmKind::hinge:
        out[i] = {body, link.across[i]};
        break;
      case ArmKind::rods_at_carrier: {
        const Vector3<T> end = carrier(link, 0);
        out[i] = {end, cross(body - end, placed.body(placed.plan.links[arm.other], 0) - end)};
        break;
      }
      case ArmKind::rods_at_body:
        out[i] = {body, cross(carrier(link, 0) - body, carrier(placed.plan.links[arm.other], 0) - body)};
        break;
    }
  }
  return out;
}

/// The intersection of the traces of both planes in a view, from a point of it: (across, up) / weight.
template <class T>
struct Meeting {
  T across{0}, up{0}, weight{0};
};

template <class T>
BasicArmCentres<T> arm_centres(const Placed<T>& placed, const Vector3<T>& contact) {
  using std::abs;
  using std::atan;
  using std::hypot;
  BasicArmCentres<T> out;
  if (!placed.plan.construction.has_planes()) return out;
  const auto [a, b] = arm_planes(placed, placed.plan.construction);
  const Vector3<T>& c = placed.at.carrier.centre;
  const auto meet = [&, &a = a, &b = b](const Vector3<T>& from, T Vector3<T>::*across) {
    const T ea = dot(a.normal, a.point - from), eb = dot(b.normal, b.point - from);
    return Meeting<T>{ea * b.normal.z - eb * a.normal.z, a.normal.*across * eb - b.normal.*across * ea,
                      a.normal.*across * b.normal.z - a.normal.z * b.normal.*across};
  };
  const Meeting<T> front = meet({c.x, contact.y, contact.z}, &Vector3<T>::y);
  const Meeting<T> side = meet({contact.x, c.y, contact.z}, &Vector3<T>::x);
  const T beside = front.across / front.weight, above = front.up / front.weight;
  out.front = {contact.y + beside, contact.z + above};
  out.front_swing_arm = hypot(beside, above);
  out.roll_centre_height = -contact.y * front.up / front.across;
  const T ahead = side.across / side.weight, over = side.up / side.weight;
  out.side = {contact.x + ahead, contact.z + over};
  out.side_swing_arm = hypot(ahead, over);
  // The ratio still gives the slope of parallel traces.
  const T slope = side.up / side.across;
  out.side_swing_angle = atan(ahead < 0 ? -slope : slope);
  return out;
}

/// Adds the parameters that constructions give in a pose, without motion.
template <class T>
void add_constructions(const BasicCornerPlan<T>& plan, const BasicCornerPlace<T>& place, const T& rack,
                       BasicWheelParameters<T>& out) {
  const Placed<T> placed{plan, place, rack};
  out.geometric_axis = geometric_axis(placed, out);
  out.arms = arm_centres(placed, out.contact);
}

/// The parameters that a pose shows by itself.
template <class T>
BasicWheelParameters<T> parameters_at_rest(const BasicCornerPlan<T>& plan, const BasicCornerPlace<T>& place,
                                           const T& rack) {
  const BasicCarrierPose<T>& carrier = place.carrier;
  const BasicCornerWheel<T>& wheel = plan.wheel;
  using std::atan;
  using std::cos;
  using std::sin;
  const double outward = plan.side == Side::left ? 1 : -1, diameter = wheel.tyre_diameter;
  BasicWheelParameters<T> out;
  out.angles = kernel::wheel_angles(plan.side, wheel, carrier.rotation);
  out.front_view_camber = atan(sin(out.angles.camber) / (cos(out.angles.camber) * cos(out.angles.toe)));
  out.contact = carrier.centre + kernel::contact_offset(plan.side, diameter, out.angles);
  out.track = (2 * outward) * out.contact.y;
  out.half_track_change = outward * (out.contact.y - plan.contact.y);
  out.wheelbase_change = out.contact.x - plan.contact.x;
  out.recession = wheel.centre.x - carrier.centre.x;
  if (plan.spring)
    out.spring_length = plan.spring->length + kernel::driver_value(plan, place, rack, Driver::spring);
  return out;
}

/// Adds the parameters that follow from motions: `bump` at unit rate of the wheel centre's height, `steer` at
/// unit rate of the rack.
template <class T>
void add_rates(const BasicCornerPlan<T>& plan, const BasicCornerPlace<T>& place, const T& rack,
               const BasicTwist<T>& bump, const BasicTwist<T>& steer, BasicWheelParameters<T>& out) {
  using std::abs;
  using std::atan;
  using std::hypot;
  const BasicCarrierPose<T>& carrier = place.carrier;
  const double diameter = plan.wheel.tyre_diameter;
  const auto& [velocity, turning, arm] = bump;
  out.velocity = velocity;
  out.turning = turning;
  const BasicWheelAngles<T> by_travel = kernel::angle_rates(plan.side, out.angles, turning);
  out.toe_by_travel = by_travel.toe;
  out.camber_by_travel = by_travel.camber;
  out.contact_velocity = kernel::contact_velocity(plan.side, diameter, out.angles, velocity, turning);
  const auto& [on_carrier, geometric] = out.contact_velocity;
  out.roll_centre_height = on_carrier.y / on_carrier.z * out.contact.y;
  out.roll_centre_height_geometric = geometric.y / geometric.z * out.contact.y;
  const Vector3<T>& c = carrier.centre;
  out.front_centre = {c.y - velocity.z / turning.x, c.z + velocity.y / turning.x};
  out.side_centre = {c.x + velocity.z / turning.y, c.z - velocity.x / turning.y};
  // Infinite where the wheel only shifts: travel is 1, so the first difference is infinite then.
  out.front_swing_arm = hypot(out.front_centre[0] - out.contact.y, out.front_centre[1] - out.contact.z);
  const T ahead = out.side_centre[0] - out.contact.x, above = out.side_centre[1] - out.contact.z;
  out.side_swing_arm = hypot(ahead, above);
  out.side_swing_angle = atan(above / abs(ahead));
  out.anti_pitch_tangent = on_carrier.x / on_carrier.z;
  out.anti_pitch_tangent_free = geometric.x / geometric.z;
  out.screw_pitch = dot(turning, velocity) / dot(turning, turning);
  if (plan.spring) out.motion_ratio = -kernel::driver_rate(plan, place, rack, Driver::spring, bump, 0);

  const bool steered = std::any_of(plan.links.begin(), plan.links.end(),
                                   [](const BasicLinkConstants<T>& link) { return link.moved_by_rack; });
  if (!steered) return;
  out.toe_by_rack = kernel::angle_rates(plan.side, out.angles, steer.turning).toe;
  const auto axis = [&](const BasicTwist<T>& steering, Driver lock) {
    return kernel::steering_axis(plan.side, carrier.centre, out.contact, out.angles.toe, steering, lock);
  };
  out.axis_at_height = axis(steer, Driver::wheel_centre_z);
  out.axis_at_contact =
      axis(kernel::steering_twist(plan, place, rack, bump, steer, Driver::contact_z), Driver::contact_z);
  if (plan.spring)
    out.axis_at_spring =
        axis(kernel::steering_twist(plan, place, rack, bump, steer, Driver::spring), Driver::spring);
}

}  // namespace linkwright::suspension::kernel
