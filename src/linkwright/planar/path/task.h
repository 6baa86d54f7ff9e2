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

/// Test for kinds of timing that have a start angle as design variable.
///
/// @param t the timing
/// @returns true if the crank angles are known but for the start angle
constexpr bool starts_anywhere(Timing t) { return t == Timing::equal_steps || t == Timing::increments; }

/// A path for any mechanism to trace: targets, timing and the motion of the crank.
struct PathTask : PathTargets {
  Timing timing = Timing::free;  ///< relation of the crank angle to the points
  double min_step = 1e-4;        ///< crank rotation that free timing keeps between two points (rad, > 0)
  double step = 0;               ///< rad, equal_steps
  /// Angles (rad), one a point; increments: from the first point; given: from the reference of the
  /// mechanism's crank angle.
  std::vector<double> angles;

  /// Searches the sense +1: the signs of step and angles as given.
  bool search_positive = true,
       search_negative = false;     ///< searches the sense -1
  bool crank_rotates_fully = true;  ///< constraint: the crank rotates fully

  /// @returns true if each point is met at any crank angle
  bool free_timing() const { return timing == Timing::free; }
  /// Test for senses that are searched.
  ///
  /// @param sense sense of crank rotation, +1 or -1
  /// @returns true if the sense is searched
  bool searches(double sense) const { return sense > 0 ? search_positive : search_negative; }
};

/// Checks the task of a mechanism.
///
/// @param task the task
/// @throws ContractError unless the targets are valid, with as many finite angles as the timing needs
void require_valid_task(const PathTask& task);

/// The crank angle of a point before the start angle is added and for sense +1: 0 when timing is free.
///
/// @param task the task
/// @param k index of the point
/// @returns the angle (rad)
double point_angle(const PathTask& task, std::size_t k);

/// Ranges that follow from a path when a study gives none: links from 1/1000 to 50 times its size (the
/// diagonal of its bounding box), places up to 50 times its size away, pivots so far from its middle, angles
/// over a full turn.
struct PathRanges {
  Range link,   ///< lengths of links, m
      place,    ///< places on the coupler, m
      pivot_x,  ///< x of a pivot, m
      pivot_y,  ///< y of a pivot, m
      turn;     ///< angles, rad
};

/// The ranges that follow from the points of a path.
///
/// @param x x of the target points (m)
/// @param y y of the target points (m)
/// @returns the ranges
PathRanges derive_ranges(const std::vector<double>& x, const std::vector<double>& y);

/// Crank angles (rad) that a mechanism reaches without being taken apart, unwrapped.
struct CrankInterval {
  double from = 0,  ///< rad
      to = 0;       ///< rad, not less than `from`
};

/// A mechanism with what it achieves on a path.
template <class Mechanism>
struct TracedPath {
  Mechanism linkage;  ///< the mechanism
  double sense = 1;   ///< +1 or -1: sense of crank rotation along the order of the points
  /// Crank angle at each target point (rad), unwrapped in the order of the points.
  std::vector<double> angles;
  /// Sum of squared distances (m2), Boskovic 2018, Eqs. (4.4), (4.13), from gates where targets are gates,
  /// and beyond the tolerances; infinite when the tracing point does not exist at a target.
  double error = 0;
  /// Constraints of the problem that are not met; empty = feasible.
  std::vector<optimise::Violation> violations;
  std::vector<std::string> active_bounds;  ///< names of parameters at a bound
};

/// The sum of the violations of a design.
///
/// @param design the design
/// @returns the sum; 0 = feasible
template <class Mechanism>
double total_violation(const TracedPath<Mechanism>& design) {
  double sum = 0;
  for (const auto& violation : design.violations) sum += violation.amount;
  return sum;
}

/// Compares designs by the feasibility rules.
///
/// @param a a design
/// @param b another
/// @returns true if `a` is better
template <class Mechanism>
bool better_design(const TracedPath<Mechanism>& a, const TracedPath<Mechanism>& b) {
  return optimise::better(a.error, total_violation(a), b.error, total_violation(b));
}

}  // namespace linkwright::planar
