// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/status.h"

namespace linkwright::planar {

/// The targets of a path, for any mechanism that traces it.
struct PathTargets {
  /// x of the target points (m), at least 3; a closed path does not repeat its first point at the end.
  std::vector<double> x,
      y;  ///< y of the target points (m), as many
  /// Targets that are gates: half of the distance from one gate post to the other along x (m), so that target
  /// k is met anywhere on the segment from (x - gate_x, y - gate_y) to (x + gate_x, y + gate_y). Empty =
  /// points.
  std::vector<double> gate_x,
      gate_y;                     ///< the same along y (m)
  std::vector<double> tolerance;  ///< a target is met as near as this (m, >= 0), at no cost; empty = exactly
  bool closed = true;             ///< the last target is followed by the first
};

/// Checks the targets of a path.
///
/// @param targets the targets
/// @throws ContractError unless there are at least 3 finite points that do not all coincide, and gates and
///   tolerances, where there are any, are as many as the points
void require_valid_targets(const PathTargets& targets);

/// Diagonal of the bounding box of the target points (m): the characteristic length of a path.
///
/// @param targets the targets
/// @returns the diagonal (m)
double path_size(const PathTargets& targets);

/// Test for bands.
///
/// @param p the targets
/// @returns true if some target is more than a point: a gate, or a point with a tolerance
inline bool has_bands(const PathTargets& p) { return !p.gate_x.empty() || !p.tolerance.empty(); }

/// The errors of a tracing point at the targets of a path, one entry a target; NaN where the mechanism does
/// not assemble.
struct PathErrors {
  std::vector<double> x,  ///< tracing point, m
      y,                  ///< tracing point, m
      distance,           ///< distance from the point or gate, m
      excess;             ///< distance beyond the tolerance, or all of it without one, m
};

/// The errors of a tracing point.
///
/// @param targets the targets
/// @param reached position of the tracing point at each target (m)
/// @returns the errors in the order of the targets
/// @throws ContractError unless there is one position for each target
PathErrors path_errors(const PathTargets& targets, const std::vector<std::complex<double>>& reached);

/// The violation of the order in which targets are to be met within one turn.
///
/// @param angles crank angles, one a target, unwrapped (rad)
/// @param sense sense of rotation, +1 or -1
/// @returns the angle (rad) by which the crank runs backwards, or continues beyond a turn; 0 = the targets
///   are met one after the other within one turn
double out_of_order(const std::vector<double>& angles, double sense);

/// The miss of a tracing point at a target: the vector from the nearest place that counts as met, zero where
/// it is met, and its symmetric derivative for the tracing point (px, py).
struct TargetMiss {
  double x = 0,   ///< m
      y = 0;      ///< m
  double xx = 1,  ///< d x / d px
      xy = 0,     ///< d x / d py = d y / d px
      yy = 1;     ///< d y / d py
};

/// The miss of a target by a point, whatever the tolerance: from the target point, or from the nearest place
/// of the gate.
///
/// @param p the targets
/// @param k index of the target
/// @param px x of the point (m)
/// @param py y of the point (m)
/// @returns the miss with its derivative
inline TargetMiss target_offset(const PathTargets& p, std::size_t k, double px, double py) {
  TargetMiss m{px - p.x[k], py - p.y[k]};
  if (p.gate_x.empty()) return m;
  const double hx = p.gate_x[k], hy = p.gate_y[k], square = hx * hx + hy * hy;
  if (!(square > 0)) return m;
  const double along = (m.x * hx + m.y * hy) / square;
  if (std::abs(along) < 1) {  // nearest to the open gate: only the miss across it counts
    m.xx = hy * hy / square;
    m.xy = -hx * hy / square;
    m.yy = hx * hx / square;
    m.x -= along * hx;
    m.y -= along * hy;
  } else {  // nearest to a post
    m.x -= along > 0 ? hx : -hx;
    m.y -= along > 0 ? hy : -hy;
  }
  return m;
}

/// The miss of a target by a point beyond the tolerance of the target, which counts as error.
///
/// @param p the targets
/// @param k index of the target
/// @param px x of the point (m)
/// @param py y of the point (m)
/// @returns the miss with its derivative; zero within the tolerance
inline TargetMiss target_miss(const PathTargets& p, std::size_t k, double px, double py) {
  TargetMiss m = target_offset(p, k, px, py);
  const double t = p.tolerance.empty() ? 0 : p.tolerance[k];
  if (!(t > 0)) return m;
  const double distance = std::hypot(m.x, m.y);
  if (distance <= t) return {0, 0, 0, 0, 0};
  const double keep = 1 - t / distance, turn = t / (distance * distance * distance);
  // d (keep m) = keep dm + m dkeep; of an open gate dm is the projection on m itself, so both add up to dm.
  if (m.xx + m.yy > 1.5) {
    m.xx = keep + turn * m.x * m.x;
    m.xy = turn * m.x * m.y;
    m.yy = keep + turn * m.y * m.y;
  }
  m.x *= keep;
  m.y *= keep;
  return m;
}

/// Targets laid out for the kernels.
struct TargetLayout {
  std::vector<double> x,  ///< x of the target points, m
      y;                  ///< y of the target points, m
  bool banded = false;    ///< gates or tolerances count
  /// When banded, half of each gate along x (m), as many as points.
  std::vector<double> gate_x,
      gate_y,     ///< the same along y (m)
      tolerance;  ///< tolerance of each target (m)
};

/// Lays out targets for the kernels.
///
/// @param targets the targets
/// @returns the layout; gates and tolerances that are not given are 0
TargetLayout lay_out(const PathTargets& targets);

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

/// The tracing point of a mechanism at a crank angle.
struct TracedPoint {
  Status status = Status::done;  ///< done, singular (the branches meet there) or no_assembly
  double gap = 0;                ///< m, by how much the links miss each other; 0 when they do not
  std::complex<double> at;       ///< NaN without assembly
};

/// The margin of a crank to a full turn.
struct CrankTurn {
  double margin = 0;  ///< m, least margin of the conditions of full rotation; negative = it does not turn
  double size = 0;    ///< m, sum of the lengths
  /// Full rotation within the tolerance of the constraint: a synthesis may end on the change point.
  ///
  /// @returns true if the crank turns fully
  bool full() const;
};

/// Parts of sentences for messages about a mechanism.
struct MechanismWords {
  std::string_view name;              ///< "four-bar"
  std::string_view missing[2];        ///< around the length by which links miss each other
  std::string_view singular;          ///< "at a toggle"
  std::string_view without_assembly;  ///< crank angles between two circuits: "that do not assemble"
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
  std::vector<Violation> violations;
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
  return linkwright::better(a.error, total_violation(a), b.error, total_violation(b));
}

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
