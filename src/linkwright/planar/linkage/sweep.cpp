// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/sweep.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "linkwright/core/check.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/unfilled_array.h"
#include "linkwright/planar/linkage/assembly.h"
#include "linkwright/planar/sweep_samples.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t line = 8;  // doubles of a cache line, and lanes of the widest register
constexpr std::size_t samples_in_registers = 1 << 14;  // number of samples between two looks at the context
constexpr std::size_t samples_one_by_one = 1 << 8;

bool all_in_registers(const Linkage& l, const LinkagePlan& plan, bool forces) {
  if (plan.parts.size() > max_sweep_parts || plan.groups.size() > max_sweep_parts) return false;
  for (const Group& g : plan.groups)
    if (!g.as<Driver>() && !g.as<Dyad>()) return false;
  if (!forces) return true;
  return l.springs.empty() && l.torsion_springs.empty() && l.forces.empty() && l.torques.empty() &&
         l.struts.empty() && l.stops.empty() &&
         std::all_of(l.joints.begin(), l.joints.end(),
                     [](const LinkageJoint& j) { return !has_friction(j) && j.type != JointType::fixed; });
}

// Value of an input's row at a sample.
double of(std::span<const double> row, std::size_t i) {
  return row.empty() ? 0.0 : row.size() == 1 ? row[0] : row[i];
}

}  // namespace

KernelSet<SweepKernel> sweep_kernels() { return LINKWRIGHT_KERNEL_SET(sweep); }

struct LinkageSweep::Memory {
  Memory(Linkage l, LinkagePlan p, const SweepWanted& w)
      : linkage(std::move(l)), plan(std::move(p)), wanted(w), motion(plan) {}

  Linkage linkage;
  LinkagePlan plan;
  SweepWanted wanted;
  bool batched = false;
  SweepTask task;
  std::size_t rows = 0, samples = 0;
  UnfilledArray<double> data;
  UnfilledArray<Status> status;
  LinkageMotion motion;
  LinkageForces forces;
  std::vector<InputMotion> inputs;
  std::vector<double> modes;                // signs, one a group
  std::optional<LinkageAssembly> assembly;  // assembly of plans without closed form

  double& number(std::size_t row, std::size_t sample) { return task.data[row * task.stride + sample]; }
  std::span<const double> row(std::size_t r) const { return {task.data + r * task.stride, samples}; }

  void make_room(std::size_t n) {
    samples = n;
    task.count = (n + line - 1) / line * line;
    // An odd number of cache lines from row to row: with a power of two all rows of a sample would compete
    // for the same few places of the cache.
    task.stride = task.count + (task.count / line % 2 == 0 ? line : 0);
    double* const first = data.make_room(rows * task.stride + line);
    const auto address = reinterpret_cast<std::uintptr_t>(first);
    task.data = first + (line * sizeof(double) - address % (line * sizeof(double))) / sizeof(double) % line;
    status.make_room(n);
  }

  void read(std::size_t i) {
    for (std::size_t k = 0; k < inputs.size(); ++k)
      inputs[k] = {number(task.inputs + 3 * k, i), number(task.inputs + 3 * k + 1, i),
                   number(task.inputs + 3 * k + 2, i)};
  }

  // The samples from `begin` to `end` of the inputs, and of the groups that cannot fail.
  void take_block(std::span<const SweepInput> from, std::size_t begin, std::size_t end) {
    bool finite = true;
    for (std::size_t k = 0; k < from.size(); ++k) {
      const std::span<const double> rows[] = {from[k].value, from[k].rate, from[k].acceleration};
      for (std::size_t r = 0; r < 3; ++r)
        finite &= copy_samples(rows[r], begin, {&number(task.inputs + 3 * k + r, begin), end - begin});
    }
    LINKWRIGHT_REQUIRE(finite, "inputs must be finite, {} samples", samples);
    for (std::size_t k = 0; k < plan.groups.size(); ++k)
      if (plan.groups[k].as<Driver>())
        for (std::size_t r = 0; r < 2; ++r)
          std::fill_n(&number(task.groups + 2 * k + r, begin), end - begin, 1.0);
    std::fill(status.data() + begin, status.data() + std::min(end, samples), Status::done);
  }

  // A block of samples at a time, so that a run can be stopped and its memory is touched once.
  void run(std::span<const SweepInput> from, std::span<const double> time, const RunContext* context) {
    const std::size_t block = batched ? samples_in_registers : samples_one_by_one;
    for (std::size_t begin = 0; begin < task.count; begin += block) {
      throw_if_interrupted(context);
      const std::size_t end = std::min(begin + block, task.count);
      take_block(from, begin, end);
      if (batched) {
        SweepTask part = task;
        part.data += begin;
        part.count = end - begin;
        if (widest_of<sweep_kernels>().run(part)) continue;
      }
      for (std::size_t i = begin; i < std::min(end, samples); ++i)
        if (!batched || number(task.good, i) == 0) scalar(i, of(time, i));
    }
  }

  // One sample by the functions for one position.
  void scalar(std::size_t i, double time) {
    read(i);
    if (assembly)
      assembly->place(inputs, motion);
    else
      solve_position(plan, inputs, motion);
    if (wanted.rates) {
      solve_velocity(plan, inputs, motion);
      solve_acceleration(plan, inputs, motion);
    }
    status.data()[i] = motion.status;
    if (wanted.forces) {
      solve_forces(linkage, plan, motion, time, inputs.empty() ? 0.0 : inputs[0].value, forces);
      status.data()[i] = forces.status;
    }
    write(i);
  }

  void write(std::size_t i) {
    const std::size_t failed = motion.failed_group < 0 ? plan.groups.size() : at(motion.failed_group);
    for (std::size_t p = 1; p < plan.parts.size(); ++p) {
      const bool known = plan.group_of_part[p] >= 0 && at(plan.group_of_part[p]) < failed;
      const PartState<double>& s = motion.parts[p];
      const double values[] = {
          s.origin.x,   s.origin.y, s.direction.x,    s.direction.y,    s.velocity.x,
          s.velocity.y, s.speed,    s.acceleration.x, s.acceleration.y, s.angular_acceleration};
      for (std::size_t r = 0; r < task.part_rows; ++r)
        number(task.parts + task.part_rows * (p - 1) + r, i) = known ? values[r] : nan;
    }
    for (std::size_t k = 0; k < plan.groups.size(); ++k) {
      const GroupTraits traits = traits_of(plan.groups[k]);
      const bool known = k < failed || (k == failed && traits.closed_form);
      const GroupState<double>& s = motion.groups[k];
      number(task.groups + 2 * k, i) = !known                                     ? nan
                                       : traits.closes_loop && traits.closed_form ? s.radicand
                                                                                  : 1.0;
      number(task.groups + 2 * k + 1, i) = !known ? nan : traits.closes_loop ? s.sine : 1.0;
    }
    if (!wanted.forces) return;
    for (std::size_t j = 0; j < linkage.joints.size(); ++j) {
      const JointReaction& r = forces.joints[j];
      number(task.joints + 3 * j, i) = r.force.x;
      number(task.joints + 3 * j + 1, i) = r.force.y;
      number(task.joints + 3 * j + 2, i) = r.moment;
    }
    for (std::size_t k = 0; k < inputs.size(); ++k) number(task.drives + k, i) = forces.drives[k];
    number(task.shaking, i) = forces.shaking_force.x;
    number(task.shaking + 1, i) = forces.shaking_force.y;
    number(task.shaking + 2, i) = forces.shaking_moment_with_drive;
  }
};

LinkageSweep::LinkageSweep(Linkage linkage, LinkagePlan plan, const SweepWanted& wanted)
    : memory_(std::make_unique<Memory>(std::move(linkage), std::move(plan), wanted)) {
  Memory& m = *memory_;
  LINKWRIGHT_REQUIRE(!wanted.forces || wanted.rates, "forces need rates");
  LINKWRIGHT_REQUIRE(!wanted.forces || m.plan.has_masses, "forces need the mass of every body: '{}' has none",
                     m.plan.massless[0]);
  m.batched = all_in_registers(m.linkage, m.plan, wanted.forces);
  m.inputs.resize(m.plan.inputs());
  m.modes = m.motion.modes;
  SweepTask& t = m.task;
  t.plan = &m.plan;
  t.gravity = math::vec(m.linkage.gravity);
  t.moment_centre = math::vec(m.linkage.moment_centre);
  t.rates = wanted.rates;
  t.forces = wanted.forces;
  t.part_rows = wanted.rates ? 10 : 4;
  const auto take = [&](std::size_t& first, std::size_t count) {
    first = m.rows;
    m.rows += count;
  };
  take(t.inputs, 3 * m.plan.inputs());
  take(t.parts, t.part_rows * (m.plan.parts.size() - 1));
  take(t.groups, 2 * m.plan.groups.size());
  take(t.good, 1);
  if (!wanted.forces) return;
  take(t.joints, 3 * m.linkage.joints.size());
  take(t.drives, m.plan.inputs());
  take(t.shaking, 3);
}

LinkageSweep::~LinkageSweep() = default;
LinkageSweep::LinkageSweep(LinkageSweep&&) noexcept = default;
LinkageSweep& LinkageSweep::operator=(LinkageSweep&&) noexcept = default;

void LinkageSweep::set_modes(std::span<const double> modes) {
  LINKWRIGHT_REQUIRE(modes.size() == memory_->plan.groups.size(), "{} groups, got {} modes",
                     memory_->plan.groups.size(), modes.size());
  memory_->modes.assign(modes.begin(), modes.end());
  memory_->motion.modes = memory_->modes;
}

void LinkageSweep::run(std::span<const SweepInput> inputs, std::span<const double> time,
                       const RunContext* context) {
  Memory& m = *memory_;
  LINKWRIGHT_REQUIRE(inputs.size() == m.plan.inputs() && !inputs.empty(), "the linkage has {} inputs, got {}",
                     m.plan.inputs(), inputs.size());
  const std::size_t n = inputs[0].value.size();
  LINKWRIGHT_REQUIRE(time.empty() || time.size() == n, "{} samples, got {} times", n, time.size());
  m.make_room(n);
  if (n == 0) return;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const std::span<const double> rows[] = {inputs[k].value, inputs[k].rate, inputs[k].acceleration};
    for (std::size_t r = 0; r < 3; ++r)
      LINKWRIGHT_REQUIRE(rows[r].size() == n || (r > 0 && rows[r].size() <= 1),
                         "{} samples, input {} has {} numbers", n, k, rows[r].size());
  }
  if (!m.plan.closed_form()) {
    InputReach reach;
    for (const SweepInput& in : inputs) {
      const auto [least, most] = std::minmax_element(in.value.begin(), in.value.end());
      LINKWRIGHT_REQUIRE(
          std::all_of(in.value.begin(), in.value.end(), [](double v) { return std::isfinite(v); }),
          "inputs must be finite, {} samples", n);
      reach.low.push_back(*least);
      reach.high.push_back(*most);
    }
    m.assembly.emplace(m.plan, reach, AtChangePoint::smooth, false, m.modes);
  }
  m.task.modes = m.motion.modes.data();
  m.run(inputs, time, context);
}

std::size_t LinkageSweep::samples() const { return memory_->samples; }
std::span<const Status> LinkageSweep::status() const { return {memory_->status.data(), memory_->samples}; }

std::span<const double> LinkageSweep::part(int part, PartRow row) const {
  const SweepTask& t = memory_->task;
  const auto r = static_cast<std::size_t>(row);
  LINKWRIGHT_REQUIRE(part >= 1 && at(part) < memory_->plan.parts.size() && r < t.part_rows,
                     "part {} of {}, row {} of {}", part, memory_->plan.parts.size(), r, t.part_rows);
  return memory_->row(t.parts + t.part_rows * (at(part) - 1) + r);
}
std::span<const double> LinkageSweep::group(int group, GroupRow row) const {
  LINKWRIGHT_REQUIRE(group >= 0 && at(group) < memory_->plan.groups.size(), "there is no group {} of {}",
                     group, memory_->plan.groups.size());
  return memory_->row(memory_->task.groups + 2 * at(group) + static_cast<std::size_t>(row));
}
std::span<const double> LinkageSweep::joint(int joint, JointRow row) const {
  LINKWRIGHT_REQUIRE(memory_->wanted.forces, "forces were not asked for");
  LINKWRIGHT_REQUIRE(joint >= 0 && at(joint) < memory_->linkage.joints.size(), "there is no joint {} of {}",
                     joint, memory_->linkage.joints.size());
  return memory_->row(memory_->task.joints + 3 * at(joint) + static_cast<std::size_t>(row));
}
std::span<const double> LinkageSweep::drive(int input) const {
  LINKWRIGHT_REQUIRE(memory_->wanted.forces, "forces were not asked for");
  LINKWRIGHT_REQUIRE(input >= 0 && at(input) < memory_->plan.inputs(), "there is no input {} of {}", input,
                     memory_->plan.inputs());
  return memory_->row(memory_->task.drives + at(input));
}
std::span<const double> LinkageSweep::shaking(ShakingRow row) const {
  LINKWRIGHT_REQUIRE(memory_->wanted.forces, "forces were not asked for");
  return memory_->row(memory_->task.shaking + static_cast<std::size_t>(row));
}

bool LinkageSweep::batched() const { return memory_->batched; }
const char* sweep_kernel_name() { return widest_of<sweep_kernels>().name; }

}  // namespace linkwright::planar
