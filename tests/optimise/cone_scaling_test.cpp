// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/cone_scaling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/core/random.h"

namespace linkwright::optimise {
namespace {

using Entries = std::vector<double>;

// A half-line, a cone in space, and one of six rows.
ConeScaling cones() {
  ConeScaling c{.blocks = {{0, 1}, {1, 3}, {4, 6}}};
  c.reset(10);
  return c;
}
// Inside, nearer to the boundary the smaller `room`.
Entries inside(const ConeScaling& c, std::uint64_t seed, double room) {
  RandomStream random({.seed = seed});
  Entries v(10);
  for (double& x : v) x = random.normal();
  c.add_unit(c.outside(v) + room, v);
  return v;
}

TEST(ConeScaling, BringsBothPointsTogether) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    ConeScaling c = cones();
    const Entries s = inside(c, 2 * seed, 0.1), z = inside(c, 2 * seed + 1, 0.1);
    ASSERT_TRUE(c.update(s, z));
    Entries a(10), b(10), back(10);
    c.apply(z, false, a);
    c.apply(s, true, b);
    c.apply(b, false, back);
    double dot = 0, square = 0;
    for (std::size_t i = 0; i < 10; ++i) {
      // Rounding times what W stretches by, some hundreds.
      EXPECT_NEAR(a[i], b[i], 1e-11);
      EXPECT_EQ(a[i], c.lambda[i]);
      EXPECT_NEAR(back[i], s[i], 1e-11);
      dot += s[i] * z[i], square += a[i] * a[i];
    }
    EXPECT_NEAR(dot, square, 1e-10);
  }
}

TEST(ConeScaling, DividesWhatItMultiplies) {
  ConeScaling c = cones();
  ASSERT_TRUE(c.update(inside(c, 1, 0.3), inside(c, 2, 0.3)));
  const Entries x = inside(c, 3, 1);
  Entries d(10), back(10);
  c.product(c.lambda, x, d);
  c.divide(d, back);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(back[i], x[i], 1e-12);
}

TEST(ConeScaling, TheLongestStepEndsOnTheBoundary) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    ConeScaling c = cones();
    ASSERT_TRUE(c.update(inside(c, 2 * seed, 0.5), inside(c, 2 * seed + 1, 0.5)));
    Entries direction = inside(c, 100 + seed, 0);
    for (double& d : direction) d = -d;
    const double step = c.longest_step(direction);
    ASSERT_TRUE(std::isfinite(step));
    Entries end = c.lambda;
    for (std::size_t i = 0; i < 10; ++i) end[i] += step * direction[i];
    EXPECT_NEAR(c.outside(end), 0, 1e-11);
  }
  ConeScaling c = cones();
  ASSERT_TRUE(c.update(inside(c, 1, 1), inside(c, 2, 1)));
  EXPECT_EQ(c.longest_step(inside(c, 3, 0.1)), HUGE_VAL);  // further inside for ever
}

TEST(ConeScaling, NeedsPointsInside) {
  ConeScaling c = cones();
  Entries s = inside(c, 1, 1);
  const Entries z = inside(c, 2, 1);
  EXPECT_LT(c.outside(s), 0);
  s[0] = -1;
  EXPECT_FALSE(c.update(s, z));
  s[0] = 1, s[4] = 0;
  EXPECT_GT(c.outside(s), 0);
  EXPECT_FALSE(c.update(s, z));
}

}  // namespace
}  // namespace linkwright::optimise
