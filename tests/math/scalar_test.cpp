// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/scalar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "linkwright/core/numbers.h"
#include "linkwright/math/dual.h"

namespace linkwright::math {
namespace {

using S = Scalar<double>;

TEST(Scalar, PositivePartCutsOffBelowZero) {
  EXPECT_EQ(S::positive_part(2.5), 2.5);
  EXPECT_EQ(S::positive_part(0.0), 0.0);
  EXPECT_EQ(S::positive_part(-2.5), 0.0);
  EXPECT_EQ(S::positive_part(infinity), infinity);
  EXPECT_EQ(S::positive_part(-infinity), 0.0);
  EXPECT_EQ(S::positive_part(std::numeric_limits<double>::denorm_min()),
            std::numeric_limits<double>::denorm_min());
  // No sign is left over that a division or an atan2 could pick up.
  EXPECT_FALSE(std::signbit(S::positive_part(-0.0)));
}

TEST(Scalar, MultiplyAdd) {
  EXPECT_EQ(S::multiply_add(3.0, 4.0, 5.0), 17.0);
  EXPECT_EQ(S::multiply_add(-0.5, 4.0, 2.0), 0.0);
  EXPECT_TRUE(std::isnan(S::multiply_add(nan, 0.0, 1.0)));
}

TEST(Scalar, MultiplyAddRoundsOnceWhereInstructionsDo) {
  // (1 + e)^2 - 1 with e = 2^-30: the fused result keeps e^2, two roundings lose it.
  const double a = 1 + 0x1p-30;
  EXPECT_NE(a * a - 1, std::fma(a, a, -1.0));
#if defined(__FMA__) || defined(__aarch64__)
  EXPECT_EQ(S::multiply_add(a, a, -1.0), std::fma(a, a, -1.0));
#else
  EXPECT_EQ(S::multiply_add(a, a, -1.0), a * a - 1);
#endif
}

TEST(Scalar, ChooseTakesOneSideOnly) {
  EXPECT_EQ(S::choose(true, 1.0, nan), 1.0);
  EXPECT_EQ(S::choose(false, nan, 2.0), 2.0);
}

TEST(Scalar, ExtremesSizesAndWholeParts) {
  EXPECT_EQ(S::min(-1.0, 2.0), -1.0);
  EXPECT_EQ(S::max(-1.0, 2.0), 2.0);
  EXPECT_EQ(S::abs(-1.5), 1.5);
  EXPECT_FALSE(std::signbit(S::abs(-0.0)));
  EXPECT_EQ(S::floor(-0.25), -1.0);
  EXPECT_EQ(S::floor(3.0), 3.0);
}

TEST(Scalar, DualNumbersCarryDerivativesThrough) {
  using D = Dual<2>;
  const D a = D::variable(3, 0), b = D::variable(-4, 1);
  const D sum = Scalar<D>::multiply_add(a, b, a);  // by (b + 1, a)
  EXPECT_EQ(sum.value, -9.0);
  EXPECT_EQ(sum.by[0], -3.0);
  EXPECT_EQ(sum.by[1], 3.0);
  EXPECT_EQ(Scalar<D>::positive_part(a).by[0], 1.0);
  const D none = Scalar<D>::positive_part(b);
  EXPECT_EQ(none.value, 0.0);
  EXPECT_EQ(none.by[1], 0.0);
}

}  // namespace
}  // namespace linkwright::math
