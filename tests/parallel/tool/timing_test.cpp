// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/tool/timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"

namespace linkwright::parallel {
namespace {

ToolTiming timed_path(const ToolPath& path, const ToolLimits& limits) {
  return timed(lay_out(path, {}).runs.at(0), path.law, limits);
}
double duration(const ToolPath& path, const ToolLimits& limits) { return timed_path(path, limits).duration; }

TEST(ToolTiming, LinesByOtherLawsTakeTheTimeOfTheTightestLimit) {
  // Peaks of the laws: 15/8, 10/sqrt(3), 60 and 2, 2 pi, 4 pi^2 (textbook figures).
  ToolPath path{.steps = {{ToolLine{.to = {0.5, 0, 0}}}}, .law = TimeLaw::polynomial_345};
  EXPECT_NEAR(duration(path, {.speed = 1, .acceleration = 1e3, .jerk = 1e6}), 0.5 * 1.875, 1e-15);
  EXPECT_NEAR(duration(path, {.speed = 1e3, .acceleration = 10, .jerk = 1e6}),
              std::sqrt(0.5 / 10 * 10 / std::numbers::sqrt3), 1e-15);
  EXPECT_NEAR(duration(path, {.speed = 1e3, .acceleration = 1e3, .jerk = 100}), std::cbrt(0.5 / 100 * 60),
              1e-15);
  path.law = TimeLaw::cycloidal;
  EXPECT_NEAR(duration(path, {.speed = 1, .acceleration = 1e3, .jerk = 1e6}), 0.5 * 2, 1e-15);
  EXPECT_NEAR(duration(path, {.speed = 1e3, .acceleration = 10, .jerk = 1e6}), std::sqrt(0.5 / 10 * 2 * pi),
              1e-15);
  EXPECT_NEAR(duration(path, {.speed = 1e3, .acceleration = 1e3, .jerk = 100}),
              std::cbrt(0.5 / 100 * 4 * pi * pi), 1e-15);
  // A turn decides where it is the slower one.
  std::get<ToolLine>(path.steps[0].form).rotation = Coordinates{0, 0, 3};
  EXPECT_NEAR(duration(path, {.speed = 1, .acceleration = 1e3, .jerk = 1e6, .angular_speed = 1}), 3 * 2,
              1e-14);
}

TEST(ToolTiming, FullCircleOfALawMeetsItsLimitExactly) {
  // About a radius of 0.1 m the middle, at full speed v = 15/8 L / T, needs v^2 / r = 20 m/s2; the jerk there
  // is v^3 / r^2 and no limit.
  const ToolPath path{.steps = {{ToolCircle{.centre = {0.1, 0, 0}, .angle = 2 * pi}}},
                      .law = TimeLaw::polynomial_345};
  const ToolLimits limits{.speed = 1e3, .acceleration = 20, .jerk = 1e9};
  EXPECT_NEAR(duration(path, limits), 1.875 * 0.2 * pi / std::sqrt(20 * 0.1), 1e-14);
}

TEST(ToolTiming, SpeedsAtJointsAreTheLargestFromWhichTheRestCanBeRun) {
  // A long line into a short one with a low speed: the double S of each with the speed at the joint.
  const ToolPath path{.steps = {{ToolLine{.to = {1, 0, 0}}}, {ToolLine{.to = {1.2, 0, 0}, .speed = 0.3}}},
                      .blend = true};
  const ToolLimits limits{.speed = 2, .acceleration = 10, .jerk = 200};
  const RateLimits fast{2, 10, 200}, slow{0.3, 10, 200};
  EXPECT_NEAR(duration(path, limits),
              double_s(1, 0, 0.3, fast).duration + double_s(0.2, 0.3, 0, slow).duration, 1e-14);
  // If the second is too short to stop from its limit, the joint is slower.
  const ToolPath short_end{.steps = {{ToolLine{.to = {1, 0, 0}}}, {ToolLine{.to = {1.001, 0, 0}}}},
                           .blend = true};
  const double joint = reachable_speed(0, 1.001 - 1, fast);
  EXPECT_NEAR(duration(short_end, limits),
              double_s(1, 0, joint, fast).duration + double_s(1.001 - 1, joint, 0, fast).duration, 1e-12);
}

TEST(ToolTiming, CornersBetweenLongLinesAreRunAtTheirSteadySpeed) {
  const ToolPath path{.steps = {{ToolLine{.to = {1, 0, 0}}}, {ToolLine{.to = {1, 1, 0}}}}, .corner = 0.05};
  const ToolLimits limits{.speed = 2, .acceleration = 10, .jerk = 1e3};
  const auto run = lay_out(path, {}).runs.at(0);
  const double steady = steady_speed(run.parts[1].curve, {2, 10, 1e3});
  const double side = double_s(0.95, 0, steady, {2, 10, 1e3}).duration;
  EXPECT_NEAR(timed(run, TimeLaw::double_s, limits).duration, 2 * side + run.parts[1].curve.length / steady,
              1e-13);
}

TEST(ToolTiming, EveryFormOfLimitOnlyCostsTime) {
  RandomStream random({.seed = 1});
  for (int n = 0; n < 100; ++n) {
    const ToolPath path{
        .steps = {{PickAndPlace{.to = {random.uniform(0.05, 0.5), 0, random.uniform(-0.1, 0.1)},
                                .height = random.uniform(0.01, 0.1),
                                .corner = random.uniform(0.05, 1),
                                .rotation = Coordinates{0, 0, random.uniform(0.1, 3)}}}},
        .law = n % 2 ? TimeLaw::double_s : TimeLaw::polynomial_345};
    const ToolLimits limits{.speed = random.uniform(0.1, 3),
                            .acceleration = random.uniform(1, 100),
                            .jerk = random.uniform(1e2, 1e4)};
    const double base = duration(path, limits);
    ToolLimits more = limits;
    more.angular_speed = more.angular_acceleration = more.angular_jerk = 1e9;
    EXPECT_LE(duration(path, more), base * (1 + 1e-12));
    // Twice the speed, four times the acceleration and eight times the jerk halve the time exactly.
    const ToolLimits twice{.speed = 2 * limits.speed,
                           .acceleration = 4 * limits.acceleration,
                           .jerk = 8 * limits.jerk,
                           .angular_speed = 2 * limits.angular_speed,
                           .angular_acceleration = 4 * limits.angular_acceleration,
                           .angular_jerk = 8 * limits.angular_jerk};
    EXPECT_NEAR(duration(path, twice), base / 2, 1e-9 * base);
  }
}

}  // namespace
}  // namespace linkwright::parallel
