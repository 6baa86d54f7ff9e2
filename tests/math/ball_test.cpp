// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/ball.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/random.h"

namespace linkwright::math {
namespace {

using Exact = Complex<DoubleDouble>;

Complex<double> random_number(RandomStream& random, double size) {
  return {size * random.normal(), size * random.normal()};
}

double distance(const Exact& a, const Exact& b) {
  const Exact off = a - b;
  return std::hypot(static_cast<double>(off.re), static_cast<double>(off.im));
}

// Sums and products of numbers from two balls, calculated with twice the digits, are in the sum and product
// of the balls.
TEST(Ball, HoldsWhatBecomesOfItsNumbers) {
  RandomStream random({.seed = 3});
  for (int i = 0; i < 20'000; ++i) {
    const double size = std::exp(random.uniform(-9, 9));
    const Ball<double> a(random_number(random, size), size * std::exp(random.uniform(-40, 1))),
        b(random_number(random, 1), std::exp(random.uniform(-40, 1)));
    const auto on_edge = [&](const Ball<double>& ball) {
      const double angle = random.uniform(0, 6.3);
      return Exact(ball.middle) + Exact(DoubleDouble(ball.radius * std::cos(angle) * (1 - 1e-15)),
                                        DoubleDouble(ball.radius * std::sin(angle) * (1 - 1e-15)));
    };
    const Exact x = on_edge(a), y = on_edge(b);
    const auto expect = [](const Ball<double>& ball, const Exact& z) {
      EXPECT_LE(distance(Exact(ball.middle), z), ball.radius);
    };
    expect(a + b, x + y);
    expect(a - b, x - y);
    expect(a * b, x * y);
    expect(-a, -x);
    EXPECT_LE(distance(x, Exact()), a.size());
  }
}

TEST(Ball, IsHardlyWiderThanRounding) {
  const Ball<double> a(Complex<double>(1.0 / 3, 0.1)), square = a * a;
  EXPECT_GT(square.radius, 0);
  EXPECT_LT(square.radius, 1e-15);
  const Ball<DoubleDouble> fine(Exact(DoubleDouble(1.0) / DoubleDouble(3.0), DoubleDouble(0.1)));
  EXPECT_LT((fine * fine).radius, 1e-29);
}

}  // namespace
}  // namespace linkwright::math
