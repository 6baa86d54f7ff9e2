// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/slider_crank.h"

#include <gmock/gmock.h>

#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {
namespace {

// Boskovic 2018, Eqs. (4.9)-(4.11), whose H is the offset counted the other way.
TEST(SliderCrank, IsTheSourcesMechanismOnBothSides) {
  SliderCrankMechanism m;
  m.parameters = {.crank = 0.4,
                  .rod = 1.1,
                  .offset = 0.2,
                  .guide_angle = 0.4,
                  .pivot_x = 0.3,
                  .pivot_y = -0.1,
                  .rod_u = 0.5,
                  .rod_v = 0.2};
  for (const SliderSide side : {SliderSide::forward, SliderSide::backward}) {
    m.branch = side;
    const Linkage l = slider_crank(m);
    const PlanResult planned = plan_linkage(l);
    ASSERT_TRUE(planned.problems.empty());
    LinkageMotion motion(planned.plan);
    for (int i = 0; i < 36; ++i) {
      const double angle = i * pi / 18;
      const double across = std::asin((0.2 - 0.4 * std::sin(angle - 0.4)) / 1.1);
      const double rod = 0.4 + (side == SliderSide::forward ? across : pi - across);
      const auto c = std::complex<double>(0.3, -0.1) + std::polar(0.4, angle) +
                     std::polar(1.0, rod) * std::complex<double>(0.5, 0.2);
      solve_position(planned.plan, std::vector<InputMotion>{{angle, 0, 0}}, motion);
      const math::Vec2 there = point_motion(planned.plan, motion, 2, {0.5, 0.2}).position;
      EXPECT_NEAR(there.x, c.real(), 1e-14);
      EXPECT_NEAR(there.y, c.imag(), 1e-14);
    }
  }
}

TEST(SliderCrank, PutsMassCentresFromTheJointsOfTheirLinks) {
  SliderCrankMechanism m;
  m.parameters = {.crank = 0.05, .rod = 0.15};
  m.masses = SliderCrankMasses{.crank = {1, 2e-3, 0.01, pi}, .rod = {0.5, 1e-3, 0.05, 0}, .slider = 0.4};
  const Linkage l = slider_crank(m);
  EXPECT_NEAR(l.bodies[1].mass->centre.real(), -0.01, 1e-17);
  EXPECT_EQ(l.bodies[2].mass->centre, std::complex<double>(0.05, 0));
  EXPECT_EQ(l.bodies[3].mass->mass, 0.4);
}

}  // namespace
}  // namespace linkwright::planar
