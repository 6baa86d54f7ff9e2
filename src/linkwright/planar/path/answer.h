// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/status.h"

namespace linkwright::planar {

/// Options of the recommended method.
struct PathSynthesisOptions {
  std::uint64_t seed = 1;  ///< of the random starts; the same seed gives the same answer
  int starts = 0;          ///< local searches per kind and sense; 0 = chosen from the timing
  int max_solutions = 4;   ///< distinct designs to return
  bool progress = true;    ///< report to the run context
};
template <class Visitor>
void fields(Visitor&& visit, PathSynthesisOptions& o) {
  visit(field::entry("starts", "local searches; 0 = chosen from the problem").between(0, 1e6), o.starts);
  visit(field::entry("max_solutions", "distinct designs to return").between(1, 100), o.max_solutions);
}

/// One step of a search's progress.
struct SearchPoint {
  std::int64_t evaluations = 0;  ///< so far
  double best = 0;               ///< least error of a feasible design so far (m2)
  /// True if both steps are the same. @returns the comparison of all members
  friend bool operator==(const SearchPoint&, const SearchPoint&) = default;
};

/// The outcome of a seed, but for its designs.
struct SearchRecord {
  Status status = Status::done;      ///< done, infeasible, deadline or cancelled
  std::int64_t evaluations = 0;      ///< evaluations of the objective in all searches
  std::vector<SearchPoint> history;  ///< one entry for each better feasible design; none of a front
};

/// The outcome of one seed.
template <class Mechanism>
struct PathAnswer : SearchRecord {
  /// Distinct, best first, feasible ones before infeasible ones; of a front by falling stroke.
  std::vector<typename Mechanism::Design> designs;
};

}  // namespace linkwright::planar
