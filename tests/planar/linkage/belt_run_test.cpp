// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/belt_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::test;

void check(const BeltRun& run, const Value& wraps, double length, double turns) {
  EXPECT_NEAR(run.length, length, 1e-14);
  EXPECT_NEAR(run.turns, turns, 1e-14);
  const std::vector<double> wanted = numbers(wraps);
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(math::degrees(run.wraps[i]), wanted[i], 1e-12);
}

TEST(BeltRun, HasTheLengthsOfOpenAndCrossedBelts) {
  const Value& wanted = at(published_case("planar-machines.json", "belt-lengths"), "computed");
  const std::vector<std::complex<double>> centres{0.0, 0.4};
  check(belt_run(centres, std::vector<double>{0.1, 0.05}, true), at(wanted, "open_wraps_deg"),
        number_at(wanted, "open_m"), 1);
  check(belt_run(centres, std::vector<double>{0.1, -0.05}, true), at(wanted, "crossed_wraps_deg"),
        number_at(wanted, "crossed_m"), 0);
}
TEST(BeltRun, TakesWheelsAtItsBack) {
  const Value& wanted = at(published_case("planar-machines.json", "belt-back-side-idler"), "computed");
  const std::vector<std::complex<double>> centres{0.0, {0.25, 0.02}, {0.5, 0.05}};
  check(belt_run(centres, std::vector<double>{0.1, -0.04, 0.07}, true), at(wanted, "wraps_deg"),
        number_at(wanted, "length_m"), 1);
}
TEST(BeltRun, RopesEndInPoints) {
  // Down, half a turn under a wheel of 50 mm, and up.
  const std::vector<std::complex<double>> centres{{-0.05, 0}, {0, -0.3}, {0.05, 0}};
  const BeltRun run = belt_run(centres, std::vector<double>{0, 0.05, 0}, false);
  EXPECT_NEAR(run.length, 0.6 + 0.05 * pi, 1e-15);
  EXPECT_NEAR(run.wraps[1], pi, 1e-14);
  EXPECT_TRUE(std::isnan(belt_run(centres, std::vector<double>{0, 0.5, 0}, false).length));
}

}  // namespace
}  // namespace linkwright::planar
