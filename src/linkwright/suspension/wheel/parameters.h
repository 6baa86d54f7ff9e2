// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "linkwright/core/numbers.h"
#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {

/// The axis about which the wheel turns when it is steered: instantaneous screw axis of the motion by the
/// rack while `lock` is held (equations 30 to 37 with 30, 31 and 36 corrected). What is held has to be given:
/// with the spring held the axis of a double wishbone passes through both ball joints, with the wheel
/// centre's or the contact point's height held it does not. The geometric axis is the line through both ball
/// joints of the carrier, without any motion: it holds nothing and has no pitch.
template <class T>
struct BasicSteeringAxis {
  Driver lock = Driver::wheel_centre_z;  ///< without meaning for the geometric axis
  Vector3<T> point;                      ///< on the axis, nearest to the wheel centre, m
  Vector3<T> direction;                  ///< unit, upward
  Vector3<T> ground;                     ///< on the axis, at the height of the contact point, m
  T caster = 0;                          ///< rad, > 0: top to the rear
  T inclination = 0;                     ///< rad, > 0: top inboard
  T trail = 0;                           ///< m along x, > 0: meets the ground ahead of the contact point
  T scrub = 0;                           ///< m along y, > 0: meets the ground inboard of the contact point
  T wheel_trail = 0,                     ///< m along the wheel, sign as `trail`
      wheel_scrub = 0;                   ///< m across the wheel, sign as `scrub`
  T caster_offset = 0;   ///< m along the wheel, at the height of its centre, > 0: axis ahead of it
  T kingpin_offset = 0;  ///< m across the wheel, at the height of its centre, > 0: axis inboard of it
  T pitch = 0;           ///< m/rad along the axis; 0 for a pure turn; NaN of the geometric axis
};
/// A steering axis, in numbers.
using SteeringAxis = BasicSteeringAxis<double>;

/// Roll centre and instant centres as they are drawn: the planes of both arms meet in the axis about which
/// the carrier would turn as it travels, if the tie rod agreed. That axis meets the transverse plane through
/// the wheel centre in the front centre and the longitudinal plane through it in the side centre; the line
/// from the contact point to the front centre meets the middle plane of the vehicle in the roll centre. The
/// motion itself (`front_centre`, `roll_centre_height`) differs by what the tie rod adds: bump steer. NaN for
/// a suspension without two planes, see CornerConstruction; a centre of parallel arms lies at infinity.
template <class T>
struct BasicArmCentres {
  /// A number that the suspension does not have.
  static constexpr double missing = nan;
  T roll_centre_height = missing;            ///< m above the ground line
  std::array<T, 2> front{missing, missing};  ///< (y, z), m
  std::array<T, 2> side{missing, missing};   ///< (x, z), m
  T front_swing_arm = missing;               ///< m, from contact to front centre
  T side_swing_arm = missing;                ///< m, from contact to side centre
  T side_swing_angle = missing;              ///< rad, of that arm above the ground
};

/// The parameters of a wheel that chassis engineers ask for at a position. Rates are taken in the motion of
/// the wheel with the rack held, per metre of wheel-centre height, unless the name says rack. Points are in
/// the vehicle's frame; directions of numbers are the same for both wheels. Without a spring its numbers are
/// NaN.
template <class T>
struct BasicWheelParameters {
  /// singular: at a limit of travel, where only angles and points are known and the rest is NaN.
  Status status = Status::done;
  /// A number that the suspension does not have.
  static constexpr double missing = nan;
  BasicWheelAngles<T> angles;  ///< toe, camber and carrier pitch
  /// Angle of the wheel's plane with the vehicle's vertical as the front view shows it (rad), > 0: top of the
  /// wheel away from the vehicle; tan = tan(camber) / cos(toe). `angles.camber` is that of the vertical with
  /// the plane itself.
  T front_view_camber = missing;
  Vector3<T> contact;             ///< lowest point of the tyre, m
  T track = missing;              ///< m, twice the contact point's distance from the middle plane (26)
  T half_track_change = missing;  ///< m, contact point outboard of that at the reference (26)
  T wheelbase_change = missing;   ///< m, contact point forward of that at the reference
  T recession = missing;          ///< m, wheel centre rearward of that at the reference
  T toe_by_travel = missing;      ///< rad/m, bump steer: > 0 toes in when it rises
  T camber_by_travel = missing;   ///< rad/m
  Vector3<T> velocity,            ///< velocity of the wheel centre, m/m
      turning;                    ///< rate of the carrier's rotation, rad/m
  BasicContactVelocity<T> contact_velocity;  ///< m/m
  /// Height above the ground line, both wheels travelling equally (27), with the carrier's velocity at the
  /// contact (m).
  T roll_centre_height = missing,
    roll_centre_height_geometric = missing;         ///< the same with the velocity of the contact point, m
  std::array<T, 2> front_centre{missing, missing};  ///< (y, z) of the instant centre seen along x, m
  std::array<T, 2> side_centre{missing, missing};   ///< (x, z) of the instant centre seen along y, m
  T front_swing_arm = missing;   ///< m, from contact to front centre; infinite for a wheel that only shifts
  T side_swing_arm = missing;    ///< m, from contact to side centre
  T side_swing_angle = missing;  ///< rad, of that arm above the ground
  /// Forward per upward velocity at the contact, of the carrier (outboard brake).
  T anti_pitch_tangent = missing,
    anti_pitch_tangent_free = missing;  ///< the same of the contact point (torque not taken by the carrier)
  T spring_length = missing;            ///< m
  T motion_ratio = missing;             ///< compression of the spring per metre of wheel-centre height
  T toe_by_rack = missing;              ///< rad/m, wheel-centre height held
  /// Pitch (m/rad) of the carrier's screw as it travels with the rack held; infinite where it only shifts.
  T screw_pitch = missing;
  BasicArmCentres<T> arms;  ///< centres as they are drawn, by the planes of the arms
  /// Steering axis with the height of the wheel centre held; of a suspension with a link on the rack.
  std::optional<BasicSteeringAxis<T>> axis_at_height,
      axis_at_spring,   ///< with the spring held; only with a spring
      axis_at_contact;  ///< with the height of the contact held
  /// Axis of a suspension whose carrier has two ball joints, steered or not.
  std::optional<BasicSteeringAxis<T>> geometric_axis;
};
/// The parameters of a wheel, in numbers.
using WheelParameters = BasicWheelParameters<double>;

/// Calls f(a, b) for every number of two sets of parameters; axes of steering that `a` has appear in `b`. A
/// number that is missing here has no derivative.
///
/// @param a the one set
/// @param b the other set
/// @param f the function, called with two numbers
template <class A, class B, class F>
void for_each_number(const BasicWheelParameters<A>& a, BasicWheelParameters<B>& b, F f) {
  const auto vector = [&](const Vector3<A>& from, Vector3<B>& to) {
    f(from.x, to.x);
    f(from.y, to.y);
    f(from.z, to.z);
  };
  f(a.angles.toe, b.angles.toe);
  f(a.angles.camber, b.angles.camber);
  f(a.angles.carrier_pitch, b.angles.carrier_pitch);
  f(a.front_view_camber, b.front_view_camber);
  vector(a.contact, b.contact);
  f(a.track, b.track);
  f(a.half_track_change, b.half_track_change);
  f(a.wheelbase_change, b.wheelbase_change);
  f(a.recession, b.recession);
  f(a.toe_by_travel, b.toe_by_travel);
  f(a.camber_by_travel, b.camber_by_travel);
  vector(a.velocity, b.velocity);
  vector(a.turning, b.turning);
  vector(a.contact_velocity.on_carrier, b.contact_velocity.on_carrier);
  vector(a.contact_velocity.geometric, b.contact_velocity.geometric);
  f(a.roll_centre_height, b.roll_centre_height);
  f(a.roll_centre_height_geometric, b.roll_centre_height_geometric);
  for (int i : {0, 1}) {
    f(a.front_centre[i], b.front_centre[i]);
    f(a.side_centre[i], b.side_centre[i]);
  }
  f(a.front_swing_arm, b.front_swing_arm);
  f(a.side_swing_arm, b.side_swing_arm);
  f(a.side_swing_angle, b.side_swing_angle);
  f(a.anti_pitch_tangent, b.anti_pitch_tangent);
  f(a.anti_pitch_tangent_free, b.anti_pitch_tangent_free);
  f(a.spring_length, b.spring_length);
  f(a.motion_ratio, b.motion_ratio);
  f(a.toe_by_rack, b.toe_by_rack);
  f(a.screw_pitch, b.screw_pitch);
  f(a.arms.roll_centre_height, b.arms.roll_centre_height);
  for (int i : {0, 1}) {
    f(a.arms.front[i], b.arms.front[i]);
    f(a.arms.side[i], b.arms.side[i]);
  }
  f(a.arms.front_swing_arm, b.arms.front_swing_arm);
  f(a.arms.side_swing_arm, b.arms.side_swing_arm);
  f(a.arms.side_swing_angle, b.arms.side_swing_angle);
  const auto axis = [&](const std::optional<BasicSteeringAxis<A>>& from,
                        std::optional<BasicSteeringAxis<B>>& to) {
    if (!from) return;
    if (!to) to.emplace();
    to->lock = from->lock;
    vector(from->point, to->point);
    vector(from->direction, to->direction);
    vector(from->ground, to->ground);
    f(from->caster, to->caster);
    f(from->inclination, to->inclination);
    f(from->trail, to->trail);
    f(from->scrub, to->scrub);
    f(from->wheel_trail, to->wheel_trail);
    f(from->wheel_scrub, to->wheel_scrub);
    f(from->caster_offset, to->caster_offset);
    f(from->kingpin_offset, to->kingpin_offset);
    f(from->pitch, to->pitch);
  };
  axis(a.axis_at_height, b.axis_at_height);
  axis(a.axis_at_spring, b.axis_at_spring);
  axis(a.axis_at_contact, b.axis_at_contact);
  axis(a.geometric_axis, b.geometric_axis);
}

/// The part of the parameters that is wanted. That of a position without motion costs half.
enum class Extent {
  at_rest,  ///< angles, contact point, track, changes, length of the spring
  all       ///< rates as well
};

/// The parameters of a wheel at a position, whatever its driver. The steer angle about +z is -toe on the left
/// and +toe on the right.
///
/// @param plan the plan of the suspension
/// @param position the position
/// @returns the parameters, with their status
WheelParameters wheel_parameters(const CornerPlan& plan, const CornerPosition& position);

/// The steering motion (unit rate of the rack) while a coordinate is held.
///
/// @param plan the plan of the suspension
/// @param position the position
/// @param rates motions by `solve_rates`, for any driver
/// @param lock coordinate that is held
/// @returns the rates of the suspension, by rack displacement
Twist steering_twist(const CornerPlan& plan, const CornerPosition& position, const CornerRates& rates,
                     Driver lock);

/// The axis of a steering motion of a wheel.
///
/// @param side side of the vehicle
/// @param centre wheel centre (m)
/// @param contact contact point (m)
/// @param toe toe of the wheel (rad)
/// @param steering the motion, at any rate
/// @param lock coordinate that the motion holds, for the record
/// @returns the axis; nothing if the motion does not turn the wheel about an upright axis
std::optional<SteeringAxis> steering_axis(Side side, const Vec3& centre, const Vec3& contact, double toe,
                                          const Twist& steering, Driver lock);

}  // namespace linkwright::suspension
