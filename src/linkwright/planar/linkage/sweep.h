// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "linkwright/core/kernels.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// The quantities that a sweep computes.
struct SweepWanted {
  bool rates = true;    ///< velocities and accelerations
  bool forces = false;  ///< joint forces and drives; needs rates and the masses of all bodies
};

/// Rows of a part: its frame and how it moves, as in PartState. Positions alone have the first four.
enum class PartRow {
  x,
  y,
  direction_x,
  direction_y,
  velocity_x,
  velocity_y,
  speed,
  acceleration_x,
  acceleration_y,
  angular_acceleration
};
/// Rows of a joint, as in JointReaction.
enum class JointRow { force_x, force_y, moment };
/// Rows of a group, as in GroupState.
enum class GroupRow { radicand, sine };
/// Rows of the ground, as in LinkageForces.
enum class ShakingRow { force_x, force_y, moment_with_drive };

/// Positions, rates and joint forces of one linkage at many inputs: flat rows, one number a sample. Dyads and
/// drivers are solved as many samples at a time as a SIMD register holds, by the formulas of
/// linkage_kernel.h; plans with general groups or gears, and forces with springs, loads, friction or welds,
/// go sample by sample, general groups on the assembly mode that their drawing shows (LinkageAssembly). Both
/// routes agree up to rounding.
///
/// Make one a linkage (and thread) and run it again and again: nothing is allocated while the number of
/// samples does not grow (but for friction, welds and a sweep that follows general groups).
class LinkageSweep {
 public:
  /// Throws ContractError when forces are wanted and a body has no mass, or without rates.
  LinkageSweep(Linkage linkage, LinkagePlan plan, const SweepWanted& wanted);
  ~LinkageSweep();
  LinkageSweep(LinkageSweep&&) noexcept;
  LinkageSweep& operator=(LinkageSweep&&) noexcept;

  /// Signs of the assembly modes, one a group; at first those of the plan.
  void set_modes(std::span<const double> modes);

  /// One entry an input of the plan. `time` (s) is what load tables may depend on: as many as samples, or
  /// none for zero. Throws ContractError on counts that do not fit and on inputs that are not finite, and
  /// Interrupted when `context` asks the run to stop: its rows are then undefined.
  void run(std::span<const SweepInput> inputs, std::span<const double> time = {},
           const RunContext* context = nullptr);

  std::size_t samples() const;
  /// done, or what keeps the sample from being computed; its numbers are NaN then, but for parts of groups
  /// that come before the one that fails, and its radicand and sine.
  std::span<const Status> status() const;
  std::span<const double> part(int part, PartRow row) const;     ///< part >= 1
  std::span<const double> group(int group, GroupRow row) const;  ///< 1 for groups that have none
  std::span<const double> joint(int joint, JointRow row) const;
  std::span<const double> drive(int input) const;  ///< N m or N
  std::span<const double> shaking(ShakingRow row) const;

  /// True if samples go together through SIMD registers, with these wishes.
  bool batched() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// Name of the instruction set that sweeps use: "avx512", "avx2" or "baseline".
const char* sweep_kernel_name();

/// The task of a kernel; rows are numbered from 0, `stride` numbers apart.
struct SweepTask {
  const LinkagePlan* plan = nullptr;
  const double* modes = nullptr;
  math::Vec2 gravity{0, 0};
  math::Vec2 moment_centre{0, 0};
  double* data = nullptr;
  std::size_t stride = 0;  ///< a multiple of 8
  std::size_t count = 0;   ///< samples, a multiple of 8: the last one is repeated
  bool rates = true, forces = false;
  // First rows.
  std::size_t inputs = 0;  ///< three an input
  std::size_t parts = 0;   ///< `part_rows` a part from part 1 on
  std::size_t part_rows = 10;
  std::size_t groups = 0;   ///< two a group
  std::size_t joints = 0;   ///< three a joint
  std::size_t drives = 0;   ///< one an input
  std::size_t shaking = 0;  ///< three
  std::size_t good = 0;     ///< 1 where all groups assemble clear of dead points, else 0
};
/// Linkages with more parts or groups go sample by sample.
inline constexpr std::size_t max_sweep_parts = 32;

/// Fills the rows; true when all samples are good. Compiled once for each instruction set; all but the
/// baseline need the machine to have the instructions.
using SweepKernel = bool(const SweepTask&);
SweepKernel sweep_baseline, sweep_avx2, sweep_avx512;
KernelSet<SweepKernel> sweep_kernels();

}  // namespace linkwright::planar
