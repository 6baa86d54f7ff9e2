// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/band_solve.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::math {

bool solve_band(std::span<double> entries, std::size_t width, std::span<double> x, double smallest) {
  const std::size_t n = x.size(), stride = band_stride(width);
  LINKWRIGHT_REQUIRE(entries.size() == n * stride, "{} rows of {} places, got {} entries", n, stride,
                     entries.size());
  const auto row = [&](std::size_t i, std::size_t from) { return &entries[i * stride + from + width - i]; };
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t last = std::min(n, k + width + 1), end = std::min(n, k + 2 * width + 1),
                      count = end - k;
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < last; ++i)
      if (std::abs(*row(i, k)) > std::abs(*row(pivot, k))) pivot = i;
    double* top = row(k, k);
    if (pivot != k) {
      std::swap_ranges(top, top + count, row(pivot, k));
      std::swap(x[k], x[pivot]);
    }
    if (!(std::abs(*top) > smallest)) return false;
    const double inverse = 1 / *top;
    for (std::size_t i = k + 1; i < last; ++i) {
      double* under = row(i, k);
      if (*under == 0) continue;
      const double factor = *under * inverse;
      for (std::size_t j = 1; j < count; ++j) under[j] -= factor * top[j];
      x[i] -= factor * x[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    const double* top = row(k, k);
    const std::size_t count = std::min(n, k + 2 * width + 1) - k;
    for (std::size_t j = 1; j < count; ++j) x[k] -= top[j] * x[k + j];
    x[k] /= *top;
  }
  return true;
}

}  // namespace linkwright::math
