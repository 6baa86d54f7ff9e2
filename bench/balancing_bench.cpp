// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/balancing/mass_redistribution.h"
#include "linkwright/planar/balancing/serial_arm.h"
#include "linkwright/planar/serial_arm/samples.h"

namespace linkwright::planar {
namespace {

// The published four-bar at 300 rpm, 201 samples, bounds of Boskovic 2018, Table 2.4: columns, programme and
// check. Argument 0: nine objectives (case 2), 1: three (case 3); then the measure.
void redistribute_masses(benchmark::State& state) {
  const FourBarMachine machine{
      {.ground = 0.6, .crank = 0.1, .coupler = 0.4, .rocker = 0.32},
      {{0.36, 4.13e-4, 0.05, 0}, {1.296, 1.87e-2, 0.2, 0}, {1.046, 9.85e-3, 0.16, 0}}};
  std::vector<double> angle;
  for (int i = 0; i <= 200; ++i) angle.push_back(2 * pi * i / 200);
  const double speed[] = {10 * pi};
  MassBalancing b{.links = {{0, {0.01, 3}, {0.001, 0.1}, {2e-4, 60e-4}},
                            {1, {0.8, 1.6}, {0.001, 0.4}, {2e-2, 7e-2}},
                            {2, {0.5, 1.5}, {0.001, 0.32}, {8e-3, 18e-3}}}};
  const std::vector<const char*> names =
      state.range(0) == 0
          ? std::vector{"O1_x_N", "O1_y_N", "O2_x_N",
                        "O2_y_N", "O3_x_N", "O3_y_N",
                        "O4_x_N", "O4_y_N", "O1_drive_torque_N_m"}
          : std::vector{"shaking_force_x_N", "shaking_force_y_N", "shaking_moment_with_drive_N_m"};
  for (const char* name : names)
    b.objectives.push_back({.quantity = name, .measure = static_cast<Measure>(state.range(1))});
  RunContext context;
  for (auto _ : state) {
    b.forces = linear_forces(machine, 9.81, {.value = angle, .rate = speed});
    benchmark::DoNotOptimize(balance(b, context).cost);
  }
}
BENCHMARK(redistribute_masses)
    ->ArgsProduct({{0, 1},
                   {static_cast<int>(Measure::rss_over_n), static_cast<int>(Measure::mean_abs),
                    static_cast<int>(Measure::max_abs)}})
    ->Unit(benchmark::kMillisecond);

ArmTask arm(bool polynomials) {
  ArmTask task{.arm = serial_arm(two_link_arm()), .laws = {}, .duration = 10, .weights = {0.5, 0.5}};
  for (const math::MotionLaw& law : two_link_motion()) {
    const auto& c = std::get<math::CycloidalMotion>(law);
    if (polynomials)
      task.laws.push_back(math::Polynomial345{c.from, c.to, c.start, c.duration, {}});
    else
      task.laws.push_back(law);
  }
  return task;
}

void arm_counterweights_exactly(benchmark::State& state) {
  const ArmTask task = arm(false);
  RunContext context;
  for (auto _ : state)
    benchmark::DoNotOptimize(balance(arm_counterweights(task, {{"first", 0, {0, 24}, {0.5, 0.5}, pi},
                                                               {"second", 1, {0, 12}, {0, 0.5}, pi}}),
                                     context)
                                 .cost);
}
BENCHMARK(arm_counterweights_exactly)->Unit(benchmark::kMillisecond);

void arm_laws_recommended(benchmark::State& state) {
  const ArmTask task = arm(true);
  const ArmDesign design{.degree = static_cast<int>(state.range(0))};
  RunContext context;
  std::uint64_t seed = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(search_arm(task, design, {}, {.seed = ++seed}, context).minima[0].cost);
}
BENCHMARK(arm_laws_recommended)->Arg(6)->Arg(8)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace linkwright::planar
