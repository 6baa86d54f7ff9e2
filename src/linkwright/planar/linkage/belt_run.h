// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace linkwright::planar {

/// The way of a belt over its wheels.
struct BeltRun {
  double length = 0;          ///< m; NaN where wheels overlap
  std::vector<double> wraps;  ///< rad, one a wheel: angle over which the belt touches it, 0 to 2 pi
  double turns = 0;  ///< sum of the wraps, minus on the right of the belt, in turns: 1 of a closed belt
};

/// The length of a belt and its angles of wrap.
///
/// @param centres centres of the wheels in the order in which the belt runs (m)
/// @param radii their radii (m), positive where the wheel lies to the left of the running belt, else negative
/// @param closed true if the belt runs back to the first wheel; the ends of a rope have no wrap
/// @returns length and wraps
BeltRun belt_run(std::span<const std::complex<double>> centres, std::span<const double> radii, bool closed);

}  // namespace linkwright::planar
