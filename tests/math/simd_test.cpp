// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/simd.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"

namespace linkwright::math {
namespace {

// The instruction set that every x86-64 machine has; wider ones are met in the kernels' own tests.
using Batch = BaselineBatch;
using S = Scalar<double>;
using V = Scalar<Batch>;

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

std::vector<double> samples() {
  std::vector<double> out = {0.0,   -0.0,   1.0,    -1.0,    0.5,      -0.5,
                             1e300, -1e300, 1e-310, -1e-310, infinity, -infinity};
  RandomStream random({.seed = 3});
  for (int i = 0; i < 500; ++i) out.push_back(random.normal() * (i % 2 ? 1e3 : 1.0));
  return out;
}

// Applies both forms to every pair of neighbours; lanes hold different values, so that a mixed-up lane shows.
template <class InLanes, class InOne>
void expect_same_bits(const InLanes& in_lanes, const InOne& in_one) {
  const std::vector<double> x = samples();
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i) {
    double a[2] = {x[i], x[(i + 1) % n]}, b[2] = {x[(i + 7) % n], x[(i + 8) % n]},
           c[2] = {x[(i + 3) % n], x[(i + 4) % n]}, out[2];
    in_lanes(Batch::load_unaligned(a), Batch::load_unaligned(b), Batch::load_unaligned(c))
        .store_unaligned(out);
    for (int lane = 0; lane < 2; ++lane) {
      const double expected = in_one(a[lane], b[lane], c[lane]);
      if (expected != expected) {
        EXPECT_NE(out[lane], out[lane]);
      } else {
        EXPECT_EQ(bits(out[lane]), bits(expected)) << a[lane] << ", " << b[lane] << ", " << c[lane];
      }
    }
  }
}

TEST(Simd, EveryOperationGivesTheBitsOfTheScalar) {
  expect_same_bits([](auto a, auto b, auto c) { return V::multiply_add(a, b, c); },
                   [](double a, double b, double c) { return S::multiply_add(a, b, c); });
  expect_same_bits([](auto a, auto, auto) { return V::positive_part(a); },
                   [](double a, double, double) { return S::positive_part(a); });
  expect_same_bits([](auto a, auto b, auto) { return V::min(a, b); },
                   [](double a, double b, double) { return S::min(a, b); });
  expect_same_bits([](auto a, auto b, auto) { return V::max(a, b); },
                   [](double a, double b, double) { return S::max(a, b); });
  expect_same_bits([](auto a, auto, auto) { return V::abs(a); },
                   [](double a, double, double) { return S::abs(a); });
  expect_same_bits([](auto a, auto b, auto c) { return V::choose(a < b, b, c); },
                   [](double a, double b, double c) { return S::choose(a < b, b, c); });
}

// The sign of a zero is left out: SSE2 rounds by adding and subtracting 2^52.
TEST(Simd, FloorGivesTheValueOfTheScalar) {
  const std::vector<double> x = samples();
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    double out[2];
    V::floor(Batch::load_unaligned(&x[i])).store_unaligned(out);
    EXPECT_EQ(out[0], S::floor(x[i])) << x[i];
    EXPECT_EQ(out[1], S::floor(x[i + 1])) << x[i + 1];
  }
}

}  // namespace
}  // namespace linkwright::math
