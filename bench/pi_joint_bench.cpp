// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <array>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/pi_joint/design_synthesis.h"
#include "linkwright/parallel/pi_joint/samples.h"

namespace linkwright::parallel {
namespace {

// Angles of the prototype, -60 to 60 deg.
constexpr int places = 256;
std::array<double, places> angles_of_the_prototype() {
  std::array<double, places> out;
  for (int i = 0; i < places; ++i) out[i] = pi / 3 * (2.0 * i / (places - 1) - 1);
  return out;
}

void pi_joint_diagonal_and_jacobian(benchmark::State& state) {
  const PiJoint joint = pi_prototype();
  const auto angles = angles_of_the_prototype();
  for (auto _ : state)
    for (double at : angles) {
      benchmark::DoNotOptimize(diagonal(joint, at));
      benchmark::DoNotOptimize(jacobian(joint, at));
    }
  state.SetItemsProcessed(state.iterations() * places);
}
BENCHMARK(pi_joint_diagonal_and_jacobian);

void pi_joint_angle_of(benchmark::State& state) {
  const PiJoint joint = pi_prototype();
  auto diagonals = angles_of_the_prototype();
  for (double& d : diagonals) d = diagonal(joint, d);
  for (auto _ : state)
    for (double d : diagonals) benchmark::DoNotOptimize(angle_of(joint, d));
  state.SetItemsProcessed(state.iterations() * places);
}
BENCHMARK(pi_joint_angle_of);

// Position, rates and back: what a control cycle asks for.
void pi_joint_motion_there_and_back(benchmark::State& state) {
  const PiJoint joint = pi_prototype();
  const auto angles = angles_of_the_prototype();
  for (auto _ : state)
    for (double at : angles)
      benchmark::DoNotOptimize(angle_motion(joint, diagonal_motion(joint, {at, 1.3, -4})));
  state.SetItemsProcessed(state.iterations() * places);
}
BENCHMARK(pi_joint_motion_there_and_back);

void pi_joint_design(benchmark::State& state) {
  const PiRequirements requirements{.half_travel = pi / 3,
                                    .torque = 4,
                                    .force_limit = 130,
                                    .speed = 0.7,
                                    .rate_limit = 0.05,
                                    .stroke = 0.12,
                                    .telescoping = 2};
  RunContext context;
  for (auto _ : state) benchmark::DoNotOptimize(design_pi_joint(requirements, {}, {.seed = 1}, context));
}
BENCHMARK(pi_joint_design)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace linkwright::parallel
