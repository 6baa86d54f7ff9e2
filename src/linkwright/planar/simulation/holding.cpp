// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/holding.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/minimum.h"
#include "linkwright/math/zero.h"
#include "linkwright/planar/linkage/dynamics.h"

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
    l_.joints[j].friction = factor * friction_at_rest(j0);
    l_.joints[j].friction_static = l_.joints[j].friction_speed = 0;
    l_.joints[j].friction_speeds.clear(), l_.joints[j].friction_values.clear();
    l_.joints[j].friction_effort = factor * j0.friction_effort;
    if (j0.efficiency < 1)
      l_.joints[j].efficiency = std::max(least_efficiency, 1 - factor * (1 - j0.efficiency));
  }
}

// A force of that size in its direction, without the table that it may have.
void HoldingForces::set_load(double size) {
  PointForce& force = l_.forces[*load_];
  force.factor = {}, force.formula = {};
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
  if (!std::isfinite(out.without_friction)) return {Status::not_converged, nan, nan, out.without_friction};
  // From there on outwards, the load at which no drive is needed to keep it moving; where it is needed
  // however large the load, or nothing moves the linkage, friction jams it.
  const double scale = std::max({std::abs(out.without_friction), std::abs(none), 1e-9}),
               most = 1e12 * std::max(scale, 1.0);
  for (const double sense : {-1.0, 1.0}) {
    const double outwards = slope > 0 ? -sense : sense;
    const auto holds = [&](double beyond) {
      const double drive = sense * needed(out.without_friction + outwards * beyond, sense);
      return std::isnan(drive) || drive > 0;
    };
    double high = scale * 1e-3, low = 0;
    while (holds(high) && high < most) low = high, high *= 4;
    double beyond = infinity;
    if (high < most && high > scale * 1e-3) {
      beyond = math::zero_between(
          [&](double b) { return needed(out.without_friction + outwards * b, sense); }, low, high);
    } else if (high < most) {
      beyond = math::bisect(holds, low, high, {.relative = 1e-15, .halvings = 200}).inside;
    }
    (outwards < 0 ? out.least : out.greatest) = out.without_friction + outwards * beyond;
  }
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

namespace {

// The joints of a linkage at rest, all of which stick: the share of what the most loaded one can bear.
class StuckLinkage {
 public:
  StuckLinkage(const Linkage& linkage, const LinkagePlan& plan, std::size_t load,
               std::span<const double> values, const LinkageMotion& placed, double time)
      : original_(linkage),
        l_(linkage),
        load_(load),
        time_(time),
        dynamics_(l_, plan, std::vector<bool>(plan.inputs(), true), AccelerationRoute::mass_matrix) {
    for (const double value : values) inputs_.push_back({value, 0, 0});
    dynamics_.motion.modes = placed.modes;
    dynamics_.motion.parts = placed.parts;
    l_.forces[load].factor = {}, l_.forces[load].formula = {};
  }

  // The share for a size of the load, with all friction times a factor; NaN where it cannot be told.
  double share(double size, double factor) {
    for (std::size_t j = 0; j < l_.joints.size(); ++j) {
      const LinkageJoint& joint = original_.joints[j];
      l_.joints[j].friction = factor * friction_at_rest(joint);  // nothing moves
      l_.joints[j].friction_static = l_.joints[j].friction_speed = 0;
      l_.joints[j].friction_speeds.clear(), l_.joints[j].friction_values.clear();
      l_.joints[j].friction_effort = factor * joint.friction_effort;
    }
    l_.forces[load_].force = size * (original_.forces[load_].force / std::abs(original_.forces[load_].force));
    dynamics_.states.emplace(l_.joints.size());
    for (std::size_t j = 0; j < l_.joints.size(); ++j)
      if (has_friction(l_.joints[j])) dynamics_.states->senses[j] = 0;
    status = dynamics_.solve(time_, inputs_);
    if (status != Status::done) return nan;
    if (dynamics_.states->held < inputs_.size()) {
      status = Status::infeasible;
      return nan;
    }
    double most = 0;
    for (std::size_t j = 0; j < l_.joints.size(); ++j)
      if (const double s = dynamics_.states->shares[j]; s > most) most = s, slips = static_cast<int>(j);
    return most;
  }

  Status status = Status::done;
  int slips = -1;  // the most loaded joint

 private:
  const Linkage& original_;
  Linkage l_;
  std::size_t load_;
  double time_;
  std::vector<InputMotion> inputs_;
  LinkageDynamics dynamics_;
};

// A size of the load that the linkage holds, by halving an interval about the least share, which is convex.
double held_size(StuckLinkage& linkage, double width) {
  math::GoldenSection section{[&](double size) { return linkage.share(size, 1); }, -width, width};
  for (int i = 0; i < 200; ++i, section.narrow()) {
    if (section.at_left <= 1) return section.left;
    if (section.at_right <= 1) return section.right;
  }
  return nan;
}

}  // namespace

HeldLoad held_load(const Linkage& linkage, const LinkagePlan& plan, std::size_t load,
                   std::span<const double> values, const LinkageMotion& placed, double time) {
  constexpr double most = 1e12, most_factor = 1e6;
  LINKWRIGHT_REQUIRE(load < linkage.forces.size(), "the linkage has {} forces, there is no force {}",
                     linkage.forces.size(), load);
  StuckLinkage stuck(linkage, plan, load, values, placed, time);
  HeldLoad out;
  double inside = 0;
  const double share = stuck.share(inside, 1);
  out.status = stuck.status;
  if (out.status != Status::done) return {out.status, nan, nan, nan, -1, -1};
  if (!(share <= 1)) {
    for (double width = 1; width < most && !(stuck.share(inside, 1) <= 1); width *= 100)
      if (const double found = held_size(stuck, width); !std::isnan(found)) inside = found;
  }
  if (!(stuck.share(inside, 1) <= 1)) {
    out.status = Status::infeasible, out.least = out.greatest = nan;
  } else {
    for (const double sense : {-1.0, 1.0}) {
      const auto holds = [&](double size) { return stuck.share(size, 1) <= 1; };
      double step = std::max(1.0, std::abs(inside));
      while (step < most && holds(inside + sense * step)) step *= 4;
      const bool ends = step < most;
      const double end =
          ends ? math::bisect(holds, inside, inside + sense * step, {.relative = 1e-15, .halvings = 200})
                     .inside
               : sense * infinity;
      if (ends) stuck.share(end, 1);
      (sense < 0 ? out.least : out.greatest) = end;
      (sense < 0 ? out.least_slips : out.greatest_slips) = ends ? stuck.slips : -1;
    }
  }
  if (stuck.share(0, 1) == 0) {
    out.margin = infinity;
    return out;
  }
  const auto holds = [&](double factor) { return factor > 0 && stuck.share(0, factor) <= 1; };
  double high = 1, low = 0;
  while (!holds(high) && high < most_factor) low = high, high *= 4;
  if (high < most_factor)
    out.margin = 1 / math::bisect(holds, high, low, {.relative = 1e-14, .halvings = 200}).inside;
  return out;
}

}  // namespace linkwright::planar
