// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/dependent/beam_parameters.h"

#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::suspension {
namespace {

constexpr double no_support = 1e-12;  ///< relative: below, lateral force and roll do not determine a point

BeamWheel wheel_at(const BeamAxlePlan& plan, const BeamPlace& place, Side side, double roll) {
  const std::size_t i = side == Side::left ? 0 : 1;
  const CornerWheel& wheel = side == Side::left ? plan.axle.left : plan.axle.right;
  BeamWheel out;
  const Mat3 rotation = half_rotation(plan, place, side);
  out.angles = wheel_angles(side, wheel, rotation);
  out.centre = on_beam(plan, place, wheel.centre);
  out.contact = contact_point(plan, place, side);
  // Against the road, whose normal leans by the roll: u . n = -sin(camber).
  const Vec3 axis = rotation * plan.axes[i], normal{0, -std::sin(roll), std::cos(roll)};
  out.road_camber = std::atan2(-dot(axis, normal), norm(cross(axis, normal)));
  out.travel = out.centre.z - wheel.centre.z;
  out.recession = wheel.centre.x - out.centre.x;
  return out;
}

/// Steer and pitch of the beam by those of a wheel without toe and camber on its left side.
WheelAngles beam_angles(const Mat3& rotation) { return wheel_angles(Side::left, {}, rotation); }
WheelAngles beam_rates(const Mat3& rotation, const Vec3& turning) {
  return angle_rates(Side::left, beam_angles(rotation), turning);
}

/// The point in the middle of the track through which lateral forces pass between axle and body. Neither
/// heave nor roll moves it along the line of action, for else the force would have a power.
void add_roll_centre(BeamParameters& p, const BeamAxlePlan& plan, const BeamPlace& place,
                     const BeamRates& rates) {
  const double c = std::cos(p.roll), s = std::sin(p.roll);
  const Vec3 along{0, c, s}, over{0, -s, c}, middle = 0.5 * (p.left.contact + p.right.contact);
  std::array<double, 2> across{}, up{}, tilt{};
  for (std::size_t k = 0; k < 2; ++k) {
    const BeamMotion& motion = k == 0 ? rates.first : rates.second;
    const Vec3 left = half_velocity(plan, place, motion, Side::left, p.left.contact),
               right = half_velocity(plan, place, motion, Side::right, p.right.contact);
    across[k] = dot(left + right, along) / 2;
    up[k] = dot(left + right, over) / 2;
    tilt[k] = dot(cross(motion.turning, over), along);
    // A beam that twists has no turning of its own: the couple of a force above the road is that of both
    // loads.
    if (plan.twist) tilt[k] = -dot(left - right, over) / dot(p.left.contact - p.right.contact, along);
  }
  // across + height tilt + slope up = 0 for both motions
  const double determinant = tilt[0] * up[1] - tilt[1] * up[0];
  if (!(std::abs(determinant) > no_support)) return;
  p.roll_centre_height = (across[1] * up[0] - across[0] * up[1]) / determinant;
  p.lateral_force_slope = (across[0] * tilt[1] - across[1] * tilt[0]) / determinant;
  p.roll_centre = middle + p.roll_centre_height * over;
}

void add_side_view(BeamParameters& p, const BeamAxlePlan& plan, const BeamPlace& place,
                   const BeamMotion& heave) {
  const Vec3 middle = 0.5 * (p.left.contact + p.right.contact);
  p.side_centre = {place.centre.x + heave.velocity.z / heave.turning.y,
                   place.centre.z - heave.velocity.x / heave.turning.y};
  const double ahead = p.side_centre[0] - middle.x, above = p.side_centre[1] - middle.z;
  p.side_swing_arm = std::hypot(ahead, above);
  const Vec3 at_ground = heave.velocity + cross(heave.turning, middle - place.centre);
  // The ratio still gives the slope of a beam that only shifts.
  const double slope = at_ground.x / at_ground.z;
  p.side_swing_angle = std::atan(ahead < 0 ? slope : -slope);
  double beam = 0, beam_up = 0, free = 0, free_up = 0;
  for (const Side side : {Side::left, Side::right}) {
    BeamWheel& wheel = side == Side::left ? p.left : p.right;
    const Vec3 velocity = half_velocity(plan, place, heave, side, wheel.centre);
    const double diameter = (side == Side::left ? plan.axle.left : plan.axle.right).tyre_diameter;
    const ContactVelocity contact =
        contact_velocity(side, diameter, wheel.angles, velocity, half_turning(plan, place, heave, side));
    beam += contact.on_carrier.x, beam_up += contact.on_carrier.z;
    free += contact.geometric.x, free_up += contact.geometric.z;
    wheel.recession_rate = -velocity.x;
  }
  p.anti_pitch_tangent = beam / beam_up;
  p.anti_pitch_tangent_free = free / free_up;
}

double angle_with(const Vec3& a, const Vec3& b) { return std::atan2(norm(cross(a, b)), std::abs(dot(a, b))); }

}  // namespace

BeamParameters beam_parameters(const BeamAxlePlan& plan, const BeamPosition& position) {
  LINKWRIGHT_REQUIRE(position.status == Status::done, "the position is {}: {}", to_string(position.status),
                     position.reason);
  const BeamPlace& place = position.place;
  BeamParameters p;
  const std::array<double, 2> inputs = beam_inputs(plan, place, AxleInputs::heave_roll);
  p.heave = inputs[0], p.roll = inputs[1];
  p.left = wheel_at(plan, place, Side::left, p.roll);
  p.right = wheel_at(plan, place, Side::right, p.roll);
  p.track = p.left.contact.y - p.right.contact.y;
  p.track_change = p.track - (plan.contacts[0].y - plan.contacts[1].y);
  p.lateral_shift =
      (p.left.contact.y + p.right.contact.y) / 2 - (plan.contacts[0].y + plan.contacts[1].y) / 2;
  p.steer = (p.right.angles.toe - p.left.angles.toe) / 2;
  p.pitch = beam_angles(place.rotation).carrier_pitch;
  const BeamRates rates = solve_rates(plan, position, AxleInputs::heave_roll);
  p.status = rates.status;
  if (rates.status != Status::done) return p;
  const auto steer_rate = [&](const BeamMotion& motion) {
    const Vec3 left = half_turning(plan, place, motion, Side::left),
               right = half_turning(plan, place, motion, Side::right);
    return (angle_rates(Side::right, p.right.angles, right).toe -
            angle_rates(Side::left, p.left.angles, left).toe) /
           2;
  };
  p.steer_by_heave = steer_rate(rates.first);
  p.roll_steer = steer_rate(rates.second);
  p.pitch_by_heave = beam_rates(place.rotation, rates.first.turning).carrier_pitch;
  if (plan.twist)
    p.twist = place.cranks[0], p.twist_by_roll = rates.second.cranks[0];
  else
    p.roll_axis_inclination = std::atan(rates.second.turning.z / rates.second.turning.x);
  double shift = 0;
  for (const Side side : {Side::left, Side::right}) {
    const BeamWheel& wheel = side == Side::left ? p.left : p.right;
    const double diameter = (side == Side::left ? plan.axle.left : plan.axle.right).tyre_diameter;
    const Vec3 velocity = half_velocity(plan, place, rates.first, side, wheel.centre);
    shift +=
        contact_velocity(side, diameter, wheel.angles, velocity, half_turning(plan, place, rates.first, side))
            .geometric.y /
        2;
  }
  p.shift_by_heave = shift;
  add_roll_centre(p, plan, place, rates);
  add_side_view(p, plan, place, rates.first);
  return p;
}

BeamAntiFeatures anti_features(const BeamParameters& axle, AxlePlace place, const VehicleLayout& layout) {
  WheelParameters wheel;
  wheel.anti_pitch_tangent = axle.anti_pitch_tangent;
  wheel.anti_pitch_tangent_free = axle.anti_pitch_tangent_free;
  const AntiFeatures body = anti_features(wheel, place, layout);
  wheel.anti_pitch_tangent_free = axle.anti_pitch_tangent;
  const AntiFeatures beam = anti_features(wheel, place, layout);
  return {body.outboard_brake, body.inboard_brake, beam.inboard_drive, body.inboard_drive};
}

VehicleAxes vehicle_axes(const AxleCentre& front, const AxleCentre& rear, double wheelbase) {
  LINKWRIGHT_REQUIRE(wheelbase > 0, "wheelbase {} m", wheelbase);
  VehicleAxes out{std::atan((front.roll_centre_height - rear.roll_centre_height) / wheelbase), nan, nan};
  const double sum = front.support_slope + rear.support_slope;
  if (!(std::abs(sum) > no_support)) return out;
  out.pitch_centre_behind = wheelbase * rear.support_slope / sum;
  out.pitch_centre_height = front.support_slope * out.pitch_centre_behind;
  return out;
}

BeamShaftState shaft_state(const BeamAxlePlan& plan, const BeamPlace& place, const BeamShaft& shaft) {
  const Vec3 along = on_beam(plan, place, shaft.beam) - shaft.body;
  return {angle_with(along, shaft.body_axis), angle_with(along, place.rotation * shaft.beam_axis),
          norm(along) - norm(shaft.beam - shaft.body)};
}

}  // namespace linkwright::suspension
