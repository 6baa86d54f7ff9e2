// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/direct/published_targets.h"
#include "linkwright/suspension/indirect/link_synthesis.h"
#include "linkwright/suspension/indirect/seven_poses.h"
#include "linkwright/suspension/indirect/synthesis.h"
#include "linkwright/suspension/indirect/synthesis_carrier_pitch.h"

namespace linkwright::suspension {
namespace {

/// A published example and the positions that its carrier takes, solved for.
struct Example {
  CarrierTargets targets;
  Suspension suspension;
};

Example example(const char* name, double travel, double step, double rack) {
  Example e{.suspension = corner_sample(name).suspension};
  e.targets.wheel = e.suspension.wheel;
  const CornerPlan plan = prepare_suspension(e.suspension);
  const CornerPosition start = reference_position(plan);
  const auto add = [&](double z, double q) {
    const CornerPosition at = solve_position(plan, Driver::wheel_centre_z, {z, q}, start);
    e.targets.poses.push_back({q, at.place.carrier.centre,
                               wheel_angles(Side::left, e.suspension.wheel, at.place.carrier.rotation)});
  };
  for (double z = -travel; z < travel + step / 2; z += step) add(z, 0);
  for (double q = -rack; rack > 0 && q < rack + 0.01; q += 0.025) add(0, q);
  return e;
}
Example example_1() { return example("front_5US", 0.2, 0.05, 0.075); }
Example example_3() { return example("interconnected", 0.1, 0.02, 0); }
Example example_4() { return example("rear_5US", 0.15, 0.025, 0); }

/// A cube of 150 mm at random around a point.
PointBox box(const Vec3& p, RandomStream& random) {
  const auto shift = [&] { return random.uniform(-0.075, 0.075); };
  const double x = shift(), y = shift(), z = shift();
  return box_around(p + Vec3{x, y, z}, 0.15);
}

IndirectTask whole(const Example& e, std::uint64_t seed) {
  IndirectTask task{.targets = e.targets};
  RandomStream random({seed, 31});
  for (const CornerLink& link : e.suspension.links) {
    LinkTask to{.name = link.name, .type = link.type, .moved_by_rack = link.moved_by_rack};
    for (const Vec3& p : link.body) to.body.push_back(box(p, random));
    for (const Vec3& p : link.carrier) to.carrier.push_back(box(p, random));
    if (link.type == LinkType::SR)  // the hinge of example 3 lies along y
      for (int k = 0; k < 2; ++k) to.carrier[k].lower.y = to.carrier[k].upper.y = link.carrier[k].y;
    task.links.push_back(to);
  }
  for (const Coupler& c : e.suspension.couplers)
    task.couplers.push_back(
        {.first = c.first, .second = c.second, .min_offset = 0.1, .point = box_around(c.point, 0.15)});
  return task;
}

// A whole mechanism from random boxes of 150 mm, another box each time.
void synthesis(benchmark::State& state, Example (*make)()) {
  const Example e = make();
  std::vector<IndirectTask> tasks;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) tasks.push_back(whole(e, seed));
  RunContext context;
  std::size_t i = 0;
  double solved = 0;
  for (auto _ : state) {
    const IndirectSynthesis found = synthesise(tasks[i % tasks.size()], {}, i + 1, context);
    solved += found.status == Status::done;
    ++i;
  }
  state.counters["solved"] = solved / static_cast<double>(i);
}
BENCHMARK_CAPTURE(synthesis, front, example_1)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(synthesis, interconnected, example_3)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(synthesis, rear, example_4)->Unit(benchmark::kMicrosecond);

// The same by differential evolution with the source's settings, links only.
void evolution(benchmark::State& state, Example (*make)()) {
  const Example e = make();
  RunContext context;
  std::uint64_t seed = 0;
  double generations = 0;
  for (auto _ : state) {
    for (const LinkTask& link : whole(e, ++seed).links)
      generations += evolve_links(e.targets, {&link, 1}, {}, {}, {.seed = seed}, context).generations;
  }
  state.counters["generations"] = generations / static_cast<double>(seed);
}
BENCHMARK_CAPTURE(evolution, front, example_1)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(evolution, rear, example_4)->Unit(benchmark::kMicrosecond);

// Example 4 without the carrier pitch; rms of the structural errors in nanometres.
void unknown_carrier_pitch(benchmark::State& state) {
  const Example e = example_4();
  CarrierTargets open = e.targets;
  for (CarrierTarget& pose : open.poses) pose.angles.carrier_pitch = nan;
  RunContext context;
  std::uint64_t seed = 0;
  double rms = 0;
  for (auto _ : state) {
    const IndirectTask task = whole(e, ++seed);
    rms += fit_with_unknown_carrier_pitch(open, task.links, {}, seed, context).rms * 1e9;
  }
  state.counters["rms_nm"] = rms / static_cast<double>(seed);
}
BENCHMARK(unknown_carrier_pitch)->Unit(benchmark::kMillisecond);

// All rods through seven positions.
void seven_poses(benchmark::State& state) {
  const Example e = example_1();
  std::uint64_t seed = 0;
  for (auto _ : state) benchmark::DoNotOptimize(seven_pose_rods(e.targets, false, ++seed));
}
BENCHMARK(seven_poses)->Unit(benchmark::kMicrosecond);

// The smallest largest deviation from 50 starts in random boxes of 150 mm, one thread; share of seeds that
// reach it.
void direct(benchmark::State& state) {
  std::uint64_t seed = 0;
  double reached = 0;
  for (auto _ : state) {
    RunContext context;
    context.set_threads(1);
    ++seed;
    DirectTask task = published_direct_task();
    place_published_boxes(task, seed);
    reached += synthesise(task, {}, seed, context).largest < 0.91779;
  }
  state.counters["reached"] = reached / static_cast<double>(seed);
}
BENCHMARK(direct)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace linkwright::suspension
