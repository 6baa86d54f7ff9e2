// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "linkwright/parallel/dexterity/dexterity.h"
#include "linkwright/parallel/dexterity/synthesis_samples.h"
#include "linkwright/parallel/workspace/prescribed_region.h"

namespace linkwright::parallel {
namespace {

/// All nodes of a cylinder, one evaluation: what a candidate of a population costs.
void region(benchmark::State& state, RobotFamily family, const std::vector<double>& x, bool derivatives) {
  const DesignedRobot designed = design(family, x);
  PoseSet poses;
  for (const RegionPoint& point : region_nodes(dexterity_benchmark(DexterityGoal::worst).region)) {
    poses.x.push_back(point.place.x);
    poses.y.push_back(point.place.y);
    poses.z.push_back(point.place.z);
  }
  const DexterityMeasures what{.length = 0.09, .output = false};
  SetDexterity out;
  for (auto _ : state) {
    measure(designed, all_positive, what, poses, derivatives, out);
    benchmark::DoNotOptimize(out.conditioning.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(poses.size()));
}
const std::vector<double> delta_values{0.1396, 0.4764, 0.7236, 0.3513};
const std::vector<double> hexa_values{0.25, 0.06, 0.09, 0.785, 0.45, 0.8, 0.45};
BENCHMARK_CAPTURE(region, delta, RobotFamily::delta, delta_values, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(region, delta_with_derivatives, RobotFamily::delta, delta_values, true)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(region, hexa, RobotFamily::hexa, hexa_values, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(region, hexa_with_derivatives, RobotFamily::hexa, hexa_values, true)
    ->Unit(benchmark::kMicrosecond);

void one_pose(benchmark::State& state) {
  const DesignedRobot designed = design(RobotFamily::delta, delta_values);
  PoseDexterity<double> out;
  for (auto _ : state) {
    measure(designed, all_positive, {}, {0.2, 0.1, -0.1}, {}, out);
    benchmark::DoNotOptimize(out.conditioning);
  }
}
BENCHMARK(one_pose);

/// A whole synthesis on one thread.
void synthesis(benchmark::State& state, DexterityGoal goal) {
  const DexterityTask task = dexterity_benchmark(goal);
  RunContext context;
  context.set_threads(1);
  for (auto _ : state) benchmark::DoNotOptimize(synthesise(task, {}, 1, context));
}
BENCHMARK_CAPTURE(synthesis, B1, DexterityGoal::worst)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(synthesis, B2, DexterityGoal::mean)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(synthesis, B3, DexterityGoal::size)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace linkwright::parallel
