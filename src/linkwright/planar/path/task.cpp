// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/task.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"

namespace linkwright::planar {

bool CrankTurn::full() const { return margin >= -tolerance::feasibility * size; }

void require_valid_task(const PathTask& p) {
  require_valid_targets(p);
  if (p.timing == Timing::given || p.timing == Timing::increments) {
    LINKWRIGHT_REQUIRE(p.angles.size() == p.x.size(), "{} angles for {} points", p.angles.size(), p.x.size());
    for (std::size_t k = 0; k < p.angles.size(); ++k)
      LINKWRIGHT_REQUIRE(std::isfinite(p.angles[k]), "angle {} is {}", k + 1, p.angles[k]);
  }
  if (p.timing == Timing::equal_steps)
    LINKWRIGHT_REQUIRE(p.step != 0 && std::isfinite(p.step), "the step must not be zero, got {}", p.step);
  LINKWRIGHT_REQUIRE(p.min_step > 0 && p.min_step < 2 * pi, "the least step is {}", p.min_step);
}

double point_angle(const PathTask& p, std::size_t k) {
  switch (p.timing) {
    case Timing::free:
      return 0;
    case Timing::equal_steps:
      return p.step * static_cast<double>(k);
    case Timing::increments:
    case Timing::given:
      return p.angles[k];
  }
  return 0;
}

PathRanges derive_ranges(const std::vector<double>& x, const std::vector<double>& y) {
  const auto [x0, x1] = std::minmax_element(x.begin(), x.end());
  const auto [y0, y1] = std::minmax_element(y.begin(), y.end());
  const double size = std::hypot(*x1 - *x0, *y1 - *y0), far = 50 * size;
  const double mx = 0.5 * (*x0 + *x1), my = 0.5 * (*y0 + *y1);
  return {{1e-3 * size, far}, {-far, far}, {mx - far, mx + far}, {my - far, my + far}, {0, 2 * pi}};
}

}  // namespace linkwright::planar
