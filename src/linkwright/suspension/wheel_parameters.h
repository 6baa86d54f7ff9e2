#pragma once

#include <array>
#include <limits>
#include <optional>

#include "linkwright/suspension/position.h"
#include "linkwright/suspension/wheel.h"

namespace linkwright::suspension {

/// The axis about which the wheel turns when it is steered: instantaneous screw axis of the motion by the
/// rack while `lock` is held (equations 30 to 37 with 30, 31 and 36 put right). What is held has to be told:
/// with the spring held the axis of a double wishbone passes through both ball joints, with the wheel
/// centre's height held, as in the source, it does not.
struct SteeringAxis {
  Driver lock = Driver::wheel_centre_z;
  Vec3 point;                               ///< on the axis, nearest to the wheel centre
  Vec3 direction;                           ///< unit, upward
  Vec3 ground;                              ///< on the axis, at the height of the contact point
  double caster = 0;                        ///< rad, > 0: top to the rear
  double inclination = 0;                   ///< rad, > 0: top inboard
  double trail = 0;                         ///< m along x, > 0: meets the ground ahead of the contact point
  double scrub = 0;                         ///< m along y, > 0: meets the ground inboard of the contact point
  double wheel_trail = 0, wheel_scrub = 0;  ///< the same along and across the wheel
  double caster_offset = 0;   ///< m along the wheel, at the height of its centre, > 0: axis ahead of it
  double kingpin_offset = 0;  ///< m across the wheel, at the height of its centre, > 0: axis inboard of it
  double pitch = 0;           ///< m/rad along the axis; 0 for a pure turn
};

/// What the chassis engineer asks of a position. Rates are taken in the motion of the wheel with the rack
/// held, per metre of wheel-centre height, unless the name says rack. Points are in the vehicle's frame;
/// directions of numbers are the same for both wheels. Without a spring its numbers are NaN.
struct WheelParameters {
  /// singular: at a limit of travel, where only angles and points are known and the rest is NaN.
  Status status = Status::done;
  WheelAngles angles;
  Vec3 contact;
  static constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  double half_track_change = missing;  ///< m, contact point outboard of that at the reference (26)
  double wheelbase_change = missing;   ///< m, contact point forward of that at the reference
  double recession = missing;          ///< m, wheel centre forward of that at the reference
  double toe_by_travel = missing;      ///< rad/m, bump steer: > 0 toes in when it rises
  double camber_by_travel = missing;   ///< rad/m
  Vec3 velocity, turning;              ///< of the wheel centre (m/m) and of the carrier (rad/m)
  ContactVelocity contact_velocity;    ///< m/m
  /// m above the ground line, both wheels travelling equally (27): with the carrier's velocity at the
  /// contact, and with that of the contact point.
  double roll_centre_height = missing, roll_centre_height_geometric = missing;
  std::array<double, 2> front_centre{missing, missing};  ///< (y, z) of the instant centre seen along x, m
  std::array<double, 2> side_centre{missing, missing};   ///< (x, z) of the instant centre seen along y, m
  double front_swing_arm =
      missing;  ///< m, from contact to front centre; infinite for a wheel that only shifts
  double side_swing_arm = missing;    ///< m, from contact to side centre
  double side_swing_angle = missing;  ///< rad, of that arm above the ground
  /// Forward per upward velocity at the contact, of the carrier (outboard brake) and of the contact point
  /// (torque not taken by the carrier).
  double support_tangent = missing, support_tangent_free = missing;
  double spring_length = missing;  ///< m
  double motion_ratio = missing;   ///< compression of the spring per metre of wheel-centre height
  double toe_by_rack = missing;    ///< rad/m, wheel-centre height held
  /// Of a guide with a link on the rack; the second only with a spring.
  std::optional<SteeringAxis> axis_at_height, axis_at_spring;
};

/// Everything at a position, whatever its driver. The steer angle about +z is -toe on the left and +toe on
/// the right.
WheelParameters wheel_parameters(const GuidePlan& plan, const GuidePosition& position);

/// Steering motion (unit rate of the rack) with `lock` held, from the motions of `solve_rates` for any
/// driver.
Twist steering_twist(const GuidePlan& plan, const GuidePosition& position, const GuideRates& rates,
                     Driver lock);

/// The axis of a steering motion (any rate) of a wheel with its centre, contact point and toe; nothing if the
/// motion does not turn the wheel about an upright axis. `lock` is what the motion holds, for the record.
std::optional<SteeringAxis> steering_axis(Side side, const Vec3& centre, const Vec3& contact, double toe,
                                          const Twist& steering, Driver lock);

}  // namespace linkwright::suspension
