// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <complex>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/planar/exact/detail/nine_point_starts.h"
#include "linkwright/planar/exact/given_pivots.h"
#include "linkwright/planar/exact/nine_points.h"
#include "linkwright/planar/exact/slider_points.h"

namespace linkwright::planar {
namespace {

using Points = std::vector<std::complex<double>>;

// Wampler, Morgan and Sommese 1992, problem 3.
const Points& nine_points() {
  static const Points points = {{0.25, 0.0}, {0.52, 0.1}, {0.8, 0.7}, {1.2, 1.0}, {1.4, 1.3},
                                {1.1, 1.48}, {0.7, 1.4},  {0.2, 1.0}, {0.02, 0.4}};
  return points;
}

Points random_points(int count) {
  RandomStream random({.seed = 1});
  Points out;
  for (int i = 0; i < count; ++i) {
    const double x = random.normal();
    out.emplace_back(x, random.normal());
  }
  return out;
}

// One thread; the first call finds the start set as well.
template <class Solve>
void all_solutions(benchmark::State& state, int expected, Solve&& solve) {
  RunContext context;
  context.set_threads(1);
  if (solve(context).finite != expected) state.SkipWithError("solutions are missing");
  for (auto _ : state) benchmark::DoNotOptimize(solve(context));
}

void five_points_with_pivots(benchmark::State& state) {
  const Points points = random_points(7);
  all_solutions(state, five_point_solutions, [&](RunContext& context) {
    return solve_five_points(std::span(points).first<5>(), {points[5], points[6]}, context);
  });
}
BENCHMARK(five_points_with_pivots)->Unit(benchmark::kMillisecond);

void seven_points_with_a_pivot(benchmark::State& state) {
  const Points points = random_points(8);
  all_solutions(state, seven_point_solutions, [&](RunContext& context) {
    return solve_seven_points(std::span(points).first<7>(), points[7], context);
  });
}
BENCHMARK(seven_points_with_a_pivot)->Unit(benchmark::kMillisecond);

void slider_crank_through_eight_points(benchmark::State& state) {
  const Points points = random_points(8);
  all_solutions(state, slider_point_solutions, [&](RunContext& context) {
    return solve_slider_points(std::span(points).first<8>(), context);
  });
}
BENCHMARK(slider_crank_through_eight_points)->Unit(benchmark::kMillisecond);

// Arguments: threads, certificates.
void all_classes_of_nine_points(benchmark::State& state) {
  RunContext context;
  context.set_threads(static_cast<int>(state.range(0)));
  NinePointOptions options;
  options.certify = state.range(1) != 0;
  const auto solve = [&] { return solve_nine_points(nine_points(), options, context).classes.size(); };
  if (solve() != nine_point_classes) state.SkipWithError("classes are missing");
  for (auto _ : state) benchmark::DoNotOptimize(solve());
}
BENCHMARK(all_classes_of_nine_points)
    ->Args({1, 0})
    ->Args({2, 0})
    ->Args({1, 1})
    ->Args({2, 1})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void start_set_of_nine_points(benchmark::State& state) {
  RunContext context;
  context.set_threads(2);
  for (auto _ : state) {
    const auto starts = find_starts<NinePoints>(1, nine_point_classes, context);
    if (!trace_test(starts, context).passed) state.SkipWithError("the trace test fails");
  }
}
BENCHMARK(start_set_of_nine_points)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace linkwright::planar
