// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/ode.h"
#include "math/oscillator.h"
#include "support/allocations.h"
#include "support/message.h"

namespace linkwright::math {
namespace {

using test::ode_methods;
using test::ode_options;
using test::oscillator;
using test::oscillator_error;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Span = std::span<const double>;

TEST(OdeEnds, StopsWhereTheRightHandSideEnds) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    const auto f = [](double t, Span y, std::span<double> rate) {
      if (t > 1.2345) return false;
      rate[0] = y[1];
      rate[1] = -y[0];
      return true;
    };
    std::array y = {1.0, 0.0};
    const auto report = integrate(f, y, 0, 3, ode_options(method, 1e-9), workspace);
    EXPECT_EQ(report.status, Status::limit_reached) << name_of(method);
    EXPECT_EQ(report.end, OdeEnd::evaluation);
    EXPECT_LE(report.t, 1.2345);
    EXPECT_GT(report.t, 1.2345 - 1e-6) << name_of(method);
    EXPECT_LT(oscillator_error(report.t, y), 1e-6) << name_of(method);
    EXPECT_THAT(report.message, HasSubstr("the right-hand side cannot be evaluated beyond t = 1.23"));
  }
  // A square root that ends: y = (1 - t / 2)^2 reaches zero at 2, and values that are not finite count as
  // false.
  std::array y = {1.0};
  const auto root = [](double, Span at, std::span<double> rate) {
    rate[0] = -std::sqrt(at[0]);
    return true;
  };
  const auto report =
      integrate(root, y, 0, 3, ode_options(OdeMethod::explicit_runge_kutta_8, 1e-8), workspace);
  EXPECT_EQ(report.status, Status::limit_reached);
  EXPECT_NEAR(report.t, 2, 0.01);
  EXPECT_LT(y[0], 1e-4);
}

TEST(OdeEnds, GoesPastAPlaceThatSmallStepsAvoid) {
  // |y| = 1 on the way; trial points of long steps leave the circle of radius 1.0005.
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    int refused = 0;
    const auto f = [&](double, Span y, std::span<double> rate) {
      if (std::hypot(y[0], y[1]) > 1.0005) return ++refused, false;
      rate[0] = y[1];
      rate[1] = -y[0];
      return true;
    };
    OdeOptions o = ode_options(method, 1e-7);
    o.initial_step = 1;
    std::array y = {1.0, 0.0};
    const auto report = integrate(f, y, 0, 4, o, workspace);
    EXPECT_EQ(report.status, Status::done) << name_of(method) << report.message;
    EXPECT_GT(refused, 0) << name_of(method);
    EXPECT_LT(oscillator_error(4, y), 1e-4) << name_of(method);
  }
}

TEST(OdeEnds, AStartThatCannotBeEvaluatedIsInfeasible) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    std::array y = {1.0, 0.5};
    const auto report = integrate([](double, Span, std::span<double>) { return false; }, y, 2, 3,
                                  ode_options(method, 1e-9), workspace);
    EXPECT_EQ(report.status, Status::infeasible);
    EXPECT_EQ(report.end, OdeEnd::evaluation);
    EXPECT_EQ(report.t, 2);
    EXPECT_EQ(report.message, "the right-hand side cannot be evaluated at the start, t = 2");
    EXPECT_THAT(y, ElementsAre(1.0, 0.5));
  }
}

TEST(OdeEnds, ReportsWhatItCannotReach) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    std::array y = {1.0, 0.0};
    ::testing::internal::CaptureStderr();
    auto report = integrate(oscillator, y, 0, 10, ode_options(method, 1e-18), workspace);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << name_of(method);
    EXPECT_EQ(report.status, Status::not_converged) << name_of(method);
    EXPECT_EQ(report.end, OdeEnd::tolerance) << name_of(method);
    EXPECT_THAT(report.message, HasSubstr("too much accuracy requested")) << name_of(method);

    OdeOptions o = ode_options(method, 1e-9);
    o.max_steps = 20;
    y = {1, 0};
    report = integrate(oscillator, y, 0, 100, o, workspace);
    EXPECT_EQ(report.status, Status::not_converged);
    EXPECT_EQ(report.end, OdeEnd::steps);
    EXPECT_EQ(report.steps, 20);
    EXPECT_THAT(report.message, HasSubstr("20 steps used up at t = "));
    EXPECT_LT(oscillator_error(report.t, y), 1e-6);

    // y = 1 / (1 - t) has a pole at 1.
    std::array pole = {1.0};
    const auto grow = [](double, Span at, std::span<double> rate) {
      rate[0] = at[0] * at[0];
      return true;
    };
    report = integrate(grow, pole, 0, 2, ode_options(method, 1e-6), workspace);
    EXPECT_NE(report.status, Status::done) << name_of(method);
    EXPECT_NEAR(report.t, 1, 1e-3) << name_of(method);
    EXPECT_FALSE(report.message.empty());
  }
}

TEST(OdeEnds, CanBeInterrupted) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    RunContext context;
    std::vector<double> fractions;
    context.set_progress([&](const Progress& progress) {
      EXPECT_EQ(progress.stage, "integration");
      fractions.push_back(progress.fraction);
      if (progress.fraction > 0.5) context.cancel();
    });
    OdeHooks hooks;
    hooks.context = &context;
    std::array y = {1.0, 0.0};
    auto report = integrate(oscillator, y, 0, 100, ode_options(method, 1e-9), hooks, workspace);
    EXPECT_EQ(report.status, Status::cancelled);
    EXPECT_EQ(report.end, OdeEnd::interrupted);
    EXPECT_GT(report.t, 50);
    EXPECT_LT(report.t, 60);
    EXPECT_LT(oscillator_error(report.t, y), 1e-4);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_LE(fractions.size(), 101u);
    EXPECT_THAT(report.message, HasSubstr("cancelled at t = 5"));

    RunContext late;
    late.set_time_limit(std::chrono::duration<double>(0));
    hooks.context = &late;
    y = {1, 0};
    report = integrate(oscillator, y, 0, 100, ode_options(method, 1e-9), hooks, workspace);
    EXPECT_EQ(report.status, Status::deadline);
    EXPECT_EQ(report.message, "time limit reached at t = 0");
    EXPECT_THAT(y, ElementsAre(1.0, 0.0));
  }
}

/// Pendulum of 1 m in Cartesian coordinates x, y, vx, vy, the rod force eliminated.
bool cartesian_pendulum(double, Span s, std::span<double> rate) {
  const double force = (s[2] * s[2] + s[3] * s[3] - 9.81 * s[1]) / (s[0] * s[0] + s[1] * s[1]);
  rate[0] = s[2];
  rate[1] = s[3];
  rate[2] = -force * s[0];
  rate[3] = -force * s[1] - 9.81;
  return true;
}

bool onto_the_rod(double, std::span<double> s) {
  const double length = std::hypot(s[0], s[1]);
  if (!(length > 0)) return false;
  s[0] /= length;
  s[1] /= length;
  const double along = s[0] * s[2] + s[1] * s[3];
  s[2] -= along * s[0];
  s[3] -= along * s[1];
  return true;
}

TEST(OdeEnds, ProjectionKeepsAPendulumOnItsRod) {
  OdeWorkspace workspace;
  for (const OdeMethod method :
       {OdeMethod::explicit_runge_kutta_5, OdeMethod::explicit_runge_kutta_8, OdeMethod::bdf}) {
    const auto off = [](Span s) {
      return std::max(std::abs(std::hypot(s[0], s[1]) - 1), std::abs(s[0] * s[2] + s[1] * s[3]));
    };
    std::array<double, 2> worst{};
    std::array<std::array<double, 4>, 2> ends{};
    for (std::size_t projected = 0; projected < 2; ++projected) {
      OdeHooks hooks;
      if (projected == 1) hooks.project = onto_the_rod;
      hooks.step = [&](double, Span s) {
        worst[projected] = std::max(worst[projected], off(s));
        return true;
      };
      const std::array outputs = {0.123, 7.7, 19.9};
      hooks.output_times = outputs;
      hooks.output = [&](double, Span s) {
        if (projected == 1) {
          EXPECT_LT(off(s), 1e-14) << name_of(method);
        }
        return true;
      };
      ends[projected] = {-1, 0, 0, 0};
      const auto report =
          integrate(cartesian_pendulum, ends[projected], 0, 20, ode_options(method, 1e-7), hooks, workspace);
      EXPECT_EQ(report.status, Status::done) << report.message;
    }
    EXPECT_GT(worst[0], 1e-9) << name_of(method);
    // A step of BDF is projected before its last correction is added up: off by the rounding of that sum, and
    // by what is left of the square of the distance.
    EXPECT_LT(worst[1], method == OdeMethod::bdf ? 1e-12 : 1e-15) << name_of(method);
    EXPECT_LT(off(ends[1]), 1e-12);
    EXPECT_NEAR(ends[0][0], ends[1][0], 1e-2) << name_of(method);
  }
}

TEST(OdeEnds, AProjectionThatFailsEndsIt) {
  OdeWorkspace workspace;
  for (const OdeMethod method :
       {OdeMethod::explicit_runge_kutta_5, OdeMethod::explicit_runge_kutta_8, OdeMethod::bdf}) {
    OdeHooks hooks;
    hooks.project = [](double t, std::span<double>) { return t < 1; };
    std::array y = {1.0, 0.0};
    const auto report = integrate(oscillator, y, 0, 3, ode_options(method, 1e-8), hooks, workspace);
    EXPECT_EQ(report.status, Status::limit_reached) << name_of(method);
    EXPECT_LT(report.t, 1);
    EXPECT_GT(report.t, 1 - 1e-6) << name_of(method);
  }
}

TEST(OdeEnds, ExceptionsPassThrough) {
  OdeWorkspace workspace;
  for (const OdeMethod method : ode_methods) {
    const auto f = [](double t, Span y, std::span<double> rate) {
      if (t > 1) throw std::runtime_error("from f");
      return oscillator(t, y, rate);
    };
    std::array y = {1.0, 0.0};
    EXPECT_THROW(integrate(f, y, 0, 3, ode_options(method, 1e-8), workspace), std::runtime_error)
        << name_of(method);
    if (method != OdeMethod::adams) {
      OdeHooks hooks;
      hooks.project = [](double t, std::span<double>) -> bool {
        return t < 1 ? true : throw std::domain_error("from the projection");
      };
      EXPECT_THROW(integrate(oscillator, y, 0, 3, ode_options(method, 1e-8), hooks, workspace),
                   std::domain_error);
    }
    y = {1, 0};
    EXPECT_EQ(integrate(oscillator, y, 0, 3, ode_options(method, 1e-8), workspace).status, Status::done);
    EXPECT_LT(oscillator_error(3, y), 1e-5);
  }
}

TEST(OdeEnds, RepeatsBitForBitWithoutAllocating) {
  for (const OdeMethod method : ode_methods)
    for (const std::size_t n : {std::size_t{2}, std::size_t{50}}) {
      const auto chain = [](double, Span y, std::span<double> rate) {
        for (std::size_t j = 0; j + 1 < y.size(); j += 2) {
          rate[j] = y[j + 1];
          rate[j + 1] = -y[j] + (j > 0 ? 0.1 * y[j - 2] : 0);
        }
        return true;
      };
      const std::array<OdeEvent, 2> events = {};
      std::vector<double> outputs = {0.5, 1.5, 2.5};
      OdeHooks hooks;
      hooks.events = events;
      hooks.event_values = [](double, Span y, std::span<double> values) {
        values[0] = y[0];
        values[1] = y[1];
      };
      hooks.event = [](double, std::span<const std::size_t> which, std::span<double> y) {
        if (which.front() == 1) return OdeAction::go_on;
        y[1] = -0.9 * y[1];
        return OdeAction::restart;
      };
      hooks.output_times = outputs;
      hooks.output = [](double, Span) { return true; };
      OdeWorkspace workspace;
      std::vector<double> y(n), first;
      const auto run = [&] {
        std::fill(y.begin(), y.end(), 0);
        y[0] = 1;
        return integrate(chain, y, 0, 10, ode_options(method, 1e-8), hooks, workspace);
      };
      EXPECT_GT(run().events, 3);
      first = y;
      const auto before = test::allocations();
      const auto report = run();
      // CVODE makes three small blocks for a Newton iteration at every start and restart.
      const long allowed = method == OdeMethod::bdf ? 3 * (report.events + 1) : 0;
      EXPECT_LE(static_cast<long>(test::allocations() - before), allowed) << name_of(method) << ' ' << n;
      EXPECT_EQ(report.status, Status::done);
      EXPECT_EQ(y, first) << name_of(method);
    }
}

TEST(OdeEnds, AWorkspaceServesAnyProblem) {
  OdeWorkspace moved;
  OdeWorkspace workspace = std::move(moved);
  for (const double to : {5.0, -5.0})
    for (const OdeMethod method : ode_methods) {
      std::array y = {1.0, 0.0};
      integrate(oscillator, y, 0, to, ode_options(method, 1e-9), workspace);
      EXPECT_LT(oscillator_error(to, y), 1e-6) << name_of(method);
      std::array one = {1.0};
      const auto decay = [](double, Span at, std::span<double> rate) { return rate[0] = -at[0], true; };
      integrate(decay, one, 0, 1, ode_options(method, 1e-9), moved);
      EXPECT_NEAR(one[0], std::exp(-1.0), 1e-6);
    }
}

TEST(OdeEnds, ContractsAreChecked) {
  OdeWorkspace workspace;
  std::array y = {1.0, 0.0};
  const auto text = [&](const OdeOptions& o, const OdeHooks& hooks, double to = 1) {
    return test::message([&] { integrate(oscillator, y, 0, to, o, hooks, workspace); });
  };
  EXPECT_THAT(test::message([&] { integrate(oscillator, {}, 0, 1, {}, workspace); }),
              HasSubstr("no components"));
  EXPECT_THAT(text({}, {}, infinity), HasSubstr("interval from 0 to inf"));
  std::array bad = {1.0, std::nan("")};
  EXPECT_THAT(test::message([&] { integrate(oscillator, bad, 0, 1, {}, workspace); }),
              HasSubstr("y[1] = nan at the start"));
  EXPECT_THAT(text({.relative_tolerance = -1}, {}), HasSubstr("tolerances -1 and"));
  EXPECT_THAT(text({.absolute_tolerances = std::span<const double>(y).first(1)}, {}),
              HasSubstr("1 absolute tolerances for 2 components"));
  EXPECT_THAT(text({.max_step = 0}, {}), HasSubstr("longest step 0"));
  EXPECT_THAT(text({.max_steps = -3}, {}), HasSubstr("check: -3 steps"));
  EXPECT_THAT(text({.event_tolerance = -1}, {}), HasSubstr("event tolerance -1"));
  EXPECT_THAT(text({.lower_bandwidth = 1}, {}), HasSubstr("bandwidths 1 and -1: both, for bdf"));
  EXPECT_THAT(text({.method = OdeMethod::bdf, .lower_bandwidth = 2, .upper_bandwidth = 0}, {}),
              HasSubstr("bandwidths 2 and 0 of 2 equations"));
  OdeHooks hooks;
  hooks.jacobian = [](double, Span, std::span<double>) { return true; };
  EXPECT_THAT(text({.method = OdeMethod::adams}, hooks), HasSubstr("adams uses no Jacobian"));
  hooks = {};
  hooks.project = [](double, std::span<double>) { return true; };
  EXPECT_THAT(text({.method = OdeMethod::adams}, hooks), HasSubstr("adams cannot project"));
  const std::array<OdeEvent, 1> events = {};
  hooks = {};
  hooks.events = events;
  EXPECT_THAT(text({}, hooks), HasSubstr("1 events without their function"));
  const std::array late = {0.5, 2.0}, unordered = {0.5, 0.4};
  hooks = {};
  hooks.output_times = late;
  EXPECT_THAT(text({}, hooks), HasSubstr("2 output times without their function"));
  hooks.output = [](double, Span) { return true; };
  EXPECT_THAT(text({}, hooks), HasSubstr("output time 2 after 0.5, between 0 and 1"));
  hooks.output_times = unordered;
  EXPECT_THAT(text({}, hooks), HasSubstr("output time 0.4 after 0.5"));
}

TEST(OdeEnds, EndsHaveNames) {
  EXPECT_EQ(name_of(OdeEnd::step_size), "step_size");
  EXPECT_EQ(name_of(OdeMethod::explicit_runge_kutta_8), "explicit_runge_kutta_8");
}

}  // namespace
}  // namespace linkwright::math
