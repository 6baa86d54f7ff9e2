// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "linkwright/core/random.h"
#include "linkwright/parallel/tool/path.h"
#include "support/message.h"

namespace linkwright::parallel {
namespace {

using ::testing::HasSubstr;

double log_uniform(RandomStream& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

Progress at(const DoubleS& motion, double t) {
  std::size_t i = 0;
  while (i < 6 && t >= motion.phase[i + 1].start) ++i;
  return after(motion.phase[i], t - motion.phase[i].start);
}

TEST(DoubleS, HasTheDurationOfEachOfItsFourForms) {
  const RateLimits limits{2, 4, 40};
  // Every limit is met: L / V + V / A + A / J.
  EXPECT_NEAR(double_s(3, 0, 0, limits).duration, 1.5 + 0.5 + 0.1, 1e-15);
  // No cruise: the peak is 1 m/s after v / A + A / J = 0.35 s, over 0.35 m.
  EXPECT_NEAR(double_s(0.35, 0, 0, limits).duration, 0.7, 1e-15);
  // No constant acceleration either: a jerk of 40 for 0.05 s four times over 2 J t^3 = 0.01 m.
  EXPECT_NEAR(double_s(0.01, 0, 0, limits).duration, 0.2, 1e-15);
  // A cruise, but no constant acceleration: V = 0.1 = J t^2 with t = 0.05 s.
  EXPECT_NEAR(double_s(1, 0, 0, {0.1, 4, 40}).duration, 10 + 0.1, 1e-14);
  // A change of speed that takes almost all of the length: (1 + 2) / 2 m in 1 / 4 + 0.1 s.
  EXPECT_NEAR(double_s(1.5 * 0.35 * (1 + 1e-14), 1, 2, limits).duration, 0.35, 1e-14);
}

// Any length, limits over six decades, speeds that the length allows.
struct Case {
  RateLimits limits;
  double length = 0, start = 0, end = 0;
  DoubleS motion;
};
Case random_case(RandomStream& random, bool at_rest) {
  Case c;
  c.limits = {log_uniform(random, 1e-2, 1e2), log_uniform(random, 1e-1, 1e3), log_uniform(random, 1, 1e6)};
  c.length = log_uniform(random, 1e-5, 1e2);
  if (!at_rest) {
    c.start = random.uniform(0, c.limits.speed);
    const double most = reachable_speed(c.start, c.length, c.limits);
    c.end = random.below(4) == 0 ? most : random.uniform(0, c.limits.speed);
    if (c.end > most) c.end = most;
    if (c.start > reachable_speed(c.end, c.length, c.limits))
      c.start = reachable_speed(c.end, c.length, c.limits);
  }
  c.motion = double_s(c.length, c.start, c.end, c.limits);
  return c;
}

TEST(DoubleS, KeepsItsLimitsMeetsItsEndsAndIsContinuous) {
  RandomStream random({.seed = 1});
  for (int n = 0; n < 2000; ++n) {
    const Case c = random_case(random, n % 2 == 0);
    const auto& [v, a, j] = c.limits;
    const auto& phases = c.motion.phase;
    // Rounding: a few dozens of operations on numbers of the size of the limits.
    const double rounding = 1e-12;
    EXPECT_EQ(phases.front().at.length, 0);
    EXPECT_EQ(phases.front().at.speed, c.start);
    const Progress end = after(phases.back(), phases.back().duration);
    EXPECT_NEAR(end.length, c.length, rounding * c.length);
    EXPECT_NEAR(end.speed, c.end, rounding * v);
    EXPECT_NEAR(end.acceleration, 0, rounding * a);
    for (std::size_t i = 0; i < 7; ++i) {
      const Progress before = after(phases[i], phases[i].duration);
      if (i < 6) {
        const Progress next = phases[i + 1].at;
        EXPECT_NEAR(before.length, next.length, rounding * c.length);
        EXPECT_NEAR(before.speed, next.speed, rounding * v);
        EXPECT_NEAR(before.acceleration, next.acceleration, rounding * a);
      }
      for (double share : {0.0, 0.3, 0.7, 1.0}) {
        const Progress p = after(phases[i], share * phases[i].duration);
        EXPECT_LE(p.speed, v * (1 + rounding));
        EXPECT_GE(p.speed, -rounding * v);
        EXPECT_LE(std::abs(p.acceleration), a * (1 + rounding));
        EXPECT_LE(std::abs(p.jerk), j);
      }
      // Something is always at its limit: the jerk, or without it the acceleration or the speed; but for a
      // peak that is so little above the ends that a last digit of it is worth a millionth of the length.
      const double above = phases[3].at.speed - std::max(c.start, c.end);
      if (i == 3 && above < 1e-6 * v) continue;
      if (phases[i].at.jerk == 0 && phases[i].duration > 1e-6 * c.motion.duration) {
        const double limit = i == 3 ? phases[i].at.speed / v : std::abs(phases[i].at.acceleration) / a;
        EXPECT_NEAR(limit, 1, rounding) << i;
      }
    }
  }
}

TEST(DoubleS, IsFasterThanAnyOtherProfileOfTheFamily) {
  RandomStream random({.seed = 2});
  for (int n = 0; n < 60; ++n) {
    const Case c = random_case(random, true);
    const auto& [v, a, j] = c.limits;
    // A profile with peak speed p and peak acceleration q that reaches both takes L / p + p / q + q / j.
    double best = INFINITY;
    constexpr int steps = 400;
    for (int i = 0; i <= steps; ++i)
      for (int k = 0; k <= steps; ++k) {
        const double p = v * std::pow(1e-9, i / double(steps)), q = a * std::pow(1e-9, k / double(steps));
        if (p < q * q / j || c.length < p * (p / q + q / j)) continue;
        best = std::min(best, c.length / p + p / q + q / j);
      }
    EXPECT_LE(c.motion.duration, best * (1 + 1e-12));
    // Neighbours on the grid are 5.3 % apart in both peaks; near the best profile the time has half of that.
    EXPECT_GE(c.motion.duration, best / 1.06);
  }
}

TEST(DoubleS, RunsBackwardsAsForwards) {
  RandomStream random({.seed = 3});
  for (int n = 0; n < 200; ++n) {
    const Case c = random_case(random, n % 4 == 0);
    const DoubleS back = double_s(c.length, c.end, c.start, c.limits);
    EXPECT_NEAR(back.duration, c.motion.duration, 1e-13 * back.duration);
    for (double share : {0.1, 0.35, 0.5, 0.8}) {
      const double t = share * back.duration;
      const Progress p = at(c.motion, t), q = at(back, back.duration - t);
      EXPECT_NEAR(p.length, c.length - q.length, 1e-11 * c.length);
      EXPECT_NEAR(p.speed, q.speed, 1e-10 * c.limits.speed);
    }
  }
}

TEST(DoubleS, ReachesASpeedOverALengthExactly) {
  const RateLimits limits{2, 4, 40};
  // From rest to 1 m/s over 0.175 m, from there to the limit over 1.5 * 0.35 m.
  EXPECT_NEAR(reachable_speed(0, 0.175, limits), 1, 1e-14);
  EXPECT_NEAR(reachable_speed(1, 0.525, limits), 2, 1e-14);
  EXPECT_EQ(reachable_speed(1, 0.6, limits), 2);
  EXPECT_EQ(reachable_speed(2, 1e-9, limits), 2);
}

TEST(DoubleS, SaysWhatItCannotDo) {
  const RateLimits limits{2, 4, 40};
  EXPECT_THAT(test::message([&] { double_s(0, 0, 0, limits); }),
              HasSubstr("length 0 and limits 2, 4, 40 must be more than 0"));
  EXPECT_THAT(test::message([&] { double_s(1, 0, 3, limits); }),
              HasSubstr("speeds 0 and 3 must be in [0, 2]"));
  EXPECT_THAT(test::message([&] { double_s(0.1, 0, 2, limits); }),
              HasSubstr("a length of 0.1 is too short for a change of speed of 2"));
  EXPECT_THAT(test::message([&] { shape(TimeLaw::double_s, 0.5); }),
              HasSubstr("a double S has no one shape"));
}

TEST(TimeLaw, ShapesRunFromRestToRestWithTheirDerivatives) {
  for (TimeLaw law : {TimeLaw::polynomial_345, TimeLaw::cycloidal}) {
    const Progress begin = shape(law, 0), end = shape(law, 1);
    EXPECT_EQ(begin.length, 0);
    EXPECT_EQ(begin.speed, 0);
    EXPECT_EQ(begin.acceleration, 0);
    EXPECT_NEAR(end.length, 1, 1e-15);
    EXPECT_NEAR(end.speed, 0, 1e-15);
    EXPECT_NEAR(end.acceleration, 0, 2e-15);
    // Differences over h: h^2 / 6 of the third derivative of each, at most 4 pi^2 * (2 pi)^3 = 1e4 here, and
    // rounding of 1e-16 / h.
    const double h = 1e-5;
    for (double x = 0.05; x < 1; x += 0.05) {
      const Progress a = shape(law, x - h), p = shape(law, x), b = shape(law, x + h);
      EXPECT_NEAR((b.length - a.length) / (2 * h), p.speed, 1e-8);
      EXPECT_NEAR((b.speed - a.speed) / (2 * h), p.acceleration, 1e-7);
      EXPECT_NEAR((b.acceleration - a.acceleration) / (2 * h), p.jerk, 1e-6);
      EXPECT_NEAR(shape(law, 1 - x).length, 1 - p.length, 1e-15);
    }
  }
}

}  // namespace
}  // namespace linkwright::parallel
