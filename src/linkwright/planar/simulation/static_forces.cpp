// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/static_forces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/planar/linkage/stop.h"
#include "linkwright/planar/linkage/strut.h"

namespace linkwright::planar {

StaticForces::StaticForces(const Linkage& linkage, const LinkagePlan& plan, std::vector<std::size_t> free,
                           LinkageAssembly* assembly)
    : motion(plan), l_(linkage), plan_(plan), free_(std::move(free)), assembly_(assembly) {
  LINKWRIGHT_REQUIRE(plan.has_masses, "rest positions need the mass of every body: '{}' has none",
                     plan.massless[0]);
  for (const std::size_t k : free_)
    LINKWRIGHT_REQUIRE(k < plan.inputs(), "the linkage has {} inputs, there is no input {}", plan.inputs(),
                       k);
  inputs_.resize(plan.inputs());
  rates_.resize(free_.size() * plan.parts.size());
}

Status StaticForces::solve(std::span<const double> values) {
  LINKWRIGHT_REQUIRE(values.size() == plan_.inputs(), "the linkage has {} inputs, got {}", plan_.inputs(),
                     values.size());
  for (std::size_t k = 0; k < values.size(); ++k) inputs_[k] = {values[k], 0, 0};
  if (assembly_)
    assembly_->place(inputs_, motion);
  else
    solve_position(plan_, inputs_, motion);
  if (motion.status != Status::done) return motion.status;
  if (load_without_value(l_, plan_, motion, 0)) return Status::limit_reached;
  constexpr double rounding = 1e-13;  // rad, and sizes of the linkage
  const bool passed = passed_stop(l_, plan_, motion, rounding) >= 0;
  for (std::size_t j = 0; j < free_.size(); ++j) {
    inputs_[free_[j]].rate = 1;
    solve_velocity(plan_, inputs_, motion);
    inputs_[free_[j]].rate = 0;
    for (std::size_t p = 1; p < plan_.parts.size(); ++p)
      rates_[j * plan_.parts.size() + p] = {motion.parts[p].velocity, motion.parts[p].speed};
    if (j > 0) continue;
    stop_rates.clear();
    for (std::size_t k = 0; k < l_.stops.size(); ++k)
      stop_rates.push_back(stop_motion(l_, plan_, motion, k).rate);
  }
  solve_velocity(plan_, inputs_, motion);
  force = along_inputs();
  return passed ? Status::limit_reached : Status::done;
}

// The generalised forces at the present rates of the motion, and their scale.
std::vector<double> StaticForces::along_inputs() {
  const std::size_t parts = plan_.parts.size();
  const math::Vec2 gravity = math::vec(l_.gravity);
  loads_.clear();
  applied_loads(l_, plan_, motion, 0, inputs_.empty() ? 0 : inputs_[0].value, loads_);
  std::vector<double> out;
  scale = 0;
  for (std::size_t j = 0; j < free_.size(); ++j) {
    const PartRate* rates = &rates_[j * parts];
    double sum = 0, sizes = 0;
    const auto add = [&](double power) { sum += power, sizes += std::abs(power); };
    for (std::size_t p = 1; p < parts; ++p) {
      const PartMass& m = plan_.masses[p];
      const math::Vec2 arm = rotate(motion.parts[p].direction, m.moment);
      add(dot(gravity, m.mass * rates[p].velocity + rates[p].speed * perpendicular(arm)));
    }
    for (const AppliedLoad& load : loads_) {
      const std::size_t p = at(plan_.bodies[at(load.body)].part);
      if (p == 0) continue;
      const math::Vec2 arm = load.point - motion.parts[p].origin;
      add(dot(load.force, rates[p].velocity + rates[p].speed * perpendicular(arm)) +
          load.torque * rates[p].speed);
    }
    out.push_back(sum);
    scale = std::max(scale, sizes);
  }
  return out;
}

std::vector<double> StaticForces::masses() const {
  const std::size_t parts = plan_.parts.size(), n = free_.size();
  std::vector<double> out(n * n);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k) {
      const PartRate *a = &rates_[j * parts], *b = &rates_[k * parts];
      for (std::size_t p = 1; p < parts; ++p) {
        const PartMass& m = plan_.masses[p];
        const math::Vec2 arm = rotate(motion.parts[p].direction, m.moment);
        out[j * n + k] += m.mass * dot(a[p].velocity, b[p].velocity) +
                          a[p].speed * cross(arm, b[p].velocity) + b[p].speed * cross(arm, a[p].velocity) +
                          m.inertia * a[p].speed * b[p].speed;
      }
    }
  return out;
}

std::vector<double> StaticForces::dampings() {
  constexpr double slow = 1e-3;  // rad/s, or sizes of the linkage in a second
  const std::size_t n = free_.size();
  const double kept = scale;
  std::vector<double> out(n * n);
  for (std::size_t k = 0; k < n; ++k) {
    const double rate = slow * (plan_.rotary[free_[k]] ? 1 : plan_.size);
    std::vector<double> forces[2];
    for (const int side : {0, 1}) {
      inputs_[free_[k]].rate = side ? rate : -rate;
      solve_velocity(plan_, inputs_, motion);
      forces[side] = along_inputs();
    }
    inputs_[free_[k]].rate = 0;
    for (std::size_t j = 0; j < n; ++j) out[j * n + k] = (forces[0][j] - forces[1][j]) / (2 * rate);
  }
  solve_velocity(plan_, inputs_, motion);
  scale = kept;
  return out;
}

double StaticForces::potential() const { return potential_energy(l_, plan_, motion); }

}  // namespace linkwright::planar
