// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/function/dead_centres.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/as_linkage.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/linkage/slider_crank.h"

namespace linkwright::planar {
namespace {

constexpr double degree = pi / 180;

FourBar four_bar_of(const StrokeLinkage& l, Branch branch) {
  return {.ground = l.ground, .crank = l.crank, .coupler = 1, .rocker = l.rocker, .branch = branch};
}

TEST(DeadCentres, TimeRatioAndImbalance) {
  EXPECT_NEAR(imbalance_of(1.4), 30 * degree, 1e-15);
  EXPECT_NEAR(time_ratio_of(-30 * degree), 1.4, 1e-15);
  EXPECT_EQ(imbalance_of(1), 0);
  EXPECT_THROW((void)imbalance_of(0.9), ContractError);
}

// The construction against the extremes of the output of the linkage itself.
TEST(DeadCentres, CrankRockersSwingAsAsked) {
  int tried = 0;
  for (const double swing : {5.0, 20.0, 45.0, 60.0, 90.0, 130.0, 170.0})
    for (const double imbalance : {-120.0, -95.0, -60.0, -20.0, -5.0, 0.0, 5.0, 20.0, 45.0, 80.0}) {
      const Strokes strokes{swing * degree, imbalance * degree};
      const std::optional<double> shortest = shortest_crank(strokes);
      const bool possible = std::abs(imbalance) < (imbalance < 0 ? 90 + swing / 2 : 90 - swing / 2);
      ASSERT_EQ(shortest.has_value(), possible) << swing << ' ' << imbalance;
      if (!shortest) continue;
      for (const double share : {0.1, 0.4, 0.8}) {
        const StrokeLinkage l = stroke_linkage(strokes, *shortest + (1 - *shortest) * share);
        // The nearer to locking, the more rounding of the lengths moves the dead centres.
        const double near = 1e-11 / l.transmission_angle;
        for (const Branch branch : {Branch::open, Branch::crossed}) {
          const FourBar bar = four_bar_of(l, branch);
          EXPECT_EQ(classify(bar).type, FourBarType::crank_rocker) << swing << ' ' << imbalance;
          const auto swept = sweep_strokes(linkage_of({bar, {}}), 3, false);
          ASSERT_TRUE(swept) << swing << ' ' << imbalance << ' ' << share;
          EXPECT_NEAR(swept->swing, strokes.swing, near) << swing << ' ' << imbalance << ' ' << share;
          // The rocker rises for longer when it turns with a counter-clockwise crank.
          EXPECT_NEAR(swept->rise, pi - strokes.imbalance, near) << swing << ' ' << imbalance << ' ' << share;
          EXPECT_NEAR(swept->transmission_angle, l.transmission_angle, 1e-7) << swing << ' ' << imbalance;
          EXPECT_NEAR(transmission_angles(bar).minimum, l.transmission_angle, 1e-7);
        }
        EXPECT_NEAR(l.chord, 2 * l.rocker * std::sin(strokes.swing / 2), 1e-12 * l.chord);
        ++tried;
      }
    }
  EXPECT_GT(tried, 120);
}

TEST(DeadCentres, SliderCranksStrokeAsAsked) {
  for (const double imbalance : {-80.0, -40.0, -10.0, 0.0, 10.0, 40.0, 80.0})
    for (const double share : {0.1, 0.4, 0.8}) {
      const Strokes strokes{0, imbalance * degree};
      const double shortest = *shortest_crank(strokes);
      const StrokeLinkage l = stroke_linkage(strokes, shortest + (1 - shortest) * share);
      const SliderCrankMechanism mechanism{
          SliderSide::forward, {.crank = l.crank, .rod = 1, .offset = l.offset}, {}};
      const auto swept = sweep_strokes(slider_crank(mechanism), 3, true);
      ASSERT_TRUE(swept) << imbalance;
      const double near = 1e-11 / l.transmission_angle;
      EXPECT_NEAR(swept->swing, l.chord, near);
      EXPECT_NEAR(swept->rise, pi - strokes.imbalance, near);
      EXPECT_NEAR(swept->transmission_angle, l.transmission_angle, 1e-7);
    }
  EXPECT_FALSE(shortest_crank({0, 90 * degree}));
}

// The root of the cubic against a grid.
TEST(DeadCentres, TheBestCrankHasTheLargestTransmissionAngle) {
  for (const double swing : {0.0, 1.0, 20.0, 45.0, 60.0, 100.0, 150.0})
    for (const double imbalance : {-150.0, -100.0, -60.0, -45.0, -20.0, -1.0, 1.0, 20.0, 55.0, 85.0}) {
      const Strokes strokes{swing * degree, imbalance * degree};
      const std::optional<double> shortest = shortest_crank(strokes);
      if (!shortest) continue;
      const double best = best_crank(strokes);
      EXPECT_GT(best, *shortest);
      EXPECT_LT(best, 1);
      const double largest = stroke_linkage(strokes, best).transmission_angle;
      double seen = 0, at = 0;
      constexpr int places = 20000;
      for (int k = 1; k < places; ++k) {
        const double crank = *shortest + (1 - *shortest) * k / places;
        const double angle = stroke_linkage(strokes, crank).transmission_angle;
        EXPECT_LE(angle, largest + 1e-12);
        if (angle > seen) seen = angle, at = crank;
      }
      EXPECT_NEAR(at, best, 1.0 / places) << swing << ' ' << imbalance;
    }
  // The rocker swings by the imbalance: zero is a root as well.
  EXPECT_GT(best_crank({30 * degree, -30 * degree}), 0.1);
}

TEST(DeadCentres, WithoutImbalanceAreThoseOfBrodellAndSoni) {
  // Brodell and Soni 1970, in grounds: coupler^2 = (1 - cos swing) / (2 cos^2 mu), rocker^2 = (1 - coupler^2)
  // / (1 - coupler^2 cos^2 mu), crank^2 = coupler^2 + rocker^2 - 1.
  for (const double swing : {20.0, 50.0, 90.0}) {
    EXPECT_EQ(best_crank({swing * degree, 0}), 0);
    const StrokeLinkage l = stroke_linkage({swing * degree, 0}, 0.3);
    const double cosine = std::cos(l.transmission_angle);
    const double coupler = (1 - std::cos(swing * degree)) / (2 * cosine * cosine);
    const double rocker = (1 - coupler) / (1 - coupler * cosine * cosine);
    const double ground = l.ground * l.ground;
    EXPECT_NEAR(1 / ground, coupler, 1e-12);
    EXPECT_NEAR(l.rocker * l.rocker / ground, rocker, 1e-12);
    EXPECT_NEAR(l.crank * l.crank / ground, coupler + rocker - 1, 1e-12);
  }
}

TEST(DeadCentres, ARatioOfTwoLengthsSettlesTheLinkage) {
  const Strokes strokes{50 * degree, -20 * degree};
  const StrokeLinkage l = stroke_linkage(strokes, 0.37);
  using enum StrokeLength;
  for (const StrokeLength one : {crank, coupler, rocker, ground, chord})
    for (const StrokeLength other : {crank, coupler, rocker, ground, chord}) {
      // The chord is the rocker times a constant.
      if (one == other || (one == chord && other == rocker) || (one == rocker && other == chord)) continue;
      const auto found = crank_of_ratio(strokes, one, other, length_of(l, one) / length_of(l, other));
      ASSERT_TRUE(found);
      EXPECT_NEAR(*found, 0.37, 1e-9);
    }
  EXPECT_FALSE(crank_of_ratio(strokes, rocker, crank, 0.1));
  // A rocker that swings by twice the imbalance is as long as the ground link, whatever the crank.
  const StrokeLinkage equal = stroke_linkage({50 * degree, -25 * degree}, 0.37);
  EXPECT_NEAR(equal.ground, equal.rocker, 1e-12);
  EXPECT_FALSE(crank_of_ratio({50 * degree, -25 * degree}, ground, rocker, 1));
}

TEST(SweepStrokes, OfLinkagesThatHaveNone) {
  // A double crank, and a linkage that does not turn.
  EXPECT_FALSE(
      sweep_strokes(linkage_of({{.ground = 1, .crank = 2, .coupler = 2, .rocker = 2}, {}}), 3, false));
  EXPECT_FALSE(
      sweep_strokes(linkage_of({{.ground = 4, .crank = 2, .coupler = 2, .rocker = 1}, {}}), 3, false));
}

}  // namespace
}  // namespace linkwright::planar
