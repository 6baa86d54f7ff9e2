// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/input_shaping.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flexible/beams.h"
#include "linkwright/core/numbers.h"
#include "linkwright/flexible/modes.h"
#include "linkwright/flexible/simulation.h"
#include "support/message.h"

namespace linkwright::flexible {
namespace {

TEST(InputShaping, UndampedShapersOfTheLiterature) {
  const ShapedMode mode{.frequency = 2 * pi};
  const auto zv = impulses(Shaper::zv, mode), zvd = impulses(Shaper::zvd, mode),
             ei = impulses(Shaper::ei, mode, 0.05);
  ASSERT_EQ(zv.size(), 2);
  EXPECT_DOUBLE_EQ(zv[0].share, 0.5);
  EXPECT_DOUBLE_EQ(zv[1].time, 0.5);
  ASSERT_EQ(zvd.size(), 3);
  EXPECT_DOUBLE_EQ(zvd[0].share, 0.25);
  EXPECT_DOUBLE_EQ(zvd[1].share, 0.5);
  EXPECT_DOUBLE_EQ(zvd[2].time, 1);
  ASSERT_EQ(ei.size(), 3);
  EXPECT_DOUBLE_EQ(ei[0].share, 1.05 / 4);
  EXPECT_DOUBLE_EQ(ei[1].share, 0.95 / 2);
}

TEST(InputShaping, LeavesWhatTheTheorySays) {
  for (const double damping : {0.0, 0.02, 0.2}) {
    const ShapedMode mode{.frequency = 3, .damping = damping};
    const auto zv = impulses(Shaper::zv, mode), zvd = impulses(Shaper::zvd, mode),
               ei = impulses(Shaper::ei, mode, 0.05);
    EXPECT_NEAR(residual_vibration(zv, mode), 0, 1e-15);
    EXPECT_NEAR(residual_vibration(zvd, mode), 0, 1e-15);
    EXPECT_LE(residual_vibration(ei, mode), 0.05 + 1e-12);
    const ShapedMode off{.frequency = 3.1, .damping = damping};
    EXPECT_GT(residual_vibration(zv, off), 10 * residual_vibration(zvd, off));
  }
  // Widths of the band with at most 5 % left, as shares of the frequency: 0.06, 0.29, 0.40 (Singhose et al.
  // 1990).
  const auto width = [](Shaper shaper) {
    const auto list = impulses(shaper, {.frequency = 1}, 0.05);
    double low = 1, high = 1;
    while (residual_vibration(list, {.frequency = low}) <= 0.05 + 1e-9) low -= 1e-4;
    while (residual_vibration(list, {.frequency = high}) <= 0.05 + 1e-9) high += 1e-4;
    return high - low;
  };
  EXPECT_NEAR(width(Shaper::zv), 0.06, 0.005);
  EXPECT_NEAR(width(Shaper::zvd), 0.29, 0.005);
  EXPECT_NEAR(width(Shaper::ei), 0.40, 0.005);
}

TEST(InputShaping, TwoShapersForTwoVibrations) {
  const ShapedMode one{.frequency = 3}, two{.frequency = 20, .damping = 0.01};
  const auto both = combined(impulses(Shaper::zv, one), impulses(Shaper::zvd, two));
  ASSERT_EQ(both.size(), 6);
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    sum += both[i].share;
    if (i > 0) {
      EXPECT_GE(both[i].time, both[i - 1].time);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-15);
  EXPECT_NEAR(residual_vibration(both, one), 0, 1e-15);
  EXPECT_NEAR(residual_vibration(both, two), 0, 1e-15);
}

// From rest to rest by a constant acceleration and a constant braking, in 0.8 s.
struct BangBang {
  HubMotion operator()(double t) const {
    const double a = 0.3, half = 0.4;
    if (t <= 0) return {.angle = 0.1};
    if (t < half) return {0.1 + a * t * t / 2, a * t, a};
    if (t < 2 * half)
      return {0.1 + a * half * half - a * (2 * half - t) * (2 * half - t) / 2, a * (2 * half - t), -a};
    return {0.1 + a * half * half};
  }
};

TEST(InputShaping, StopsALinkWithoutVibration) {
  const Chain chain = discretise(torque_beam(), 4);
  const double breaks[] = {0.4, 0.8};
  const double w = modes(chain, 1)[0].frequency, w2 = modes(chain, 2)[1].frequency;
  const auto left = [&](std::span<const Impulse> list) {
    const auto stops = shaped_breaks(breaks, list);
    const Simulation run =
        simulate_motion(chain, [&](double t) { return shaped(BangBang{}, list, t); },
                        {.end = stops.back() + 3, .output_interval = 0.005, .step = 0.0025, .breaks = stops});
    EXPECT_EQ(run.status, Status::done);
    EXPECT_NEAR(run.samples.back().angle, 0.1 + 0.048, 1e-12);
    return std::max(largest(run.samples, &Sample::tip_eta, stops.back(), 99).value,
                    -smallest(run.samples, &Sample::tip_eta, stops.back(), 99).value);
  };
  const std::vector<Impulse> none = {{}};
  const double unshaped = left(none);
  EXPECT_GT(unshaped, 0.05);
  const auto zv = impulses(Shaper::zv, {w});
  EXPECT_LT(left(zv), 0.03 * unshaped);  // the rest is the second mode
  EXPECT_LT(left(combined(zv, impulses(Shaper::zv, {w2}))), 0.003 * unshaped);
  // Shaped for a frequency ten per cent off.
  const double zv_off = left(impulses(Shaper::zv, {1.1 * w})),
               zvd_off = left(impulses(Shaper::zvd, {1.1 * w}));
  EXPECT_LT(zvd_off, 0.4 * zv_off);
  EXPECT_LT(left(impulses(Shaper::ei, {1.1 * w})), zv_off);
}

TEST(InputShaping, EvenMotionStaysEven) {
  // A law that moves before time 0 is late by the mean of the impulses, without jumps.
  const auto list = impulses(Shaper::zv, {.frequency = 5});
  const auto even = [](double t) { return HubMotion{.angle = 1 + 2 * t, .rate = 2}; };
  for (const double t : {0.0, 0.1, list[1].time, 3.0}) {
    EXPECT_NEAR(shaped(even, list, t).angle, 1 + 2 * (t - list[1].time / 2), 1e-12);
    EXPECT_DOUBLE_EQ(shaped(even, list, t).rate, 2);
  }
}

TEST(InputShaping, ShapedTorqueHasTheSameImpulse) {
  const auto list = impulses(Shaper::zvd, {.frequency = 5, .damping = 0.1});
  const auto law = [](double t) { return t < 1 ? 3.0 : 0.0; };
  double sum = 0;
  for (int i = 0; i < 30000; ++i) sum += shaped_torque(law, list, (i + 0.5) * 1e-4) * 1e-4;
  EXPECT_NEAR(sum, 3, 1e-3);
  EXPECT_EQ(shaped_torque(law, list, -0.1), 0);
  const auto stops = shaped_breaks(std::vector{1.0}, list);
  EXPECT_EQ(stops.size(), 6);
  EXPECT_EQ(stops[0], 0);
}

TEST(InputShaping, RefusesWhatMakesNoSense) {
  EXPECT_NE(test::message([] { impulses(Shaper::zv, {.frequency = 0}); }).find("a frequency of 0 rad/s"),
            std::string::npos);
  EXPECT_NE(test::message([] {
              impulses(Shaper::zv, {.frequency = 1, .damping = 1});
            }).find("a damping ratio of 1"),
            std::string::npos);
  EXPECT_NE(
      test::message([] { impulses(Shaper::ei, {.frequency = 1}, 0); }).find("0 of the vibration to remain"),
      std::string::npos);
}

}  // namespace
}  // namespace linkwright::flexible
