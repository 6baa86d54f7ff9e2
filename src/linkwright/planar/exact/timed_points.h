// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/planar/exact/given_pivots.h"

namespace linkwright::planar {

inline constexpr std::size_t min_timed_points = 3, max_timed_points = 5;

struct TimedPoints {
  std::vector<std::complex<double>> points;  ///< three to five (m)
  std::vector<double> turns;                 ///< rotation of the crank at each (rad), counted from anywhere
  /// Crank pivot and rocker pivot (m), each as good as two points: with three points alone.
  std::array<std::optional<std::complex<double>>, 2> pivots;
};

struct TimedPointSolutions {
  Status status = Status::done;  ///< deadline or cancelled: of what was looked at by then
  bool swept = false;            ///< infinitely many: a sample of them
  bool dependent = false;        ///< points and rotations depend on each other
  /// Cranks that hold the points at their rotations, complex ones included in the first.
  int cranks = 0, real_cranks = 0;
  int slides = 0;  ///< couplers on a slide instead of a rocker, not of a sweep
  std::vector<TracingFourBar> found;
  /// Number of the coupler curve of each, from 0: timed cognates, whose cranks turn alike, share one (not of
  /// a sweep).
  std::vector<int> curve;
};

/// All four-bars whose coupler point is at the points when the crank has turned as given: the crank holds the
/// frame that is at the point and turns with the crank, so that it is a dyad of these poses, and so is the
/// rocker of the coupler's poses that follow. Five points have up to twelve, in pairs of timed cognates; four
/// and three are swept.
///
/// Throws ContractError for another number of points or of rotations, numbers that are not finite, pivots
/// beside more than three points, or pivots that coincide.
TimedPointSolutions solve_timed_points(const TimedPoints& target, RunContext& context);

}  // namespace linkwright::planar
