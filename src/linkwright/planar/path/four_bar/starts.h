// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/planar/path/curve_overlay.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/path/four_bar/projection.h"

namespace linkwright::planar {

using PathStart = PathStartOf<FourBar>;

/// Starts for free timing: random linkages whose coupler curve is laid on the path by arc length and
/// similarity. Holds the path in the form that the comparison needs.
class PathMatcher {
 public:
  PathMatcher(const PathProblem& problem, Branch branch, double sense);

  /// Best of `linkages` random linkages of a kind, each over all shifts (closed path) or a number of random
  /// arcs (open). Empty when none of them assembles.
  std::optional<PathStart> best_of(int linkages, RatioKind kind, RandomStream& stream);

 private:
  Branch branch_;
  double sense_;
  CurveOverlay overlay_;
};

}  // namespace linkwright::planar
