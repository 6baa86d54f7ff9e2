// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/vector2.h"

#include <gtest/gtest.h>

#include "linkwright/core/numbers.h"

namespace linkwright::math {
namespace {

const Vec2 a{3, -4}, b{0.5, 2};

TEST(Vector2, ProductsAreThoseOfComplexNumbers) {
  const std::complex<double> product = std::conj(number(a)) * number(b);
  EXPECT_EQ(dot(a, b), product.real());
  EXPECT_EQ(cross(a, b), product.imag());
  EXPECT_GT(cross(Vec2{1, 0}, Vec2{0, 1}), 0);  // to the left
  EXPECT_EQ(number(rotate(a, b)), number(a) * number(b));
  EXPECT_EQ(number(rotate_inverse(a, b)), std::conj(number(a)) * number(b));
  EXPECT_EQ(number(conjugate(a)), std::conj(number(a)));
  EXPECT_EQ(number(perpendicular(a)), std::complex<double>(0, 1) * number(a));
  EXPECT_EQ(number(a + b - 2.0 * a), number(b) - number(a));
  EXPECT_EQ(number(-a), -number(a));
}
TEST(Vector2, AnglesAndUnitVectorsGoTogether) {
  EXPECT_EQ(norm(a), 5);
  EXPECT_EQ(angle_of({-1, 0}), pi);
  for (double t : {-3.0, -0.1, 0.0, 2.5}) EXPECT_NEAR(angle_of(unit(t)), t, 1e-15);
  EXPECT_EQ(number(vec({1, 2})), std::complex<double>(1, 2));
}
// One Newton step squares the error: 1 + e becomes 1 - 1.5 e^2.
TEST(Vector2, RenormalisedBringsToUnitLength) {
  EXPECT_NEAR(norm(renormalised(1.000001 * unit(0.3))), 1, 2e-12);
  EXPECT_NEAR(norm(renormalised((1 + 1e-10) * unit(0.3))), 1, 2.3e-16);
  EXPECT_NEAR(cross(renormalised(1.001 * unit(0.3)), unit(0.3)), 0, 1e-16);
}

}  // namespace
}  // namespace linkwright::math
