// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <array>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/assembly_modes/assembly_modes.h"
#include "linkwright/parallel/assembly_modes/platform_paths.h"

namespace linkwright::parallel {
namespace {

// All 40 solutions for the arm angles of the reference, followed and proved; the generic platform they start
// from is solved once, by the first call: see below.
void hexa_assembly_modes(benchmark::State& state) {
  const Robot robot = hexa({.base_radius = 0.25,
                            .base_offset = 0.06,
                            .platform_radius = 0.09,
                            .platform_angle = pi / 4,
                            .arm = 0.25,
                            .rod = 0.55});
  const std::array<double, 6> angles{0.32103887, 0.36944957, 0.60240363, 0.78082835, 0.57088078, 0.61648700};
  for (auto _ : state) {
    const AssemblyModes found = assembly_modes(robot, angles);
    if (found.real != 12 || !found.complete) state.SkipWithError("modes are missing");
    benchmark::DoNotOptimize(found);
  }
}
BENCHMARK(hexa_assembly_modes)->Unit(benchmark::kMillisecond);

void generic_platform_monodromy(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(monodromy(2));
}
BENCHMARK(generic_platform_monodromy)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace linkwright::parallel
