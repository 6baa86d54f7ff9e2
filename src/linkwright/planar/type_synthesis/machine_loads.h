// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/type_synthesis/found_linkage.h"

namespace linkwright::planar {

/// Masses, speed and load under which the forces of found machines are compared.
struct MachineLoads {
  double mass_per_metre = 1;     ///< of bars and plates by their largest extent (kg/m), > 0
  double crank_speed = 2 * pi;   ///< constant (rad/s)
  std::complex<double> force{};  ///< constant force on the traced point, in the global frame (N)
  double torque = 0;             ///< constant, on the body of the traced point, counter-clockwise (N m)
  double gravity = 9.81;         ///< along -y (m/s2), >= 0
};

/// Gives the bodies of a found linkage uniform masses, and its traced point the load.
///
/// @param found the linkage, without masses
/// @param loads masses and load; the speed is not part of a linkage
void add_loads(FoundLinkage& found, const MachineLoads& loads);

/// The largest forces of a machine over crank angles.
struct PeakForces {
  double joint_force = infinity;   ///< N, of all joints
  double drive_torque = infinity;  ///< N m, without its sign
};

/// The largest joint force and drive torque by the analysis of any linkage, position after position.
///
/// @param loaded a linkage with masses and loads
/// @param crank_speed constant speed of its crank (rad/s)
/// @param crank angles of its crank (rad)
/// @returns the peaks; infinity where a position has no answer
PeakForces peak_forces(const FoundLinkage& loaded, double crank_speed, std::span<const double> crank);

/// Joint forces and drive torques of one machine at many crank angles.
struct ForceSamples {
  std::size_t count = 0;             ///< crank angles
  std::vector<double> joint_force;   ///< N: those of the first joint, then of the second, ...
  std::vector<double> drive_torque;  ///< N m, without sign
};

/// The same forces as rows, by the sweep of any linkage.
///
/// @param loaded a linkage with masses and loads
/// @param crank_speed constant speed of its crank (rad/s)
/// @param crank angles of its crank (rad)
/// @param out receives the rows
/// @returns false if a position has no answer; the rows are then undefined
bool sample_forces(const FoundLinkage& loaded, double crank_speed, std::span<const double> crank,
                   ForceSamples& out);

}  // namespace linkwright::planar
