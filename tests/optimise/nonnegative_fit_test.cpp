// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/nonnegative_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/core/random.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using FitNumbers = std::vector<double>;

TEST(NonnegativeFit, IsTheOrdinaryFitWhereThatIsNotNegative) {
  const FitNumbers columns = {1, 0, 0, 1, 1, 0}, b = {3, 2, 0};
  FitNumbers x(2);
  EXPECT_NEAR(fit_nonnegative(columns, b, x), 0, 1e-14);
  EXPECT_NEAR(x[0], 1, 1e-14);
  EXPECT_NEAR(x[1], 2, 1e-14);
}

TEST(NonnegativeFit, LeavesOutWhatWouldBeNegative) {
  const FitNumbers columns = {1, 0, 0, 1}, b = {3, -2};
  FitNumbers x(2);
  EXPECT_NEAR(fit_nonnegative(columns, b, x), 2, 1e-14);
  EXPECT_NEAR(x[0], 3, 1e-14);
  EXPECT_EQ(x[1], 0);
}

// The conditions of the minimum: x >= 0, no descent along any column, none at all along those in use.
TEST(NonnegativeFit, MeetsItsConditionsOnRandomColumns) {
  const std::size_t m = 9, n = 14;
  for (std::uint32_t trial = 0; trial < 50; ++trial) {
    RandomStream random({.seed = 5, .individual = trial});
    FitNumbers columns(m * n), b(m), x(n);
    for (double& v : columns) v = random.normal();
    for (double& v : b) v = random.normal();
    const double norm = fit_nonnegative(columns, b, x);
    FitNumbers rest = b;
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < m; ++i) rest[i] -= columns[k * m + i] * x[k];
    double square = 0;
    for (const double r : rest) square += r * r;
    EXPECT_NEAR(norm, std::sqrt(square), 1e-12);
    for (std::size_t k = 0; k < n; ++k) {
      double slope = 0;
      for (std::size_t i = 0; i < m; ++i) slope += columns[k * m + i] * rest[i];
      EXPECT_GE(x[k], 0);
      // Rounding of a fit of columns of size 4, worst condition some thousands.
      EXPECT_LE(slope, 1e-9) << trial << " " << k;
      EXPECT_TRUE(x[k] == 0 || slope >= -1e-9) << trial << " " << k;
    }
  }
}

TEST(NonnegativeFit, TakesNothing) {
  FitNumbers x;
  const FitNumbers b = {3, 4};
  EXPECT_EQ(fit_nonnegative({}, b, x), 5);
  EXPECT_THAT(test::message([&] { fit_nonnegative(b, b, x); }),
              ::testing::HasSubstr("2 numbers for 0 columns"));
}

}  // namespace
}  // namespace linkwright::optimise
