#pragma once

#include <cstdint>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/path/four_bar/problem.h"

namespace linkwright::planar {

/// Options of the recommended method.
struct PathSynthesisOptions {
  std::uint64_t seed = 1;
  int starts = 0;         ///< local searches per kind and sense; 0 = chosen from the timing
  int max_solutions = 4;  ///< distinct designs to return
  bool progress = true;   ///< report to the run context
};
template <class Visitor>
void fields(Visitor&& visit, PathSynthesisOptions& o) {
  visit(Field{.key = "starts",
              .summary = "local searches; 0 = chosen from the problem",
              .minimum = 0,
              .maximum = 1e6},
        o.starts);
  visit(Field{.key = "max_solutions", .summary = "distinct designs to return", .minimum = 1, .maximum = 100},
        o.max_solutions);
}

/// One step of a search's progress.
struct SearchPoint {
  std::int64_t evaluations = 0;  ///< so far
  double best = 0;               ///< least error of a feasible design so far (m2)
  friend bool operator==(const SearchPoint&, const SearchPoint&) = default;
};

/// Answer of one seed.
struct PathSynthesis {
  Status status = Status::done;     ///< done, infeasible, deadline or cancelled
  std::vector<PathDesign> designs;  ///< distinct, best first; feasible ones before infeasible ones
  std::int64_t evaluations = 0;
  std::vector<SearchPoint> history;  ///< one entry for each better feasible design
};

/// The recommended method. Prescribed and relative timing: the linear unknowns (scale, rotation, position,
/// tracing point) are eliminated (variable projection), full crank rotation holds by construction, and
/// Levenberg-Marquardt with the exact Jacobian runs from many starts. Free timing: see
/// search_free_timing. Where a bound or limit is active, an augmented Lagrangian finishes. When the best
/// design has drawbacks (usability.h), the best one without them is looked for and stands beside it.
PathSynthesis synthesise_path(const PathProblem& problem, const PathSynthesisOptions& options,
                              RunContext& context);

}  // namespace linkwright::planar
