#pragma once

#include "linkwright/core/tolerance.h"
#include "linkwright/math/simd.h"
#include "linkwright/planar/linkage_kernel.h"
#include "linkwright/planar/linkage_sweep.h"

namespace linkwright::planar {

/// Reads and writes rows of a sweep, one register of samples at a time.
template <class Batch>
struct SweepRows {
  double* data;
  std::size_t stride;
  LINKWRIGHT_KERNEL Batch load(std::size_t row) const { return Batch::load_unaligned(data + row * stride); }
  LINKWRIGHT_KERNEL void store(std::size_t row, const Batch& value) const {
    value.store_unaligned(data + row * stride);
  }
  LINKWRIGHT_KERNEL void store(std::size_t row, const Vec<Batch>& value) const {
    store(row, value.x);
    store(row + 1, value.y);
  }
};

/// The wrench w about `about` that a joint of the plan puts on its part after, as the reaction of the model's
/// joint. Pins have no moment about themselves.
template <class Batch>
LINKWRIGHT_KERNEL void store_reaction(const SweepTask& task, const SweepRows<Batch>& rows, const PlanJoint& j,
                                      bool moment, const PartState<Batch>* parts, const Wrench<Batch>& w,
                                      const Vec<Batch>& about) {
  if (j.joint < 0) return;
  const std::size_t row = task.joints + 3 * static_cast<std::size_t>(j.joint);
  Batch turning(0.0);
  if (moment) {
    const PartPoint& second = j.reversed ? j.before : j.after;
    turning = w.moment + cross(about - point_on(parts[second.part], second.at), w.force);
  }
  const Batch side(j.reversed ? -1.0 : 1.0);
  rows.store(row, side * w.force);
  rows.store(row + 2, side * turning);
}

template <class Batch>
LINKWRIGHT_KERNEL void sweep_forces(const SweepTask& task, const SweepRows<Batch>& rows,
                                    const PartState<Batch>* parts, const GroupState<Batch>* states,
                                    Wrench<Batch>* needed) {
  const LinkagePlan& plan = *task.plan;
  const Vec<Batch> gravity = spread<Batch>(task.gravity);
  const Batch none(0.0);
  needed[0] = {{none, none}, none};
  for (std::size_t p = 1; p < plan.parts.size(); ++p)
    needed[p] = needed_wrench(plan.masses[p], parts[p], gravity);
  for (std::size_t k = plan.groups.size(); k-- > 0;) {
    const Group& g = plan.groups[k];
    if (g.type == GroupType::driver) {
      const PlanJoint& j = g.joints[0];
      const Wrench<Batch> w = driver_force(g, parts, needed);
      store_reaction(task, rows, j, true, parts, w, point_on(parts[j.after.part], j.after.at));
      const Batch side(j.reversed ? -1.0 : 1.0);
      Batch drive = w.moment;
      if (j.slide)
        drive = dot(turn(parts[j.before.part].direction, spread<Batch>(j.before.direction)), w.force);
      rows.store(task.drives + static_cast<std::size_t>(g.input), side * drive);
      continue;
    }
    const GroupState<Batch>& s = states[k];
    for_dyad(
        g.type, [&](auto type) __attribute__((always_inline)) {
          constexpr DyadLayout at = layout(decltype(type)::value);
          Wrench<Batch> joints[3];
          dyad_forces(type, g, parts, s, needed, joints);
          store_reaction(task, rows, g.joints[0], at.slide1, parts, joints[0], s.reference);
          store_reaction(task, rows, g.joints[1], at.slide2, parts, joints[1], s.reference);
          store_reaction(task, rows, g.joints[2], at.slide3, parts, joints[2], s.reference);
        });
  }
  rows.store(task.shaking, -needed[0].force);
  rows.store(task.shaking + 2, -needed[0].moment);
}

template <class Batch, bool rates, bool forces>
LINKWRIGHT_KERNEL void sweep_all(const SweepTask& task) {
  const LinkagePlan& plan = *task.plan;
  const Batch none(0.0);
  PartState<Batch> parts[most_sweep_parts];
  GroupState<Batch> states[most_sweep_parts];
  Wrench<Batch> needed[most_sweep_parts];
  parts[0] = {{none, none}, {Batch(1.0), none}, {none, none}, none, {none, none}, none};
  for (std::size_t i = 0; i < task.count; i += Batch::size) {
    const SweepRows<Batch> rows{task.data + i, task.stride};
    auto good = none == none;
    for (std::size_t k = 0; k < plan.groups.size(); ++k) {
      const Group& g = plan.groups[k];
      GroupState<Batch>& s = states[k];
      if (g.type == GroupType::driver) {
        const std::size_t row = task.inputs + 3 * static_cast<std::size_t>(g.input);
        place_driver(g, rows.load(row), parts);
        if constexpr (rates) {
          const Batch rate = rows.load(row + 1);
          drive_velocity(g, rate, parts);
          drive_acceleration(g, rate, rows.load(row + 2), parts);
        }
      } else {
        for_dyad(
            g.type, [&](auto type) __attribute__((always_inline)) {
              place_dyad(type, g, Batch(task.modes[k]), parts, s);
              if constexpr (rates) {
                dyad_velocity(type, g, parts, s);
                dyad_acceleration(type, g, parts, s);
              }
            });
        good =
            good & (s.radicand > none) & (math::Scalar<Batch>::abs(s.sine) >= Batch(tolerance::toggle_angle));
        rows.store(task.groups + 2 * k, s.radicand);
        rows.store(task.groups + 2 * k + 1, s.sine);
      }
    }
    for (std::size_t p = 1; p < plan.parts.size(); ++p) {
      const std::size_t row = task.parts + task.part_rows * (p - 1);
      const PartState<Batch>& part = parts[p];
      rows.store(row, part.origin);
      rows.store(row + 2, part.direction);
      if constexpr (rates) {
        rows.store(row + 4, part.velocity);
        rows.store(row + 6, part.speed);
        rows.store(row + 7, part.acceleration);
        rows.store(row + 9, part.angular_acceleration);
      }
    }
    rows.store(task.good, math::Scalar<Batch>::choose(good, Batch(1.0), none));
    if constexpr (forces) sweep_forces(task, rows, parts, states, needed);
  }
}

template <class Batch>
LINKWRIGHT_KERNEL void sweep_with(const SweepTask& task) {
  if (task.forces)
    sweep_all<Batch, true, true>(task);
  else if (task.rates)
    sweep_all<Batch, true, false>(task);
  else
    sweep_all<Batch, false, false>(task);
}

}  // namespace linkwright::planar
