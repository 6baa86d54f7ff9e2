// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "linkwright/planar/type_synthesis/atlas.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/draw_shape.h"
#include "linkwright/planar/type_synthesis/place.h"
#include "linkwright/planar/type_synthesis/polish.h"

// Curves of 96 points of machines given as programs of points, on each instruction set: points alone, with
// their derivatives by the crank angle, and with those of one residual a point by all parameters. A prototype
// needed 0.46, 1.2 and 0.35 to 0.75 us for a four-bar and 0.87, 2.6 and 2.0 us for an eight-bar on four
// lanes.
namespace linkwright::planar {
namespace {

constexpr std::size_t samples = stroke_samples;

MachineShape some_shape(const char* name) {
  MachineShape shape{.program = program_named(name)};
  for (std::uint32_t k = 0;; ++k) {
    RandomStream random({.seed = 3, .individual = k});
    if (draw_shape(shape, 0, random)) return shape;
  }
}

struct Arrays {
  std::array<double, samples> angle, x, y, tx, ty, nx, ny, quality, worst;
  std::vector<double> rows = std::vector<double>(samples * (max_machine_parameters + 1), 1.0);
  Arrays() {
    for (std::size_t k = 0; k < samples; ++k)
      angle[k] = 0.065 * static_cast<double>(k), nx[k] = 0.6, ny[k] = 0.8;
  }
};

enum class Wanted { points, tangents, rows, pair_angles };

void curve(benchmark::State& state, const char* name, Wanted wanted) {
  const auto kernels = runnable(machine_curve_kernels());
  const auto& kernel = kernels[std::min(static_cast<std::size_t>(state.range(0)), kernels.size() - 1)];
  const MachineShape shape = some_shape(name);
  Arrays a;
  CurveTask task{.program = shape.program,
                 .x = shape.x.data(),
                 .signs = shape.signs,
                 .angle = a.angle.data(),
                 .count = samples};
  if (wanted != Wanted::pair_angles) task.px = a.x.data(), task.py = a.y.data();
  if (wanted == Wanted::tangents || wanted == Wanted::rows) task.tx = a.tx.data(), task.ty = a.ty.data();
  if (wanted == Wanted::rows)
    task.nx = a.nx.data(), task.ny = a.ny.data(), task.rows = a.rows.data(), task.stride = samples;
  if (wanted == Wanted::pair_angles) task.quality = a.quality.data(), task.worst = a.worst.data();
  for (auto _ : state) {
    kernel.run->curve(task);
    benchmark::DoNotOptimize(a.x.data());
    benchmark::ClobberMemory();
  }
  state.SetLabel(kernel.name);
}
BENCHMARK_CAPTURE(curve, four_bar_points, "four_bar", Wanted::points)->DenseRange(0, 2);
BENCHMARK_CAPTURE(curve, four_bar_rows, "four_bar", Wanted::rows)->DenseRange(0, 2);
BENCHMARK_CAPTURE(curve, stephenson_3_points, "stephenson_3:a", Wanted::points)->DenseRange(0, 2);
BENCHMARK_CAPTURE(curve, stephenson_3_tangents, "stephenson_3:a", Wanted::tangents)->DenseRange(0, 2);
BENCHMARK_CAPTURE(curve, stephenson_3_rows, "stephenson_3:a", Wanted::rows)->DenseRange(0, 2);
BENCHMARK_CAPTURE(curve, stephenson_2_points, "stephenson_2:a", Wanted::points)->DenseRange(0, 2);
BENCHMARK_CAPTURE(curve, stephenson_2_rows, "stephenson_2:a", Wanted::rows)->DenseRange(0, 2);
BENCHMARK_CAPTURE(curve, eight_bar_points, "eight_bar:1315b", Wanted::points)->DenseRange(0, 2);
BENCHMARK_CAPTURE(curve, eight_bar_rows, "eight_bar:1315b", Wanted::rows)->DenseRange(0, 2);
BENCHMARK_CAPTURE(curve, eight_bar_pair_angles, "eight_bar:1315b", Wanted::pair_angles)->DenseRange(0, 2);

void normal_equations(benchmark::State& state) {
  Arrays a;
  std::vector<double> out(22 * 23 / 2);
  for (auto _ : state) {
    compute_products(
        {.rows = a.rows.data(), .stride = samples, .count = samples, .columns = 22, .out = out.data()});
    benchmark::DoNotOptimize(out.data());
  }
}
BENCHMARK(normal_equations);

Stroke superellipse(bool closed) {
  Stroke stroke{.closed = closed};
  for (int k = 0; k < 48; ++k) {
    const double a = 2 * pi * k / (closed ? 48 : 60), c = std::cos(a), s = std::sin(a);
    stroke.points.emplace_back(std::copysign(std::sqrt(std::abs(c)), c),
                               0.7 * std::copysign(std::sqrt(std::abs(s)), s));
  }
  return stroke;
}

void polish(benchmark::State& state, const char* name) {
  const SampledStroke target = sampled_stroke(superellipse(true));
  MachineFitter fitter(target, {});
  FittedMachine placed{.shape = some_shape(name)};
  place_machine(target, placed);
  for (auto _ : state) {
    FittedMachine machine = placed;
    fitter.polish(machine, infinity);
    benchmark::DoNotOptimize(machine.error);
  }
}
BENCHMARK_CAPTURE(polish, four_bar, "four_bar")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(polish, stephenson_3, "stephenson_3:a")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(polish, stephenson_2, "stephenson_2:a")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(polish, eight_bar, "eight_bar:1315b")->Unit(benchmark::kMicrosecond);

void match(benchmark::State& state, bool closed) {
  RunContext context;
  context.set_threads(1);
  const SampledStroke target = sampled_stroke(superellipse(closed));
  std::size_t entries = 0;
  std::vector<std::shared_ptr<const FamilyAtlas>> atlases;
  for (const auto& family : names(MachineFamily{}))
    if (!programs_of(family.value).empty()) {
      atlases.push_back(family_atlas(family.value, context));
      entries += atlases.back()->entries.size();
    }
  for (auto _ : state)
    for (const auto& atlas : atlases)
      benchmark::DoNotOptimize(match_atlas(*atlas, target, 400, context).size());
  state.counters["entries"] = static_cast<double>(entries);
}
BENCHMARK_CAPTURE(match, closed_stroke, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(match, open_stroke, false)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace linkwright::planar
