// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <span>
#include <string>
#include <vector>

#include "linkwright/clearance/joint_clearance.h"
#include "linkwright/core/numbers.h"

// Motion in continuous contact that repeats itself with every period of the drives: any pins of any linkage.
namespace linkwright::clearance {

/// The period of drives.
struct DrivePeriod {
  double period = 0;  ///< s; 0: there is none
  int input = -1;     ///< input that has no period, or none that all share
};
/// Shortest time after which all inputs have the same values and rates, angles up to whole turns. Inputs that
/// rest have any period; without one that moves there is none. Loads that depend on time have none, either,
/// but are not looked at here (see load_against_time).
DrivePeriod drive_period(std::span<const planar::InputDrive> drives, const std::vector<bool>& rotary);

/// Name of a load whose factor is a table against time; empty: there is none.
std::string load_against_time(const planar::Linkage& linkage);

/// The growth of small departures from a periodic motion.
enum class OrbitStability { stable, neutral, unstable };
constexpr std::array<EnumName<OrbitStability>, 3> names(OrbitStability) {
  return {
      {{OrbitStability::stable, "stable", "small departures die out"},
       {OrbitStability::neutral, "neutral", "small departures neither grow nor die out, as without damping"},
       {OrbitStability::unstable, "unstable", "small departures grow"}}};
}

struct JointOrbit {
  /// done; not_converged: Newton's method found none; else that of the simulation that failed.
  Status status = Status::done;
  std::string message;                ///< says why it is not `done`; else empty
  std::vector<ClearanceState> start;  ///< states of the clearance links: angle and rate
  /// Largest change over a period, of angles (rad) and of rates as shares of one turn a period.
  double residual = infinity;
  /// Floquet multipliers, two a clearance, largest first.
  std::vector<std::complex<double>> multipliers;
  OrbitStability stability = OrbitStability::neutral;
  int iterations = 0;
  long evaluations = 0;  ///< evaluations of the equations of motion
};

/// Shooting: Newton's method on angles and rates of all clearance links over one period from `start` (s),
/// with central differences and steps of at most 0.5, from the angles and rates of `clearances`. All inputs
/// follow laws, whose period it is. There may be several orbits, or none. Multipliers within 1e-5 of the unit
/// circle count as on it. Tensions are not looked at. Throws ContractError as simulate_joint_clearance does.
JointOrbit find_joint_orbit(const planar::Linkage& linkage, std::span<const JointClearance> clearances,
                            std::span<const planar::InputDrive> drives, double start, double period,
                            const planar::SimulationOptions& options, const RunContext* context = nullptr);

/// The period after which the last of the states of a section comes back: least p, at most `most`, for which
/// no number of it differs from that of p states before by more than the tolerance; 0: none. Numbers are to
/// be scaled so that one tolerance fits them.
int repeating_period(std::span<const std::vector<double>> states, double tolerance, int most);

}  // namespace linkwright::clearance
