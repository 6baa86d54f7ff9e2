// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "linkwright/parallel/workspace/workspace.h"

namespace linkwright::parallel {
namespace {

Drives drives() {
  Drives out;
  out.fill({.type = DriveType::pi_joint,
            .ratio = 0.4,
            .mounting = 0.5236,
            .lowest = -1.0472,
            .highest = 1.0472,
            .quantum = 1.27e-5});
  return out;
}
Robot delta_robot() { return delta({.base_radius = 0.2, .platform_radius = 0.045, .arm = 0.35, .rod = 0.8}); }
Robot hexa_robot() {
  return hexa({.base_radius = 0.25,
               .base_offset = 0.06,
               .platform_radius = 0.09,
               .platform_angle = 0.785398,
               .arm = 0.25,
               .rod = 0.55});
}

void map(benchmark::State& state, const WorkspaceTask& task) {
  std::size_t nodes = 0, reached = 0;
  for (auto _ : state) {
    const WorkspaceMap found = workspace(task, RunContext());
    nodes = found.count();
    reached = nodes - totals(found).count[static_cast<std::size_t>(Criterion::leg)];
    benchmark::DoNotOptimize(found.criterion.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(nodes));
  state.counters["nodes"] = static_cast<double>(nodes);
  state.counters["reached"] = static_cast<double>(reached);
}

// A million nodes of which the legs reach nearly all, or of a box around everything.
void delta_inside(benchmark::State& state) {
  map(state,
      {.conditions = {.robot = delta_robot(), .drives = drives(), .assembly = -1, .min_transmission = 0.5},
       .grid = {{-0.5, -0.5, -0.99}, {0.49, 0.49, 0}, 0.01},
       .wanted = all_indices});
}
void delta_around(benchmark::State& state, const WantedIndices& wanted) {
  map(state,
      {.conditions = {.robot = delta_robot(), .drives = drives(), .assembly = -1, .min_transmission = 0.5},
       .grid = {{-1, -1, -1.2}, {1, 1, 0}, 0.017},
       .wanted = wanted});
}
void hexa_inside(benchmark::State& state) {
  map(state, {.conditions = {.robot = hexa_robot(),
                             .drives = drives(),
                             .assembly = 1,
                             .min_transmission = 0.4,
                             .characteristic_length = 0.09},
              .grid = {{-0.2, -0.2, -0.65}, {0.196, 0.196, -0.254}, 0.004},
              .wanted = all_indices});
}
BENCHMARK(delta_inside)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(delta_around, all_indices, all_indices)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(delta_around, criteria_alone, no_indices)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(hexa_inside)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace linkwright::parallel
