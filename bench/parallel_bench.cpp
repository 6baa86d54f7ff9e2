// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/parallel/robot/drives.h"

namespace linkwright::parallel {
namespace {

// Poses in the middle of a robot's workspace with their arm angles.
struct Places {
  Robot robot;
  std::vector<Pose> poses;
  std::vector<std::array<double, max_legs>> angles;
};

Places places_of(const Robot& robot, const Vec3& middle, double size, double tilt) {
  Places out{robot, {}, {}};
  RandomStream random({.seed = 1});
  const auto within = [&](double by) {
    return Vec3{random.uniform(-by, by), random.uniform(-by, by), random.uniform(-by, by)};
  };
  while (out.poses.size() < 1024) {
    Pose pose{middle + within(size)};
    if (robot.freedom == Freedom::space) pose.rotation = math::turn_about(within(tilt));
    if (robot.freedom == Freedom::plane_translation) pose.position.z = 0;
    const ArmAngles angles = inverse(robot, pose);
    if (angles.status != Status::done) continue;
    out.poses.push_back(pose);
    out.angles.push_back(angles.angle);
  }
  return out;
}

Places delta_places() {
  return places_of(delta({.base_radius = 0.2, .platform_radius = 0.045, .arm = 0.35, .rod = 0.8}),
                   {0, 0, -0.85}, 0.2, 0);
}
Places hexa_places() {
  return places_of(hexa({.base_radius = 0.25,
                         .base_offset = 0.06,
                         .platform_radius = 0.09,
                         .platform_angle = 0.785398163397448,
                         .arm = 0.25,
                         .rod = 0.55}),
                   {0, 0, -0.5}, 0.1, 0.2);
}
Places five_bar_places() {
  return places_of(
      planar({.base_x = -0.15, .arm = 0.25, .rod = 0.35}, {.base_x = 0.15, .arm = 0.25, .rod = 0.35}),
      {0, 0.4, 0}, 0.1, 0);
}

template <class Each>
void over(benchmark::State& state, const Places& places, Each&& each) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(each(i));
    i = (i + 1) % places.poses.size();
  }
}

void delta_inverse(benchmark::State& state) {
  const Places p = delta_places();
  over(state, p, [&](std::size_t i) { return inverse(p.robot, p.poses[i]); });
}
void delta_direct(benchmark::State& state) {
  const Places p = delta_places();
  over(state, p, [&](std::size_t i) { return direct(p.robot, p.angles[i], -1); });
}
void delta_quality(benchmark::State& state) {
  const Places p = delta_places();
  over(state, p,
       [&](std::size_t i) { return quality(p.robot, jacobians(p.robot, p.poses[i], p.angles[i]), 1); });
}
void five_bar_inverse(benchmark::State& state) {
  const Places p = five_bar_places();
  over(state, p, [&](std::size_t i) { return inverse(p.robot, p.poses[i]); });
}
void five_bar_direct(benchmark::State& state) {
  const Places p = five_bar_places();
  over(state, p, [&](std::size_t i) { return direct(p.robot, p.angles[i], 1); });
}
void hexa_inverse(benchmark::State& state) {
  const Places p = hexa_places();
  over(state, p, [&](std::size_t i) { return inverse(p.robot, p.poses[i]); });
}
// From a neighbour: 2 mm and about a degree away.
void hexa_direct_near(benchmark::State& state) {
  const Places p = hexa_places();
  const Mat3 turn = math::turn_about(Vec3{0.01, -0.01, 0.01});
  over(state, p, [&](std::size_t i) {
    return direct_near(p.robot, p.angles[i],
                       {p.poses[i].position + Vec3{0.001, -0.001, 0.0012}, turn * p.poses[i].rotation});
  });
}
void hexa_quality(benchmark::State& state) {
  const Places p = hexa_places();
  over(state, p,
       [&](std::size_t i) { return quality(p.robot, jacobians(p.robot, p.poses[i], p.angles[i]), 0.09); });
}
BENCHMARK(delta_inverse);
BENCHMARK(delta_direct);
BENCHMARK(delta_quality);
BENCHMARK(five_bar_inverse);
BENCHMARK(five_bar_direct);
BENCHMARK(hexa_inverse);
BENCHMARK(hexa_direct_near);
BENCHMARK(hexa_quality);

}  // namespace
}  // namespace linkwright::parallel
