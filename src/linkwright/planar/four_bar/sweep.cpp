// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/four_bar/sweep.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/interruption.h"
#include "linkwright/math/sincos.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t line = 8;  // doubles of a cache line, and lanes of the widest register
constexpr std::size_t samples_between_looks = 1 << 16;  // a millisecond or so
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

// `count` numbers: those given, the last (or only) one repeated, or zeros for none.
void spread(std::span<const double> from, std::size_t count, std::vector<double>& to) {
  to.resize(count);
  const auto rest = std::copy(from.begin(), from.end(), to.begin());
  std::fill(rest, to.end(), from.empty() ? 0 : from.back());
}

}  // namespace

KernelSet<FourBarSweepKernel> four_bar_sweep_kernels() { return LINKWRIGHT_KERNEL_SET(four_bar_sweep); }

struct FourBarSweep::Memory {
  FourBarSweepTask task;
  std::vector<double> constants, angle, cosine, sine, rate, acceleration, good;
  std::unique_ptr<double[]> data;
  std::size_t data_size = 0;
  std::vector<Status> status;
  std::size_t samples = 0;  // number of samples in a row

  void prepare(std::span<const FourBarMachine> machines, bool over_machines, double gravity,
               const SweepInput& crank, const RunContext* context);
  void run(std::span<const FourBarMachine> machines, const SweepInput& crank, const RunContext* context);
  void mend(std::span<const FourBarMachine> machines, const SweepInput& crank);
};

void FourBarSweep::Memory::prepare(std::span<const FourBarMachine> machines, bool over_machines,
                                   double gravity, const SweepInput& crank, const RunContext* context) {
  const std::size_t n = crank.value.size();
  const auto fits = [&](std::span<const double> v) { return v.size() <= 1 || v.size() == n; };
  LINKWRIGHT_REQUIRE(fits(crank.rate) && fits(crank.acceleration),
                     "{} crank angles need as many rates and accelerations, one or none, got {} and {}", n,
                     crank.rate.size(), crank.acceleration.size());
  const auto finite = [](std::span<const double> values) {
    double sum = 0;  // sum of zeros; NaN with anything that is not finite
    for (const double v : values) sum += v * 0.0;
    return sum == 0;
  };
  LINKWRIGHT_REQUIRE(finite(crank.value) && finite(crank.rate) && finite(crank.acceleration),
                     "crank angles, rates and accelerations of {} samples must be finite", n);
  LINKWRIGHT_REQUIRE(std::isfinite(gravity), "gravity {} must be finite", gravity);
  const auto whole = [](std::size_t count) { return (count + line - 1) / line * line; };
  task.over_machines = over_machines;
  task.gravity = gravity;
  samples = over_machines ? machines.size() : n;
  task.lanes = whole(samples);
  task.angles = over_machines ? n : 1;

  const std::size_t width = over_machines ? task.lanes : 1;
  task.width = over_machines ? std::max(task.lanes, line) : 1;
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

  const std::size_t steps = over_machines ? n : task.lanes;
  const std::span<const double> none;  // without angles there is no room for the one rate of all
  throw_if_interrupted(context);
  spread(n > 0 ? crank.rate : none, steps, rate);
  throw_if_interrupted(context);
  spread(n > 0 ? crank.acceleration : none, steps, acceleration);
  if (over_machines) {
    cosine.resize(n);
    sine.resize(n);
    for (std::size_t i = 0; i < n; ++i) math::sincos_of_any(crank.value[i], sine[i], cosine[i]);
  } else {
    spread(crank.value, steps, angle);
    for (double& a : angle) a += machines[0].linkage.frame_angle;
  }
  throw_if_interrupted(context);
  const std::size_t numbers = task.rows * task.angles * task.lanes;
  if (data_size < numbers) {
    data.reset();
    data.reset(new double[numbers]);  // the kernel writes every number
    data_size = numbers;
  }
  good.resize(task.angles * task.lanes);
  status.resize(task.angles * task.lanes);
  task.constants = constants.data();
  task.angle = angle.data(), task.cosine = cosine.data(), task.sine = sine.data();
  task.rate = rate.data(), task.acceleration = acceleration.data();
  task.data = data.get(), task.good = good.data();
}

void FourBarSweep::Memory::run(std::span<const FourBarMachine> machines, const SweepInput& crank,
                               const RunContext* context) {
  std::fill(status.begin(), status.end(), Status::done);
  const std::size_t block =
      std::max(line, samples_between_looks / std::max<std::size_t>(task.angles, 1) / line * line);
  for (task.begin = 0; task.begin < task.lanes; task.begin = task.end) {
    throw_if_interrupted(context);
    task.end = std::min(task.begin + block, task.lanes);
    if (!widest_of<four_bar_sweep_kernels>().run(task)) mend(machines, crank);
  }
}

// The plain functions solve, one by one, the samples that the kernel could not: they name the reason and
// keep the good part.
void FourBarSweep::Memory::mend(std::span<const FourBarMachine> machines, const SweepInput& crank) {
  for (std::size_t i = 0; i < task.angles; ++i)
    for (std::size_t k = task.begin; k < std::min(task.end, samples); ++k) {
      if (good[i * task.lanes + k] != 0) continue;
      const auto& [linkage, masses] = machines[task.over_machines ? k : 0];
      const std::size_t step = task.over_machines ? i : k;
      const FourBarRates r = rates(linkage, crank.value[step], rate[step], acceleration[step]);
      const auto values = all_rows(r, reactions(linkage, masses, r, task.gravity));
      for (std::size_t row = 0; row < four_bar_row_count; ++row)
        if (kept(task.wanted, row)) data[(task.first[row] + i * task.rows) * task.lanes + k] = values[row];
      status[i * task.lanes + k] = r.status;
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
  memory_->prepare({&machine, 1}, false, gravity, crank, context);
  memory_->run({&machine, 1}, crank, context);
}

void FourBarSweep::run(std::span<const FourBarMachine> machines, double gravity, const SweepInput& crank,
                       const RunContext* context) {
  memory_->prepare(machines, true, gravity, crank, context);
  memory_->run(machines, crank, context);
}

std::span<const double> FourBarSweep::row(FourBarRow row, std::size_t angle) const {
  const FourBarSweepTask& task = memory_->task;
  LINKWRIGHT_REQUIRE(kept(task.wanted, row_index(row)), "row {} is not wanted of this sweep", row_index(row));
  LINKWRIGHT_REQUIRE(angle < task.angles, "angle {} of {}", angle, task.angles);
  return {memory_->data.get() + (task.first[row_index(row)] + angle * task.rows) * task.lanes,
          memory_->samples};
}
std::span<const Status> FourBarSweep::status(std::size_t angle) const {
  LINKWRIGHT_REQUIRE(angle < memory_->task.angles, "angle {} of {}", angle, memory_->task.angles);
  return {memory_->status.data() + angle * memory_->task.lanes, memory_->samples};
}

const char* four_bar_sweep_kernel_name() { return widest_of<four_bar_sweep_kernels>().name; }

}  // namespace linkwright::planar
