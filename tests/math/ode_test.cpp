// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/ode.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "math/oscillator.h"
#include "support/published.h"

namespace linkwright::math {
namespace {

using test::ode_methods;
using test::ode_options;
using test::oscillator;
using test::oscillator_error;
using ::testing::ElementsAre;
using Span = std::span<const double>;

TEST(Ode, EveryMethodFollowsTheTolerance) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    double previous = 1;
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      std::array y = {1.0, 0.0};
      const auto report = integrate(oscillator, y, 0, 20, ode_options(method, tolerance), workspace);
      EXPECT_EQ(report.status, Status::done) << name_of(method);
      EXPECT_EQ(report.t, 20);
      EXPECT_GT(report.evaluations, report.steps);
      const double error = oscillator_error(20, y);
      // Some tens (order 8) to thousands (BDF) of steps, each within the tolerance, on a circle that keeps
      // errors.
      EXPECT_LT(error, 1000 * tolerance) << name_of(method) << ' ' << tolerance;
      EXPECT_LT(error, 0.1 * previous) << name_of(method) << ' ' << tolerance;
      previous = error;
    }
  }
}

// Steps of equal length: tolerances so wide that max_step alone rules.
TEST(Ode, RungeKuttaPairsHaveTheirOrders) {
  OdeWorkspace workspace;
  for (const auto& [method, order, step] :
       {std::tuple{OdeMethod::explicit_runge_kutta_5, 5, 0.1}, {OdeMethod::explicit_runge_kutta_8, 8, 0.5}}) {
    std::array<double, 2> errors{};
    for (int i = 0; i < 2; ++i) {
      OdeOptions o = ode_options(method, 1e3);
      o.initial_step = o.max_step = i == 0 ? step : step / 2;
      std::array y = {1.0, 0.0};
      const auto report = integrate(oscillator, y, 0, 10, o, workspace);
      EXPECT_NEAR(static_cast<double>(report.steps), 10 / o.max_step, 1);
      errors[static_cast<std::size_t>(i)] = oscillator_error(10, y);
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), order, 0.3) << name_of(method) << ' ' << errors[0];
  }
}

TEST(Ode, TimeDependentRightHandSide) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    std::array y = {0.0};
    // y = sin(t^2)
    const auto f = [](double t, Span, std::span<double> rate) {
      rate[0] = 2 * t * std::cos(t * t);
      return true;
    };
    integrate(f, y, 0, 4, ode_options(method, 1e-9), workspace);
    EXPECT_NEAR(y[0], std::sin(16.0), 1e-6) << name_of(method);
  }
}

TEST(Ode, KeepsTheEnergyOfAnOscillator) {
  OdeWorkspace workspace;
  std::array y = {1.0, 0.0};
  double worst = 0;
  OdeHooks hooks;
  hooks.step = [&](double, Span at) {
    worst = std::max(worst, std::abs(at[0] * at[0] + at[1] * at[1] - 1));
    return true;
  };
  const auto report = integrate(oscillator, y, 0, 200 * pi,
                                ode_options(OdeMethod::explicit_runge_kutta_8, 1e-11), hooks, workspace);
  EXPECT_EQ(report.status, Status::done);
  EXPECT_LT(worst, 1e-8);  // 100 turns of some 30 steps, each within 1e-11 and mostly in phase
  EXPECT_LT(oscillator_error(200 * pi, y), 1e-8);
}

TEST(Ode, GoesBackTheWayItCame) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    std::array y = {1.0, 0.0};
    std::vector<double> times;
    const std::array outputs = {5.0, 2.0, -3.0};
    OdeHooks hooks;
    hooks.output_times = outputs;
    hooks.output = [&](double t, Span at) {
      times.push_back(t);
      EXPECT_LT(oscillator_error(t, at), 2e-6) << name_of(method);
      return true;
    };
    integrate(oscillator, y, 0, 7, ode_options(method, 1e-9), workspace);
    integrate(oscillator, y, 7, -3, ode_options(method, 1e-9), hooks, workspace);
    EXPECT_LT(oscillator_error(-3, y), 2e-6) << name_of(method);
    EXPECT_THAT(times, ElementsAre(5.0, 2.0, -3.0));
  }
}

TEST(Ode, AnEmptyIntervalIsDone) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    std::array y = {0.3, -0.2};
    const std::array outputs = {2.0};
    int told = 0;
    OdeHooks hooks;
    hooks.output_times = outputs;
    hooks.output = [&](double, Span) { return ++told, true; };
    const auto report = integrate(oscillator, y, 2, 2, ode_options(method, 1e-9), hooks, workspace);
    EXPECT_EQ(report.status, Status::done);
    EXPECT_EQ(report.end, OdeEnd::time);
    EXPECT_EQ(report.steps, 0);
    EXPECT_EQ(report.t, 2);
    EXPECT_EQ(told, 1);
    EXPECT_THAT(y, ElementsAre(0.3, -0.2));
  }
}

// Values between steps are as accurate as accurate as what is delivered at their ends.
TEST(Ode, OutputsAreAsAccurateAsSteps) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods)
    for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-11}) {
      std::vector<double> outputs;
      for (int i = 0; i <= 3000; ++i) outputs.push_back(0.01 * i);
      double at_outputs = 0, at_steps = 0;
      OdeHooks hooks;
      hooks.output_times = outputs;
      hooks.output = [&](double t, Span y) {
        at_outputs = std::max(at_outputs, oscillator_error(t, y));
        return true;
      };
      hooks.step = [&](double t, Span y) {
        at_steps = std::max(at_steps, oscillator_error(t, y));
        return true;
      };
      std::array y = {1.0, 0.0};
      const auto report = integrate(oscillator, y, 0, 30, ode_options(method, tolerance), hooks, workspace);
      EXPECT_EQ(report.status, Status::done);
      EXPECT_LT(at_outputs, 1.5 * at_steps + tolerance) << name_of(method) << ' ' << tolerance;
    }
}

TEST(Ode, StepsDoNotDependOnOutputs) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    std::array<std::array<double, 2>, 2> ends{};
    for (std::size_t run = 0; run < 2; ++run) {
      std::vector<double> outputs;
      for (int i = 0; i <= 1000; ++i) outputs.push_back(0.01 * i);
      OdeHooks hooks;
      if (run == 1) {
        hooks.output_times = outputs;
        hooks.output = [](double, Span) { return true; };
      }
      ends[run] = {1.0, 0.0};
      integrate(oscillator, ends[run], 0, 10, ode_options(method, 1e-7), hooks, workspace);
    }
    EXPECT_EQ(ends[0], ends[1]) << name_of(method);
  }
}

TEST(Ode, HooksEndIt) {
  OdeWorkspace workspace;
  const std::array outputs = {1.0, 2.0, 3.0};
  OdeHooks hooks;
  hooks.output_times = outputs;
  hooks.output = [](double t, Span) { return t < 2; };
  std::array y = {1.0, 0.0};
  auto report =
      integrate(oscillator, y, 0, 3, ode_options(OdeMethod::explicit_runge_kutta_8, 1e-9), hooks, workspace);
  EXPECT_EQ(report.status, Status::done);
  EXPECT_EQ(report.end, OdeEnd::hook);
  EXPECT_EQ(report.t, 2);
  EXPECT_LT(oscillator_error(2, y), 1e-7);

  hooks = {};
  hooks.step = [](double t, Span) { return t < 1; };
  y = {1, 0};
  report =
      integrate(oscillator, y, 0, 3, ode_options(OdeMethod::explicit_runge_kutta_8, 1e-9), hooks, workspace);
  EXPECT_EQ(report.end, OdeEnd::hook);
  EXPECT_GE(report.t, 1);
  EXPECT_LT(report.t, 3);
  EXPECT_LT(oscillator_error(report.t, y), 1e-7);
}

// IFToMM benchmark A01: a pendulum of 1 m, let go horizontally; the published data start at x = -1 m.
TEST(Ode, PublishedPendulumKeepsItsPhaseFor2000Seconds) {
  const Value& published = test::published_case("multibody-benchmarks.json", "A01-simple-pendulum");
  const Value& samples = test::at(published, "published.samples_t_x_y_m");
  std::vector<double> times;
  std::vector<std::array<double, 2>> positions;
  for (const Value& sample : samples.as_array()) {
    const auto row = test::numbers(sample);
    times.push_back(row[0]);
    positions.push_back({row[1], row[2]});
  }
  ASSERT_EQ(times.back(), 2000);
  const double g = test::number_at(published, "inputs.g_m_per_s2");
  const auto pendulum = [g](double, Span y, std::span<double> rate) {  // angle from the vertical
    rate[0] = y[1];
    rate[1] = -g * std::sin(y[0]);
    return true;
  };
  OdeWorkspace workspace;
  for (const OdeMethod method :
       {OdeMethod::explicit_runge_kutta_5, OdeMethod::explicit_runge_kutta_8, OdeMethod::adams}) {
    std::size_t next = 0;
    OdeHooks hooks;
    hooks.output_times = times;
    hooks.output = [&](double t, Span y) {
      // Half a unit of the sixth printed digit, and as much for what the error of the period does to the
      // phase.
      EXPECT_NEAR(std::sin(y[0]), positions[next][0], 1e-6) << name_of(method) << " t = " << t;
      EXPECT_NEAR(-std::cos(y[0]), positions[next][1], 1e-6) << name_of(method) << " t = " << t;
      ++next;
      return true;
    };
    std::array y = {-pi / 2, 0.0};
    OdeOptions o = ode_options(method, 1e-13);
    o.max_steps = 10'000'000;
    const auto report = integrate(pendulum, y, 0, 2000, o, hooks, workspace);
    EXPECT_EQ(report.status, Status::done) << report.message;
    EXPECT_EQ(next, times.size());
    EXPECT_NEAR(0.5 * y[1] * y[1] - g * std::cos(y[0]), 0, 1e-5) << name_of(method);
  }
}

// One step each: the polynomial inside is no worse than the step.
TEST(Ode, InnerStatesAreAsAccurateAsTheStep) {
  OdeWorkspace workspace;
  const auto exact = [](double t) { return std::array{1 / (1 + 0.5 * t * t), std::exp(std::sin(t))}; };
  const auto f = [](double t, Span y, std::span<double> rate) {
    rate[0] = -t * y[0] * y[0];
    rate[1] = y[1] * std::cos(t);
    return true;
  };
  for (const auto& [method, step] : {std::tuple{OdeMethod::explicit_runge_kutta_5, 0.3},
                                     {OdeMethod::explicit_runge_kutta_5, 0.05},
                                     {OdeMethod::explicit_runge_kutta_8, 1.2},
                                     {OdeMethod::explicit_runge_kutta_8, 0.3}}) {
    std::vector<double> outputs;
    for (int i = 0; i <= 40; ++i) outputs.push_back(step * i / 40);
    double worst = 0, last = 0;
    OdeHooks hooks;
    hooks.output_times = outputs;
    hooks.output = [&](double t, Span y) {
      const auto expected = exact(t);
      last = std::hypot(y[0] - expected[0], y[1] - expected[1]);
      worst = std::max(worst, last);
      return true;
    };
    OdeOptions o = ode_options(method, 1e3);
    o.initial_step = o.max_step = step;
    std::array y = exact(0);
    const auto report = integrate(f, y, 0, step, o, hooks, workspace);
    EXPECT_EQ(report.steps, 1);
    EXPECT_LE(worst, 1.5 * last) << name_of(method) << ' ' << step;
  }
}

/// Stiff: y0 follows cos t within 1e-5 at once; y1 decays slowly; y2 oscillates.
bool stiff(double t, Span y, std::span<double> rate) {
  rate[0] = -1e5 * (y[0] - std::cos(t)) - std::sin(t);
  rate[1] = -y[1];
  rate[2] = 0.5 * y[1] - y[2];
  return true;
}

TEST(Ode, BdfTakesLongStepsThroughStiffEquations) {
  OdeWorkspace workspace;
  OdeOptions o = ode_options(OdeMethod::bdf, 1e-8);
  const auto error = [](Span y) {
    return std::abs(y[0] - std::cos(10.0)) + std::abs(y[1] - std::exp(-10.0)) +
           std::abs(y[2] - 6 * std::exp(-10.0));
  };
  for (int kind = 0; kind < 3; ++kind) {
    OdeHooks hooks;
    int asked = 0;
    if (kind == 1) {
      o.lower_bandwidth = 1;
      o.upper_bandwidth = 0;
    }
    if (kind == 2) {
      o.lower_bandwidth = o.upper_bandwidth = -1;
      hooks.jacobian = [&](double, Span, std::span<double> jacobian) {
        ++asked;
        std::fill(jacobian.begin(), jacobian.end(), 0);
        jacobian[0] = -1e5;
        jacobian[4] = -1;
        jacobian[5] = 0.5;
        jacobian[8] = -1;
        return true;
      };
    }
    std::array y = {0.0, 1.0, 1.0};
    const auto report = integrate(stiff, y, 0, 10, o, hooks, workspace);
    EXPECT_EQ(report.status, Status::done) << report.message;
    EXPECT_LT(error(y), 1e-6) << kind;
    EXPECT_LT(report.steps, 1000) << kind;  // an explicit method is held to 1e-5 a step by stability
    EXPECT_EQ(asked > 0, kind == 2);
    if (kind == 2) {
      EXPECT_LT(report.evaluations, 2 * report.steps);
    }
  }
}

TEST(Ode, ToleranceOfEachComponent) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    // Lengths in m and in nm: one absolute tolerance would not do for both.
    const auto f = [](double, Span y, std::span<double> rate) {
      rate[0] = y[1] * 1e-9;
      rate[1] = -y[0] * 1e9;
      return true;
    };
    const std::array tolerances = {1e-9, 1.0};
    OdeOptions o = ode_options(method, 1e-13);
    o.absolute_tolerances = tolerances;
    std::array y = {1.0, 0.0};
    const auto report = integrate(f, y, 0, 10, o, workspace);
    EXPECT_EQ(report.status, Status::done);
    EXPECT_NEAR(y[0], std::cos(10.0), 1e-6) << name_of(method);
    EXPECT_NEAR(y[1] * 1e-9, -std::sin(10.0), 1e-6) << name_of(method);
    EXPECT_GT(std::abs(y[0] - std::cos(10.0)), 1e-13) << name_of(method);
  }
}

}  // namespace
}  // namespace linkwright::math
