// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "linkwright/suspension/corner/suspension.h"

/// The wheel's formulas, written once for numbers and for numbers with derivatives.
namespace linkwright::suspension::kernel {

template <class T>
Vector3<T> wheel_axis(Side side, const T& toe, const T& camber) {
  using std::cos;
  using std::sin;
  const T flat = cos(camber);
  const T y = cos(toe) * flat;
  return {sin(toe) * flat, side == Side::left ? y : -y, -sin(camber)};
}

template <class T>
Vector3<T> on_left(Side side, const Vector3<T>& a) {
  return side == Side::left ? a : math::mirrored(a);
}
template <class T>
Vector3<T> turning_on_left(Side side, const Vector3<T>& a) {
  return side == Side::left ? a : -math::mirrored(a);
}
template <class T>
Matrix3<T> on_left(Side side, const Matrix3<T>& m) {
  return side == Side::left ? m : math::mirrored(m);
}

template <class T>
BasicWheelAngles<T> wheel_angles(Side side, const BasicCornerWheel<T>& reference,
                                 const Matrix3<T>& rotation) {
  using std::atan2;
  using std::cos;
  using std::hypot;
  using std::sin;
  // The second column of the rotation without its reference part is the axis; what is left of it is the
  // carrier pitch.
  const T ct = cos(reference.toe), st = sin(reference.toe);
  const T cc = cos(reference.camber), sc = sin(reference.camber);
  const Matrix3<T> left = on_left(side, rotation);
  const Vector3<T> axis = left * Vector3<T>{st * cc, ct * cc, -sc};
  const Vector3<T> up =
      left * Vector3<T>{st * sc, ct * sc, cc};  // the reference's upward direction in the plane of the wheel
  const T across = hypot(axis.x, axis.y);
  const T toe = atan2(axis.x, axis.y), camber = atan2(-axis.z, across);
  // Forward and upward in the plane of the wheel in its present position.
  const Vector3<T> forward{axis.y / across, -axis.x / across, 0};
  return {toe, camber, atan2(dot(up, forward), dot(up, cross(forward, axis)))};
}

template <class T>
Vector3<T> angular_velocity(Side side, const BasicWheelAngles<T>& at, const BasicWheelAngles<T>& rates) {
  using std::cos;
  using std::sin;
  const T ct = cos(at.toe), st = sin(at.toe);
  const T cc = cos(at.camber), sc = sin(at.camber);
  return turning_on_left(side, Vector3<T>{-rates.camber * ct + rates.carrier_pitch * st * cc,
                                          rates.camber * st + rates.carrier_pitch * ct * cc,
                                          -rates.toe - rates.carrier_pitch * sc});
}

template <class T>
BasicWheelAngles<T> angle_rates(Side side, const BasicWheelAngles<T>& at, const Vector3<T>& turning) {
  using std::cos;
  using std::sin;
  const Vector3<T> turn = turning_on_left(side, turning);
  const T ct = cos(at.toe), st = sin(at.toe);
  const T carrier_pitch = (turn.x * st + turn.y * ct) / cos(at.camber);
  return {-turn.z - carrier_pitch * sin(at.camber), turn.y * st - turn.x * ct, carrier_pitch};
}

template <class T>
Vector3<T> contact_offset(Side side, double tyre_diameter, const BasicWheelAngles<T>& angles) {
  using std::cos;
  using std::sin;
  const T sc = sin(angles.camber);
  return on_left(side, (-tyre_diameter / 2) *
                           Vector3<T>{sin(angles.toe) * sc, cos(angles.toe) * sc, cos(angles.camber)});
}

template <class T>
BasicContactVelocity<T> contact_velocity(Side side, double tyre_diameter, const BasicWheelAngles<T>& at,
                                         const Vector3<T>& velocity, const Vector3<T>& turning) {
  using std::cos;
  using std::sin;
  const BasicWheelAngles<T> rates = angle_rates(side, at, turning);
  const T ct = cos(at.toe), st = sin(at.toe);
  const T cc = cos(at.camber), sc = sin(at.camber);
  const Vector3<T> swing{rates.toe * ct * sc + rates.camber * st * cc,
                         -rates.toe * st * sc + rates.camber * ct * cc, -rates.camber * sc};
  return {velocity + cross(turning, contact_offset(side, tyre_diameter, at)),
          velocity - (tyre_diameter / 2) * on_left(side, swing)};
}

}  // namespace linkwright::suspension::kernel
