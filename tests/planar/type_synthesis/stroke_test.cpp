// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/stroke.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

TEST(ChamferDistances, AreThoseOfParallelSegments) {
  const std::vector<std::complex<double>> a{{0, 0}, {1, 0}}, b{{0, 0.25}, {1, 0.25}};
  EXPECT_NEAR(chamfer_distance(a, false, b, false), 0.5, 1e-12);
  EXPECT_NEAR(chamfer_distance(a, false, a, false), 0, 1e-15);
}

// The grid of cells against the plain search.
TEST(ChamferDistances, AreThoseOfAllPairs) {
  std::vector<std::complex<double>> a, b;
  for (int k = 0; k < 30; ++k) {
    a.emplace_back(std::cos(0.3 * k), std::sin(0.5 * k));
    b.emplace_back(40 + 3 * std::cos(0.2 * k), 7 * std::sin(0.31 * k) - 20);
  }
  const auto p = equal_steps(a, true, 2000), q = equal_steps(b, false, 2000);
  double sum = 0;
  for (const auto* from : {&p, &q})
    for (const auto& x : *from) {
      double least = infinity;
      for (const auto& y : from == &p ? q : p) least = std::min(least, std::abs(x - y));
      sum += least / 2000;
    }
  EXPECT_NEAR(chamfer_distance(a, true, b, false), sum, 1e-9 * sum);
}

TEST(SampledStrokes, DoNotDependOnTheSpacingOfThePoints) {
  const Stroke coarse{.points = {{0, 0}, {4, 0}, {4, 3}, {0, 3}}, .closed = true};
  const Stroke fine{.points = {{0, 0}, {0.5, 0}, {1, 0}, {4, 0}, {4, 0.1}, {4, 3}, {2, 3}, {0, 3}},
                    .closed = true};
  const SampledStroke a = sampled_stroke(coarse), b = sampled_stroke(fine);
  EXPECT_NEAR(a.size, b.size, 1e-12);
  EXPECT_NEAR(std::abs(a.centre - b.centre), 0, 1e-12);
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    EXPECT_NEAR(a.x[k], b.x[k], 1e-9);
    EXPECT_NEAR(a.y[k], b.y[k], 1e-9);
  }
  EXPECT_NEAR(a.length * a.size, 14, 1e-12);
}

TEST(SampledStrokes, HaveEqualSteps) {
  const Stroke stroke{.points = {{0, 0}, {1, 0}, {1, 2}}, .closed = false};
  const auto points = equal_steps(stroke.points, false, 7);
  for (std::size_t k = 1; k < points.size(); ++k)
    EXPECT_NEAR(std::abs(points[k] - points[k - 1]), 0.5, 1e-12);
  EXPECT_EQ(points.back(), stroke.points.back());
}

}  // namespace
}  // namespace linkwright::planar
