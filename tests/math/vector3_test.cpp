// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/vector3.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace linkwright::math {
namespace {

double largest(const Mat3& a, const Mat3& b) {
  double out = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 d = a.row[i] - b.row[i];
    out = std::max({out, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  }
  return out;
}

TEST(Vector3, TurnsAreRightHanded) {
  const double quarter = std::acos(0.0);
  // Rounding of the cosine of a quarter turn.
  EXPECT_LT(norm(turn_x(quarter) * Vec3{0, 1, 0} - Vec3{0, 0, 1}), 1e-15);
  EXPECT_LT(norm(turn_y(quarter) * Vec3{0, 0, 1} - Vec3{1, 0, 0}), 1e-15);
  EXPECT_LT(norm(turn_z(quarter) * Vec3{1, 0, 0} - Vec3{0, 1, 0}), 1e-15);
  EXPECT_EQ(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
}

TEST(Vector3, TurnAboutAVectorAgreesWithTheAxes) {
  // On both sides of the switch to series and far off; rounding of a few operations.
  for (double angle : {0.0, 1e-9, 0.00999, 0.01001, 0.7, -3.0}) {
    EXPECT_LT(largest(turn_about({angle, 0, 0}), turn_x(angle)), 4e-16) << angle;
    EXPECT_LT(largest(turn_about({0, angle, 0}), turn_y(angle)), 4e-16) << angle;
    EXPECT_LT(largest(turn_about({0, 0, angle}), turn_z(angle)), 4e-16) << angle;
  }
  const Vec3 turn{0.3, -0.5, 0.2};
  EXPECT_LT(norm(turn_about(turn) * turn - turn), 4e-16);
  EXPECT_LT(largest(turn_about(turn) * turn_about(-turn), Mat3{}), 4e-16);
}

TEST(Vector3, TurnOfARotationIsTheVectorThatMadeIt) {
  // Small, about each axis beyond a right angle, and just short of half a turn, where the sine vanishes.
  for (const Vec3& turn : {Vec3{}, Vec3{1e-9, -2e-9, 3e-9}, Vec3{0.3, -0.5, 0.2}, Vec3{2.8, 0.3, -0.1},
                           Vec3{-0.3, 2.9, 0.2}, Vec3{0.1, 0.2, -3.0}, Vec3{3.1415926, 0, 0}}) {
    const Vec3 back = turn_of(turn_about(turn));
    EXPECT_LT(norm(back - turn), 2e-15) << turn.x;
  }
  // Small turns keep their digits.
  EXPECT_LT(norm(turn_of(turn_about({1e-12, 0, 0})) - Vec3{1e-12, 0, 0}), 1e-27);
  // Half a turn may have either vector.
  const Vec3 half = turn_of(turn_about(4 * std::atan(1.0) * unit({1, -2, 2})));
  EXPECT_LT(std::min(norm(half - 4 * std::atan(1.0) * unit({1, -2, 2})),
                     norm(half + 4 * std::atan(1.0) * unit({1, -2, 2}))),
            2e-15);
  // Beyond it the turn the other way is less.
  EXPECT_LT(norm(turn_of(turn_z(4)) - Vec3{0, 0, 4 - 8 * std::atan(1.0)}), 1e-15);
}

TEST(Vector3, RectifyingSquaresTheError) {
  const Mat3 exact = turn_about({0.3, -0.5, 0.2});
  Mat3 off = exact;
  off.row[1].x += 1e-6;
  const Mat3 mended = rectified(off);
  // A shear of 1e-6 is half a rotation; what is left across is of the order of its square.
  EXPECT_LT(largest(mended * transposed(mended), Mat3{}), 2e-12);
  EXPECT_LT(largest(mended, exact), 1.01e-6);
}

TEST(Vector3, AcrossIsARightHandedFrame) {
  for (const Vec3& axis :
       {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, unit({1, 1, 1}), unit({0.1, -3, 0.2})}) {
    const auto [first, second] = across(axis);
    EXPECT_NEAR(dot(first, axis), 0, 2e-16);
    EXPECT_NEAR(norm(first), 1, 4e-16);
    EXPECT_LT(norm(cross(first, second) - axis), 5e-16);
  }
}

TEST(Vector3, MirrorOfATurnedPointIsTheMirrorTurned) {
  const Mat3 rotation = turn_about({0.3, -0.5, 0.2});
  const Vec3 point{1, 2, 3};
  EXPECT_EQ(mirrored(rotation) * mirrored(point), mirrored(rotation * point));
  EXPECT_LT(largest(mirrored(rotation), turn_about(-mirrored(Vec3{0.3, -0.5, 0.2}))), 2e-16);
}

}  // namespace
}  // namespace linkwright::math
