// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

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

}  // namespace linkwright::planar
