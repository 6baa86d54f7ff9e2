// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/cam/curve_scan.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkwright::planar {
namespace {

using math::Motion;

ProgrammeCurve cycloidal_turn() {
  return ProgrammeCurve({.segments = {{CamLaw::cycloidal, pi, 0.02, {}}, {CamLaw::cycloidal, pi, 0, {}}}});
}

TEST(CamCurveScan, ExtremesAreRefinedBetweenSamples) {
  const ProgrammeCurve curve = cycloidal_turn();
  // A narrow well at an angle that is no sample.
  const double place = 1.234567890123;
  const auto well = [&](const Motion&, double angle) { return -std::exp(-40 * std::pow(angle - place, 2)); };
  const CamExtreme least = least_over(curve, well);
  EXPECT_NEAR(least.value, -1, 1e-15);
  EXPECT_NEAR(least.angle, place, 1e-11);
  const CamExtreme fastest = greatest_over(curve, [](const Motion& m, double) { return m.rate; });
  EXPECT_NEAR(fastest.value, 0.04 / pi, 1e-15);
  EXPECT_NEAR(fastest.angle, pi / 2, 1e-11);
}

TEST(CamCurveScan, RangesEndAtZerosAndJoinAcrossTheTurn) {
  const ProgrammeCurve curve = cycloidal_turn();
  const auto ranges =
      negative_ranges(curve, [](const Motion&, double angle) { return 0.5 - std::cos(angle); });
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_NEAR(ranges[0].from, 5 * pi / 3, 1e-14);
  EXPECT_NEAR(ranges[0].to, 7 * pi / 3, 1e-14);
  EXPECT_TRUE(negative_ranges(curve, [](const Motion&, double) { return 1.0; }).empty());
  const auto all = negative_ranges(curve, [](const Motion&, double) { return -1.0; });
  ASSERT_EQ(all.size(), 1u);
  EXPECT_DOUBLE_EQ(all[0].to - all[0].from, 2 * pi);
}

// The range is narrower than the distance of samples and lies between two of them.
TEST(CamCurveScan, FindsNarrowRanges) {
  const double place = 100.26 * 2 * pi / 720;
  const auto dip = [&](const Motion&, double angle) { return std::pow(angle - place, 2) - 1e-8; };
  const auto ranges = negative_ranges(cycloidal_turn(), dip);
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_NEAR(ranges[0].from, place - 1e-4, 1e-10);
  EXPECT_NEAR(ranges[0].to, place + 1e-4, 1e-10);
}

}  // namespace
}  // namespace linkwright::planar
