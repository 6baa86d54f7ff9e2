#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/planar/path/problem.h"
#include "linkwright/planar/path/projection.h"

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
  double compare(double first, double length, std::complex<double>& a, std::complex<double>& p) const;

  const PathProblem& problem_;
  Branch branch_;
  double sense_;
  std::vector<double> fraction_;       // of the path's length, one a target point
  std::vector<std::size_t> compared_;  // points that take part in the comparison
  std::vector<std::complex<double>> centred_;
  std::complex<double> mean_;
  double spread_ = 0;
  std::vector<std::complex<double>> curve_;  // equally spaced along its length
  std::vector<double> angle_;
  std::vector<std::complex<double>> raw_;
  std::vector<double> raw_angle_, raw_length_;
};

}  // namespace linkwright::planar
