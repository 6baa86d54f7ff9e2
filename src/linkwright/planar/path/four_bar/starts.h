#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/planar/path/curve_overlay.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/path/four_bar/projection.h"

namespace linkwright::planar {

/// A linkage to start a local search from.
struct PathStart {
  FourBar linkage;
  std::vector<double> angles;  ///< crank angle at each point, in order
  double mismatch = 0;         ///< sum of squared distances at the points that were compared (m2)
};

/// Random q = logarithms (and start angle) of PathProjection for a kind: slacks uniform in the logarithm over
/// [-3, 3], ratios (kind any) over [-1.5, 1.5]; a double-crank has a ground link of positive length.
std::vector<double> random_ratios(RatioKind kind, std::size_t variables, RandomStream& stream);

/// Starts for free timing: random linkages whose coupler curve is laid on the path by arc length and
/// similarity. Holds the path in the form that the comparison needs.
class PathMatcher {
 public:
  PathMatcher(const PathProblem& problem, Branch branch, double sense);

  /// Best of `linkages` random linkages of a kind, each over all shifts (closed path) or a number of random
  /// arcs (open). Empty when none of them assembles.
  std::optional<PathStart> best_of(int linkages, RatioKind kind, RandomStream& stream);

 private:
  void sample_curve(double from, double to, double l1, double l3, double l4, std::complex<double> point);

  const PathProblem& problem_;
  Branch branch_;
  double sense_;
  CurveOverlay overlay_;
};

}  // namespace linkwright::planar
