// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace linkwright::planar {

/// One input over the samples: values (rad or m), and rates and accelerations: as many, or one for all
/// samples, or none for zero.
struct SweepInput {
  std::span<const double> value, rate, acceleration;
};

}  // namespace linkwright::planar
