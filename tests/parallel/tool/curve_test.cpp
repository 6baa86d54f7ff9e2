// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/parallel/tool/path.h"

namespace linkwright::parallel {
namespace {

using math::Vec3;

Vec3 random_vector(RandomStream& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}
// One of each form, of sizes from 0.05 to 1.
std::vector<ToolCurve> random_curves(RandomStream& random) {
  const Vec3 p = random_vector(random), in = unit(random_vector(random)), axis = unit(random_vector(random));
  Vec3 out = unit(random_vector(random));
  while (dot(in, out) < -0.98) out = unit(random_vector(random));
  return {straight(p, p + random_vector(random)),
          circular(p, p + random_vector(random), axis, random.uniform(0.1, 2 * pi)),
          rounded(p, in, out, random.uniform(0.05, 1))};
}

TEST(ToolCurve, DirectionAndCurvatureAreDerivativesByTheLength) {
  RandomStream random({.seed = 1});
  for (int n = 0; n < 100; ++n)
    for (const ToolCurve& c : random_curves(random)) {
      for (double x : {0.1, 0.3, 0.499, 0.501, 0.75, 0.9}) {
        // The error of a difference is h^2 / 6 of a third derivative, (angle / length)^3 = 1 / m^3 in shares
        // of this step; rounding 1e-16 / 1e-5.
        const double s = x * c.length, scale = std::max(1.0, c.angle) / c.length, h = 1e-5 / scale;
        const CurvePoint a = point_at(c, s - h), p = point_at(c, s), b = point_at(c, s + h);
        EXPECT_NEAR(norm(p.tangent), 1, 1e-14);
        EXPECT_LT(norm((1 / (2 * h)) * (b.position - a.position) - p.tangent), 1e-9);
        EXPECT_LT(norm((1 / (2 * h)) * (b.tangent - a.tangent) - p.curvature * p.normal), 2e-9 * scale);
        EXPECT_NEAR((b.curvature - a.curvature) / (2 * h), p.curvature_slope, 1e-9 * scale * scale);
      }
    }
}

TEST(ToolCurve, EndsWhereItSaysInTheDirectionThatItSays) {
  RandomStream random({.seed = 2});
  for (int n = 0; n < 100; ++n)
    for (const ToolCurve& c : random_curves(random)) {
      const CurvePoint first = point_at(c, 0), last = point_at(c, c.length);
      EXPECT_LT(norm(first.position - c.from), 1e-15);
      EXPECT_LT(norm(first.tangent - c.tangent), 1e-15);
      EXPECT_LT(norm(last.position - end_of(c)), 1e-15);
      EXPECT_LT(norm(last.tangent - end_direction(c)), 1e-14);
      if (c.form == ToolCurve::Form::corner) {
        EXPECT_EQ(first.curvature, 0);
        EXPECT_NEAR(last.curvature, 0, 1e-14);
        // Both halves, from either end, meet in the middle: that is the length that was computed for it.
        const double half = c.length / 2, e = 1e-12 * c.length;
        EXPECT_LT(norm(point_at(c, half - e).position - point_at(c, half).position), 2 * e + 1e-14);
      }
    }
}

TEST(ToolCurve, CornersAreSymmetricAndReachAsFarAsAsked) {
  const ToolCurve c = rounded({1, 2, 3}, {0, 0, 1}, {1, 0, 0}, 0.1);
  EXPECT_EQ(c.from, (Vec3{1, 2, 2.9}));
  EXPECT_EQ(c.to, (Vec3{1.1, 2, 3}));
  EXPECT_NEAR(c.angle, pi / 2, 1e-15);
  const Vec3 middle = point_at(c, c.length / 2).position;
  EXPECT_NEAR(middle.x - 1, 3 - middle.z, 1e-15);
  // Shorter than the corner itself, longer than its chord.
  EXPECT_LT(c.length, 0.2);
  EXPECT_GT(c.length, 0.1 * std::sqrt(2));
}

TEST(ToolCurve, CirclesTurnRightHandedAboutTheirAxis) {
  const ToolCurve c = circular({1, 0, 5}, {0, 0, -7}, {0, 0, 1}, pi / 2);
  EXPECT_NEAR(c.length, pi / 2, 1e-15);
  EXPECT_LT(norm(end_of(c) - Vec3{0, 1, 5}), 1e-15);
  EXPECT_LT(norm(end_of(circular({1, 0, 5}, {0, 0, -7}, {0, 0, 1}, 2 * pi)) - Vec3{1, 0, 5}), 1e-15);
}

// Derivatives of the position by a polynomial of the length in time.
TEST(ToolCurve, MotionOfAPointHasItsDerivatives) {
  RandomStream random({.seed = 4});
  for (int n = 0; n < 50; ++n)
    for (const ToolCurve& c : random_curves(random)) {
      const JerkPhase phase{0, 0, {0.4 * c.length, 0.3, -0.5, 2}};
      const auto state = [&](double t) {
        const Progress p = after(phase, t);
        return moved(point_at(c, p.length), p);
      };
      // h^2 / 6 of the third derivatives, which are up to 1e6 in the tightest corners of 0.05 m; rounding of
      // 1e-16 / h.
      const double h = 1e-6;
      const PointMotion a = state(-h), m = state(0), b = state(h);
      const Vec3 p = point_at(c, after(phase, -h).length).position,
                 q = point_at(c, after(phase, h).length).position;
      EXPECT_LT(norm((1 / (2 * h)) * (q - p) - m.velocity), 1e-9);
      EXPECT_LT(norm((1 / (2 * h)) * (b.velocity - a.velocity) - m.acceleration), 1e-7);
      EXPECT_LT(norm((1 / (2 * h)) * (b.acceleration - a.acceleration) - m.jerk), 1e-5);
    }
}

TEST(ToolCurve, LimitsAlongItKeepThoseInSpace) {
  RandomStream random({.seed = 3});
  for (int n = 0; n < 300; ++n) {
    const RateLimits limits{std::pow(10, random.uniform(-1, 1)), std::pow(10, random.uniform(0, 3)),
                            std::pow(10, random.uniform(1, 6))};
    for (const ToolCurve& c : random_curves(random)) {
      const RateLimits along = limits_along(c, limits);
      const double steady = steady_speed(c, limits);
      EXPECT_GT(along.speed, 0);
      EXPECT_GT(along.acceleration, 0);
      EXPECT_GE(along.jerk, 0.399 * limits.jerk);
      EXPECT_GE(steady, along.speed * (1 - 1e-15));
      EXPECT_LE(steady, limits.speed);
      double most = steady / limits.speed;
      for (int i = 0; i <= 50; ++i) {
        const CurvePoint p = point_at(c, i / 50.0 * c.length);
        // Both are convex in speed, acceleration and jerk along, so their corners are the worst.
        for (double a : {-along.acceleration, 0.0, along.acceleration})
          for (double j : {-along.jerk, along.jerk}) {
            const PointMotion all = moved(p, {0, along.speed, a, j});
            EXPECT_LE(norm(all.acceleration), limits.acceleration * (1 + 1e-12));
            EXPECT_LE(norm(all.jerk), limits.jerk * (1 + 1e-12));
          }
        const PointMotion even = moved(p, {0, steady, 0, 0});
        EXPECT_LE(norm(even.acceleration), limits.acceleration * (1 + 1e-12));
        EXPECT_LE(norm(even.jerk), limits.jerk * (1 + 1e-12));
        most = std::max({most, norm(even.acceleration) / limits.acceleration, norm(even.jerk) / limits.jerk});
      }
      // The steady speed wastes nothing: the peaks are at samples, the middle and the ends.
      EXPECT_NEAR(most, 1, 1e-12);
    }
  }
}

}  // namespace
}  // namespace linkwright::parallel
