// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "linkwright/suspension/corner/suspension.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

using test::at;
using test::number_at;

void expect_near(const Vec3& a, const Vec3& b, double close) { EXPECT_LT(norm(a - b), close); }

TEST(Wheel, RotationAndAngularVelocityAsComputedElsewhere) {
  const Value& reference = published("rotation-and-angular-velocity");
  const Value& in = at(reference, "inputs");
  const Value& computed = at(reference, "computed");
  const WheelAngles angles{number_at(in, "toe_rad"), number_at(in, "camber_rad"), number_at(in, "spin_rad")};
  const CornerWheel wheel{{}, number_at(in, "toe_ref_rad"), number_at(in, "camber_ref_rad"), 0.6};
  const Mat3 rotation = carrier_rotation(Side::left, wheel, angles);
  const auto& rows = at(computed, "R_rowmajor").as_array();
  for (int i = 0; i < 3; ++i) expect_near(rotation.row[i], point(rows[i]), 1e-15);
  expect_near(wheel_axis(Side::left, angles.toe, angles.camber), point(at(computed, "wheel_axis")), 1e-15);
  const WheelAngles rates{number_at(in, "toe_rate_rad_s"), number_at(in, "camber_rate_rad_s"),
                          number_at(in, "spin_rate_rad_s")};
  expect_near(angular_velocity(Side::left, angles, rates), point(at(computed, "omega_rad_s")), 1e-15);
}

TEST(Wheel, AnglesComeBack) {
  const CornerWheel wheel{{}, 0.07, -0.05, 0.6};
  for (Side side : {Side::left, Side::right})
    for (const WheelAngles& there :
         {WheelAngles{0.31, -0.12, 0.23}, WheelAngles{-1.2, 0.9, -2.0}, WheelAngles{}}) {
      const WheelAngles back = wheel_angles(side, wheel, carrier_rotation(side, wheel, there));
      // A few roundings.
      EXPECT_NEAR(back.toe, there.toe, 1e-15);
      EXPECT_NEAR(back.camber, there.camber, 1e-15);
      EXPECT_NEAR(back.carrier_pitch, there.carrier_pitch, 1e-15);
      const WheelAngles rates = angle_rates(side, there, angular_velocity(side, there, {0.7, -0.4, 0.9}));
      EXPECT_NEAR(rates.toe, 0.7, 1e-15);
      EXPECT_NEAR(rates.camber, -0.4, 1e-15);
      EXPECT_NEAR(rates.carrier_pitch, 0.9, 1e-15);
    }
  EXPECT_EQ(wheel_angles(Side::left, wheel, {}).carrier_pitch, 0);
}

TEST(Wheel, AngularVelocityAndContactAgainstDifferences) {
  constexpr double h = 1e-6;
  const CornerWheel wheel{{}, 0.07, -0.05, 0.6};
  const WheelAngles here{0.31, -0.12, 0.23}, rates{0.7, -0.4, 0.9};
  const Vec3 velocity{0.1, 0.2, 1.0};
  const auto later = [&](double t) {
    return WheelAngles{here.toe + t * rates.toe, here.camber + t * rates.camber,
                       here.carrier_pitch + t * rates.carrier_pitch};
  };
  for (Side side : {Side::left, Side::right}) {
    const Mat3 more = carrier_rotation(side, wheel, later(h)),
               less = carrier_rotation(side, wheel, later(-h));
    const Mat3 turn = more * transposed(less);
    const Vec3 turning = (0.25 / h) * Vec3{turn.row[2].y - turn.row[1].z, turn.row[0].z - turn.row[2].x,
                                           turn.row[1].x - turn.row[0].y};
    // h^2 and rounding / h.
    expect_near(turning, angular_velocity(side, here, rates), 1e-9);
    const Vec3 shift =
        (0.5 / h) * (contact_offset(side, 0.6, later(h)) - contact_offset(side, 0.6, later(-h)));
    const ContactVelocity found =
        contact_velocity(side, 0.6, here, velocity, angular_velocity(side, here, rates));
    expect_near(found.geometric, velocity + shift, 1e-9);
    const Vec3 fixed = transposed(carrier_rotation(side, wheel, here)) * contact_offset(side, 0.6, here);
    expect_near(found.on_carrier, velocity + (0.5 / h) * (more * fixed - less * fixed), 1e-9);
  }
}

TEST(Wheel, ContactIsTheLowestPointOfTheDisc) {
  const WheelAngles angles{0.3, -0.2, 0};
  for (Side side : {Side::left, Side::right}) {
    const Vec3 offset = contact_offset(side, 0.6, angles), axis = wheel_axis(side, angles.toe, angles.camber);
    EXPECT_NEAR(dot(offset, axis), 0, 1e-16);
    EXPECT_NEAR(norm(offset), 0.3, 1e-16);
    for (double turn : {-0.1, 0.1}) EXPECT_GT((math::turn_about(turn * axis) * offset).z, offset.z);
  }
}

}  // namespace
}  // namespace linkwright::suspension
