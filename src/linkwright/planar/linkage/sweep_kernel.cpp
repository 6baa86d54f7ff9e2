// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/tolerance.h"
#include "linkwright/math/simd.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/planar/linkage/sweep.h"

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
  LINKWRIGHT_KERNEL void store(std::size_t row, const math::Vector2<Batch>& value) const {
    store(row, value.x);
    store(row + 1, value.y);
  }
};

/// The wrench w about `about` that a joint of the plan puts on its part after, as the reaction of the model's
/// joint. Pins have no moment about themselves.
template <class Batch>
LINKWRIGHT_KERNEL void store_reaction(const SweepTask& task, const SweepRows<Batch>& rows, const PlanJoint& j,
                                      bool moment, const PartState<Batch>* parts, const Wrench<Batch>& w,
                                      const math::Vector2<Batch>& about) {
  if (j.joint < 0) return;
  const std::size_t row = task.joints + 3 * static_cast<std::size_t>(j.joint);
  Batch turning(0.0);
  if (moment) {
    const PartPoint& second = j.reversed ? j.before : j.after;
    turning = w.moment + cross(about - point_on(parts[second.part], second.at), w.force);
  }
  rows.store(row, j.reversed ? -w.force : w.force);
  rows.store(row + 2, j.reversed ? -turning : turning);
}

/// Registers of samples that go through each step together: one waits for its square roots and divisions
/// while the next continues.
inline constexpr std::size_t sweep_together = 4;

/// Motion of all parts for `sweep_together` registers of samples.
template <class Batch>
struct SweepBlock {
  struct Register {
    PartState<Batch> parts[max_sweep_parts];
    GroupState<Batch> states[max_sweep_parts];
    Wrench<Batch> needed[max_sweep_parts];
    // Keeps the same place of two registers off the same place of the cache.
    Batch apart[24];
  };
  Register registers[sweep_together];
  double* data[sweep_together];
  std::size_t stride;
  LINKWRIGHT_KERNEL SweepRows<Batch> rows(std::size_t b) const { return {data[b], stride}; }
};

template <class Batch>
LINKWRIGHT_KERNEL void sweep_forces(const SweepTask& task, SweepBlock<Batch>& block) {
  const LinkagePlan& plan = *task.plan;
  const math::Vector2<Batch> gravity = math::broadcast<Batch>(task.gravity);
  const Batch none(0.0);
  for (auto& r : block.registers) {
    r.needed[0] = {{none, none}, none};
    for (std::size_t p = 1; p < plan.parts.size(); ++p)
      r.needed[p] = needed_wrench(plan.masses[p], r.parts[p], gravity);
  }
  for (std::size_t k = plan.groups.size(); k-- > 0;) {
    const Group& g = plan.groups[k];
    const Dyad* dyad = g.as<Dyad>();
    if (!dyad) {  // a driver
      const PlanJoint& j = g.joints[0];
      for (std::size_t b = 0; b < sweep_together; ++b) {
        auto& r = block.registers[b];
        const Wrench<Batch> w = driver_force(g, r.parts, r.needed);
        const SweepRows<Batch> rows = block.rows(b);
        store_reaction(task, rows, j, true, r.parts, w, point_on(r.parts[j.after.part], j.after.at));
        Batch drive = w.moment;
        if (j.slide)
          drive = dot(rotate(r.parts[j.before.part].direction, math::broadcast<Batch>(j.before.direction)),
                      w.force);
        rows.store(task.drives + static_cast<std::size_t>(j.input), j.reversed ? -drive : drive);
      }
      continue;
    }
    for_dyad(
        dyad->type, [&](auto type) __attribute__((always_inline)) {
          constexpr DyadLayout at = layout(decltype(type)::value);
          for (std::size_t b = 0; b < sweep_together; ++b) {
            auto& r = block.registers[b];
            const SweepRows<Batch> rows = block.rows(b);
            const math::Vector2<Batch> about = r.states[k].reference;
            Wrench<Batch> joints[3];
            dyad_forces(type, g, r.parts, r.states[k], r.needed, joints);
            store_reaction(task, rows, g.joints[0], at.slide1, r.parts, joints[0], about);
            store_reaction(task, rows, g.joints[1], at.slide2, r.parts, joints[1], about);
            store_reaction(task, rows, g.joints[2], at.slide3, r.parts, joints[2], about);
          }
        });
  }
  for (const SharedPin& pin : plan.shared_pins)
    for (std::size_t b = 0; b < sweep_together; ++b) {
      if (b > 0 && block.data[b] == block.data[b - 1]) continue;  // the last register once more
      const SweepRows<Batch> rows = block.rows(b);
      const auto row = [&](std::size_t k) {
        return task.joints + 3 * static_cast<std::size_t>(pin.joints[k]);
      };
      math::Vector2<Batch> pairs[max_sweep_parts];
      for (std::size_t k = 0; k < pin.joints.size(); ++k)
        pairs[k] = {rows.load(row(k)), rows.load(row(k) + 1)};
      for (std::size_t i = 0; i < pin.joints.size(); ++i) {
        math::Vector2<Batch> sum{none, none};
        for (std::size_t k = 0; k < pin.joints.size(); ++k) sum = sum + Batch(pin.share[i][k]) * pairs[k];
        rows.store(row(i), sum);
      }
    }
  for (std::size_t b = 0; b < sweep_together; ++b) {
    const Wrench<Batch>& on_linkage = block.registers[b].needed[0];
    const math::Vector2<Batch> centre{Batch(task.moment_centre.x), Batch(task.moment_centre.y)};
    block.rows(b).store(task.shaking, -on_linkage.force);
    block.rows(b).store(task.shaking + 2, cross(centre, on_linkage.force) - on_linkage.moment);
  }
}

template <bool rates, class Batch>
LINKWRIGHT_KERNEL void sweep_motion(const SweepTask& task, SweepBlock<Batch>& block) {
  const LinkagePlan& plan = *task.plan;
  for (std::size_t k = 0; k < plan.groups.size(); ++k) {
    const Group& g = plan.groups[k];
    const Dyad* dyad = g.as<Dyad>();
    if (!dyad) {  // a driver
      const std::size_t row = task.inputs + 3 * static_cast<std::size_t>(g.joints[0].input);
      for (std::size_t b = 0; b < sweep_together; ++b) {
        PartState<Batch>* parts = block.registers[b].parts;
        const SweepRows<Batch> rows = block.rows(b);
        place_driver(g, rows.load(row), parts);
        if constexpr (rates) {
          const Batch rate = rows.load(row + 1);
          drive_velocity(g, rate, parts);
          drive_acceleration(g, rate, rows.load(row + 2), parts);
        }
      }
      continue;
    }
    for_dyad(
        dyad->type, [&](auto type) __attribute__((always_inline)) {
          const Batch mode(task.modes[k]);
          for (auto& r : block.registers) place_dyad(type, g, *dyad, mode, r.parts, r.states[k]);
          if constexpr (rates) {
            for (auto& r : block.registers) dyad_velocity(type, g, r.parts, r.states[k]);
            for (auto& r : block.registers) dyad_acceleration(type, g, r.parts, r.states[k]);
          }
        });
  }
}

/// Writes the motion of one register; whether all its samples are good.
template <bool rates, class Batch>
LINKWRIGHT_KERNEL bool sweep_write(const SweepTask& task, const SweepRows<Batch>& rows,
                                   const typename SweepBlock<Batch>::Register& r) {
  const LinkagePlan& plan = *task.plan;
  const Batch none(0.0);
  auto good = none == Batch(0.0);
  for (std::size_t k = 0; k < plan.groups.size(); ++k) {
    if (!plan.groups[k].as<Dyad>()) continue;
    const GroupState<Batch>& s = r.states[k];
    good = good & (s.radicand > none) & (math::Scalar<Batch>::abs(s.sine) >= Batch(tolerance::toggle_angle));
    rows.store(task.groups + 2 * k, s.radicand);
    rows.store(task.groups + 2 * k + 1, s.sine);
  }
  rows.store(task.good, math::Scalar<Batch>::choose(good, Batch(1.0), none));
  for (std::size_t p = 1; p < plan.parts.size(); ++p) {
    const std::size_t row = task.parts + task.part_rows * (p - 1);
    const PartState<Batch>& part = r.parts[p];
    rows.store(row, part.origin);
    rows.store(row + 2, part.direction);
    if constexpr (rates) {
      rows.store(row + 4, part.velocity);
      rows.store(row + 6, part.speed);
      rows.store(row + 7, part.acceleration);
      rows.store(row + 9, part.angular_acceleration);
    }
  }
  return xsimd::all(good);
}

template <class Batch, bool rates, bool forces>
LINKWRIGHT_KERNEL bool sweep_all(const SweepTask& task) {
  const Batch none(0.0);
  SweepBlock<Batch> block;
  for (auto& r : block.registers)
    r.parts[0] = {{none, none}, {Batch(1.0), none}, {none, none}, none, {none, none}, none};
  block.stride = task.stride;
  bool good = true;
  for (std::size_t i = 0; i < task.count; i += sweep_together * Batch::size) {
    // The last block repeats its last register: it is written over with the same numbers.
    for (std::size_t b = 0; b < sweep_together; ++b) {
      const std::size_t first = i + b * Batch::size, last = task.count - Batch::size;
      block.data[b] = task.data + (first < last ? first : last);
    }
    sweep_motion<rates>(task, block);
    for (std::size_t b = 0; b < sweep_together; ++b)
      good = sweep_write<rates, Batch>(task, block.rows(b), block.registers[b]) && good;
    if constexpr (forces) sweep_forces(task, block);
  }
  return good;
}

template <class Batch>
LINKWRIGHT_KERNEL bool sweep_with(const SweepTask& task) {
  if (task.forces) return sweep_all<Batch, true, true>(task);
  if (task.rates) return sweep_all<Batch, true, false>(task);
  return sweep_all<Batch, false, false>(task);
}

bool LINKWRIGHT_COMPILED(sweep)(const SweepTask& task) { return sweep_with<math::KernelBatch>(task); }

}  // namespace linkwright::planar
