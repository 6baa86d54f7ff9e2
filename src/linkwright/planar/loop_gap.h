// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "linkwright/core/tolerance.h"

namespace linkwright::planar {

/// The distance by which a loop fails to close, in metres: 0 = it closes, up to the rounding that may push a
/// toggle just outside; positive = coupler and rocker are together too short, or differ too much, for A and
/// B0 at `distance`. Never clamped: beyond rounding the gap is real.
inline double loop_gap(double distance, double coupler, double rocker) {
  const double reach = coupler + rocker, fold = std::abs(coupler - rocker);
  const double rounding = tolerance::closure * (distance + reach);
  if (distance <= reach + rounding && distance >= fold - rounding) return 0;
  return distance > reach ? distance - reach : fold - distance;
}

}  // namespace linkwright::planar
