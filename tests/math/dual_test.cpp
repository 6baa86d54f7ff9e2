// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/dual.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "linkwright/math/vector3.h"

namespace linkwright::math {
namespace {

using D = Dual<2>;

TEST(Dual, EveryOperationAgreesWithDifferences) {
  const auto check = [](auto f) {
    const double x = 0.7, y = -0.4, h = 1e-5;
    const D both = f(D::variable(x, 0), D::variable(y, 1));
    EXPECT_EQ(both.value, f(D(x), D(y)).value);
    const double by_x = (f(D(x + h), D(y)).value - f(D(x - h), D(y)).value) / (2 * h);
    const double by_y = (f(D(x), D(y + h)).value - f(D(x), D(y - h)).value) / (2 * h);
    // Central differences: h^2 times third derivatives of up to 100.
    EXPECT_NEAR(both.by[0], by_x, 1e-8);
    EXPECT_NEAR(both.by[1], by_y, 1e-8);
  };
  check([](D x, D y) { return x + y; });
  check([](D x, D y) { return x - y; });
  check([](D x, D y) { return x * y; });
  check([](D x, D y) { return x / y; });
  check([](D x, D y) { return -x + 2 * y - x * 3.0; });
  check([](D x, D y) { return 1 / x + y / 2 + (1 - y) + (x - 1) + (2 + x) + (y + 1); });
  check([](D x, D y) { return sqrt(x) + abs(y); });
  check([](D x, D y) { return sin(x) * cos(y); });
  check([](D x, D y) { return atan(x / y); });
  check([](D x, D y) { return atan2(x, y) + hypot(x, y); });
  check([](D x, D y) {
    x += y;
    y -= x * x;
    return y;
  });
}

TEST(Dual, ComparesByValue) {
  EXPECT_TRUE(D::variable(1, 0) < D(2));
  EXPECT_TRUE(D(1) < 1.5 && D(2) > 1.5);
  EXPECT_EQ(value_of(D::variable(3, 1)), 3);
}

TEST(Dual, VectorsMixWithPlainOnes) {
  // Turn about z by the variable: the derivative of the turned x axis is the turned y axis.
  const double angle = 0.3;
  const Matrix3<D> turn = turn_about(D::variable(angle, 0) * Vec3{0, 0, 1});
  const Vector3<D> turned = turn * Vec3{1, 0, 0};
  // Rounding of a few operations.
  EXPECT_NEAR(turned.x.value, std::cos(angle), 1e-15);
  EXPECT_NEAR(turned.x.by[0], -std::sin(angle), 1e-15);
  EXPECT_NEAR(turned.y.by[0], std::cos(angle), 1e-15);
  EXPECT_NEAR(dot(turned, Vec3{1, 0, 0}).by[0], -std::sin(angle), 1e-15);
  EXPECT_NEAR(cross(Vec3{0, 0, 1}, turned).x.by[0], -std::cos(angle), 1e-15);
  EXPECT_NEAR((2.0 * turned - Vec3{1, 1, 1}).y.by[0], 2 * std::cos(angle), 1e-15);
}

}  // namespace
}  // namespace linkwright::math
