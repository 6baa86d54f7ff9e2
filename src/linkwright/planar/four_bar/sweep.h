// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/linkage/plan.h"

namespace linkwright::planar {

/// Rows of a sweep of four-bars, as in FourBarRates and FourBarReactions; directions are cosine (x) and sine
/// (y) in the global frame.
enum class FourBarRow {
  crank_x,                    ///< cosine of the crank's direction
  crank_y,                    ///< sine of the crank's direction
  coupler_x,                  ///< cosine of the coupler's direction
  coupler_y,                  ///< sine of the coupler's direction
  rocker_x,                   ///< cosine of the rocker's direction
  rocker_y,                   ///< sine of the rocker's direction
  transmission_sine,          ///< sin(rocker angle - coupler angle)
  coupler_speed,              ///< rad/s
  rocker_speed,               ///< rad/s
  coupler_acceleration,       ///< rad/s2
  rocker_acceleration,        ///< rad/s2
  ground_on_crank_x,          ///< force at O1, x, N
  ground_on_crank_y,          ///< force at O1, y, N
  crank_on_coupler_x,         ///< force at O2, x, N
  crank_on_coupler_y,         ///< force at O2, y, N
  rocker_on_coupler_x,        ///< force at O3, x, N
  rocker_on_coupler_y,        ///< force at O3, y, N
  ground_on_rocker_x,         ///< force at O4, x, N
  ground_on_rocker_y,         ///< force at O4, y, N
  drive_torque,               ///< torque of the ground's motor on the crank, N m
  shaking_force_x,            ///< force of the mechanism on the ground, x, N
  shaking_force_y,            ///< force of the mechanism on the ground, y, N
  shaking_moment,             ///< moment on the ground about O1 by the joint forces alone, N m
  shaking_moment_with_drive,  ///< the same with the motor's reaction, N m
};
/// Number of the rows.
inline constexpr std::size_t four_bar_row_count = 24;

/// Flags of the rows that are kept; the others are not computed.
struct FourBarWanted {
  bool directions = true;  ///< crank_x ... transmission_sine
  bool rates = true;       ///< coupler_speed ... rocker_acceleration
  bool forces = true;      ///< ground_on_crank_x ... ground_on_rocker_y
  bool shaking = true;     ///< drive_torque ... shaking_moment_with_drive
};

/// A four-bar with the masses of its links.
struct FourBarMachine {
  FourBar linkage;       ///< lengths, frame and branch
  FourBarMasses masses;  ///< masses of its links
};

/// Positions, rates and reactions of one four-bar at many crank angles, or of many four-bars at the same
/// crank angles: flat rows, as many samples at a time as a SIMD register holds, by the formulas of
/// detail/forces_kernel.h. Equal to `rates` and `reactions` up to rounding.
///
/// Make one a thread and run it again and again: nothing is allocated while the numbers of machines and
/// angles do not grow.
class FourBarSweep {
 public:
  /// Memory for sweeps.
  ///
  /// @param wanted flags of the rows that are kept
  explicit FourBarSweep(const FourBarWanted& wanted);
  ~FourBarSweep();
  /// Takes the memory of another sweep.
  FourBarSweep(FourBarSweep&&) noexcept;
  /// Takes the memory of another sweep. @returns this sweep
  FourBarSweep& operator=(FourBarSweep&&) noexcept;

  /// Sweeps one four-bar. Rows run over the crank angles.
  ///
  /// @param linkage the four-bar
  /// @param masses masses of its links
  /// @param gravity acceleration of free fall (m/s2), along -y of the global frame
  /// @param crank crank angles from the ground link (rad), rates and accelerations of the crank
  /// @param context the run that may ask it to stop; may be null
  /// @throws ContractError as `rates` and `reactions` do, and on counts that do not fit
  /// @throws Interrupted when `context` asks the run to stop: its rows are then undefined
  void run(const FourBar& linkage, const FourBarMasses& masses, double gravity, const SweepInput& crank,
           const RunContext* context = nullptr);
  /// Sweeps many four-bars: registers hold machines. Rows run over the machines, one row an angle.
  ///
  /// @param machines the four-bars with their masses
  /// @param gravity acceleration of free fall (m/s2), along -y of the global frame
  /// @param crank crank angles from the ground links (rad), rates and accelerations of the cranks
  /// @param context the run that may ask it to stop; may be null
  /// @throws ContractError as `rates` and `reactions` do, and on counts that do not fit
  /// @throws Interrupted when `context` asks the run to stop: its rows are then undefined
  void run(std::span<const FourBarMachine> machines, double gravity, const SweepInput& crank,
           const RunContext* context = nullptr);

  /// The numbers of one row, in the memory of the sweep: over the angles of one four-bar, or over the
  /// machines at one angle. NaN where the rates have it.
  ///
  /// @param row the row
  /// @param angle index of the crank angle, for many machines
  /// @returns one number a sample; valid until the next run
  /// @throws ContractError if the row is not wanted or there is no such angle
  std::span<const double> row(FourBarRow row, std::size_t angle = 0) const;
  /// Status of each sample, as that of `rates`.
  ///
  /// @param angle index of the crank angle, for many machines
  /// @returns one status a sample; valid until the next run
  /// @throws ContractError if there is no such angle
  std::span<const Status> status(std::size_t angle = 0) const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// Name of the instruction set that sweeps of four-bars use. @returns "avx512", "avx2" or "baseline"
const char* four_bar_sweep_kernel_name();

}  // namespace linkwright::planar
