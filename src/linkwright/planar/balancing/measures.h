// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "linkwright/core/field.h"

/// @file
/// One number for a quantity that was sampled over a motion. A NaN among the samples makes the measure NaN.
namespace linkwright::planar {

/// Root of the sum of squares, divided by the number of intervals, which is one less than that of the
/// samples: (1/n) sqrt(sum over i = 0 ... n of x_i^2), Boskovic 2018, Eqs. (2.37), (2.80) taken literally. It
/// depends on the mesh: it falls like 1/sqrt(n).
///
/// @param samples the quantity, at least 2 samples
/// @returns the measure, in the unit of the samples; NaN if a sample is NaN
/// @throws ContractError if there are too few samples
double rss_over_n(std::span<const double> samples);

/// Root of the mean of the squares. A periodic quantity must hold each sample once.
///
/// @param samples the quantity, at least 1 sample
/// @returns the measure, in the unit of the samples; NaN if a sample is NaN
/// @throws ContractError if there is no sample
double rms(std::span<const double> samples);

/// Mean of the absolute values.
///
/// @param samples the quantity, at least 1 sample
/// @returns the measure, in the unit of the samples; NaN if a sample is NaN
/// @throws ContractError if there is no sample
double mean_abs(std::span<const double> samples);

/// Largest absolute value.
///
/// @param samples the quantity, at least 1 sample
/// @returns the measure, in the unit of the samples; NaN if a sample is NaN
/// @throws ContractError if there is no sample
double max_abs(std::span<const double> samples);

/// The measures by name.
enum class Measure {
  rss_over_n,  ///< root of the sum of squares over the number of intervals
  rms,         ///< root mean square
  mean_abs,    ///< mean of the absolute values
  max_abs,     ///< largest absolute value
  maximum,     ///< largest value
  minimum,     ///< smallest value
  range        ///< from the smallest to the largest value
};
constexpr std::array<EnumName<Measure>, 7> names(Measure) {
  return {{{Measure::rss_over_n, "rss_over_n", "root of the sum of squares over the number of intervals"},
           {Measure::rms, "rms", "root mean square"},
           {Measure::mean_abs, "mean_abs", "mean of the absolute values"},
           {Measure::max_abs, "max_abs", "largest absolute value"},
           {Measure::maximum, "maximum", "largest value"},
           {Measure::minimum, "minimum", "smallest value"},
           {Measure::range, "range", "from the smallest to the largest value"}}};
}

/// A measure of a sampled quantity.
///
/// @param measure the measure
/// @param samples the quantity
/// @returns its value, in the unit of the samples
/// @throws ContractError if there are too few samples
double measure(Measure measure, std::span<const double> samples);

/// A measure of a quantity over a period. When the samples close, the last one is the first one again, and
/// means count one of the two. rss_over_n keeps both, as it is defined.
///
/// @param measure the measure
/// @param samples the quantity
/// @param closes true if the last sample is the first one again
/// @returns its value, in the unit of the samples
/// @throws ContractError if there are too few samples
double measure(Measure measure, std::span<const double> samples, bool closes);

/// Number of the samples of a period that count, from the first one on.
///
/// @param measure the measure
/// @param n number of samples
/// @param closes true if the last sample is the first one again
/// @returns n or n - 1
constexpr std::size_t counted(Measure measure, std::size_t n, bool closes) {
  return closes && n > 1 && (measure == Measure::rms || measure == Measure::mean_abs) ? n - 1 : n;
}

/// The properties of a measure that searches may build on.
struct MeasureProperties {
  /// True for a norm of the samples: it is convex, the same for x and -x, and zero only where all are.
  bool norm = false;
  bool quadratic = false;  ///< root of a sum of squares: smooth but at zero
};

/// The properties of a measure.
///
/// @param measure the measure
/// @returns its properties
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
