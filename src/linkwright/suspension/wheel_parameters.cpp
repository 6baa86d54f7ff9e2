#include "linkwright/suspension/wheel_parameters.h"

#include <algorithm>
#include <cmath>

namespace linkwright::suspension {
namespace {

/// A steering motion that turns the wheel less than this (rad/m) about the vertical steers nothing.
constexpr double no_steering = 1e-9;

Twist combined(const Twist& a, double by, const Twist& b) {
  return {a.velocity + by * b.velocity, a.turning + by * b.turning, a.arm + by * b.arm};
}

}  // namespace

Twist steering_twist(const GuidePlan& plan, const GuidePosition& position, const GuideRates& rates,
                     Driver lock) {
  const double rack = position.input.rack;
  const double by_steering = driver_rate(plan, position.place, rack, lock, rates.steer, 1);
  const double by_bump = driver_rate(plan, position.place, rack, lock, rates.bump, 0);
  return combined(rates.steer, -by_steering / by_bump, rates.bump);
}

std::optional<SteeringAxis> steering_axis(Side side, const Vec3& wheel_centre, const Vec3& contact_point,
                                          double toe, const Twist& steering, Driver lock) {
  // On the left, or in the mirror.
  const bool left = side == Side::left;
  const auto seen = [&](const Vec3& a) { return left ? a : math::mirrored(a); };
  const Vec3 centre = seen(wheel_centre), contact = seen(contact_point), velocity = seen(steering.velocity);
  const Vec3 turning = left ? steering.turning : -math::mirrored(steering.turning);
  if (!(std::abs(turning.z) > no_steering)) return std::nullopt;
  const double square = dot(turning, turning);
  const Vec3 up = ((turning.z > 0 ? 1 : -1) / std::sqrt(square)) * turning;
  const Vec3 point = centre + (1 / square) * cross(turning, velocity);
  const auto at_height = [&](double z) { return point + ((z - point.z) / up.z) * up; };
  const Vec3 ground = at_height(contact.z), level = at_height(centre.z);
  const double cosine = std::cos(toe), sine = std::sin(toe);
  const Vec3 forward{cosine, -sine, 0}, outboard{sine, cosine, 0};
  SteeringAxis out{.lock = lock, .point = seen(point), .direction = seen(up), .ground = seen(ground)};
  out.caster = -std::atan(up.x / up.z);
  out.inclination = -std::atan(up.y / up.z);
  out.trail = ground.x - contact.x;
  out.scrub = contact.y - ground.y;
  out.wheel_trail = dot(ground - contact, forward);
  out.wheel_scrub = dot(contact - ground, outboard);
  out.caster_offset = dot(level - centre, forward);
  out.kingpin_offset = dot(centre - level, outboard);
  out.pitch = dot(turning, velocity) / square;
  return out;
}

WheelParameters wheel_parameters(const GuidePlan& plan, const GuidePosition& position) {
  const CarrierPose& carrier = position.place.carrier;
  const GuideWheel& wheel = plan.wheel;
  const double outward = plan.side == Side::left ? 1 : -1, diameter = wheel.tyre_diameter;
  WheelParameters out;
  out.angles = wheel_angles(plan.side, wheel, carrier.rotation);
  out.contact = carrier.centre + contact_offset(plan.side, diameter, out.angles);
  out.half_track_change = outward * (out.contact.y - plan.contact.y);
  out.wheelbase_change = out.contact.x - plan.contact.x;
  out.recession = carrier.centre.x - wheel.centre.x;
  const double rack = position.input.rack;
  if (plan.spring)
    out.spring_length = plan.spring->length + driver_value(plan, position.place, rack, Driver::spring);

  const GuideRates rates = solve_rates(plan, position, Driver::wheel_centre_z);
  out.status = rates.status;
  if (out.status != Status::done) return out;
  const auto& [velocity, turning, arm] = rates.bump;
  out.velocity = velocity;
  out.turning = turning;
  const WheelAngles by_travel = angle_rates(plan.side, out.angles, turning);
  out.toe_by_travel = by_travel.toe;
  out.camber_by_travel = by_travel.camber;
  out.contact_velocity = contact_velocity(plan.side, diameter, out.angles, velocity, turning);
  const auto& [on_carrier, geometric] = out.contact_velocity;
  out.roll_centre_height = on_carrier.y / on_carrier.z * out.contact.y;
  out.roll_centre_height_geometric = geometric.y / geometric.z * out.contact.y;
  const Vec3& c = carrier.centre;
  out.front_centre = {c.y - velocity.z / turning.x, c.z + velocity.y / turning.x};
  out.side_centre = {c.x + velocity.z / turning.y, c.z - velocity.x / turning.y};
  // Infinite where the wheel only shifts: travel is 1, so the first difference is infinite then.
  out.front_swing_arm = std::hypot(out.front_centre[0] - out.contact.y, out.front_centre[1] - out.contact.z);
  const double ahead = out.side_centre[0] - out.contact.x, above = out.side_centre[1] - out.contact.z;
  out.side_swing_arm = std::hypot(ahead, above);
  out.side_swing_angle = std::atan(above / std::abs(ahead));
  out.support_tangent = on_carrier.x / on_carrier.z;
  out.support_tangent_free = geometric.x / geometric.z;
  if (plan.spring) out.motion_ratio = -driver_rate(plan, position.place, rack, Driver::spring, rates.bump, 0);

  const bool steered = std::any_of(plan.links.begin(), plan.links.end(),
                                   [](const LinkConstants& link) { return link.moved_by_rack; });
  if (!steered) return out;
  out.toe_by_rack = angle_rates(plan.side, out.angles, rates.steer.turning).toe;
  const auto axis = [&](const Twist& steering, Driver lock) {
    return steering_axis(plan.side, carrier.centre, out.contact, out.angles.toe, steering, lock);
  };
  out.axis_at_height = axis(rates.steer, Driver::wheel_centre_z);
  if (plan.spring)
    out.axis_at_spring = axis(steering_twist(plan, position, rates, Driver::spring), Driver::spring);
  return out;
}

}  // namespace linkwright::suspension
