// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

namespace linkwright::planar {

/// The error of a function generator at a place of the range, and the least sine of its angles of
/// transmission there.
struct PlaceError {
  double error = 0, sine = 1;
};

/// The errors of a function generator over the range.
struct RangeErrors {
  bool assembles = true;  ///< everywhere
  /// Errors where it assembles (rad or m); rms infinity if nowhere.
  double greatest_error = 0, rms_error = 0;
  double pair_angle = 0;  ///< rad, the least; 0 unless it assembles everywhere
};

/// From `samples` places with shares 0 to 1; `at` gives nothing where the generator does not assemble. Throws
/// ContractError for less than two samples.
RangeErrors range_errors(const std::function<std::optional<PlaceError>(double share)>& at, int samples);

}  // namespace linkwright::planar
