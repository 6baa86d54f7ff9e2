// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/belt_run.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {

BeltRun belt_run(std::span<const std::complex<double>> centres, std::span<const double> radii, bool closed) {
  const std::size_t n = centres.size();
  LINKWRIGHT_REQUIRE(n >= 2 && radii.size() == n, "{} wheels with {} radii", n, radii.size());
  const std::size_t strands = closed ? n : n - 1;
  BeltRun out;
  std::vector<double> directions;
  for (std::size_t i = 0; i < strands; ++i) {
    const std::complex<double> way = centres[(i + 1) % n] - centres[i];
    const double step = radii[(i + 1) % n] - radii[i];
    const double straight = std::sqrt(std::norm(way) - step * step);
    out.length += straight;
    directions.push_back(std::arg(way) - std::atan2(step, straight));
  }
  out.wraps.assign(n, 0.0);
  for (std::size_t i = closed ? 0 : 1; i < strands; ++i) {
    const double side = radii[i] < 0 ? -1 : 1,
                 turn = side * (directions[i] - directions[(i + strands - 1) % strands]);
    out.wraps[i] = turn - full_turn * std::floor(turn / full_turn);
    out.length += std::abs(radii[i]) * out.wraps[i];
    out.turns += side * out.wraps[i] / full_turn;
  }
  return out;
}

}  // namespace linkwright::planar
