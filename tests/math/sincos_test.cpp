// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/sincos.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/simd.h"

namespace linkwright::math {
namespace {

// The bound that the header promises.
double bound(double x) { return 3e-16 * (1 + std::abs(x) / 1e3); }

void expect_near_exact(double x) {
  double sine = 0, cosine = 0;
  sincos(x, sine, cosine);
  // 64 bits of mantissa: the reference adds less than 1e-19.
  EXPECT_LE(std::abs(static_cast<double>(sine - std::sin(static_cast<long double>(x)))), bound(x)) << x;
  EXPECT_LE(std::abs(static_cast<double>(cosine - std::cos(static_cast<long double>(x)))), bound(x)) << x;
}

TEST(Sincos, KeepsItsBoundOverFiveDecades) {
  RandomStream random({.seed = 1});
  for (const double range : {1.0, 10.0, 1e2, 1e3, 1e5})
    for (int i = 0; i < 20000; ++i) expect_near_exact(random.uniform(-range, range));
}

TEST(Sincos, KeepsItsBoundWhereQuadrantsMeet) {
  // Multiples of pi / 4 up to the ends of the range; there the reduced angle is smallest or largest.
  for (int k = -2000; k <= 2000; ++k) {
    for (const int stride : {1, 63}) {
      const double x = k * stride * (pi / 4);
      if (std::abs(x) > 1e5) continue;
      expect_near_exact(x);
      expect_near_exact(std::nextafter(x, 1e9));
      expect_near_exact(std::nextafter(x, -1e9));
    }
  }
}

TEST(Sincos, IsExactAtZeroAndSmallAngles) {
  double sine = 1, cosine = 0;
  sincos(0.0, sine, cosine);
  EXPECT_EQ(sine, 0);
  EXPECT_EQ(cosine, 1);
  sincos(1e-12, sine, cosine);
  EXPECT_EQ(sine, 1e-12);
  EXPECT_EQ(cosine, 1);
}

TEST(Sincos, OfAnyAngleGoesOnBeyondTheRange) {
  for (const double x : {0.5, 1e5, -1e5, 1.2e5, -3e9, 1e300}) {
    double sine = 0, cosine = 0;
    sincos_of_any(x, sine, cosine);
    // At 1e5 the bound of sincos, beyond it the rounding of the library.
    EXPECT_NEAR(sine, std::sin(x), 4e-14) << x;
    EXPECT_NEAR(cosine, std::cos(x), 4e-14) << x;
  }
}

TEST(Sincos, BatchGivesTheBitsOfTheScalar) {
  using Batch = BaselineBatch;
  RandomStream random({.seed = 2});
  for (const double range : {1.0, 1e2, 1e5})
    for (int i = 0; i < 10000; ++i) {
      // Lanes in different quadrants.
      const double x[2] = {random.uniform(-range, range), random.uniform(-range, range)};
      Batch s, c;
      sincos(Batch::load_unaligned(x), s, c);
      double sines[2], cosines[2];
      s.store_unaligned(sines);
      c.store_unaligned(cosines);
      for (int lane = 0; lane < 2; ++lane) {
        double sine = 0, cosine = 0;
        sincos(x[lane], sine, cosine);
        EXPECT_EQ(std::bit_cast<std::uint64_t>(sine), std::bit_cast<std::uint64_t>(sines[lane])) << x[lane];
        EXPECT_EQ(std::bit_cast<std::uint64_t>(cosine), std::bit_cast<std::uint64_t>(cosines[lane]))
            << x[lane];
      }
    }
}

}  // namespace
}  // namespace linkwright::math
