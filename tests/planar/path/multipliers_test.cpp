// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/detail/multipliers.h"

#include <gtest/gtest.h>

#include <array>

namespace linkwright::planar {
namespace {

// (x - 2)^2 with x <= 1 and x >= -5: the second holds anyway. Minimised in closed form for a multiplier m and
// a penalty r: x = (4 - m + r) / (2 + r) while m + r (x - 1) > 0.
TEST(Multipliers, EndAtABound) {
  std::array<double, 2> multipliers{}, values{};
  double penalty = 3, x = 0;
  int evaluations = 0;
  const double violation = minimise_by_multipliers(
      60, multipliers, values, penalty,
      [&] {
        x = (4 - multipliers[0] + penalty) / (2 + penalty);
        return 1.0;
      },
      [&] {
        ++evaluations;
        values = {x - 1, -5 - x};
      });
  EXPECT_NEAR(x, 1, 1e-9);
  EXPECT_NEAR(multipliers[0], 2, 1e-8);  // the slope of the objective there
  EXPECT_EQ(multipliers[1], 0);
  EXPECT_LE(violation, 1e-10);
  EXPECT_LT(evaluations, 60);
}

TEST(Multipliers, ADescentThatFailsEndsThem) {
  std::array<double, 1> multipliers{}, values{};
  double penalty = 1;
  EXPECT_EQ(minimise_by_multipliers(
                5, multipliers, values, penalty, [] { return infinity; }, [] {}),
            infinity);
}

}  // namespace
}  // namespace linkwright::planar
