// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/ode.h"
#include "math/oscillator.h"

namespace linkwright::math {
namespace {

using test::ode_methods;
using test::ode_options;
using test::oscillator;
using ::testing::ElementsAre;
using Span = std::span<const double>;

struct Impact {
  double t, speed;
};

/// A ball let go from 1 m, restitution 0.8, until `count` impacts: flights are 2 v / g long.
std::vector<Impact> impacts(double g, std::size_t count) {
  std::vector<Impact> out;
  double t = std::sqrt(2 / g), v = std::sqrt(2 * g);
  for (std::size_t i = 0; i < count; ++i) {
    out.push_back({t, v});
    v *= 0.8;
    t += 2 * v / g;
  }
  return out;
}

TEST(OdeEvents, BouncingBallMeetsTheFloorEveryTime) {
  constexpr double g = 9.81;
  const auto ball = [](double, Span y, std::span<double> rate) {
    rate[0] = y[1];
    rate[1] = -g;
    return true;
  };
  const auto expected = impacts(g, 40);
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods)
    // Output every 0.1 s, every 1 ms, and none.
    for (const int outputs : {0, 40, 4000}) {
      std::vector<double> times;
      for (int i = 1; i <= outputs; ++i) times.push_back(4.0 * i / outputs);
      std::vector<Impact> found;
      const std::array events = {OdeEvent{.crossing = OdeCrossing::falling}};
      OdeHooks hooks;
      hooks.output_times = times;
      if (outputs > 0) hooks.output = [](double, Span) { return true; };
      hooks.events = events;
      hooks.event_values = [](double, Span y, std::span<double> values) { values[0] = y[0]; };
      hooks.event = [&](double t, std::span<const std::size_t> which, std::span<double> y) {
        EXPECT_THAT(which, ElementsAre(0u));
        EXPECT_NEAR(y[0], 0, 1e-10);
        found.push_back({t, -y[1]});
        y[1] *= -0.8;
        return found.size() == expected.size() ? OdeAction::stop : OdeAction::restart;
      };
      std::array y = {1.0, 0.0};
      // BDF and Adams need small steps to follow even a parabola.
      const auto report = integrate(ball, y, 0, 10, ode_options(method, 1e-12), hooks, workspace);
      EXPECT_EQ(report.status, Status::done) << report.message;
      EXPECT_EQ(report.end, OdeEnd::event) << name_of(method);
      EXPECT_EQ(report.event, 0u);
      EXPECT_EQ(report.events, 40);
      ASSERT_EQ(found.size(), expected.size()) << name_of(method) << ' ' << outputs;
      // Every flight adds the 1e-12 of its end twice, and the steps of Runge-Kutta are exact on a parabola.
      // Those of the others are not: some 1e-11 of the height are 1e-11 / speed of the time,
      // down to 1 mm/s.
      const bool exact =
          method == OdeMethod::explicit_runge_kutta_5 || method == OdeMethod::explicit_runge_kutta_8;
      const double tolerance = exact ? 1e-10 : 1e-7;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(found[i].t, expected[i].t, tolerance) << name_of(method) << " impact " << i;
        EXPECT_NEAR(found[i].speed, expected[i].speed, 10 * tolerance) << name_of(method) << " impact " << i;
      }
    }
}

std::vector<double> crossings(OdeMethod method, OdeCrossing crossing, double level, double to,
                              double from = 0) {
  OdeWorkspace workspace;
  std::vector<double> found;
  const std::array events = {OdeEvent{.crossing = crossing}};
  OdeHooks hooks;
  hooks.events = events;
  hooks.event_values = [&](double, Span y, std::span<double> values) { values[0] = y[0] - level; };
  hooks.event = [&](double t, std::span<const std::size_t>, std::span<double>) {
    found.push_back(t);
    return OdeAction::go_on;
  };
  std::array y = {std::cos(from), -std::sin(from)};
  EXPECT_EQ(integrate(oscillator, y, from, to, ode_options(method, 1e-11), hooks, workspace).status,
            Status::done);
  return found;
}

TEST(OdeEvents, DirectionsAreThoseOfTheIntegration) {
  using ::testing::DoubleNear;
  for (const OdeMethod method : ode_methods) {
    const auto at = [](double t) { return DoubleNear(t, 1e-8); };
    EXPECT_THAT(crossings(method, OdeCrossing::falling, 0, 10), ElementsAre(at(pi / 2), at(5 * pi / 2)));
    EXPECT_THAT(crossings(method, OdeCrossing::rising, 0, 10), ElementsAre(at(3 * pi / 2)));
    EXPECT_THAT(crossings(method, OdeCrossing::either, 0, 10),
                ElementsAre(at(pi / 2), at(3 * pi / 2), at(5 * pi / 2)));
    // Backwards from 10, where the cosine is negative.
    EXPECT_THAT(crossings(method, OdeCrossing::rising, 0, 0, 10), ElementsAre(at(5 * pi / 2), at(pi / 2)));
    EXPECT_THAT(crossings(method, OdeCrossing::falling, 0, 0, 10), ElementsAre(at(3 * pi / 2)));
  }
}

TEST(OdeEvents, GrazingIsSeenBothWays) {
  for (const OdeMethod method : ode_methods)
    for (const double depth : {1e-1, 1e-3, 1e-5, 1e-7}) {
      // -cos t > 1 - depth within acos(1 - depth) of pi: both crossings within one step of the pair of
      // order 8.
      const double half = std::acos(1 - depth);
      const auto found = crossings(method, OdeCrossing::either, depth - 1, 6);
      ASSERT_EQ(found.size(), 2u) << name_of(method) << ' ' << depth;
      // An error of y of some 1e-9 moves a grazing crossing by 1e-9 / sin(half).
      EXPECT_NEAR(found[0], pi - half, 1e-8 / half) << name_of(method) << ' ' << depth;
      EXPECT_NEAR(found[1], pi + half, 1e-8 / half) << name_of(method) << ' ' << depth;
      EXPECT_TRUE(crossings(method, OdeCrossing::either, -1 - depth, 6).empty())
          << name_of(method) << ' ' << depth;
    }
}

TEST(OdeEvents, SimultaneousEventsComeTogether) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    const std::array<OdeEvent, 4> events = {};
    std::vector<std::vector<std::size_t>> found;
    OdeHooks hooks;
    hooks.events = events;
    hooks.event_values = [](double, Span y, std::span<double> values) {
      values[0] = y[0];         // pi / 2
      values[1] = y[1] + 0.5;   // pi / 6
      values[2] = -y[0] * 3;    // pi / 2
      values[3] = y[0] * y[1];  // pi / 2
    };
    hooks.event = [&](double, std::span<const std::size_t> which, std::span<double>) {
      found.emplace_back(which.begin(), which.end());
      return OdeAction::go_on;
    };
    std::array y = {1.0, -1e-3};  // so that the last one is not zero at the start
    integrate(oscillator, y, 0, 2, ode_options(method, 1e-10), hooks, workspace);
    EXPECT_THAT(found, ElementsAre(ElementsAre(1u), ElementsAre(0u, 2u, 3u))) << name_of(method);
  }
}

TEST(OdeEvents, NothingHappensAtTheStart) {
  for (const OdeMethod method : ode_methods) {
    // cos t - 1 starts at zero without slope, sin t with one.
    EXPECT_THAT(crossings(method, OdeCrossing::falling, 0, 1, -pi / 2), ::testing::IsEmpty());
    EXPECT_THAT(crossings(method, OdeCrossing::either, 0, pi, pi / 2), ::testing::IsEmpty());
    EXPECT_THAT(crossings(method, OdeCrossing::either, 1, 3), ::testing::IsEmpty());
    EXPECT_THAT(crossings(method, OdeCrossing::either, 0, 5, pi / 2),
                ElementsAre(::testing::DoubleNear(3 * pi / 2, 1e-8)));
  }
}

TEST(OdeEvents, TerminalEventsEnd) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    const std::array events = {OdeEvent{.terminal = false}, OdeEvent{.terminal = true}};
    OdeHooks hooks;
    hooks.events = events;
    hooks.event_values = [](double, Span y, std::span<double> values) {
      values[0] = y[1] + 0.5;
      values[1] = y[0];
    };
    const std::array outputs = {1.0, 1.5, 1.6, 2.0};
    std::vector<double> told;
    hooks.output_times = outputs;
    hooks.output = [&](double t, Span) { return told.push_back(t), true; };
    std::array y = {1.0, 0.0};
    const auto report = integrate(oscillator, y, 0, 10, ode_options(method, 1e-10), hooks, workspace);
    EXPECT_EQ(report.status, Status::done);
    EXPECT_EQ(report.end, OdeEnd::event);
    EXPECT_EQ(report.event, 1u);
    EXPECT_EQ(report.events, 2);
    EXPECT_NEAR(report.t, pi / 2, 1e-7);
    EXPECT_NEAR(y[0], 0, 1e-11);
    EXPECT_NEAR(y[1], -1, 1e-7);
    EXPECT_THAT(told, ElementsAre(1.0, 1.5)) << name_of(method);
  }
}

// A pulse that lasts 1e-3 of a step: found with the steps that `max_step` allows.
TEST(OdeEvents, MaxStepGuardsShortPulses) {
  OdeWorkspace workspace;
  const std::array<OdeEvent, 1> events = {};
  OdeHooks hooks;
  hooks.events = events;
  hooks.event_values = [](double t, Span, std::span<double> values) {
    values[0] = std::abs(t - 3.21) < 0.01 ? -1 : 1;
  };
  OdeOptions o = ode_options(OdeMethod::explicit_runge_kutta_8, 1e-6);
  o.max_step = 0.1;
  std::array y = {1.0, 0.0};
  std::vector<double> found;
  hooks.event = [&](double t, std::span<const std::size_t>, std::span<double>) {
    found.push_back(t);
    return OdeAction::go_on;
  };
  integrate(oscillator, y, 0, 10, o, hooks, workspace);
  EXPECT_THAT(found, ElementsAre(::testing::DoubleNear(3.2, 1e-11), ::testing::DoubleNear(3.22, 1e-11)));
}

TEST(OdeEvents, AccumulatingImpactsDoNotHang) {
  // Restitution 0.5: infinitely many impacts before 3 sqrt(2 / g) = 1.354 s.
  OdeWorkspace workspace;
  const std::array events = {OdeEvent{.crossing = OdeCrossing::falling}};
  OdeHooks hooks;
  hooks.events = events;
  hooks.event_values = [](double, Span y, std::span<double> values) { values[0] = y[0]; };
  double slowest = 1;
  hooks.event = [&](double, std::span<const std::size_t>, std::span<double> y) {
    slowest = std::min(slowest, -y[1]);
    y[1] *= -0.5;
    return OdeAction::restart;
  };
  OdeOptions o = ode_options(OdeMethod::explicit_runge_kutta_5, 1e-9);
  o.max_steps = 2000;
  std::array y = {1.0, 0.0};
  const auto fall = [](double, Span at, std::span<double> rate) {
    rate[0] = at[1];
    rate[1] = -9.81;
    return true;
  };
  const auto report = integrate(fall, y, 0, 2, o, hooks, workspace);
  EXPECT_LE(report.steps, 2000);
  EXPECT_GT(report.events, 25);
  EXPECT_LT(slowest, 1e-7);
}

}  // namespace
}  // namespace linkwright::math
