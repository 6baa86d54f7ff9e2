// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/four_bar/problem.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

FourBar random_crank_rocker(RandomStream& r) {
  const double a1 = r.uniform(0.1, 2), a2 = r.uniform(0.1, 2), a3 = r.uniform(0.1, 2);
  return {.ground = 1 + 0.5 * (a2 + a3),
          .crank = 1,
          .coupler = 1 + 0.5 * (a1 + a2),
          .rocker = 1 + 0.5 * (a1 + a3),
          .coupler_u = r.uniform(-2, 2),
          .coupler_v = r.uniform(-2, 2),
          .branch = r.bits() % 2 ? Branch::open : Branch::crossed};
}

// Every way to give four targets one of their local nearest places on the path, in order within one turn:
// enumerated. The assignment is at least as good; where no order presses it is the same.
TEST(AssignCrankAngles, IsTheBestOfAllWaysInOrder) {
  constexpr int fine = 4000;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    RandomStream r({.seed = seed});
    const FourBar l = random_crank_rocker(r);
    const double sense = r.bits() % 2 ? 1 : -1;
    PathProblem p;
    p.closed = r.bits() % 2;
    for (int k = 0; k < 4; ++k) {
      p.x.push_back(r.uniform(-2, 2));
      p.y.push_back(r.uniform(-2, 2));
    }
    std::vector<Complex> path(fine);
    for (int s = 0; s < fine; ++s) path[s] = position(l, sense * 2 * pi * s / fine).coupler_point;
    std::vector<std::vector<int>> places(4);
    const auto cost = [&](int k, int s) {
      return std::norm(path[(s + fine) % fine] - Complex(p.x[k], p.y[k]));
    };
    for (int k = 0; k < 4; ++k)
      for (int s = 0; s < fine; ++s)
        if (cost(k, s) <= cost(k, s - 1) && cost(k, s) <= cost(k, s + 1)) places[k].push_back(s);
    double best = infinity;
    for (int a : places[0])
      for (int b : places[1])
        for (int c : places[2])
          for (int d : places[3]) {
            const auto on = [&](int s) { return (s - a + fine) % fine; };
            if (on(b) <= on(c) && on(c) <= on(d))
              best = std::min(best, cost(0, a) + cost(1, b) + cost(2, c) + cost(3, d));
          }
    const auto found = assign_crank_angles(p, l, sense, 0);
    ASSERT_TRUE(found) << seed;
    EXPECT_LE(found->error, best * (1 + 1e-3) + 1e-6) << seed;
    double turned = 0;
    for (int k = 0; k + 1 < 4; ++k) {
      const double step = sense * (found->angles[k + 1] - found->angles[k]);
      EXPECT_GE(step, 0) << seed;
      turned += step;
    }
    EXPECT_LE(turned, 2 * pi) << seed;
    double error = 0;
    for (int k = 0; k < 4; ++k)
      error += std::norm(position(l, found->angles[k]).coupler_point - Complex(p.x[k], p.y[k]));
    EXPECT_NEAR(error, found->error, 1e-12);
  }
}

// Points of the linkage's own curve, wherever the first one lies: nothing is missed, crossings and all.
TEST(AssignCrankAngles, FindsTheAnglesOfItsOwnCurve) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    RandomStream r({.seed = seed, .run = 1});
    const FourBar l = random_crank_rocker(r);
    const double sense = r.bits() % 2 ? 1 : -1, first = r.uniform(-10, 10);
    PathProblem p;
    const int n = 40;
    for (int k = 0; k < n; ++k) {
      const Complex c = position(l, first + sense * 2 * pi * k / n).coupler_point;
      p.x.push_back(c.real());
      p.y.push_back(c.imag());
    }
    const auto found = assign_crank_angles(p, l, sense, 0);
    ASSERT_TRUE(found);
    // The grid is half a degree; the parabola leaves the square of it.
    EXPECT_LT(found->error, n * 1e-6) << seed;
    for (int k = 0; k < n; ++k) {
      const double off = std::remainder(found->angles[k] - (first + sense * 2 * pi * k / n), 2 * pi);
      EXPECT_LT(std::abs(off), 0.03) << seed << " " << k;
    }
  }
}

TEST(AssignCrankAngles, StaysWithinTheInputsOfARocker) {
  const FourBar l{
      .ground = 2, .crank = 1.5, .coupler = 1.2, .rocker = 1.1, .coupler_u = 0.8, .coupler_v = 0.5};
  const AngleInterval inputs = classify(l).inputs.front();
  PathProblem p;
  p.closed = false;
  for (int k = 0; k < 10; ++k) {
    const Complex c = position(l, 0.1 + 0.05 * k).coupler_point;
    p.x.push_back(c.real());
    p.y.push_back(c.imag());
  }
  for (double near : {0.2, 0.2 + 2 * pi, 0.2 - 4 * pi}) {
    const auto found = assign_crank_angles(p, l, 1, near);
    ASSERT_TRUE(found);
    EXPECT_LT(found->error, 1e-7);
    for (double angle : found->angles) EXPECT_TRUE(angle > inputs.from && angle < inputs.to);
  }
  EXPECT_FALSE(assign_crank_angles(p, l, 1, pi));  // does not assemble there
}

}  // namespace
}  // namespace linkwright::planar
