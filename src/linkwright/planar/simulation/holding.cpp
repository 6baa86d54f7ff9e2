// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/holding.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/zero.h"

namespace linkwright::planar {

HoldingForces::HoldingForces(const Linkage& linkage, const LinkagePlan& plan, std::optional<std::size_t> load)
    : original_(linkage), l_(linkage), plan_(plan), load_(load), inputs_(plan.inputs()), motion_(plan) {
  LINKWRIGHT_REQUIRE(plan.inputs() == 1, "a holding range needs one input, not {}", plan.inputs());
  LINKWRIGHT_REQUIRE(plan.has_masses, "forces need the mass of every body: '{}' has none", plan.massless[0]);
  LINKWRIGHT_REQUIRE(!load || *load < linkage.forces.size(),
                     "the linkage has {} forces, there is no force {}", linkage.forces.size(), *load);
}

void HoldingForces::set_friction(double factor) {
  constexpr double least_efficiency = 1e-3;
  for (std::size_t j = 0; j < l_.joints.size(); ++j) {
    const LinkageJoint& j0 = original_.joints[j];
    // About to move, a joint has its friction at rest.
    l_.joints[j].friction = factor * std::max(j0.friction, j0.friction_static);
    l_.joints[j].friction_static = l_.joints[j].friction_speed = 0;
    l_.joints[j].friction_effort = factor * j0.friction_effort;
    if (j0.efficiency < 1)
      l_.joints[j].efficiency = std::max(least_efficiency, 1 - factor * (1 - j0.efficiency));
  }
}

// A force of that size in its direction, without the table that it may have.
void HoldingForces::set_load(double size) {
  PointForce& force = l_.forces[*load_];
  force.factor = {};
  force.force = size * (original_.forces[*load_].force / std::abs(original_.forces[*load_].force));
}

bool HoldingForces::place(double value, const LinkageMotion& placed) {
  motion_.modes = placed.modes;
  motion_.parts = placed.parts;
  inputs_[0] = {value, 0, 0};
  solve_motion(plan_, inputs_, motion_);
  return motion_.status == Status::done;
}

// The drive with which the linkage is about to move in a sense; nothing where friction jams it.
std::optional<double> HoldingForces::drive(double sense, double time) {
  constexpr double slow = 1e-9;  // rad/s, or sizes of the linkage in a second: dampers do not feel it
  inputs_[0].rate = sense * slow * (plan_.rotary[0] ? 1 : plan_.size);
  solve_velocity(plan_, inputs_, motion_);  // the accelerations stay zero
  solve_forces(l_, plan_, motion_, time, inputs_[0].value, forces_);
  if (forces_.status != Status::done) return std::nullopt;
  return forces_.drives[0];
}

HoldingRange HoldingForces::drives(double time) {
  HoldingRange out;
  const std::optional<double> down = drive(-1, time), up = drive(1, time);
  if (forces_.status != Status::done && forces_.status != Status::self_locking)
    return {forces_.status, nan, nan, nan};
  out.least = down.value_or(-infinity);
  out.greatest = up.value_or(infinity);
  if (out.least > out.greatest) std::swap(out.least, out.greatest);
  return out;
}

HoldingRange HoldingForces::range(double value, const LinkageMotion& placed, double time) {
  if (!place(value, placed)) return {motion_.status, nan, nan, nan};
  if (!load_) {
    set_friction(0);
    const std::optional<double> free = drive(1, time);
    set_friction(1);
    HoldingRange out = drives(time);
    out.without_friction = free.value_or(nan);
    return out;
  }
  // The force with which no drive is needed: without friction the drive is affine in it.
  const auto needed = [&](double size, double sense) {
    set_load(size);
    return drive(sense, time).value_or(nan);
  };
  set_friction(0);
  const double none = needed(0, 1), slope = needed(1, 1) - none;
  HoldingRange out{.without_friction = -none / slope};
  set_friction(1);
  double found[2];
  for (const int side : {0, 1}) {
    const double sense = side ? 1 : -1;
    double size = out.without_friction, value_at = needed(size, sense);
    double change = std::abs(size) > 0 ? 1e-3 * size : 1;
    for (int i = 0; i < 60 && std::abs(change) > 1e-14 * std::abs(size); ++i) {
      const double next = needed(size + change, sense), rate = (next - value_at) / change;
      size += change, value_at = next;
      if (value_at == 0 || rate == 0) break;
      change = -value_at / rate;
    }
    found[side] = size;
  }
  out.least = std::min(found[0], found[1]), out.greatest = std::max(found[0], found[1]);
  if (!std::isfinite(out.least + out.greatest))
    return {Status::not_converged, nan, nan, out.without_friction};
  return out;
}

double HoldingForces::self_locking_margin(double value, const LinkageMotion& placed, double time) {
  constexpr double most = 1e6, rounding = 1e-12;
  if (!place(value, placed)) return nan;
  if (load_) set_load(0);
  if (std::none_of(original_.joints.begin(), original_.joints.end(), loses_power)) return 0;
  const auto holds = [&](double factor) {
    set_friction(factor);
    const HoldingRange r = drives(time);
    const double slack = rounding * std::min(std::abs(r.least) + std::abs(r.greatest), most);
    return r.status == Status::done && r.least <= slack && r.greatest >= -slack;
  };
  double high = 1, low = 0;
  if (holds(0)) return infinity;
  while (!holds(high)) {
    low = high, high *= 4;
    if (high > most) return 0;
  }
  const double factor = math::bisect(holds, high, low, {.relative = 1e-12, .halvings = 200}).inside;
  set_friction(1);
  return 1 / factor;
}

}  // namespace linkwright::planar
