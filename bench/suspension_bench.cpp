#include <benchmark/benchmark.h>

#include "linkwright/suspension/derivatives.h"
#include "linkwright/suspension/samples.h"
#include "linkwright/suspension/wheel_parameters.h"

namespace linkwright::suspension {
namespace {

// What is asked of each position.
enum Task { position, rates, parameters };

// Travel from -80 to +80 mm in steps of 5 mm at some racks, each position from the one before.
void sweep(benchmark::State& state, const char* name, Task task) {
  constexpr int count = 33;
  const GuidePlan plan = prepare(guide_sample(name).guide);
  const GuidePosition reference = reference_position(plan);
  std::int64_t done = 0;
  for (auto _ : state)
    for (double rack : {-0.03, 0.0, 0.03}) {
      GuidePosition at = solve_position(plan, Driver::wheel_centre_z, {-0.08, rack}, reference);
      for (int i = 0; i < count; ++i) {
        at = solve_position(plan, Driver::wheel_centre_z, {-0.08 + 0.005 * i, rack}, at);
        if (at.status != Status::done) state.SkipWithError("a position failed");
        benchmark::DoNotOptimize(at);
        if (task == rates) benchmark::DoNotOptimize(solve_rates(plan, at, Driver::wheel_centre_z));
        if (task == parameters) benchmark::DoNotOptimize(wheel_parameters(plan, at));
      }
      done += count;
    }
  state.SetItemsProcessed(done);
}

void guide_5KS_position(benchmark::State& s) { sweep(s, "5KS", position); }
void guide_5KS_rates(benchmark::State& s) { sweep(s, "5KS", rates); }
void guide_5KS_parameters(benchmark::State& s) { sweep(s, "5KS", parameters); }
void guide_double_wishbone_parameters(benchmark::State& s) { sweep(s, "2RS-KS", parameters); }
void guide_strut_parameters(benchmark::State& s) { sweep(s, "SP-3KS", parameters); }
void guide_trapezoidal_parameters(benchmark::State& s) { sweep(s, "RR-KS", parameters); }
BENCHMARK(guide_5KS_position)->Unit(benchmark::kMicrosecond);
BENCHMARK(guide_5KS_rates)->Unit(benchmark::kMicrosecond);
BENCHMARK(guide_5KS_parameters)->Unit(benchmark::kMicrosecond);
BENCHMARK(guide_double_wishbone_parameters)->Unit(benchmark::kMicrosecond);
BENCHMARK(guide_strut_parameters)->Unit(benchmark::kMicrosecond);
BENCHMARK(guide_trapezoidal_parameters)->Unit(benchmark::kMicrosecond);

// Both limits of travel to 1e-11 m.
void guide_5KS_limits(benchmark::State& state) {
  const GuidePlan plan = prepare(guide_sample("5KS").guide);
  const GuidePosition reference = reference_position(plan);
  for (auto _ : state) benchmark::DoNotOptimize(travel_limits(plan, Driver::wheel_centre_z, 0, reference));
}
BENCHMARK(guide_5KS_limits)->Unit(benchmark::kMicrosecond);

// Derivatives of all parameters at a position, for all thirty coordinates of the rods or for the first nine.
void derivatives(benchmark::State& state, std::size_t count, Extent extent) {
  const WheelGuide& guide = guide_sample("5KS").guide;
  std::vector<DesignNumber> numbers = hard_points(guide);
  numbers.resize(count);
  const DerivativePlan plan = prepare_derivatives(guide, numbers);
  const GuidePosition at =
      solve_position(plan.plan, Driver::wheel_centre_z, {0.03, 0.02}, reference_position(plan.plan));
  for (auto _ : state) benchmark::DoNotOptimize(wheel_derivatives(plan, at, extent));
}
BENCHMARK_CAPTURE(derivatives, rods, 30, Extent::all)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(derivatives, nine_coordinates, 9, Extent::all)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(derivatives, nine_coordinates_at_rest, 9, Extent::at_rest)->Unit(benchmark::kMicrosecond);

void derivatives_along_travel(benchmark::State& state) {
  const DerivativePlan plan = prepare_derivatives(guide_sample("5KS").guide, {});
  const GuidePosition at =
      solve_position(plan.plan, Driver::wheel_centre_z, {0.03, 0.02}, reference_position(plan.plan));
  for (auto _ : state) benchmark::DoNotOptimize(input_derivatives(plan, at));
}
BENCHMARK(derivatives_along_travel)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace linkwright::suspension
