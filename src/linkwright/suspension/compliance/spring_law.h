// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

/// @file
/// Forces of springs and stops over their compression. Of torsion bars read rad for m and N m for N.
namespace linkwright::suspension {

/// Points of a characteristic.
struct ForceCurve {
  std::vector<double> compression,  ///< m, ascending
      force;                        ///< N, as many
};

/// A force and its slope at a compression.
struct SpringForce {
  double force = 0,   ///< N, > 0: it pushes its ends apart
      stiffness = 0,  ///< N/m, the slope by compression
      bend = 0;       ///< N/m2, the slope of the stiffness
};

/// Checks the points of a characteristic.
///
/// @param curve the points
/// @returns empty, or why they are none: fewer than two, of different number, not ascending, not finite
std::string problem(const ForceCurve& curve);

/// The force of a characteristic. Between the points it is cubic with the slopes of Fritsch and Butland
/// (1984), which keep it monotone where the points are and make the slope continuous; beyond the ends it is
/// straight.
///
/// @param curve the points
/// @param compression m
/// @returns force and slope
/// @throws ContractError if the curve has a problem
SpringForce force_of(const ForceCurve& curve, double compression);

/// The compression at which a characteristic has a force.
///
/// @param curve the points, whose forces ascend
/// @param force N
/// @returns the compression (m); nothing where the forces do not ascend or end before, for the curve is not
///   continued here
/// @throws ContractError if the curve has a problem
std::optional<double> compression_of(const ForceCurve& curve, double force);

/// A spring: its stiffness (N/m) and the force with which it pushes its ends apart at the reference (N), or
/// its characteristic.
struct SpringLaw {
  double stiffness = 0;             ///< N/m
  double preload = 0;               ///< N
  std::optional<ForceCurve> curve;  ///< replaces the stiffness
  double start = 0;                 ///< compression on the curve at the reference, m
};

/// The force of a spring.
///
/// @param law the spring
/// @param compression from the reference, m
/// @returns force and slope
/// @throws ContractError if the stiffness is negative or not finite, or the curve has a problem
SpringForce force_of(const SpringLaw& law, double compression);

/// A bump stop, or a rebound stop with extension in place of compression.
struct StopLaw {
  double clearance = 0;             ///< compression from the reference at which it engages, m
  double stiffness = 0;             ///< N/m
  std::optional<ForceCurve> curve;  ///< replaces the stiffness; over the compression of the stop itself
  std::optional<double> solid_at;   ///< greatest compression of the stop itself, m: there it bottoms
};

/// The force of a stop.
///
/// @param law the stop
/// @param compression of the element that it is on, from the reference, m; of a rebound stop the extension
/// @returns force and slope; zero before it engages
/// @throws ContractError as for a spring
SpringForce force_of(const StopLaw& law, double compression);

/// Test for a stop at its end.
///
/// @param law the stop
/// @param compression of the element that it is on, from the reference, m; of a rebound stop the extension
/// @returns true if it is compressed to its end or beyond
bool bottoms(const StopLaw& law, double compression);

}  // namespace linkwright::suspension
