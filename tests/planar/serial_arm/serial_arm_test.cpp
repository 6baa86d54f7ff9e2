// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/serial_arm/serial_arm.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/differences.h"
#include "planar/serial_arm_cases.h"
#include "support/allocations.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

TEST(SerialArm, StandsWhereItsAnglesSay) {
  const SerialArm arm{{1, 2}, {{2, {}, {}}, {1, {}, {}}, {0.5, {}, {}}}};
  const std::vector<ArmElement> e = elements(arm);
  const std::vector<math::Motion> motion = {{pi / 2}, {0}, {pi}};  // absolute: up, right, left
  std::vector<ArmLinkRates> r(3);
  rates(e, arm.base, motion, r);
  const auto near = [](std::complex<double> a, std::complex<double> b) { EXPECT_LT(std::abs(a - b), 1e-15); };
  near(r[0].joint.position, {1, 2});
  near(r[1].joint.position, {1, 4});
  near(r[2].joint.position, {2, 4});
  near(point(r[2], 0.5).position, {1.5, 4});
  near(point(r[1], {0, 1}).position, {1, 5});  // left of a link along x
}

// Velocity and acceleration of joints and of a point of the last link against differences in time.
RC_GTEST_PROP(SerialArmProperty, RatesAreTheDerivativesOfPositions, ()) {
  const std::size_t n = static_cast<std::size_t>(*rc::gen::inRange(1, 6));
  const SerialArm arm = test::any_arm(n);
  const std::vector<ArmElement> e = elements(arm);
  const std::vector<math::Motion> start = test::any_motion(n);
  const std::complex<double> place(*test::between(-2, 2), *test::between(-2, 2));
  const auto function = [&](std::span<const double> t, std::span<double> out, std::span<double> jacobian) {
    std::vector<math::Motion> m = start;
    for (math::Motion& k : m) {
      k.value += k.rate * t[0] + k.acceleration * t[0] * t[0] / 2;
      k.rate += k.acceleration * t[0];
    }
    std::vector<ArmLinkRates> r(n);
    rates(e, arm.base, m, r);
    std::size_t row = 0;
    const auto put = [&](const ArmPointMotion& p) {
      for (const auto& [value, rate] : {std::pair{p.position, p.velocity}, {p.velocity, p.acceleration}}) {
        out[row] = value.real(), out[row + 1] = value.imag();
        if (!jacobian.empty()) jacobian[row] = rate.real(), jacobian[row + 1] = rate.imag();
        row += 2;
      }
    };
    put(point(r.back(), place));
    put(r[n / 2].joint);
    return true;
  };
  // The fastest link turns with up to 8 rad/s and gains 40 rad/s2.
  const double t[1] = {0}, scale[1] = {0.05};
  RC_ASSERT(math::check_jacobian(function, 8, t, scale).passed);
}

TEST(SerialArm, RatesAllocateNothing) {
  const SerialArm arm{0, {{2, {}, {}}, {1, {}, {}}}};
  const std::vector<ArmElement> e = elements(arm);
  const std::vector<math::Motion> motion(2);
  std::vector<ArmLinkRates> r(2);
  const std::size_t before = test::allocations();
  rates(e, arm.base, motion, r);
  EXPECT_EQ(test::allocations(), before);
}

TEST(SerialArm, RejectsWhatIsNoArm) {
  EXPECT_THAT(test::message([] { elements({}); }), HasSubstr("an arm has at least one link"));
  EXPECT_THAT(test::message([] {
                elements({0, {{1, {}, {}}, {0, {}, {}}}});
              }),
              HasSubstr("length 0 of link 2 must be positive and finite"));
  std::vector<ArmLinkRates> r(1);
  EXPECT_THAT(test::message([&] { rates({}, 0, {}, r); }), HasSubstr("0 motions and 1 rates for 0 links"));
}

}  // namespace
}  // namespace linkwright::planar
