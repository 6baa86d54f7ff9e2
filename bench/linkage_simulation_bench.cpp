// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/planar/linkage/samples.h"
#include "linkwright/planar/simulation/coordinates.h"
#include "linkwright/planar/simulation/elastic_body.h"

namespace linkwright::planar {
namespace {

// The equations of motion at one instant.
void linkage_dynamics_andrews(benchmark::State& state) {
  const LinkageSample s = andrews_squeezer_sample();
  const LinkagePlan p = plan_linkage(s.linkage).plan;
  LinkageDynamics dynamics(s.linkage, p, {true});
  InputMotion crank{s.from[0], 1000, 0};
  for (auto _ : state) {
    crank.value += 1e-3;
    benchmark::DoNotOptimize(dynamics.solve(0, std::span(&crank, 1)));
  }
}
BENCHMARK(linkage_dynamics_andrews);

// The same of a slider-crank whose rod bends in `range` segments: as many equations, by either route.
void elastic_rod(benchmark::State& state, AccelerationRoute route) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "crank", "O", "A", 0.05);
  add_bar(l, "rod", "A", "B", 0.3);
  add_body(l, "slider", {{"B", {0, 0}}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "rod.A");
  add_pin(l, "B", "rod.B", "slider.B");
  add_slide(l, "guide", "ground.O", "slider.B");
  add_drive(l, "O");
  set_mode(l, "rod", "slider", AssemblyMode::plus);
  set_uniform_all(l, 1);
  const ElasticBody rod{.body = 2,
                        .elastic_modulus = 2.1e11,
                        .second_moment = 1e-10,
                        .area = 8e-5,
                        .density = 7850,
                        .segments = static_cast<int>(state.range(0))};
  std::vector<InputMotion> inputs{{0.5, 100, 0}};
  const ElasticLinkage e = with_elastic_bodies(l, std::span(&rod, 1), inputs);
  std::vector<bool> free(1, false);
  for (const InputDrive& c : e.free) {
    inputs.push_back({c.value, c.rate, 0});
    free.push_back(true);
  }
  LinkageDynamics dynamics(e.linkage, e.plan, free, route);
  for (auto _ : state) benchmark::DoNotOptimize(dynamics.solve(0, inputs));
}
void linkage_dynamics_elastic_rod_masses(benchmark::State& s) {
  elastic_rod(s, AccelerationRoute::mass_matrix);
}
void linkage_dynamics_elastic_rod_forces(benchmark::State& s) {
  elastic_rod(s, AccelerationRoute::joint_forces);
}
BENCHMARK(linkage_dynamics_elastic_rod_masses)->Arg(2)->Arg(3)->Arg(4)->Arg(8)->Arg(16)->Arg(32)->Arg(64);
BENCHMARK(linkage_dynamics_elastic_rod_forces)->Arg(2)->Arg(3)->Arg(4)->Arg(8)->Arg(16)->Arg(32)->Arg(64);

// Andrews' squeezer over 0.03 s at a relative tolerance of 10^-range, search for change points included;
// `digits` against the published angle of the crank.
void andrews(benchmark::State& state, decltype(&simulate) route, math::OdeMethod method) {
  const LinkageSample s = andrews_squeezer_sample();
  const LinkagePlan p = plan_linkage(s.linkage).plan;
  const InputDrive drive{{}, s.from[0], 0};
  const std::array<double, 2> times{0, 0.03};
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  double angle = 0, open = 0;
  for (auto _ : state)
    route(
        s.linkage, p, std::span(&drive, 1), times,
        {.method = method, .relative_tolerance = tolerance, .absolute_tolerance = tolerance},
        [&](const SimulationInstant& now) {
          angle = now.inputs[0].value;
          open = now.motion->closure_residual;
          return true;
        },
        nullptr);
  state.counters["digits"] = -std::log10(std::abs(angle / 15.81077119629904 - 1));
  state.counters["closure"] = open;
}
void linkage_simulate_andrews(benchmark::State& s) {
  andrews(s, simulate, math::OdeMethod::explicit_runge_kutta_8);
}
void linkage_simulate_andrews_5(benchmark::State& s) {
  andrews(s, simulate, math::OdeMethod::explicit_runge_kutta_5);
}
void linkage_simulate_andrews_all(benchmark::State& s) {
  andrews(s, simulate_all_coordinates, math::OdeMethod::explicit_runge_kutta_8);
}
BENCHMARK(linkage_simulate_andrews)->Arg(7)->Arg(9)->Unit(benchmark::kMillisecond);
BENCHMARK(linkage_simulate_andrews_5)->Arg(7)->Arg(9)->Unit(benchmark::kMillisecond);
BENCHMARK(linkage_simulate_andrews_all)->Arg(7)->Unit(benchmark::kMillisecond);

// Forty four-bars through twenty change points in 20 s; `drift` of the energy in J of 4855.
void linkage_simulate_chain(benchmark::State& state) {
  const Linkage l = four_bar_chain_sample(40).linkage;
  const LinkagePlan p = plan_linkage(l).plan;
  const InputDrive drive{{}, pi / 2, -1};
  const std::array<double, 2> times{0, 20};
  SimulationReport report;
  for (auto _ : state)
    report = simulate(l, p, std::span(&drive, 1), times,
                      {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-11}, {});
  state.counters["drift"] = report.largest_drift;
}
BENCHMARK(linkage_simulate_chain)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace linkwright::planar
