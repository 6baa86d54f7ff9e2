// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/general.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/samples.h"
#include "linkwright/planar/linkage/sweep.h"

namespace linkwright::planar {
namespace {

// The task at each position.
enum Task { position, rates, forces };

// A turn of the crank in `count` positions, along the groups or with all bodies at once.
void sweep(benchmark::State& state, const char* name, PlanRoute route, Task task) {
  constexpr int count = 360;
  const LinkageSample& sample = linkage_sample(name);
  const LinkagePlan along = plan_linkage(sample.linkage).plan,
                    asked = plan_linkage(sample.linkage, route).plan;
  LinkageMotion motion(asked), start(along);
  LinkageForces found;
  std::vector<InputMotion> inputs{{sample.from[0], sample.speed, 0}};
  solve_position(along, inputs, start);
  motion.parts = start.parts;
  for (auto _ : state)
    for (int i = 0; i < count; ++i) {
      inputs[0].value = sample.from[0] + i * (sample.to[0] - sample.from[0]) / count;
      solve_position(asked, inputs, motion);
      if (task != position) {
        solve_velocity(asked, inputs, motion);
        solve_acceleration(asked, inputs, motion);
      }
      if (task == forces) solve_forces(sample.linkage, asked, motion, 0, inputs[0].value, found);
      if (motion.status != Status::done) state.SkipWithError("a position failed");
      benchmark::DoNotOptimize(motion.parts.data());
      benchmark::DoNotOptimize(found.drives.data());
      benchmark::ClobberMemory();
    }
  state.SetItemsProcessed(state.iterations() * count);
}

void linkage_four_bar_forces(benchmark::State& s) { sweep(s, "four_bar", PlanRoute::along_groups, forces); }
void linkage_four_bar_forces_at_once(benchmark::State& s) {
  sweep(s, "four_bar", PlanRoute::all_at_once, forces);
}
void linkage_watt_2_forces(benchmark::State& s) { sweep(s, "watt_2", PlanRoute::along_groups, forces); }
void linkage_jansen_position(benchmark::State& s) {
  sweep(s, "jansen_leg", PlanRoute::along_groups, position);
}
void linkage_jansen_rates(benchmark::State& s) { sweep(s, "jansen_leg", PlanRoute::along_groups, rates); }
void linkage_jansen_forces(benchmark::State& s) { sweep(s, "jansen_leg", PlanRoute::along_groups, forces); }
void linkage_triad_position(benchmark::State& s) { sweep(s, "triad", PlanRoute::along_groups, position); }
void linkage_triad_forces(benchmark::State& s) { sweep(s, "triad", PlanRoute::along_groups, forces); }
BENCHMARK(linkage_four_bar_forces);
BENCHMARK(linkage_four_bar_forces_at_once);
BENCHMARK(linkage_watt_2_forces);
BENCHMARK(linkage_jansen_position);
BENCHMARK(linkage_jansen_rates);
BENCHMARK(linkage_jansen_forces);
BENCHMARK(linkage_triad_position);
BENCHMARK(linkage_triad_forces);

// The same turn through SIMD registers, many positions at a time, and what keeping it in flat rows costs.
void linkage_sweep(benchmark::State& state, const char* name, const SweepWanted& wanted) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const LinkageSample& sample = linkage_sample(name);
  LinkageSweep sweep(sample.linkage, plan_linkage(sample.linkage).plan, wanted);
  std::vector<double> value(n);
  for (std::size_t i = 0; i < n; ++i)
    value[i] =
        sample.from[0] + (sample.to[0] - sample.from[0]) * static_cast<double>(i) / static_cast<double>(n);
  const SweepInput input{value, {&sample.speed, 1}, {}};
  for (auto _ : state) {
    sweep.run({&input, 1});
    benchmark::ClobberMemory();
  }
  if (!sweep.batched()) state.SkipWithError("not in registers");
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
  state.SetLabel(sweep_kernel_name());
}
constexpr SweepWanted places_only{.rates = false, .forces = false}, rates_too{.rates = true, .forces = false},
    forces_too{.rates = true, .forces = true};
BENCHMARK_CAPTURE(linkage_sweep, four_bar_position, "four_bar", places_only)->Arg(360);
BENCHMARK_CAPTURE(linkage_sweep, four_bar_rates, "four_bar", rates_too)->Arg(360);
BENCHMARK_CAPTURE(linkage_sweep, four_bar_forces, "four_bar", forces_too)->Arg(360)->Arg(3600);
BENCHMARK_CAPTURE(linkage_sweep, jansen_position, "jansen_leg", places_only)->Arg(360);
BENCHMARK_CAPTURE(linkage_sweep, jansen_rates, "jansen_leg", rates_too)->Arg(360);
BENCHMARK_CAPTURE(linkage_sweep, jansen_forces, "jansen_leg", forces_too)->Arg(360);

// A turn of an overhead cam with finger and valve in 720 positions, with all forces and that of the contact.
void linkage_cam_forces(benchmark::State& state) {
  constexpr int count = 720;
  constexpr double degree = pi / 180;
  Linkage l = grounded({{"O", {0, 0}}, {"P", {-0.021, -0.03}}, {"G", {0.02, -0.034}}});
  add_drawn(l, "cam", {{"O", {0, 0}}});
  add_drawn(l, "finger", {{"P", {-0.021, -0.03}}, {"R", {0, -0.026}}, {"T", {0.02, -0.03}}});
  add_drawn(l, "valve", {{"T", {0.02, -0.03}}});
  add_pin(l, "shaft", "ground.O", "cam.O");
  add_pin(l, "pivot", "ground.P", "finger.P");
  add_slide(l, "guide", "ground.G", "valve.T", -pi / 2, -pi / 2);
  add_slot(l, "tip", "valve.T", "finger.T");
  for (std::size_t b = 1; b < l.bodies.size(); ++b) l.bodies[b].mass = BodyMass{0.1, 1e-5, 0};
  l.cams.push_back({.name = "lobe",
                    .turns = 0,
                    .moves = 2,
                    .contact = {2, 1},
                    .roller_radius = 0.009,
                    .base_radius = 0.017,
                    .programme = {.segments = {{CamLaw::dwell, 220 * degree, 0, {}},
                                               {CamLaw::polynomial_4567, 70 * degree, 0.01, {}},
                                               {CamLaw::polynomial_4567, 70 * degree, 0, {}}}}});
  add_drive(l, "shaft");
  const LinkagePlan plan = plan_linkage(l).plan;
  LinkageMotion motion(plan);
  LinkageForces found;
  std::vector<InputMotion> inputs{{0, 300, 0}};
  for (auto _ : state)
    for (int i = 0; i < count; ++i) {
      inputs[0].value = full_turn * i / count;
      solve_motion(plan, inputs, motion);
      solve_forces(l, plan, motion, 0, inputs[0].value, found);
      if (motion.status != Status::done) state.SkipWithError("a position failed");
      benchmark::DoNotOptimize(found.cams.data());
    }
  state.SetItemsProcessed(state.iterations() * count);
}
BENCHMARK(linkage_cam_forces)->Unit(benchmark::kMillisecond);

// Limits, change points and circuits over a full turn, in all modes.
void linkage_limits(benchmark::State& state, const char* name) {
  const LinkageSample& sample = linkage_sample(name);
  const LinkagePlan p = plan_linkage(sample.linkage).plan;
  for (auto _ : state) {
    const InputLimits limits = input_limits(p, sample.from, 0, 0, 2 * pi);
    benchmark::DoNotOptimize(limits.circuits);
  }
}
BENCHMARK_CAPTURE(linkage_limits, four_bar, "four_bar")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(linkage_limits, jansen_leg, "jansen_leg")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace linkwright::planar
