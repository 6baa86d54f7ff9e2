// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "linkwright/suspension/compliance/compliance.h"
#include "linkwright/suspension/compliance/statics.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/axle.h"
#include "linkwright/suspension/wheel/derivatives.h"
#include "linkwright/suspension/wheel/parameters.h"

namespace linkwright::suspension {
namespace {

// The task at each position.
enum Task { position, rates, parameters };

// Travel from -80 to +80 mm in steps of 5 mm at some racks, each position from the one before.
void sweep(benchmark::State& state, const char* name, Task task) {
  constexpr int count = 33;
  const CornerPlan plan = prepare_suspension(corner_sample(name).suspension);
  const CornerPosition reference = reference_position(plan);
  std::int64_t done = 0;
  for (auto _ : state)
    for (double rack : {-0.03, 0.0, 0.03}) {
      CornerPosition at = solve_position(plan, Driver::wheel_centre_z, {-0.08, rack}, reference);
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

void corner_5US_position(benchmark::State& s) { sweep(s, "5US", position); }
void corner_5US_rates(benchmark::State& s) { sweep(s, "5US", rates); }
void corner_5US_parameters(benchmark::State& s) { sweep(s, "5US", parameters); }
void corner_double_wishbone_parameters(benchmark::State& s) { sweep(s, "2RS-US", parameters); }
void corner_strut_parameters(benchmark::State& s) { sweep(s, "SP-3US", parameters); }
void corner_trapezoidal_parameters(benchmark::State& s) { sweep(s, "RR-US", parameters); }
BENCHMARK(corner_5US_position)->Unit(benchmark::kMicrosecond);
BENCHMARK(corner_5US_rates)->Unit(benchmark::kMicrosecond);
BENCHMARK(corner_5US_parameters)->Unit(benchmark::kMicrosecond);
BENCHMARK(corner_double_wishbone_parameters)->Unit(benchmark::kMicrosecond);
BENCHMARK(corner_strut_parameters)->Unit(benchmark::kMicrosecond);
BENCHMARK(corner_trapezoidal_parameters)->Unit(benchmark::kMicrosecond);

// Both limits of travel to 1e-11 m.
void corner_5US_limits(benchmark::State& state) {
  const CornerPlan plan = prepare_suspension(corner_sample("5US").suspension);
  const CornerPosition reference = reference_position(plan);
  for (auto _ : state) benchmark::DoNotOptimize(travel_limits(plan, Driver::wheel_centre_z, 0, reference));
}
BENCHMARK(corner_5US_limits)->Unit(benchmark::kMicrosecond);

// A suspension with rubber in every joint, elastic in all six directions but for balls, or with rods that
// yield along their line only: the whole compliance with all joint forces at one position.
enum Elastic { rubber, rods };
void compliance(benchmark::State& state, const char* name, Elastic elastic, bool preloaded) {
  const Suspension& suspension = corner_sample(name).suspension;
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition at =
      solve_position(plan, Driver::wheel_centre_z, {0.03, 0.01}, reference_position(plan));
  CornerElasticity elasticity{.spring = 3e4};
  for (const CornerLink& link : suspension.links) {
    LinkElasticity& joints = elasticity.links.emplace_back();
    if (elastic == rods) {
      joints.body = {{.translation = {1.5e7, rigid, rigid}}};
      continue;
    }
    joints.body.assign(body_points(link.type), bushing(2e6, 8e6, 40, 1500));
    joints.carrier.assign(carrier_points(link.type), ball_joint(1e8));
  }
  const std::optional<PointLoad> load =
      preloaded ? std::optional(PointLoad{plan.contact, {0, 0, 4000}}) : std::nullopt;
  for (auto _ : state) {
    const Compliance found = solve_compliance(suspension, at.place, 0.01, elasticity, Support::spring, load);
    if (found.status != Status::done) state.SkipWithError("singular");
    benchmark::DoNotOptimize(found.at_centre);
  }
}
void compliance_5US_rubber(benchmark::State& s) { compliance(s, "5US", rubber, false); }
void compliance_5US_rods(benchmark::State& s) { compliance(s, "5US", rods, false); }
void compliance_5US_rubber_preloaded(benchmark::State& s) { compliance(s, "5US", rubber, true); }
void compliance_double_wishbone_rubber(benchmark::State& s) { compliance(s, "2RS-US", rubber, false); }
BENCHMARK(compliance_5US_rubber)->Unit(benchmark::kMicrosecond);
BENCHMARK(compliance_5US_rods)->Unit(benchmark::kMicrosecond);
BENCHMARK(compliance_5US_rubber_preloaded)->Unit(benchmark::kMicrosecond);
BENCHMARK(compliance_double_wishbone_rubber)->Unit(benchmark::kMicrosecond);

/// Both wheels of an axle with 20 bushings at 11 travels and 5 racks, positions included: at most 200 ms.
void compliance_axle_of_20_bushings(benchmark::State& state) {
  const Suspension left = corner_sample("5US").suspension;
  CornerElasticity elasticity{.spring = 3e4};
  for (std::size_t i = 0; i < left.links.size(); ++i)
    elasticity.links.push_back({{bushing(2e6, 8e6, 40, 1500)}, {bushing(9e6, 2e7, 90, 2500)}});
  for (auto _ : state)
    for (const Suspension& suspension : {left, mirrored(left)}) {
      const CornerPlan plan = prepare_suspension(suspension);
      const CornerPosition reference = reference_position(plan);
      for (int i = 0; i < 11; ++i)
        for (int k = 0; k < 5; ++k) {
          const CornerInput input{-0.05 + 0.01 * i, -0.04 + 0.02 * k};
          const CornerPosition at = solve_position(plan, Driver::wheel_centre_z, input, reference);
          const Compliance found =
              solve_compliance(suspension, at.place, input.rack, elasticity, Support::contact_held);
          if (found.status != Status::done) state.SkipWithError("singular");
          benchmark::DoNotOptimize(found.at_centre);
        }
    }
}
BENCHMARK(compliance_axle_of_20_bushings)->Unit(benchmark::kMillisecond);

void forces_5US(benchmark::State& state) {
  const Suspension& suspension = corner_sample("5US").suspension;
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition at = reference_position(plan);
  const WheelLoad load = load_at(plan.wheel.centre, plan.contact, {-1000, 2000, 4000});
  for (auto _ : state) benchmark::DoNotOptimize(solve_forces(suspension, plan, at, load, Support::spring));
}
BENCHMARK(forces_5US)->Unit(benchmark::kMicrosecond);

// Both wheels over roll from -5 to +5 degrees in steps of half a degree, with everything that is reported.
void axle_roll_double_wishbone(benchmark::State& state) {
  const AxlePlan plan = prepare_axle(corner_sample("2RS-US").suspension);
  std::vector<double> values;
  for (int i = -10; i <= 10; ++i) values.push_back(i * 0.5 / 57.3);
  for (auto _ : state) benchmark::DoNotOptimize(sweep_axle(plan, AxleMotion::roll, values));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(values.size()));
}
BENCHMARK(axle_roll_double_wishbone)->Unit(benchmark::kMicrosecond);

/// 5 heaves, 10 rolls and 10 racks with all columns: at most 50 ms.
void axle_grid_of_500(benchmark::State& state) {
  const AxlePlan plan = prepare_axle(corner_sample("2RS-US").suspension);
  std::vector<double> heaves, rolls, racks;
  for (int i = 0; i < 5; ++i) heaves.push_back(-0.06 + 0.03 * i);
  for (int i = 0; i < 10; ++i) rolls.push_back(-0.07 + 0.015 * i), racks.push_back(-0.05 + 0.011 * i);
  for (auto _ : state) benchmark::DoNotOptimize(solve_axle_grid(plan, heaves, rolls, racks));
}
BENCHMARK(axle_grid_of_500)->Unit(benchmark::kMillisecond);

// Derivatives of all parameters at a position, for all thirty coordinates of the rods or for the first nine.
void derivatives(benchmark::State& state, std::size_t count, Extent extent) {
  const Suspension& suspension = corner_sample("5US").suspension;
  std::vector<DesignNumber> numbers = hard_points(suspension);
  numbers.resize(count);
  const DerivativePlan plan = prepare_derivatives(suspension, numbers);
  const CornerPosition at =
      solve_position(plan.plan, Driver::wheel_centre_z, {0.03, 0.02}, reference_position(plan.plan));
  for (auto _ : state) benchmark::DoNotOptimize(wheel_derivatives(plan, at, extent));
}
BENCHMARK_CAPTURE(derivatives, rods, 30, Extent::all)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(derivatives, nine_coordinates, 9, Extent::all)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(derivatives, nine_coordinates_at_rest, 9, Extent::at_rest)->Unit(benchmark::kMicrosecond);

void derivatives_along_travel(benchmark::State& state) {
  const DerivativePlan plan = prepare_derivatives(corner_sample("5US").suspension, {});
  const CornerPosition at =
      solve_position(plan.plan, Driver::wheel_centre_z, {0.03, 0.02}, reference_position(plan.plan));
  for (auto _ : state) benchmark::DoNotOptimize(input_derivatives(plan, at));
}
BENCHMARK(derivatives_along_travel)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace linkwright::suspension
