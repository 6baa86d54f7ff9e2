// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace linkwright::parallel {
namespace {

TEST(PiRange, IsWhatTheJointDoesAtItsEnds) {
  const PiJoint joint{0.17, 0.4};
  const PiRange range = pi_range(joint, -1.0, 0.9);
  EXPECT_NEAR(range.shortest.value, diagonal(joint, -1.0), 1e-16);
  EXPECT_NEAR(range.longest.value, diagonal(joint, 0.9), 1e-16);
  EXPECT_NEAR(range.rate_low.value, jacobian(joint, -1.0), 1e-16);
  EXPECT_NEAR(range.transmission_high.value, std::sin(angles(joint, 0.9).transmission), 1e-15);
}

// The largest rate against a scan of ranges that contain the maximum and of ranges that do not.
TEST(PiRange, FindsTheLargestRate) {
  for (const double ratio : {0.4, 1.5})
    for (const auto& [low, high] : {std::pair{-1.2, 0.8}, {0.1, 0.8}, {-1.4, -1.0}}) {
      const PiJoint joint{0.2, ratio};
      double most = 0;
      for (int i = 0; i <= 2000; ++i) most = std::max(most, jacobian(joint, low + (high - low) * i / 2000));
      // A maximum is missed by half a step squared.
      EXPECT_NEAR(pi_range(joint, low, high).rate_most.value, most, 1e-6 * 0.2) << ratio << " " << low;
    }
}

TEST(PiRange, DerivativesAreThoseOfDifferences) {
  const std::array<double, 4> x{0.17, 0.4, -1.0, 0.9};
  const auto numbers = [](const std::array<double, 4>& v) {
    const PiRange r = pi_range({v[0], v[1]}, v[2], v[3]);
    return std::array{r.shortest, r.longest,   r.transmission_low, r.transmission_high,
                      r.rate_low, r.rate_high, r.rate_most};
  };
  // Central differences: h^2/6 and eps/h.
  constexpr double h = 1e-5;
  for (int j = 0; j < 4; ++j) {
    auto more = x, less = x;
    more[j] += h;
    less[j] -= h;
    const auto at = numbers(x), up = numbers(more), down = numbers(less);
    for (std::size_t k = 0; k < at.size(); ++k)
      EXPECT_NEAR(at[k].by[j], (up[k].value - down[k].value) / (2 * h), 1e-9) << k << " by " << j;
  }
}

}  // namespace
}  // namespace linkwright::parallel
