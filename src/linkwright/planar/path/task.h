// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/optimise/problem.h"
#include "linkwright/planar/path/targets.h"

namespace linkwright::planar {

/// The relation of the crank angle to the target points.
enum class Timing {
  free,         ///< each point is met at any crank angle, in the order of the points
  equal_steps,  ///< crank angle of point i = start angle + i step
  increments,   ///< crank angle of a point = that of the one before + its increment, from the start angle
  given,        ///< crank angle of each point is given
};
constexpr std::array<EnumName<Timing>, 4> names(Timing) {
  return {{{Timing::free, "free", "each point is met at any crank angle, in order"},
           {Timing::equal_steps, "equal_steps", "crank angle of point i = start angle + i step"},
           {Timing::increments, "increments",
            "crank angle of a point = that of the one before + its increment, from the start angle"},
           {Timing::given, "given", "the crank angle of each point is given"}}};
}
/// True if the crank angles are known but for the start angle, which is then a design variable.
constexpr bool starts_anywhere(Timing t) { return t == Timing::equal_steps || t == Timing::increments; }

/// A path for any mechanism to trace: targets, timing and the motion of the crank.
struct PathTask : PathTargets {
  Timing timing = Timing::free;
  double min_step = 1e-4;  ///< crank rotation that free timing keeps between two points (rad, > 0)
  double step = 0;         ///< rad, equal_steps
  /// rad, one a point; increments: from the first point; given: from the reference of the mechanism's crank
  /// angle
  std::vector<double> angles;

  bool search_positive = true,
       search_negative = false;  ///< senses of crank rotation: +1 = the signs of step and angles as given
  bool crank_rotates_fully = true;

  bool free_timing() const { return timing == Timing::free; }
  bool searches(double sense) const { return sense > 0 ? search_positive : search_negative; }
};

/// Throws ContractError unless the targets are valid, with as many finite angles as the timing needs.
void require_valid_task(const PathTask& task);

/// Crank angle (rad) of point k before the start angle is added and for sense +1: 0 when timing is free.
double point_angle(const PathTask& task, std::size_t k);

/// Ranges that follow from a path when a study gives none: links from 1/1000 to 50 times its size (the
/// diagonal of its bounding box), places up to 50 times its size away, pivots so far from its middle, angles
/// over a full turn.
struct PathRanges {
  Range link, place, pivot_x, pivot_y, turn;
};
PathRanges derive_ranges(const std::vector<double>& x, const std::vector<double>& y);

/// Crank angles (rad) that a mechanism reaches without being taken apart, unwrapped.
struct CrankInterval {
  double from = 0, to = 0;
};

/// A mechanism with what it achieves on a path.
template <class Mechanism>
struct TracedPath {
  Mechanism linkage;
  double sense = 1;  ///< +1 or -1: sense of crank rotation along the order of the points
  std::vector<double>
      angles;        ///< crank angle at each target point (rad), unwrapped in the order of the points
  double error = 0;  ///< sum of squared distances (m2), Boskovic 2018, Eqs. (4.4), (4.13), from gates
                     ///< where targets are gates, and beyond the tolerances; infinite when the tracing
                     ///< point does not exist at a target
  /// Constraints of the problem that are not met; empty = feasible.
  std::vector<optimise::Violation> violations;
  std::vector<std::string> active_bounds;  ///< names of parameters at a bound
};

/// Sum of its violations; 0 = feasible.
template <class Mechanism>
double total_violation(const TracedPath<Mechanism>& design) {
  double sum = 0;
  for (const auto& violation : design.violations) sum += violation.amount;
  return sum;
}

/// By the feasibility rules.
template <class Mechanism>
bool better_design(const TracedPath<Mechanism>& a, const TracedPath<Mechanism>& b) {
  return optimise::better(a.error, total_violation(a), b.error, total_violation(b));
}

}  // namespace linkwright::planar
