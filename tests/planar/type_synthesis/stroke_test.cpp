// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/stroke.h"

#include <gtest/gtest.h>

#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

TEST(ChamferDistances, AreThoseOfParallelSegments) {
  const std::vector<std::complex<double>> a{{0, 0}, {1, 0}}, b{{0, 0.25}, {1, 0.25}};
  EXPECT_NEAR(chamfer_distance(a, false, b, false), 0.5, 1e-12);
  EXPECT_NEAR(chamfer_distance(a, false, a, false), 0, 1e-15);
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
