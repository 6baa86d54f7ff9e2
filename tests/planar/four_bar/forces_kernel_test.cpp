#include "linkwright/planar/four_bar/detail/forces_kernel.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "planar/four_bars.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

// With the crank at unit speed the derivative by the crank angle is that by time: speeds against exact
// derivatives of the directions, accelerations against those of the speeds.
RC_GTEST_PROP(FourBarForcesKernelProperty, RatesAreTheExactDerivatives, ()) {
  using Jet = ceres::Jet<double, 1>;
  const FourBar l = *any_four_bar();
  const Jet angle(*any_angle(), 0), c = cos(angle), s = sin(angle), one(1.0), none(0.0);
  const FourBarShape<Jet> shape =
      four_bar_shape(Jet(l.ground * std::cos(l.frame_angle)), Jet(l.ground * std::sin(l.frame_angle)),
                     Jet(l.crank), Jet(l.coupler), Jet(l.rocker), Jet(sign(l.branch)));
  const Closure<Jet> closure = close_at_crank(shape, c, s);
  const Jet size = sine_size(shape, closure);
  RC_PRE(size.a > 0.02);
  const FourBarDirections<Jet> e = four_bar_directions(shape, c, s, closure, Jet(0.5) / closure.r2);
  const FourBarTurning<Jet> t = four_bar_turning(shape, e, one / (shape.sign * size), one, none);
  // Rounding of lengths over the shortest, and once more over the sine for each derivative.
  const double lengths = (l.ground + l.crank + l.coupler + l.rocker) / std::min(l.coupler, l.rocker);
  const double rounding = 1e-14 * lengths * lengths / (size.a * size.a);
  RC_ASSERT(std::abs(e.e2x.v[0] + t.w2.a * e.e2y.a) <= rounding);
  RC_ASSERT(std::abs(e.e2y.v[0] - t.w2.a * e.e2x.a) <= rounding);
  RC_ASSERT(std::abs(e.e3x.v[0] + t.w3.a * e.e3y.a) <= rounding);
  RC_ASSERT(std::abs(e.e3y.v[0] - t.w3.a * e.e3x.a) <= rounding);
  const double again = rounding * lengths * lengths / (size.a * size.a);
  RC_ASSERT(std::abs(t.w2.v[0] - t.a2.a) <= again);
  RC_ASSERT(std::abs(t.w3.v[0] - t.a3.a) <= again);
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
