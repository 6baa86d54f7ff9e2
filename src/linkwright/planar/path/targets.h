#pragma once

#include <cmath>
#include <cstddef>

#include "linkwright/planar/path/problem.h"

namespace linkwright::planar {

/// Whether some target of a problem is more than a point: a gate, or a point with a tolerance.
inline bool has_bands(const PathProblem& p) { return !p.gate_x.empty() || !p.tolerance.empty(); }

/// How a tracing point misses a target: the vector (m) from the nearest place that counts as met, zero where
/// it is met, and its symmetric derivative for the tracing point.
struct TargetMiss {
  double x = 0, y = 0;
  double xx = 1, xy = 0, yy = 1;  ///< d x / d px, d x / d py = d y / d px, d y / d py
};

/// Miss of target `k` by the point (px, py), whatever the tolerance: from the target point, or from the
/// nearest place of the gate.
inline TargetMiss target_offset(const PathProblem& p, std::size_t k, double px, double py) {
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

/// The same beyond the tolerance of the target: what counts as error.
inline TargetMiss target_miss(const PathProblem& p, std::size_t k, double px, double py) {
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

}  // namespace linkwright::planar
