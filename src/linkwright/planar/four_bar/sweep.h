// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "linkwright/core/kernels.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/four_bar/reactions.h"
#include "linkwright/planar/sweep_input.h"

namespace linkwright::planar {

/// Rows of a sweep of four-bars, as in FourBarRates and FourBarReactions; directions are cosine (x) and sine
/// (y) in the global frame.
enum class FourBarRow {
  crank_x,  // directions
  crank_y,
  coupler_x,
  coupler_y,
  rocker_x,
  rocker_y,
  transmission_sine,
  coupler_speed,  // rates
  rocker_speed,
  coupler_acceleration,
  rocker_acceleration,
  ground_on_crank_x,  // forces
  ground_on_crank_y,
  crank_on_coupler_x,
  crank_on_coupler_y,
  rocker_on_coupler_x,
  rocker_on_coupler_y,
  ground_on_rocker_x,
  ground_on_rocker_y,
  drive_torque,  // shaking
  shaking_force_x,
  shaking_force_y,
  shaking_moment,
  shaking_moment_with_drive,
};
inline constexpr std::size_t four_bar_row_count = 24;

/// Flags of the rows that are kept; the others are not computed.
struct FourBarWanted {
  bool directions = true;  ///< crank_x ... transmission_sine
  bool rates = true;       ///< coupler_speed ... rocker_acceleration
  bool forces = true;      ///< ground_on_crank_x ... ground_on_rocker_y
  bool shaking = true;     ///< drive_torque ... shaking_moment_with_drive
};

struct FourBarMachine {
  FourBar linkage;
  FourBarMasses masses;
};

/// Positions, rates and reactions of one four-bar at many crank angles, or of many four-bars at the same
/// crank angles: flat rows, as many samples at a time as a SIMD register holds, by the formulas of
/// four_bar_forces_kernel.h. Equal to `rates` and `reactions` up to rounding.
///
/// Make one a thread and run it again and again: nothing is allocated while the numbers of machines and
/// angles do not grow.
class FourBarSweep {
 public:
  explicit FourBarSweep(const FourBarWanted& wanted);
  ~FourBarSweep();
  FourBarSweep(FourBarSweep&&) noexcept;
  FourBarSweep& operator=(FourBarSweep&&) noexcept;

  /// One four-bar: `crank.value` are crank angles (rad) from the ground link, rate and acceleration those of
  /// the crank. Rows run over the angles. Throws ContractError as `rates` and `reactions` do, and on counts
  /// that do not fit, and Interrupted when `context` asks the run to stop: its rows are then undefined.
  void run(const FourBar& linkage, const FourBarMasses& masses, double gravity, const SweepInput& crank,
           const RunContext* context = nullptr);
  /// Many four-bars: registers hold machines. Rows run over the machines, one row an angle.
  void run(std::span<const FourBarMachine> machines, double gravity, const SweepInput& crank,
           const RunContext* context = nullptr);

  /// Numbers of a kind: over the angles of one four-bar; or over the machines, at the angle with this index.
  /// NaN where the rates have it. Throws ContractError for a row that is not wanted.
  std::span<const double> row(FourBarRow row, std::size_t angle = 0) const;
  /// Status of each sample, as that of `rates`.
  std::span<const Status> status(std::size_t angle = 0) const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// Name of the instruction set that sweeps of four-bars use: "avx512", "avx2" or "baseline".
const char* four_bar_sweep_kernel_name();

/// Constants of a machine in the order of the kernel's rows: ground direction, ground, crank, coupler,
/// rocker, sign of the branch, base parameters of crank, coupler and rocker.
inline constexpr std::size_t four_bar_constants = 19;

/// The task of a kernel.
struct FourBarSweepTask {
  FourBarWanted wanted;
  bool over_machines = false;  ///< registers hold machines, else angles
  double gravity = 0;
  const double* constants = nullptr;  ///< `four_bar_constants` rows over the machines, `lanes` numbers each
  std::size_t lanes = 0;  ///< length of a row, a multiple of 8: the last machine or angle is repeated
  std::size_t begin = 0, end = 0;  ///< the lanes that this call fills, multiples of 8
  std::size_t angles = 0;          ///< number of rows of a kind: 1, or angles where registers hold machines
  // Over `lanes`, the angle from the global x axis; over machines, cosine and sine of the crank angle.
  const double *angle = nullptr, *cosine = nullptr, *sine = nullptr;
  const double *rate = nullptr, *acceleration = nullptr;  ///< rates, as many as `angle` or `cosine`
  double* data = nullptr;  ///< row r at angle i begins at data[(first[r] + i * rows) * lanes]
  std::size_t rows = 0;    ///< kept ones
  std::array<std::size_t, four_bar_row_count> first{};
  double* good = nullptr;  ///< `lanes` numbers an angle: 1 where the result holds, else 0
};

/// Fills the lanes of the rows from `begin` to `end`; true when all their samples are good. Compiled once for
/// each instruction set; all but the baseline need the machine to have the instructions.
using FourBarSweepKernel = bool(const FourBarSweepTask&);
FourBarSweepKernel four_bar_sweep_baseline, four_bar_sweep_avx2, four_bar_sweep_avx512;
KernelSet<FourBarSweepKernel> four_bar_sweep_kernels();

}  // namespace linkwright::planar
