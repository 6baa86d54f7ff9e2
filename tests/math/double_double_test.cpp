// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/double_double.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>

#include "linkwright/core/random.h"

namespace linkwright::math {
namespace {

// 113 bits: seven more than a double-double
#if LDBL_MANT_DIG >= 113
using Quad = long double;
#else
__extension__ typedef __float128 Quad;
#endif

Quad quad(const DoubleDouble& a) { return static_cast<Quad>(a.high) + static_cast<Quad>(a.low); }

// |found - expected| / |expected|
double relative(const DoubleDouble& found, Quad expected) {
  const Quad off = (quad(found) - expected) / expected;
  return static_cast<double>(off < 0 ? -off : off);
}

TEST(DoubleDouble, OperationsAreAsAccurateAsTheyAreSaidToBe) {
  RandomStream random({.seed = 2});
  const auto draw = [&] {
    const double high = random.normal() * std::exp2(random.uniform(-20, 20));
    return DoubleDouble::sum(high, high * 0x1p-54 * random.uniform(-1, 1));
  };
  for (int i = 0; i < 20'000; ++i) {
    const DoubleDouble a = draw(), b = draw();
    EXPECT_LE(relative(a + b, quad(a) + quad(b)), 0x1p-104);
    EXPECT_LE(relative(a - b, quad(a) - quad(b)), 0x1p-104);
    EXPECT_LE(relative(a * b, quad(a) * quad(b)), 0x1p-101);
    EXPECT_LE(relative(a / b, quad(a) / quad(b)), 0x1p-101);
    EXPECT_EQ(a < b, quad(a) < quad(b));
    EXPECT_EQ(a > b, quad(a) > quad(b));
  }
}

TEST(DoubleDouble, TheSumOfTwoDoublesIsExact) {
  const DoubleDouble s = DoubleDouble::sum(1, 0x1p-80);
  EXPECT_EQ(s.high, 1);
  EXPECT_EQ(s.low, 0x1p-80);
  EXPECT_EQ(static_cast<double>(s - DoubleDouble(1.0)), 0x1p-80);
}

TEST(DoubleDouble, KeepsDigitsThatADoubleLoses) {
  const DoubleDouble third = DoubleDouble(1.0) / DoubleDouble(3.0);
  EXPECT_LT(std::abs(static_cast<double>(third * DoubleDouble(3.0) - DoubleDouble(1.0))), 0x1p-101);
}

}  // namespace
}  // namespace linkwright::math
