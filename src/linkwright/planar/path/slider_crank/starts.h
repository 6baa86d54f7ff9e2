#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/planar/path/curve_overlay.h"
#include "linkwright/planar/path/slider_crank/problem.h"

namespace linkwright::planar {

/// A slider-crank to start a local search from.
struct SliderPathStart {
  SliderCrankMechanism mechanism;
  std::vector<double> angles;  ///< crank angle at each point, in order
  double mismatch = 0;         ///< sum of squared distances at the points that were compared (m2)
};

/// Starts for free timing: random slider-cranks whose curve is laid on the path by arc length and similarity.
/// Holds the path in the form that the comparison needs, and its memory: one per thread.
class SliderPathMatcher {
 public:
  SliderPathMatcher(const SliderPathProblem& problem, SliderSide side, double sense);

  /// Best of `mechanisms` random ones, each over all shifts (closed path) or a number of random arcs (open).
  /// Empty when none of them fits.
  std::optional<SliderPathStart> best_of(int mechanisms, RandomStream& stream);

 private:
  void sample_curve(double from, double to, double rho, double eta, std::complex<double> point);

  const SliderPathProblem& problem_;
  SliderSide side_;
  double sense_;
  CurveOverlay overlay_;
};

}  // namespace linkwright::planar
