// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/axle.h"

#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::suspension {
namespace {

/// Forward per upward velocity of the contact point, as the carrier turns about the side centre of the arm
/// planes. The angle still describes parallel arms, whose centre lies at infinity.
double tangent_by_arms(const WheelParameters& wheel) {
  const double slope = std::tan(wheel.arms.side_swing_angle);
  return wheel.arms.side[0] < wheel.contact.x ? slope : -slope;
}

}  // namespace

std::optional<std::array<double, 2>> roll_centre(const WheelParameters& left, const WheelParameters& right) {
  const Vec3 &p = left.contact, &q = right.contact;
  const Vec3 &v = left.contact_velocity.on_carrier, &w = right.contact_velocity.on_carrier;
  // Both lines: (point - contact) . velocity = 0 in y and z.
  const double determinant = v.y * w.z - v.z * w.y;
  if (!(std::abs(determinant) > 1e-12 * std::hypot(v.y, v.z) * std::hypot(w.y, w.z))) return std::nullopt;
  const double a = p.y * v.y + p.z * v.z, b = q.y * w.y + q.z * w.z;
  return std::array{(a * w.z - b * v.z) / determinant, (b * v.y - a * w.y) / determinant};
}

RollGains roll_gains(const WheelParameters& wheel) {
  const double rise = std::abs(wheel.contact.y) / wheel.contact_velocity.geometric.z;
  return {rise * wheel.toe_by_travel, 1 + rise * wheel.camber_by_travel};
}

AntiFeatures anti_features(const WheelParameters& wheel, AxlePlace place, const VehicleLayout& layout) {
  LINKWRIGHT_REQUIRE(layout.wheelbase > 0 && layout.centre_height > 0,
                     "wheelbase {} m, height of the mass centre {} m", layout.wheelbase,
                     layout.centre_height);
  const auto share = [](double of) { return of >= 0 && of <= 1; };
  LINKWRIGHT_REQUIRE(share(layout.front_brake_share) && share(layout.axle_drive_share), "shares {} and {}",
                     layout.front_brake_share, layout.axle_drive_share);
  const bool front = place == AxlePlace::front;
  const double gain = (front ? 100 : -100) * layout.wheelbase / layout.centre_height;
  const double braking = front ? layout.front_brake_share : 1 - layout.front_brake_share;
  return {gain * braking * wheel.anti_pitch_tangent, gain * braking * wheel.anti_pitch_tangent_free,
          gain * layout.axle_drive_share * wheel.anti_pitch_tangent_free,
          gain * braking * tangent_by_arms(wheel)};
}

Ackermann ackermann(double inner, double outer, double wheelbase, double track) {
  LINKWRIGHT_REQUIRE(wheelbase > 0 && track > 0, "wheelbase {} m, track {} m", wheelbase, track);
  LINKWRIGHT_REQUIRE(outer > 0, "outer angle {} rad: angles are changes from straight ahead, > 0", outer);
  // cot ideal = cot outer - track / wheelbase
  const double ideal = std::atan2(std::sin(outer), std::cos(outer) - track / wheelbase * std::sin(outer));
  return {ideal, 100 * (inner - outer) / (ideal - outer)};
}

TurningCircle turning_circle(double outer, double wheelbase, double axes, double scrub, double overhang,
                             double width) {
  LINKWRIGHT_REQUIRE(wheelbase > 0 && axes > 0 && outer > 0,
                     "wheelbase {} m, distance of the axes {} m, outer angle {} rad", wheelbase, axes, outer);
  // From the middle of the rear axle to the centre of the turn.
  const double across = wheelbase / std::tan(outer) - axes / 2;
  return {2 * (wheelbase / std::sin(outer) + scrub),
          2 * std::hypot(wheelbase + overhang, across + width / 2)};
}

}  // namespace linkwright::suspension
