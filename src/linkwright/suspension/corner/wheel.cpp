// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/detail/wheel_kernel.h"
#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {

Mat3 carrier_rotation(Side side, const CornerWheel& reference, const WheelAngles& angles) {
  return kernel::on_left(side, math::turn_z(-angles.toe) * math::turn_x(-angles.camber) *
                                   math::turn_y(angles.carrier_pitch) * math::turn_x(reference.camber) *
                                   math::turn_z(reference.toe));
}

WheelAngles wheel_angles(Side side, const CornerWheel& reference, const Mat3& rotation) {
  return kernel::wheel_angles(side, reference, rotation);
}

Vec3 angular_velocity(Side side, const WheelAngles& at, const WheelAngles& rates) {
  return kernel::angular_velocity(side, at, rates);
}

WheelAngles angle_rates(Side side, const WheelAngles& at, const Vec3& turning) {
  return kernel::angle_rates(side, at, turning);
}

Vec3 contact_offset(Side side, double tyre_diameter, const WheelAngles& angles) {
  return kernel::contact_offset(side, tyre_diameter, angles);
}

ContactVelocity contact_velocity(Side side, double tyre_diameter, const WheelAngles& at, const Vec3& velocity,
                                 const Vec3& turning) {
  return kernel::contact_velocity(side, tyre_diameter, at, velocity, turning);
}

}  // namespace linkwright::suspension
