// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/four_bar/sweep.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/unfilled_array.h"
#include "linkwright/math/sincos.h"
#include "linkwright/planar/four_bar/detail/sweep_kernel.h"
#include "linkwright/planar/sweep_samples.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t line = 8;  // doubles of a cache line, and lanes of the widest register
constexpr std::size_t samples_between_looks = 1 << 14;  // what the inner caches hold
constexpr std::size_t row_index(FourBarRow row) { return static_cast<std::size_t>(row); }

bool kept(const FourBarWanted& wanted, std::size_t row) {
  if (row <= row_index(FourBarRow::transmission_sine)) return wanted.directions;
  if (row <= row_index(FourBarRow::rocker_acceleration)) return wanted.rates;
  if (row <= row_index(FourBarRow::ground_on_rocker_y)) return wanted.forces;
  return wanted.shaking;
}

// In the order of FourBarRow.
std::array<double, four_bar_row_count> all_rows(const FourBarRates& r, const FourBarReactions& f) {
  return {r.crank_direction.real(),
          r.crank_direction.imag(),
          r.coupler_direction.real(),
          r.coupler_direction.imag(),
          r.rocker_direction.real(),
          r.rocker_direction.imag(),
          r.transmission_sine,
          r.coupler_speed,
          r.rocker_speed,
          r.coupler_acceleration,
          r.rocker_acceleration,
          f.ground_on_crank.real(),
          f.ground_on_crank.imag(),
          f.crank_on_coupler.real(),
          f.crank_on_coupler.imag(),
          f.rocker_on_coupler.real(),
          f.rocker_on_coupler.imag(),
          f.ground_on_rocker.real(),
          f.ground_on_rocker.imag(),
          f.drive_torque,
          f.shaking_force.real(),
          f.shaking_force.imag(),
          f.shaking_moment,
          f.shaking_moment_with_drive};
}

void require_finite(bool finite, std::size_t samples) {
  LINKWRIGHT_REQUIRE(finite, "crank angles, rates and accelerations of {} samples must be finite", samples);
}

}  // namespace

KernelSet<FourBarSweepKernel> four_bar_sweep_kernels() { return LINKWRIGHT_KERNEL_SET(four_bar_sweep); }

struct FourBarSweep::Memory {
  FourBarSweepTask task;
  std::vector<double> constants, angle, cosine, sine, rate, acceleration;
  UnfilledArray<double> data, good;
  UnfilledArray<Status> status;
  std::size_t samples = 0;  // number of samples in a row

  void prepare(std::span<const FourBarMachine> machines, bool over_machines, double gravity,
               const SweepInput& crank);
  void take_constants(std::span<const FourBarMachine> machines);
  void take_crank(const SweepInput& crank);
  void take_block(double frame_angle, const SweepInput& crank);
  void run(std::span<const FourBarMachine> machines, const SweepInput& crank, const RunContext* context);
  void mend(std::span<const FourBarMachine> machines, const SweepInput& crank);
};

void FourBarSweep::Memory::prepare(std::span<const FourBarMachine> machines, bool over_machines,
                                   double gravity, const SweepInput& crank) {
  const std::size_t n = crank.value.size();
  const auto fits = [&](std::span<const double> v) { return v.size() <= 1 || v.size() == n; };
  LINKWRIGHT_REQUIRE(fits(crank.rate) && fits(crank.acceleration),
                     "{} crank angles need as many rates and accelerations, one or none, got {} and {}", n,
                     crank.rate.size(), crank.acceleration.size());
  LINKWRIGHT_REQUIRE(std::isfinite(gravity), "gravity {} must be finite", gravity);
  task.over_machines = over_machines;
  task.gravity = gravity;
  samples = over_machines ? machines.size() : n;
  task.lanes = (samples + line - 1) / line * line;
  task.angles = over_machines ? n : 1;
  take_constants(machines);
  if (over_machines) take_crank(crank);
  task.data = data.make_room(task.rows * task.angles * task.lanes);
  task.good = good.make_room(task.angles * task.lanes);
  status.make_room(task.angles * task.lanes);
}

void FourBarSweep::Memory::take_constants(std::span<const FourBarMachine> machines) {
  const std::size_t width = task.over_machines ? task.lanes : 1;
  task.width = task.over_machines ? std::max(task.lanes, line) : 1;
  constants.resize(four_bar_constants * task.width);  // read even when there is no angle
  for (std::size_t k = 0; k < width && !machines.empty(); ++k) {
    const auto& [l, m] = machines[std::min(k, machines.size() - 1)];
    require_lengths(l);
    LINKWRIGHT_REQUIRE(std::isfinite(l.frame_angle), "frame angle {} must be finite", l.frame_angle);
    double fx, fy;
    math::sincos_of_any(l.frame_angle, fy, fx);
    const BaseParameters crank_base = base_parameters(m.crank), coupler = base_parameters(m.coupler),
                         rocker = base_parameters(m.rocker);
    std::size_t row = 0;
    for (const double v : {fx, fy, l.ground, l.crank, l.coupler, l.rocker, planar::sign(l.branch)})
      constants[row++ * task.width + k] = v;
    for (const BaseParameters* b : {&crank_base, &coupler, &rocker})
      for (const double v : {b->mass, b->moment.real(), b->moment.imag(), b->inertia})
        constants[row++ * task.width + k] = v;
  }
  task.constants = constants.data();
}

// The crank angles that all machines share.
void FourBarSweep::Memory::take_crank(const SweepInput& crank) {
  const std::size_t n = crank.value.size();
  for (std::vector<double>* to : {&angle, &cosine, &sine, &rate, &acceleration}) to->resize(n);
  require_finite(copy_samples(crank.value, 0, angle) && copy_samples(crank.rate, 0, rate) &&
                     copy_samples(crank.acceleration, 0, acceleration),
                 n);
  for (std::size_t i = 0; i < n; ++i) math::sincos_of_any(angle[i], sine[i], cosine[i]);
  task.cosine = cosine.data(), task.sine = sine.data();
  task.rate = rate.data(), task.acceleration = acceleration.data();
}

// The crank angles of one machine from `begin` to `end`. The kernel counts them from `begin`.
void FourBarSweep::Memory::take_block(double frame_angle, const SweepInput& crank) {
  const std::size_t count = task.end - task.begin;
  for (std::vector<double>* to : {&angle, &rate, &acceleration}) to->resize(count);
  require_finite(copy_samples(crank.value, task.begin, angle) && copy_samples(crank.rate, task.begin, rate) &&
                     copy_samples(crank.acceleration, task.begin, acceleration),
                 samples);
  for (double& a : angle) a += frame_angle;
  task.angle = angle.data(), task.rate = rate.data(), task.acceleration = acceleration.data();
}

void FourBarSweep::Memory::run(std::span<const FourBarMachine> machines, const SweepInput& crank,
                               const RunContext* context) {
  const std::size_t block =
      std::max(line, samples_between_looks / std::max<std::size_t>(task.angles, 1) / line * line);
  for (task.begin = 0; task.begin < task.lanes; task.begin = task.end) {
    throw_if_interrupted(context);
    task.end = std::min(task.begin + block, task.lanes);
    for (std::size_t i = 0; i < task.angles; ++i)
      std::fill_n(status.data() + i * task.lanes + task.begin, task.end - task.begin, Status::done);
    if (!task.over_machines) take_block(machines[0].linkage.frame_angle, crank);
    FourBarSweepTask part = task;
    if (!task.over_machines) {
      part.data += task.begin, part.good += task.begin;
      part.begin = 0, part.end = task.end - task.begin;
    }
    if (!widest_of<four_bar_sweep_kernels>().run(part)) mend(machines, crank);
  }
}

// The plain functions solve, one by one, the samples that the kernel could not: they name the reason and
// keep the good part.
void FourBarSweep::Memory::mend(std::span<const FourBarMachine> machines, const SweepInput& crank) {
  for (std::size_t i = 0; i < task.angles; ++i)
    for (std::size_t k = task.begin; k < std::min(task.end, samples); ++k) {
      if (task.good[i * task.lanes + k] != 0) continue;
      const auto& [linkage, masses] = machines[task.over_machines ? k : 0];
      const std::size_t step = task.over_machines ? i : k;
      const std::size_t in_block = task.over_machines ? i : k - task.begin;
      const FourBarRates r = rates(linkage, crank.value[step], rate[in_block], acceleration[in_block]);
      const auto values = all_rows(r, reactions(linkage, masses, r, task.gravity));
      for (std::size_t row = 0; row < four_bar_row_count; ++row)
        if (kept(task.wanted, row))
          task.data[(task.first[row] + i * task.rows) * task.lanes + k] = values[row];
      status.data()[i * task.lanes + k] = r.status;
    }
}

FourBarSweep::FourBarSweep(const FourBarWanted& wanted) : memory_(std::make_unique<Memory>()) {
  FourBarSweepTask& task = memory_->task;
  task.wanted = wanted;
  for (std::size_t row = 0; row < four_bar_row_count; ++row)
    if (kept(wanted, row)) task.first[row] = task.rows++;
}
FourBarSweep::~FourBarSweep() = default;
FourBarSweep::FourBarSweep(FourBarSweep&&) noexcept = default;
FourBarSweep& FourBarSweep::operator=(FourBarSweep&&) noexcept = default;

void FourBarSweep::run(const FourBar& linkage, const FourBarMasses& masses, double gravity,
                       const SweepInput& crank, const RunContext* context) {
  const FourBarMachine machine{linkage, masses};
  memory_->prepare({&machine, 1}, false, gravity, crank);
  memory_->run({&machine, 1}, crank, context);
}

void FourBarSweep::run(std::span<const FourBarMachine> machines, double gravity, const SweepInput& crank,
                       const RunContext* context) {
  memory_->prepare(machines, true, gravity, crank);
  memory_->run(machines, crank, context);
}

std::span<const double> FourBarSweep::row(FourBarRow row, std::size_t angle) const {
  const FourBarSweepTask& task = memory_->task;
  LINKWRIGHT_REQUIRE(kept(task.wanted, row_index(row)), "row {} is not wanted of this sweep", row_index(row));
  LINKWRIGHT_REQUIRE(angle < task.angles, "angle {} of {}", angle, task.angles);
  return {task.data + (task.first[row_index(row)] + angle * task.rows) * task.lanes, memory_->samples};
}
std::span<const Status> FourBarSweep::status(std::size_t angle) const {
  LINKWRIGHT_REQUIRE(angle < memory_->task.angles, "angle {} of {}", angle, memory_->task.angles);
  return {memory_->status.data() + angle * memory_->task.lanes, memory_->samples};
}

const char* four_bar_sweep_kernel_name() { return widest_of<four_bar_sweep_kernels>().name; }

}  // namespace linkwright::planar
