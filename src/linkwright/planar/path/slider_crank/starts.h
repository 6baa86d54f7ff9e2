// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/planar/path/curve_overlay.h"
#include "linkwright/planar/path/slider_crank/problem.h"

namespace linkwright::planar {

using SliderPathStart = PathStartOf<SliderCrankMechanism>;

/// Starts for free timing: random slider-cranks whose curve is laid on the path by arc length and similarity.
/// Holds the path in the form that the comparison needs, and its memory: one per thread.
class SliderPathMatcher {
 public:
  SliderPathMatcher(const SliderPathProblem& problem, SliderSide side, double sense);

  /// Best of `mechanisms` random ones, each over all shifts (closed path) or a number of random arcs (open).
  /// Empty when none of them fits.
  std::optional<SliderPathStart> best_of(int mechanisms, RandomStream& stream);

 private:
  const SliderPathProblem& problem_;
  SliderSide side_;
  double sense_;
  CurveOverlay overlay_;
};

}  // namespace linkwright::planar
