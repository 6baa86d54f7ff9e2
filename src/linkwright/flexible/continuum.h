// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/flexible/chain.h"

/// The uniform link as a continuum, with its tip mass: frequencies to compare chains with.
namespace linkwright::flexible {

/// First `count` frequencies (rad/s) of small bending vibrations in the plane about a hub at rest (driven) or
/// free to turn (then without its rotation), by the beam's theory; exact but for rounding, about 1e-12
/// relative. The differential equations of Timoshenko's beam are carried from the hub to the tip in the six
/// 2 x 2 minors of the two solutions that the hub allows, which loses no digits to the one that grows
/// fastest.
///
/// Euler and Bernoulli, hub driven, J_p = 0: 1 + cos z cosh z + z mu (cos z sinh z - sin z cosh z) = 0 with
/// omega = z^2 w_s and mu = m_p / m.
std::vector<double> continuum_frequencies(const Beam& beam, int count, Hub hub = Hub::driven);

/// First `count` frequencies (rad/s) of vibrations along the link, that of the driven and the free hub alike:
/// omega = z sqrt(E / rho) / L with cos z = z mu sin z, mu = m_p / m. Used if the link is extensible.
std::vector<double> axial_frequencies(const Beam& beam, int count);

/// Deflection of the tip (m) under a small force there (N): L^3 / (3 E I) + L / (G A k) for each newton.
double tip_deflection(const Beam& beam, double force);

}  // namespace linkwright::flexible
