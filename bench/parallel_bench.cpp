#include <benchmark/benchmark.h>

#include <array>
#include <numbers>

#include "linkwright/parallel/assembly_modes.h"
#include "linkwright/parallel/pi_design_synthesis.h"
#include "linkwright/parallel/pi_samples.h"
#include "linkwright/parallel/platform_paths.h"

namespace linkwright::parallel {
namespace {

// Angles of the prototype, -60 to 60 deg.
constexpr int places = 256;
std::array<double, places> angles_of_the_prototype() {
  std::array<double, places> out;
  for (int i = 0; i < places; ++i) out[i] = std::numbers::pi / 3 * (2.0 * i / (places - 1) - 1);
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
  const PiRequirements requirements{.half_travel = std::numbers::pi / 3,
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

// All 40 solutions for the arm angles of the reference, followed and proved; the generic platform they start
// from is solved once, by the first call, in about five times as long.
void hexa_assembly_modes(benchmark::State& state) {
  const Robot robot = hexa({.base_radius = 0.25,
                            .base_offset = 0.06,
                            .platform_radius = 0.09,
                            .platform_angle = std::numbers::pi / 4,
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
