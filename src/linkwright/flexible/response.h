// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/core/table.h"
#include "linkwright/flexible/beam.h"

/// @file
/// The quantities of hub and link at an instant, and the results of samples of them.
namespace linkwright::flexible {

/// The quantities of hub and link at one time.
struct Sample {
  double time = 0;  ///< s
  /// Angle of the hub, and its derivatives (rad, rad/s, rad/s2).
  double angle = 0,      ///< angle of the hub, rad
      rate = 0,          ///< its rate, rad/s
      acceleration = 0;  ///< its acceleration, rad/s2
  double torque = 0;     ///< torque of the drive: given, or needed for the given motion (N m)
  /// Displacement of the tip along xi from its place on the undeformed link (m).
  double tip_xi = 0,
         tip_eta = 0;    ///< the same along eta, m
  double tip_angle = 0;  ///< angle of the link there against the hub (rad)
  /// Force of the hub on the link at O1 along xi (N).
  double reaction_xi = 0,
         reaction_eta = 0,      ///< the same along eta, N
      moment = 0;               ///< couple of the hub on the link at O1, N m
  double bending_moment = 0;    ///< largest |M| along the link (N m); NaN for source_linearised
  double kinetic = 0,           ///< J
      potential = 0;            ///< J
  double work = 0;              ///< work of all drives since the start (J)
  double dissipated = 0;        ///< by all dampers (J)
  double angular_momentum = 0;  ///< about O (N m s)

  /// The balance kinetic + potential + dissipated - work, which stays as it was at the start. @returns J
  double energy_balance() const { return kinetic + potential + dissipated - work; }
};

/// The smallest or largest value of a sampled quantity between two times, with the time, refined by a
/// parabola through three samples.
struct Extreme {
  double time = 0,  ///< s
      value = 0;    ///< value of the quantity
};

/// The smallest value of a quantity.
///
/// @param samples the samples
/// @param quantity the member of Sample
/// @param from first time (s)
/// @param to last time (s)
/// @returns value and time
/// @throws ContractError if there is no sample with a number between both times
Extreme smallest(std::span<const Sample> samples, double Sample::*quantity, double from, double to);

/// The largest value of a quantity.
///
/// @param samples the samples
/// @param quantity the member of Sample
/// @param from first time (s)
/// @param to last time (s)
/// @returns value and time
/// @throws ContractError if there is no sample with a number between both times
Extreme largest(std::span<const Sample> samples, double Sample::*quantity, double from, double to);

/// The bending stress by a moment.
///
/// @param beam the beam
/// @param moment bending moment (N m)
/// @param fibre_distance distance of the outer fibre from the neutral line (m), > 0
/// @returns the stress (Pa)
/// @throws ContractError unless the distance is positive
double bending_stress(const Beam& beam, double moment, double fibre_distance);

/// The samples as a table, one row a sample; columns time_s, hub_angle_rad, ..., energy_balance_J, the last
/// from what it was in the first sample.
///
/// @param samples the samples
/// @returns the table "response"
Table table_of(std::span<const Sample> samples);

}  // namespace linkwright::flexible
