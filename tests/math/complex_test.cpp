// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/complex.h"

#include <gtest/gtest.h>

#include <complex>

#include "linkwright/core/random.h"
#include "linkwright/math/double_double.h"

namespace linkwright::math {
namespace {

TEST(Complex, CalculatesAsTheStandardTypeDoes) {
  RandomStream random({.seed = 1});
  for (int i = 0; i < 200; ++i) {
    const std::complex<double> a(random.normal(), random.normal()), b(random.normal(), random.normal());
    const Complex<double> x(a.real(), a.imag()), y(b.real(), b.imag());
    const auto expect = [](const Complex<double>& z, const std::complex<double>& expected) {
      EXPECT_NEAR(z.re, expected.real(), 4e-16 * (1 + std::abs(expected)) * 4);
      EXPECT_NEAR(z.im, expected.imag(), 4e-16 * (1 + std::abs(expected)) * 4);
    };
    expect(x + y, a + b);
    expect(x - y, a - b);
    expect(-x, -a);
    expect(x * y, a * b);
    expect(2.5 * x, 2.5 * a);
    expect(conj(x), std::conj(a));
    expect(inverse(x), 1.0 / a);
    EXPECT_NEAR(norm(x), std::norm(a), 1e-15 * std::norm(a));
  }
}

TEST(Complex, TakesANarrowerScalar) {
  const Complex<DoubleDouble> wide{Complex<double>(0.1, -3)};
  EXPECT_EQ(wide.re.high, 0.1);
  EXPECT_EQ(wide.re.low, 0);
  EXPECT_EQ(wide.im.high, -3);
}

TEST(Complex, ZeroHasNoInverse) { EXPECT_FALSE(std::isfinite(inverse(Complex<double>(0, 0)).re)); }

}  // namespace
}  // namespace linkwright::math
