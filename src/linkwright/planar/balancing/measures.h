// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "linkwright/core/field.h"

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

/// The measures by name.
enum class Measure { rss_over_n, rms, mean_abs, max_abs, maximum, minimum, range };
constexpr std::array<EnumName<Measure>, 7> names(Measure) {
  return {{{Measure::rss_over_n, "rss_over_n", "root of the sum of squares over the number of intervals"},
           {Measure::rms, "rms", "root mean square"},
           {Measure::mean_abs, "mean_abs", "mean of the absolute values"},
           {Measure::max_abs, "max_abs", "largest absolute value"},
           {Measure::maximum, "maximum", "largest value"},
           {Measure::minimum, "minimum", "smallest value"},
           {Measure::range, "range", "from the smallest to the largest value"}}};
}
double measure(Measure measure, std::span<const double> samples);
/// ... of a period: when it `closes`, the last sample is the first one again, and means count one of the two.
/// rss_over_n keeps both, as it is defined.
double measure(Measure measure, std::span<const double> samples, bool closes);
/// Number of the n samples of a period that count, the first ones.
constexpr std::size_t counted(Measure measure, std::size_t n, bool closes) {
  return closes && n > 1 && (measure == Measure::rms || measure == Measure::mean_abs) ? n - 1 : n;
}

/// The properties of a measure that searches may build on.
struct MeasureProperties {
  /// True for a norm of the samples: it is convex, the same for x and -x, and zero only where all are.
  bool norm = false;
  bool quadratic = false;  ///< root of a sum of squares: smooth but at zero
};
constexpr MeasureProperties properties(Measure measure) {
  switch (measure) {
    case Measure::rss_over_n:
    case Measure::rms:
      return {.norm = true, .quadratic = true};
    case Measure::mean_abs:
    case Measure::max_abs:
      return {.norm = true};
    case Measure::maximum:
    case Measure::minimum:
    case Measure::range:
      break;
  }
  return {};
}

}  // namespace linkwright::planar
