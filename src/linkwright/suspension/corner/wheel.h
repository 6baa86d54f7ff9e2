// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/suspension/corner/suspension.h"

/// @file
/// The wheel on its carrier: angles, their rates, and the contact point. Right wheels are treated as the
/// mirror image of left ones, so that angles of both have the same signs.
namespace linkwright::suspension {

/// The angles of a wheel: rad; as rates rad/s (or per m). Carrier pitch is the turn of the carrier about the
/// wheel's axis, zero at the reference and positive about +y (for both wheels: forward at the top).
template <class T>
struct BasicWheelAngles {
  T toe{0},              ///< > 0: front of the wheel towards the vehicle
      camber{0},         ///< > 0: top of the wheel away from the vehicle
      carrier_pitch{0};  ///< > 0: forward at the top
};
/// The angles of a wheel, in numbers.
using WheelAngles = BasicWheelAngles<double>;

/// Rotation of the carrier from the reference (equation 50, and 51 with its signs corrected).
///
/// @param side side of the vehicle
/// @param reference wheel at the reference position
/// @param angles angles of the wheel
/// @returns the rotation matrix
Mat3 carrier_rotation(Side side, const CornerWheel& reference, const WheelAngles& angles);

/// The angles of a rotation (equations 23, 24 and 50 inverted).
///
/// @param side side of the vehicle
/// @param reference wheel at the reference position
/// @param rotation rotation of the carrier from the reference
/// @returns the angles; camber in (-pi/2, pi/2)
WheelAngles wheel_angles(Side side, const CornerWheel& reference, const Mat3& rotation);

/// Angular velocity of the carrier from the rates of the angles (equation 53).
///
/// @param side side of the vehicle
/// @param at angles of the wheel
/// @param rates rates of the angles (rad/s)
/// @returns the angular velocity (rad/s)
Vec3 angular_velocity(Side side, const WheelAngles& at, const WheelAngles& rates);

/// The rates of the angles from the angular velocity of the carrier; at a camber of a right angle toe has no
/// rate.
///
/// @param side side of the vehicle
/// @param at angles of the wheel
/// @param turning angular velocity of the carrier (rad/s)
/// @returns the rates (rad/s)
WheelAngles angle_rates(Side side, const WheelAngles& at, const Vec3& turning);

/// The vector from the wheel centre to the lowest point of the tyre, a thin disc (equation 25).
///
/// @param side side of the vehicle
/// @param tyre_diameter m
/// @param angles angles of the wheel
/// @returns the vector (m)
Vec3 contact_offset(Side side, double tyre_diameter, const WheelAngles& angles);

/// Two velocities at the contact. They differ along the tyre by the carrier pitch.
template <class T>
struct BasicContactVelocity {
  /// Velocity of the point of the carrier there (equation 28 with its sign corrected): the wheel is held by
  /// the carrier, as by an outboard brake.
  Vector3<T> on_carrier;
  /// Velocity of the contact point itself: the wheel turns freely.
  Vector3<T> geometric;
};
/// Two velocities at the contact, in numbers.
using ContactVelocity = BasicContactVelocity<double>;

/// The velocities at the contact.
///
/// @param side side of the vehicle
/// @param tyre_diameter m
/// @param at angles of the wheel
/// @param velocity velocity of the wheel centre (m/s)
/// @param turning angular velocity of the carrier (rad/s)
/// @returns both velocities (m/s)
ContactVelocity contact_velocity(Side side, double tyre_diameter, const WheelAngles& at, const Vec3& velocity,
                                 const Vec3& turning);

}  // namespace linkwright::suspension
