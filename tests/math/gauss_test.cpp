// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/gauss.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkwright::math {
namespace {

TEST(Gauss, IsExactForPolynomialsOfDegreeNine) {
  for (int degree = 0; degree <= 9; ++degree) {
    const auto power = [&](double x) { return std::pow(x, degree); };
    const double exact = (std::pow(2.5, degree + 1) - std::pow(-1.0, degree + 1)) / (degree + 1);
    EXPECT_NEAR(gauss_integral(power, -1, 2.5), exact, 1e-14 * (1 + std::abs(exact)));
  }
  EXPECT_GT(std::abs(gauss_integral([](double x) { return std::pow(x, 10); }, -1, 1) - 2.0 / 11), 1e-4);
  EXPECT_EQ(gauss_integral([](double x) { return x; }, 3, 3), 0);
}

}  // namespace
}  // namespace linkwright::math
