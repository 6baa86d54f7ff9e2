// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/core/table.h"
#include "linkwright/flexible/beam.h"

/// The quantities of hub and link at an instant, and the results of samples of them.
namespace linkwright::flexible {

struct Sample {
  double time = 0;  ///< s
  /// Angle of the hub, and its derivatives (rad, rad/s, rad/s2).
  double angle = 0, rate = 0, acceleration = 0;
  double torque = 0;               ///< torque of the drive: given, or needed for the given motion (N m)
  double tip_xi = 0, tip_eta = 0;  ///< displacement of the tip from where the undeformed link has it (m)
  double tip_angle = 0;            ///< angle of the link there against the hub (rad)
  double reaction_xi = 0, reaction_eta = 0, moment = 0;  ///< reaction of the hub on the link at O1 (N, N m)
  double bending_moment = 0;          ///< largest |M| along the link (N m); NaN for source_linearised
  double kinetic = 0, potential = 0;  ///< J
  double work = 0;                    ///< work of all drives since the start (J)
  double dissipated = 0;              ///< by all dampers (J)
  double angular_momentum = 0;        ///< about O (N m s)

  /// kinetic + potential + dissipated - work: stays as it was at the start (J).
  double energy_balance() const { return kinetic + potential + dissipated - work; }
};

/// Smallest or largest value of a sampled quantity between two times, with the time, refined by a parabola
/// through three samples.
struct Extreme {
  double time = 0, value = 0;
};
Extreme smallest(std::span<const Sample> samples, double Sample::*quantity, double from, double to);
Extreme largest(std::span<const Sample> samples, double Sample::*quantity, double from, double to);

/// Bending stress (Pa) of a moment (N m) at the distance of the outer fibre (m).
double bending_stress(const Beam& beam, double moment, double fibre_distance);

/// One row a sample; columns time_s, hub_angle_rad, ..., energy_balance_J, the last from what it was in the
/// first sample.
Table table_of(std::span<const Sample> samples);

}  // namespace linkwright::flexible
