// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <complex>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/path/task.h"

namespace linkwright::planar {

void require_valid_targets(const PathTargets& p) {
  LINKWRIGHT_REQUIRE(p.x.size() >= 3 && p.x.size() == p.y.size(),
                     "needs at least 3 points, got {} x and {} y", p.x.size(), p.y.size());
  for (std::size_t k = 0; k < p.x.size(); ++k)
    LINKWRIGHT_REQUIRE(std::isfinite(p.x[k]) && std::isfinite(p.y[k]), "point {} is ({}, {})", k + 1, p.x[k],
                       p.y[k]);
  LINKWRIGHT_REQUIRE(p.gate_x.size() == p.gate_y.size() &&
                         (p.gate_x.empty() || p.gate_x.size() == p.x.size()) &&
                         (p.tolerance.empty() || p.tolerance.size() == p.x.size()),
                     "{} x and {} y of gates and {} tolerances for {} points", p.gate_x.size(),
                     p.gate_y.size(), p.tolerance.size(), p.x.size());
  for (const double tolerance : p.tolerance)
    LINKWRIGHT_REQUIRE(tolerance >= 0 && std::isfinite(tolerance), "a tolerance is {}", tolerance);
  LINKWRIGHT_REQUIRE(path_size(p) > 0, "all {} points coincide", p.x.size());
}

double path_size(const PathTargets& p) {
  const auto [x0, x1] = std::minmax_element(p.x.begin(), p.x.end());
  const auto [y0, y1] = std::minmax_element(p.y.begin(), p.y.end());
  return std::hypot(*x1 - *x0, *y1 - *y0);
}

PathErrors path_errors(const PathTargets& targets, const std::vector<std::complex<double>>& reached) {
  LINKWRIGHT_REQUIRE(reached.size() == targets.x.size(), "{} places for {} targets", reached.size(),
                     targets.x.size());
  PathErrors out;
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const double x = reached[k].real(), y = reached[k].imag();
    out.x.push_back(x);
    out.y.push_back(y);
    const TargetMiss miss = target_miss(targets, k, x, y), offset = target_offset(targets, k, x, y);
    out.excess.push_back(std::hypot(miss.x, miss.y));
    out.distance.push_back(std::hypot(offset.x, offset.y));
  }
  return out;
}

double out_of_order(const std::vector<double>& angles, double sense) {
  double turned = 0, back = 0;
  for (std::size_t k = 0; k + 1 < angles.size(); ++k) {
    const double step = sense * (angles[k + 1] - angles[k]);
    turned += step;
    back += std::max(0.0, -step);
  }
  return back + std::max(0.0, turned - 2 * pi);
}

TargetLayout lay_out(const PathTargets& targets) {
  TargetLayout out{.x = targets.x, .y = targets.y};
  if (!has_bands(targets)) return out;
  out.banded = true;
  const std::vector<double> none(targets.x.size(), 0.0);
  out.gate_x = targets.gate_x.empty() ? none : targets.gate_x;
  out.gate_y = targets.gate_y.empty() ? none : targets.gate_y;
  out.tolerance = targets.tolerance.empty() ? none : targets.tolerance;
  return out;
}

}  // namespace linkwright::planar
