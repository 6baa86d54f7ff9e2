// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <algorithm>

#include "linkwright/flexible/arm.h"
#include "linkwright/flexible/modes.h"
#include "linkwright/flexible/reference_beam.h"
#include "linkwright/flexible/samples.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/flexible/statics.h"

namespace linkwright::flexible {
namespace {

// The published examples: 20 s of spin-up at 16 rad/s with 5 ms, 5 s of a torque of 6 N m with 2 ms, one run
// each. Time for each step: it has to grow with the number of cells and no more.
void spin_up(benchmark::State& state) {
  const Chain chain = discretise(spin_up_beam(), int(state.range(0)));
  const double breaks[] = {15};
  long steps = 0, iterations = 0;
  for (auto _ : state) {
    const Simulation run = simulate_motion(
        chain, SpinUp{16, 15}, {.end = 20, .output_interval = 0.1, .step = 0.005, .breaks = breaks});
    steps += run.steps;
    iterations += run.iterations;
    if (run.status != Status::done) state.SkipWithError(run.message.c_str());
  }
  state.counters["iterations_per_step"] = double(iterations) / double(steps);
  state.counters["time_per_step"] =
      benchmark::Counter(double(steps), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(spin_up)->Arg(2)->Arg(8)->Arg(25)->Arg(50)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond);

void torque(benchmark::State& state) {
  const Chain chain = discretise(torque_beam(), int(state.range(0)));
  const double breaks[] = {2};
  long steps = 0, iterations = 0;
  for (auto _ : state) {
    const Simulation run = simulate_torque(
        chain, SinePulse{6, 2}, {.end = 5, .output_interval = 0.1, .step = 0.002, .breaks = breaks});
    steps += run.steps;
    iterations += run.iterations;
    if (run.status != Status::done) state.SkipWithError(run.message.c_str());
  }
  state.counters["iterations_per_step"] = double(iterations) / double(steps);
  state.counters["time_per_step"] =
      benchmark::Counter(double(steps), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(torque)->Arg(2)->Arg(8)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond);

// Kane's beam, 20 s with 5 ms: what another program takes 1.65 s (4 cable elements, 0.8 mm off the
// limit), 8.4 s (8, 0.08 mm off) and 88 s (16, half the step) for.
void kane_spin_up(benchmark::State& state) {
  const Chain chain = discretise(kane_beam(), int(state.range(0)));
  const double breaks[] = {15};
  double lowest = 0;
  for (auto _ : state) {
    const Simulation run = simulate_motion(
        chain, SpinUp{6, 15}, {.end = 20, .output_interval = 0.005, .step = 0.005, .breaks = breaks});
    lowest = 0;
    for (const Sample& s : run.samples) lowest = std::min(lowest, s.tip_eta);
  }
  state.counters["lowest_tip_mm"] = 1e3 * lowest;
}
BENCHMARK(kane_spin_up)->Arg(4)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond);

// Halves the step again and takes the limit of both: the tip to 1e-6 m.
void extrapolated_spin_up(benchmark::State& state) {
  const Chain chain = discretise(spin_up_beam(), int(state.range(0)));
  const double breaks[] = {15};
  for (auto _ : state)
    benchmark::DoNotOptimize(simulate_motion(
        chain, SpinUp{16, 15},
        {.end = 20, .output_interval = 0.1, .step = 0.005, .breaks = breaks, .extrapolate = true}));
}
BENCHMARK(extrapolated_spin_up)->Arg(2)->Arg(8)->Unit(benchmark::kMillisecond);

// Two links, both driven, 1 s in steps of 2 ms.
void two_links(benchmark::State& state) {
  Beam inner = torque_beam(), outer = torque_beam();
  inner.length = outer.length = 0.9;
  inner.tip_mass = outer.hub_radius = outer.hub_inertia = 0;
  const ArmLink links[] = {{inner, int(state.range(0)), {}}, {outer, int(state.range(0)), Hinge{}}};
  const ArmChain arm = arm_chain(links);
  const SpinUp hub{1, 1}, elbow{-2, 1};
  const HingeDrive motor[] = {{.hinge = 0, .motion = AngleLaw(elbow)}};
  for (auto _ : state)
    benchmark::DoNotOptimize(
        simulate_motion(arm.chain, hub, {.end = 1, .output_interval = 0.1, .step = 0.002, .hinges = motor}));
}
BENCHMARK(two_links)->Arg(4)->Unit(benchmark::kMillisecond);

void reference_spin_up(benchmark::State& state) {
  const double breaks[] = {15};
  for (auto _ : state)
    benchmark::DoNotOptimize(reference_motion(spin_up_beam(), SpinUp{4, 15},
                                              {.end = 20,
                                               .output_interval = 0.1,
                                               .tolerance = 1e-7,
                                               .breaks = breaks,
                                               .beam = {.degree = 7, .points = 16}}));
}
BENCHMARK(reference_spin_up)->Unit(benchmark::kMillisecond);

void first_three_frequencies(benchmark::State& state) {
  const Chain chain = discretise(spin_up_beam(), int(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(modes(chain, 3, {.speed = 4}));
}
BENCHMARK(first_three_frequencies)->Arg(2)->Arg(8)->Arg(100)->Arg(200)->Unit(benchmark::kMicrosecond);

void large_deflection(benchmark::State& state) {
  const Beam beam = spin_up_beam();
  const Chain chain = discretise(beam, int(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(equilibrium(chain, {.force = {0, 10 * beam.bending_stiffness() / 64}}));
}
BENCHMARK(large_deflection)->Arg(4)->Arg(200)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace linkwright::flexible
