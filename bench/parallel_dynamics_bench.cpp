// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "linkwright/parallel/robot/dynamics.h"

namespace linkwright::parallel {
namespace {

Robot bench_delta() { return delta({.base_radius = 0.2, .platform_radius = 0.045, .arm = 0.35, .rod = 0.8}); }
Robot bench_hexa() {
  return hexa({.base_radius = 0.25,
               .base_offset = 0.06,
               .platform_radius = 0.09,
               .platform_angle = 0.785,
               .arm = 0.25,
               .rod = 0.55});
}

const RobotMasses masses = equal_legs(
    {.mass = 0.9, .inertia = {0.004, 0.0046, 0.0071}},
    {.rod_mass = 0.2, .elbow_mass = 0.1, .arm_inertia = 0.03, .arm_mass = 0.75, .arm_centre = 0.175});

DynamicState state_of(const Robot& robot) {
  if (robot.freedom == Freedom::space)
    return {{{0.05, -0.03, -0.5}, math::turn_about(Vec3{0.15, -0.2, 0.25})},
            {{0.4, -0.3, 0.2}, {1, -0.7, 1.5}},
            {{6, 4, -5}, {12, 8, -20}}};
  return {{{0.2, -0.1, -0.85}}, {{1.5, -0.8, 0.6}, {}}, {{20, 35, -15}, {}}};
}

// Motion of arms and drives, torques, efforts, powers and joint forces of one state, motors at the arms.
void inverse_of(benchmark::State& state, const Robot& robot) {
  const DynamicState at = state_of(robot);
  for (auto _ : state) benchmark::DoNotOptimize(inverse_dynamics(robot, {}, masses, all_positive, at));
}
void delta_inverse_dynamics(benchmark::State& s) { inverse_of(s, bench_delta()); }
void hexa_inverse_dynamics(benchmark::State& s) { inverse_of(s, bench_hexa()); }
BENCHMARK(delta_inverse_dynamics)->Unit(benchmark::kNanosecond);
BENCHMARK(hexa_inverse_dynamics)->Unit(benchmark::kNanosecond);

void direct_of(benchmark::State& state, const Robot& robot) {
  const DynamicState at = state_of(robot);
  const Vector6 efforts = inverse_dynamics(robot, {}, masses, all_positive, at).drive_effort;
  for (auto _ : state)
    benchmark::DoNotOptimize(direct_dynamics(robot, {}, masses, all_positive, at, efforts));
}
void delta_direct_dynamics(benchmark::State& s) { direct_of(s, bench_delta()); }
void hexa_direct_dynamics(benchmark::State& s) { direct_of(s, bench_hexa()); }
BENCHMARK(delta_direct_dynamics)->Unit(benchmark::kNanosecond);
BENCHMARK(hexa_direct_dynamics)->Unit(benchmark::kNanosecond);

}  // namespace
}  // namespace linkwright::parallel
