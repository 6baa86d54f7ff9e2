// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/suspension/corner/suspension.h"

/// The wheel on its carrier: angles, their rates, and the contact point. Right wheels are treated as the
/// mirror image of left ones, so that angles of both have the same signs.
namespace linkwright::suspension {

/// rad; as rates rad/s (or per m). Carrier pitch is the turn of the carrier about the wheel's axis, zero at
/// the reference and positive about +y (for both wheels: forward at the top).
template <class T>
struct BasicWheelAngles {
  T toe{0}, camber{0}, carrier_pitch{0};
};
using WheelAngles = BasicWheelAngles<double>;

/// Rotation of the carrier from the reference (equation 50, and 51 with its signs corrected).
Mat3 carrier_rotation(Side side, const CornerWheel& reference, const WheelAngles& angles);

/// The angles of a rotation (equations 23, 24 and 50 turned round); camber in (-pi/2, pi/2).
WheelAngles wheel_angles(Side side, const CornerWheel& reference, const Mat3& rotation);

/// Angular velocity of the carrier from the rates of the angles (equation 53), and back; at a camber of a
/// right angle toe has no rate.
Vec3 angular_velocity(Side side, const WheelAngles& at, const WheelAngles& rates);
WheelAngles angle_rates(Side side, const WheelAngles& at, const Vec3& turning);

/// From the wheel centre to the lowest point of the tyre, a thin disc (equation 25).
Vec3 contact_offset(Side side, double tyre_diameter, const WheelAngles& angles);

/// Two velocities at the contact: of the point of the carrier there (equation 28 with its sign corrected; the
/// wheel is held by the carrier, as by an outboard brake), and of the contact point itself (the wheel turns
/// freely). They differ along the tyre by the carrier pitch.
template <class T>
struct BasicContactVelocity {
  Vector3<T> on_carrier;
  Vector3<T> geometric;
};
using ContactVelocity = BasicContactVelocity<double>;
ContactVelocity contact_velocity(Side side, double tyre_diameter, const WheelAngles& at, const Vec3& velocity,
                                 const Vec3& turning);

}  // namespace linkwright::suspension
