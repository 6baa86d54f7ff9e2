// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/vector2.h"
#include "support/generators.h"

namespace linkwright::math {
namespace {

using linkwright::test::between;

// Coordinates up to 10 and angles of some turns; products of two or three of them are below 100.
rc::Gen<Pose> any_pose() {
  return rc::gen::construct<Pose>(between(-10, 10), between(-10, 10), between(-20, 20));
}
// A few dozen roundings of numbers below 100, each 1e-16 of them.
constexpr double tolerance = 1e-12;

bool same(const Pose& a, const Pose& b) {
  return std::abs(a.x - b.x) < tolerance && std::abs(a.y - b.y) < tolerance &&
         std::abs(angle_difference(a.angle, b.angle)) < tolerance;
}
bool wrapped(const Pose& p) { return p.angle > -pi && p.angle <= pi; }

TEST(Pose, TurnsFirstAndShiftsThen) {
  const auto p = transform({10, 20, pi / 2}, {3, 1});
  EXPECT_NEAR(p.real(), 9, 1e-14);
  EXPECT_NEAR(p.imag(), 23, 1e-14);
}

TEST(Pose, DifferenceIsSeenFromTheSecond) {
  // From (1, 1) looking up, (1, 3) is two ahead; from 170 to -170 degrees the short way is 20 onwards.
  const Pose d = difference({1, 3, radians(-170)}, {1, 1, pi / 2});
  EXPECT_NEAR(d.x, 2, 1e-15);
  EXPECT_NEAR(d.y, 0, 1e-15);
  EXPECT_NEAR(degrees(d.angle), 100, 1e-13);
  EXPECT_NEAR(degrees(difference({0, 0, radians(-170)}, {0, 0, radians(170)}).angle), 20, 1e-13);
}

TEST(Pose, DifferenceOfNearPosesKeepsItsDigits) {
  const Pose a{1e6, 1e6, 0.3}, b{1e6 + 0.125, 1e6, 0.3};
  const Pose d = difference(b, a);
  EXPECT_NEAR(std::hypot(d.x, d.y), 0.125, 1e-16);
}

TEST(Pose, HalfATurnStaysPositive) {
  EXPECT_EQ(inverse({0, 0, pi}).angle, pi);
  EXPECT_EQ(compose({0, 0, pi / 2}, {0, 0, pi / 2}).angle, pi);
}

RC_GTEST_PROP(Pose, ComposedMotionsFollowEachOther, ()) {
  const Pose a = *any_pose(), b = *any_pose();
  const std::complex<double> p(*between(-10, 10), *between(-10, 10));
  RC_ASSERT(std::abs(transform(compose(a, b), p) - transform(a, transform(b, p))) < tolerance);
  RC_ASSERT(wrapped(compose(a, b)));
}

RC_GTEST_PROP(Pose, IsAGroup, ()) {
  const Pose a = *any_pose(), b = *any_pose(), c = *any_pose();
  RC_ASSERT(same(compose(compose(a, b), c), compose(a, compose(b, c))));
  RC_ASSERT(same(compose(a, Pose{}), a));
  RC_ASSERT(same(compose(Pose{}, a), a));
  RC_ASSERT(same(compose(a, inverse(a)), Pose{}));
  RC_ASSERT(same(compose(inverse(a), a), Pose{}));
  RC_ASSERT(same(inverse(compose(a, b)), compose(inverse(b), inverse(a))));
  RC_ASSERT(wrapped(inverse(a)));
}

RC_GTEST_PROP(Pose, DifferenceUndoesCompose, ()) {
  const Pose a = *any_pose(), b = *any_pose();
  RC_ASSERT(same(compose(a, difference(b, a)), b));
  RC_ASSERT(same(difference(compose(a, b), a), b));
  RC_ASSERT(same(difference(b, a), compose(inverse(a), b)));
  RC_ASSERT(same(difference(a, a), Pose{}));
  RC_ASSERT(wrapped(difference(b, a)));
}

RC_GTEST_PROP(Pose, KeepsDistances, ()) {
  const Pose a = *any_pose();
  const std::complex<double> p(*between(-10, 10), *between(-10, 10)), q(*between(-10, 10), *between(-10, 10));
  RC_ASSERT(std::abs(std::abs(transform(a, p) - transform(a, q)) - std::abs(p - q)) < tolerance);
}

}  // namespace
}  // namespace linkwright::math
