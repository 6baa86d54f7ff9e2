// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/spectrum.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/FFT>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::math {
namespace {

// The largest number up to n without prime factors above 5.
std::size_t smooth_below(std::size_t n) {
  for (;; --n) {
    std::size_t rest = n;
    for (const std::size_t p : {2, 3, 5})
      while (rest % p == 0) rest /= p;
    if (rest == 1) return n;
  }
}

}  // namespace

Spectrum spectrum(std::span<const double> values, double step) {
  LINKWRIGHT_REQUIRE(step > 0 && std::isfinite(step), "values {} s apart", step);
  Spectrum out;
  if (values.size() < 8) return out;
  const std::size_t n = smooth_below(values.size());
  const auto count = static_cast<double>(n);
  double mean = 0;
  std::vector<double> windowed(n);
  for (std::size_t i = 0; i < n; ++i) mean += values[i] / count;
  if (!std::isfinite(mean)) return out;
  for (std::size_t i = 0; i < n; ++i)
    windowed[i] = (values[i] - mean) * (1 - std::cos(2 * pi * static_cast<double>(i) / count));
  const std::vector<std::complex<double>> lines = fourier_transform(windowed);
  for (std::size_t k = 1; 2 * k < n; ++k) {
    out.frequency.push_back(static_cast<double>(k) / (count * step));
    out.amplitude.push_back(2 * std::abs(lines[k]) / count);
  }
  return out;
}

std::vector<std::complex<double>> fourier_transform(std::span<const double> values) {
  LINKWRIGHT_REQUIRE(values.size() >= 2, "{} values, at least 2 are needed", values.size());
  Eigen::FFT<double> transform;
  std::vector<std::complex<double>> out(values.size());
  transform.fwd(out.data(), values.data(), static_cast<Eigen::Index>(values.size()));
  return out;
}

}  // namespace linkwright::math
