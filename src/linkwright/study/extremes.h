// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "linkwright/core/numbers.h"

// The largest of what a study reports, and where it is.
namespace linkwright::study {

/// The extreme value of some rows and the row that has it, the first of those that
/// are equal but for rounding. Rows without a finite
/// value are passed over. Values are offered by one of `greatest`, `least` and `largest`, which say whether
/// it is the extreme one so far.
struct Extreme {
  /// Values that differ by less than this share of their size are one but for rounding.
  static constexpr double tie = 1e-12;

  double value = nan;  ///< NaN = there is none
  std::size_t row = 0;

  bool any() const { return !std::isnan(value); }
  bool greatest(double v, std::size_t of) { return std::isfinite(v) && !(v <= value) && take(v, of); }
  bool least(double v, std::size_t of) { return std::isfinite(v) && !(v >= value) && take(v, of); }
  /// Takes the value of the greatest size.
  bool largest(double v, std::size_t of) {
    if (!std::isfinite(v) || std::abs(v) <= std::abs(value)) return false;
    // One of the other sign that ties leaves the first with its sign.
    return std::abs(std::abs(v) - std::abs(at_row_)) <= tie * std::abs(v) && v * at_row_ < 0 ? false
                                                                                             : take(v, of);
  }

 private:
  /// The first of several values that tie by rounding keeps its row.
  bool take(double v, std::size_t of) {
    value = v;
    if (std::abs(v - at_row_) <= tie * std::abs(v)) return false;
    row = of, at_row_ = v;
    return true;
  }

  double at_row_ = nan;  ///< the value in the row
};

/// The value of greatest size.
inline Extreme largest(std::span<const double> values) {
  Extreme out;
  for (std::size_t i = 0; i < values.size(); ++i) out.largest(values[i], i);
  return out;
}

/// The greatest size of the values, 0 without any.
inline double largest_size(std::span<const double> values) {
  const Extreme most = largest(values);
  return most.any() ? std::abs(most.value) : 0;
}

}  // namespace linkwright::study
