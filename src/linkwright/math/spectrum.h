// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace linkwright::math {

/// Amplitudes of the vibrations in evenly spaced values.
struct Spectrum {
  std::vector<double> frequency;  ///< Hz, from one over the interval up to half the rate of the values
  std::vector<double> amplitude;  ///< in the unit of the values
};

/// Spectrum of values that are `step` seconds apart, without their mean, under Hann's window: a sine of
/// amplitude A reads A at its frequency, or up to 15 % less between two of them, and 4 of them wide. Values
/// at the end that would make the number have prime factors above 5 are left out. Empty for fewer than 8
/// values, or when one is not finite. Throws ContractError unless step > 0.
Spectrum spectrum(std::span<const double> values, double step);

/// Discrete Fourier transform, sum of values[j] exp(-2 pi i j k / n) for k = 0 ... n - 1, of at least 2
/// values.
std::vector<std::complex<double>> fourier_transform(std::span<const double> values);

}  // namespace linkwright::math
