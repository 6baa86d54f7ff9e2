// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/detail/kernel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/random.h"
#include "linkwright/math/dual.h"
#include "linkwright/math/simd.h"

namespace linkwright::planar {
namespace {

using Batch = math::BaselineBatch;
using math::Dual;

TEST(SliderCrankPathKernel, TheRodIsOfItsLengthAndItsEndLiesOnTheGuide) {
  RandomStream r({.seed = 1});
  for (int i = 0; i < 500; ++i) {
    const double crank = r.uniform(0.1, 1), offset = r.uniform(-1, 1);
    const double rod = crank + std::abs(offset) + r.uniform(0, 1), phase = r.uniform(0, 6.3);
    for (const double side : {1.0, -1.0}) {
      const double across = crank * std::sin(phase);
      const RodClosure<double> c = close_rod(across, offset, 1 / rod);
      const math::Vec2 v = rod_direction(c, side);
      EXPECT_NEAR(norm(v), 1, 1e-15);
      EXPECT_NEAR(across + rod * v.y, offset, 4e-16 * (rod + crank));
      EXPECT_GE(side * v.x, 0);
    }
  }
}

TEST(SliderCrankPathKernel, ARodThatDoesNotReachIsFiniteAndFlagged) {
  const RodClosure<double> c = close_rod(0.2, 1.5, 1.0);
  EXPECT_LT(c.radicand, 0);
  EXPECT_EQ(rod_direction(c, 1.0).x, 0);
  EXPECT_EQ(rod_direction(c, 1.0).y, 1.3);
}

// The range of the slider's way over a turn sampled in 0.1 degrees: second order in the step.
TEST(SliderCrankPathKernel, TheStrokeIsTheRangeOfTheWay) {
  RandomStream r({.seed = 2});
  for (int i = 0; i < 40; ++i) {
    const double crank = r.uniform(0.1, 1), offset = r.uniform(-1, 1);
    const double rod = crank + std::abs(offset) + r.uniform(0.05, 1);
    double low = 1e9, high = -1e9;
    for (int k = 0; k < 3600; ++k) {
      const double phase = k * 6.283185307179586 / 3600;
      const double s = crank * std::cos(phase) +
                       rod * rod_direction(close_rod(crank * std::sin(phase), offset, 1 / rod), 1.0).x;
      low = std::min(low, s);
      high = std::max(high, s);
    }
    EXPECT_NEAR(slider_stroke(crank, rod, offset), high - low, 2e-5);
    EXPECT_GE(slider_stroke(crank, rod, offset), 2 * crank * (1 - 1e-15));
  }
  // A short crank loses no digits: in line with the guide its stroke is twice its length.
  EXPECT_NEAR(slider_stroke(1e-12, 1.0, 0.0) / 2e-12, 1, 1e-15);
  // A rod that just lets the crank turn: the inner dead point is at the foot of the pivot.
  EXPECT_NEAR(slider_stroke(0.5, 1.25, 0.75), std::sqrt(1.75 * 1.75 - 0.75 * 0.75), 1e-15);
}

TEST(SliderCrankPathKernel, NumbersDualNumbersAndRegistersAgree) {
  RandomStream r({.seed = 3});
  for (int i = 0; i < 200; ++i) {
    const double crank = r.uniform(0.1, 1), offset = r.uniform(-1, 1), phase = r.uniform(0, 6.3);
    const double rod = crank + std::abs(offset) + r.uniform(0.1, 1), across = crank * std::sin(phase);
    for (const double side : {1.0, -1.0}) {
      const RodClosure<double> c = close_rod(across, offset, 1 / rod);
      const math::Vec2 v = rod_direction(c, side);
      const RodClosure<Batch> lanes = close_rod(Batch(across), Batch(offset), Batch(1 / rod));
      const math::Vector2<Batch> w = rod_direction(lanes, Batch(side));
      EXPECT_EQ(w.x.get(0), v.x);
      EXPECT_EQ(w.y.get(1), v.y);
      EXPECT_EQ(slider_stroke(Batch(crank), Batch(rod), Batch(offset)).get(1),
                slider_stroke(crank, rod, offset));
      // Derivatives by crank sine and offset against the closed form dpsi = dsine / cosine.
      using D = Dual<2>;
      const RodClosure<D> dual = close_rod(D::variable(across, 0), D::variable(offset, 1), D(1 / rod));
      const math::Vector2<D> d = rod_direction(dual, D(side));
      EXPECT_EQ(d.x.value, v.x);
      EXPECT_NEAR(d.y.by[0], -1 / rod, 1e-14);
      EXPECT_NEAR(d.x.by[1], -v.y / (rod * v.x), 1e-12 / std::abs(v.x));
    }
  }
}

}  // namespace
}  // namespace linkwright::planar
