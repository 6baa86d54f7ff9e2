// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/path/task.h"

namespace linkwright::planar {
namespace {

// One target of each kind: point, point with tolerance, gate, gate with tolerance.
PathTargets targets() {
  PathTargets p;
  p.x = {1, 2, 3, 4};
  p.y = {0, 1, -1, 0.5};
  p.gate_x = {0, 0, 0.3, -0.5};
  p.gate_y = {0, 0, 0.4, 0.2};
  p.tolerance = {0, 0.25, 0, 0.1};
  return p;
}

// Distance to the nearest of many places between the posts, beyond the tolerance.
double sampled(const PathTargets& p, std::size_t k, double px, double py) {
  double least = infinity;
  for (int i = -2000; i <= 2000; ++i)
    least = std::min(least,
                     std::hypot(px - p.x[k] - p.gate_x[k] * i / 2000, py - p.y[k] - p.gate_y[k] * i / 2000));
  return std::max(0.0, least - p.tolerance[k]);
}

TEST(PathTargets, MissIsTheDistanceBeyondTheTolerance) {
  const PathTargets p = targets();
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    RandomStream r({.seed = seed});
    for (std::size_t k = 0; k < 4; ++k) {
      const double px = p.x[k] + r.uniform(-1, 1), py = p.y[k] + r.uniform(-1, 1);
      const TargetMiss m = target_miss(p, k, px, py);
      // Places 0.0003 apart miss the nearest one by at most half of that.
      EXPECT_NEAR(std::hypot(m.x, m.y), sampled(p, k, px, py), 2e-4);
      met += m.x == 0 && m.y == 0;
    }
  }
  EXPECT_GT(met, 20);
}

TEST(PathTargets, ItsDerivativeIsThatOfDifferences) {
  const PathTargets p = targets();
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomStream r({.seed = seed});
    for (std::size_t k = 0; k < 4; ++k) {
      const double px = p.x[k] + r.uniform(-1, 1), py = p.y[k] + r.uniform(-1, 1), h = 1e-6;
      const auto at = [&](double dx, double dy) { return target_miss(p, k, px + dx, py + dy); };
      const TargetMiss m = at(0, 0), e = at(h, 0), w = at(-h, 0), n = at(0, h), s = at(0, -h);
      // Only the edges of tolerances and the ends of gates have a kink.
      const bool kink =
          std::abs((e.x - m.x) - (m.x - w.x)) > 1e-9 || std::abs((n.y - m.y) - (m.y - s.y)) > 1e-9;
      if (kink) continue;
      EXPECT_NEAR(m.xx, (e.x - w.x) / (2 * h), 1e-7);
      EXPECT_NEAR(m.xy, (n.x - s.x) / (2 * h), 1e-7);
      EXPECT_NEAR(m.xy, (e.y - w.y) / (2 * h), 1e-7);
      EXPECT_NEAR(m.yy, (n.y - s.y) / (2 * h), 1e-7);
    }
  }
}

TEST(PathTargets, OffsetTakesNoNoticeOfTheTolerance) {
  const PathTargets p = targets();
  EXPECT_EQ(target_offset(p, 1, 2.1, 1).x, 2.1 - 2.0);
  EXPECT_EQ(target_miss(p, 1, 2.1, 1).x, 0);
  PathTargets plain = p;
  plain.gate_x.clear(), plain.gate_y.clear(), plain.tolerance.clear();
  EXPECT_TRUE(has_bands(p));
  EXPECT_FALSE(has_bands(plain));
  EXPECT_EQ(target_miss(plain, 3, 5, 0.5).x, 1);
}

}  // namespace
}  // namespace linkwright::planar
