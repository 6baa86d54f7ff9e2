// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace linkwright::planar {

/// One input over the samples of a sweep.
struct SweepInput {
  /// Values, one a sample (rad or m).
  std::span<const double> value,
      rate,          ///< rates (rad/s or m/s): one a sample, or one for all, or none for zero
      acceleration;  ///< accelerations, likewise
};

}  // namespace linkwright::planar
