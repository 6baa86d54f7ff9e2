// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/four_bar/detail/forces_kernel.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "linkwright/math/dual.h"
#include "planar/four_bars.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

// The derivative by the crank angle is that by time for a crank at unit speed: speeds against exact
// derivatives of the directions, accelerations against those of the speeds.
RC_GTEST_PROP(FourBarForcesKernelProperty, RatesAreTheExactDerivatives, ()) {
  using D = math::Dual<1>;
  const FourBar l = *any_four_bar();
  const D angle = D::variable(*any_angle(), 0), c = cos(angle), s = sin(angle), one(1.0), none(0.0);
  const FourBarShape<D> shape =
      four_bar_shape(D(l.ground * std::cos(l.frame_angle)), D(l.ground * std::sin(l.frame_angle)), D(l.crank),
                     D(l.coupler), D(l.rocker), D(sign(l.branch)));
  const Closure<D> closure = close_at_crank(shape, c, s);
  const D size = sine_size(shape, closure);
  RC_PRE(size.value > 0.02);
  const FourBarDirections<D> e = four_bar_directions(shape, c, s, closure, D(0.5) / closure.r2);
  const FourBarTurning<D> t = four_bar_turning(shape, e, one / (shape.sign * size), one, none);
  // Rounding of lengths over the shortest, and once more over the sine for each derivative.
  const double lengths = (l.ground + l.crank + l.coupler + l.rocker) / std::min(l.coupler, l.rocker);
  const double rounding = 1e-14 * lengths * lengths / (size.value * size.value);
  RC_ASSERT(std::abs(e.e2x.by[0] + t.w2.value * e.e2y.value) <= rounding);
  RC_ASSERT(std::abs(e.e2y.by[0] - t.w2.value * e.e2x.value) <= rounding);
  RC_ASSERT(std::abs(e.e3x.by[0] + t.w3.value * e.e3y.value) <= rounding);
  RC_ASSERT(std::abs(e.e3y.by[0] - t.w3.value * e.e3x.value) <= rounding);
  const double again = rounding * lengths * lengths / (size.value * size.value);
  RC_ASSERT(std::abs(t.w2.by[0] - t.a2.value) <= again);
  RC_ASSERT(std::abs(t.w3.by[0] - t.a3.value) <= again);
}

// A link that stands still asks for its weight, and for the moment of it.
TEST(FourBarForcesKernel, NeedOfALinkAtRestIsItsWeight) {
  const LinkNeed<double> need = link_need(LinkBase<double>{2, 0.5, 0.25, 7}, 0.0, 1.0, 0.0, 0.0, 0.0, 10.0);
  EXPECT_EQ(need.x, 0);
  EXPECT_EQ(need.y, 20);
  EXPECT_EQ(need.moment, -0.25 * 10);  // turned to the left, the mass centre lies 0.25 / 2 left of the joint
}

}  // namespace
}  // namespace linkwright::planar
