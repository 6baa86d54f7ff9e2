#pragma once

#include <span>

// One number for a quantity that was sampled over a motion. All throw ContractError when there are too few
// samples; a NaN among the samples makes the measure NaN.
namespace linkwright::planar {

/// Root of the sum of squares, divided by the number of intervals, which is one less than that of the
/// samples: (1/n) sqrt(sum over i = 0 ... n of x_i^2), Boskovic 2018, Eqs. (2.37), (2.80) taken literally. It
/// depends on the mesh: it falls like 1/sqrt(n). At least 2 samples.
double rss_over_n(std::span<const double> samples);

/// Root of the mean of the squares. Of a periodic quantity give each sample once. At least 1 sample.
double rms(std::span<const double> samples);

/// Mean of the absolute values. At least 1 sample.
double mean_abs(std::span<const double> samples);

/// Largest absolute value. At least 1 sample.
double max_abs(std::span<const double> samples);

}  // namespace linkwright::planar
