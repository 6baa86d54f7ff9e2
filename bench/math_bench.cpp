// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/math/ode.h"

namespace linkwright::math {
namespace {

// The cost of an integration besides the right-hand side: two components that cost nothing, ten turns.
void ode_overhead(benchmark::State& state, OdeMethod method, bool events) {
  OdeOptions o;
  o.method = method;
  o.relative_tolerance = o.absolute_tolerance = 1e-7;
  const std::array<OdeEvent, 1> watched = {};
  OdeHooks hooks;
  if (events) {
    hooks.events = watched;
    hooks.event_values = [](double, std::span<const double> y, std::span<double> values) {
      values[0] = y[0] - 2;
    };
  }
  const auto f = [](double, std::span<const double> y, std::span<double> rate) {
    rate[0] = y[1];
    rate[1] = -y[0];
    return true;
  };
  OdeWorkspace workspace;
  long evaluations = 0, steps = 0;
  double error = 0;
  for (auto _ : state) {
    std::array y = {1.0, 0.0};
    const OdeReport report = integrate(f, y, 0, 20 * pi, o, hooks, workspace);
    evaluations += report.evaluations;
    steps = report.steps;
    error = std::hypot(y[0] - 1, y[1]);
  }
  state.SetItemsProcessed(evaluations);
  state.counters["steps"] = static_cast<double>(steps);
  state.counters["calls"] = static_cast<double>(evaluations) / static_cast<double>(state.iterations());
  state.counters["error"] = error;
  state.counters["time_per_call"] = benchmark::Counter(
      static_cast<double>(evaluations), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(ode_overhead, explicit_runge_kutta_5, OdeMethod::explicit_runge_kutta_5, false);
BENCHMARK_CAPTURE(ode_overhead, explicit_runge_kutta_8, OdeMethod::explicit_runge_kutta_8, false);
BENCHMARK_CAPTURE(ode_overhead, explicit_runge_kutta_8_event, OdeMethod::explicit_runge_kutta_8, true);
BENCHMARK_CAPTURE(ode_overhead, adams, OdeMethod::adams, false);
BENCHMARK_CAPTURE(ode_overhead, bdf, OdeMethod::bdf, false);

}  // namespace
}  // namespace linkwright::math
