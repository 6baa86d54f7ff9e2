// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/band_solve.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/message.h"

namespace linkwright::math {
namespace {

using ::testing::HasSubstr;

struct Band {
  std::size_t n, width;
  std::vector<double> entries;
  Band(std::size_t rows, std::size_t w) : n(rows), width(w), entries(rows * band_stride(w)) {}
  double& at(std::size_t i, std::size_t j) { return entries[i * band_stride(width) + j + width - i]; }
  bool holds(std::size_t i, std::size_t j) const { return j + width >= i && j <= i + width; }
  std::vector<double> times(const std::vector<double>& x) {
    std::vector<double> out(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (holds(i, j)) out[i] += at(i, j) * x[j];
    return out;
  }
};

// Zeros on the diagonal, so that rows must be exchanged.
Band saddle(std::size_t n, std::size_t width) {
  Band a(n, width);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (a.holds(i, j))
        a.at(i, j) = i == j && i % 3 == 1
                         ? 0
                         : std::sin(static_cast<double>(1 + 7 * i * i + 2 * i * j + 3 * j * j * j));
  return a;
}

TEST(SolveBand, FindsWhatWasMultiplied) {
  for (const std::size_t n : {1u, 2u, 5u, 40u})
    for (const std::size_t width : {1u, 2u, 4u, 7u}) {
      Band a = n == 1 ? Band(1, width) : saddle(n, width);
      if (n == 1) a.at(0, 0) = 3;
      std::vector<double> x;
      for (std::size_t i = 0; i < n; ++i) x.push_back(std::cos(static_cast<double>(i)));
      std::vector<double> right = a.times(x);
      ASSERT_TRUE(solve_band(a.entries, width, right)) << n << ' ' << width;
      // Conditions of these matrices are below 1e5.
      for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(right[i], x[i], 1e-10) << n << ' ' << width;
    }
}

TEST(SolveBand, TellsSingularMatrices) {
  Band a(4, 1);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      if (a.holds(i, j)) a.at(i, j) = i < 2 && j < 2 ? 1 : i == j;  // the first two rows are the same
  std::vector<double> right{1, 2, 3, 4};
  EXPECT_FALSE(solve_band(a.entries, 1, right, 1e-14));
  std::vector<double> few(3);
  EXPECT_THAT(linkwright::test::message([&] { solve_band(few, 1, right); }),
              HasSubstr("4 rows of 4 places, got 3 entries"));
}

}  // namespace
}  // namespace linkwright::math
