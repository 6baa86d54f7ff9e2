// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <complex>

#include "linkwright/core/check.h"
#include "linkwright/planar/balancing/four_bar.h"

namespace linkwright::planar {

ForceBalance force_balance(const FourBar& l, const BaseParameters& coupler) {
  require_lengths(l);
  return {.crank = (coupler.moment / l.coupler - coupler.mass) * l.crank,
          .rocker = -coupler.moment * (l.rocker / l.coupler)};
}

PointMass counterweight(std::complex<double> change, double radius) {
  LINKWRIGHT_REQUIRE(radius > 0 && std::isfinite(radius), "radius must be more than 0, got {}", radius);
  LINKWRIGHT_REQUIRE(std::isfinite(change.real()) && std::isfinite(change.imag()),
                     "change of the first moment ({}, {}) must be finite", change.real(), change.imag());
  return {.mass = std::abs(change) / radius, .distance = radius, .angle = std::arg(change)};
}

Counterweights balancing_counterweights(const FourBar& linkage, const FourBarMasses& masses,
                                        double crank_radius, double rocker_radius) {
  const ForceBalance wanted = force_balance(linkage, base_parameters(masses.coupler));
  return {.crank = counterweight(wanted.crank - base_parameters(masses.crank).moment, crank_radius),
          .rocker = counterweight(wanted.rocker - base_parameters(masses.rocker).moment, rocker_radius)};
}

FourBarMasses with_counterweights(const FourBarMasses& masses, const Counterweights& weights) {
  return {.crank = with_attached(masses.crank, {&weights.crank, 1}),
          .coupler = masses.coupler,
          .rocker = with_attached(masses.rocker, {&weights.rocker, 1})};
}

}  // namespace linkwright::planar
