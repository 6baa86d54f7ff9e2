// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>

#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/four_bar/reactions.h"
#include "linkwright/planar/link_mass.h"

namespace linkwright::planar {

/// First moments (kg m) in the frames of the links: own joint in the origin, link line along x.
struct ForceBalance {
  std::complex<double> crank,  ///< own joint O
      rocker;                  ///< own joint B0
};

/// The first moments that crank and rocker must have for the mass centre of the whole four-bar to stand
/// still, given the coupler: m2 L1 - S2 L1 / L2 and S2 L3 / L2 are opposed by those of crank and rocker, with
/// L1 the crank, L2 the coupler and L3 the rocker (Berkof and Lowen 1969). The shaking force is then the
/// weight alone, at any speed and acceleration; the shaking moment is not balanced, and the drive torque may
/// grow.
///
/// @param linkage the four-bar
/// @param coupler base parameters of the coupler; its own joint is A
/// @returns the first moments of crank and rocker (kg m)
/// @throws ContractError as require_lengths does
ForceBalance force_balance(const FourBar& linkage, const BaseParameters& coupler);

/// The mass that changes the first moment of a link by a wanted change when it is fixed to it at a radius.
/// Its angle is in (-pi, pi], 0 when nothing is to be changed.
///
/// @param change wanted change of the first moment in the frame of the link (kg m)
/// @param radius distance from the own joint of the link (m), more than 0
/// @returns the mass with its distance and angle
/// @throws ContractError unless the radius is more than 0 and everything is finite
PointMass counterweight(std::complex<double> change, double radius);

/// Counterweights of crank and rocker, at given radii, that balance a four-bar as it is.
struct Counterweights {
  PointMass crank,  ///< at O
      rocker;       ///< at B0
};

/// The counterweights that balance the shaking force of a four-bar as it is.
///
/// @param linkage the four-bar
/// @param masses masses of its links
/// @param crank_radius distance of the counterweight of the crank from O (m), more than 0
/// @param rocker_radius distance of the counterweight of the rocker from B0 (m), more than 0
/// @returns both counterweights
/// @throws ContractError as `force_balance`, `base_parameters` and `counterweight` do
Counterweights balancing_counterweights(const FourBar& linkage, const FourBarMasses& masses,
                                        double crank_radius, double rocker_radius);

/// The masses with the counterweights fixed to them.
///
/// @param masses masses of the links
/// @param weights counterweights of crank and rocker
/// @returns the inertia of the links with the counterweights fixed to them
/// @throws ContractError as `with_attached` does
FourBarMasses with_counterweights(const FourBarMasses& masses, const Counterweights& weights);

}  // namespace linkwright::planar
