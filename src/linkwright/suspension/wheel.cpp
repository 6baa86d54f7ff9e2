#include "linkwright/suspension/wheel.h"

#include <cmath>

namespace linkwright::suspension {
namespace {

Vec3 on_left(Side side, const Vec3& a) { return side == Side::left ? a : math::mirrored(a); }
Vec3 turning_on_left(Side side, const Vec3& a) { return side == Side::left ? a : -math::mirrored(a); }
Mat3 on_left(Side side, const Mat3& m) { return side == Side::left ? m : math::mirrored(m); }

}  // namespace

Mat3 carrier_rotation(Side side, const GuideWheel& reference, const WheelAngles& angles) {
  return on_left(side, math::turn_z(-angles.toe) * math::turn_x(-angles.camber) * math::turn_y(angles.spin) *
                           math::turn_x(reference.camber) * math::turn_z(reference.toe));
}

WheelAngles wheel_angles(Side side, const GuideWheel& reference, const Mat3& rotation) {
  // The second column of the rotation without its reference part is the axis; what is left of it is the spin.
  const double ct = std::cos(reference.toe), st = std::sin(reference.toe);
  const double cc = std::cos(reference.camber), sc = std::sin(reference.camber);
  const Mat3 left = on_left(side, rotation);
  const Vec3 axis = left * Vec3{st * cc, ct * cc, -sc};
  const Vec3 up =
      left * Vec3{st * sc, ct * sc, cc};  // the reference's upward direction in the plane of the wheel
  const double across = std::hypot(axis.x, axis.y);
  const double toe = std::atan2(axis.x, axis.y), camber = std::atan2(-axis.z, across);
  // Forward and upward in the plane of the wheel as it stands now.
  const Vec3 forward{axis.y / across, -axis.x / across, 0};
  return {toe, camber, std::atan2(dot(up, forward), dot(up, cross(forward, axis)))};
}

Vec3 angular_velocity(Side side, const WheelAngles& at, const WheelAngles& rates) {
  const double ct = std::cos(at.toe), st = std::sin(at.toe);
  const double cc = std::cos(at.camber), sc = std::sin(at.camber);
  return turning_on_left(side, {-rates.camber * ct + rates.spin * st * cc,
                                rates.camber * st + rates.spin * ct * cc, -rates.toe - rates.spin * sc});
}

WheelAngles angle_rates(Side side, const WheelAngles& at, const Vec3& turning) {
  const Vec3 turn = turning_on_left(side, turning);
  const double ct = std::cos(at.toe), st = std::sin(at.toe);
  const double spin = (turn.x * st + turn.y * ct) / std::cos(at.camber);
  return {-turn.z - spin * std::sin(at.camber), turn.y * st - turn.x * ct, spin};
}

Vec3 contact_offset(Side side, double tyre_diameter, const WheelAngles& angles) {
  const double sc = std::sin(angles.camber);
  return on_left(side, (-tyre_diameter / 2) * Vec3{std::sin(angles.toe) * sc, std::cos(angles.toe) * sc,
                                                   std::cos(angles.camber)});
}

ContactVelocity contact_velocity(Side side, double tyre_diameter, const WheelAngles& at, const Vec3& velocity,
                                 const Vec3& turning) {
  const WheelAngles rates = angle_rates(side, at, turning);
  const double ct = std::cos(at.toe), st = std::sin(at.toe);
  const double cc = std::cos(at.camber), sc = std::sin(at.camber);
  const Vec3 swing{rates.toe * ct * sc + rates.camber * st * cc,
                   -rates.toe * st * sc + rates.camber * ct * cc, -rates.camber * sc};
  return {velocity + cross(turning, contact_offset(side, tyre_diameter, at)),
          velocity - (tyre_diameter / 2) * on_left(side, swing)};
}

}  // namespace linkwright::suspension
