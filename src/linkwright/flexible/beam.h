// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "linkwright/core/field.h"

/// @file
/// A rigid hub that turns about the fixed axis Oz by theta, a uniform flexible link welded to it at O1, at
/// the distance r_H from O, and a mass at its tip (Boskovic 2018, chapter 3). Axes of the hub: xi along the
/// undeformed link, eta a quarter turn counter-clockwise of it; they turn with the hub. SI units, rad.
namespace linkwright::flexible {

/// The deformation and inertia of the cross-sections.
enum class Theory {
  euler_bernoulli,  ///< neither shear nor rotary inertia
  rayleigh,         ///< rotary inertia
  timoshenko,       ///< shear and rotary inertia
};
constexpr std::array<EnumName<Theory>, 3> names(Theory) {
  return {{{Theory::euler_bernoulli, "euler_bernoulli", "neither shear nor rotary inertia"},
           {Theory::rayleigh, "rayleigh", "rotary inertia of the cross-sections"},
           {Theory::timoshenko, "timoshenko", "shear and rotary inertia of the cross-sections"}}};
}

/// The cause of the hub's rotation.
enum class Hub {
  driven,  ///< its angle is given as a function of time
  free,    ///< a torque is given, or none
};

constexpr std::array<EnumName<Hub>, 2> names(Hub) {
  return {{{Hub::driven, "driven", "its angle is prescribed, whatever the link does"},
           {Hub::free, "free", "it turns with the link: rest, a torque, or none"}}};
}

/// The hub, the link and the mass at its tip.
struct Beam {
  double length = 0;                 ///< L (m)
  double density = 0;                ///< rho (kg/m3)
  double area = 0;                   ///< A (m2)
  double second_moment = 0;          ///< I of the cross-section (m4)
  double elastic_modulus = 0;        ///< E (Pa)
  double shear_modulus = 0;          ///< G (Pa); Timoshenko only
  double shear_coefficient = 0;      ///< k; Timoshenko only
  double tip_mass = 0;               ///< m_p (kg)
  double tip_inertia = 0;            ///< J_p (kg m2)
  double hub_radius = 0;             ///< r_H (m)
  double hub_inertia = 0;            ///< J_H about O (kg m2)
  Theory theory = Theory::rayleigh;  ///< deformation and inertia of the cross-sections
  bool extensible = false;           ///< springs E A / l along the link; else it keeps its length

  /// Damping forces of the link: mass_damping M q' + stiffness_damping K q' of its own coordinates
  /// (Rayleigh); the second alone is Kelvin and Voigt's material.
  double mass_damping = 0;       ///< 1/s
  double stiffness_damping = 0;  ///< s

  double hub_stiffness = 0;  ///< spring between ground and hub, without torque at theta = 0 (N m)
  double hub_damping = 0;    ///< damper between ground and hub (N m s)
  double gravity = 0;        ///< along -y of the ground (m/s2); x is the direction of xi at theta = 0

  /// The mass of the link, m = rho A L. @returns kg
  double mass() const { return density * area * length; }
  /// The bending stiffness E I. @returns N m2
  double bending_stiffness() const { return elastic_modulus * second_moment; }
  /// The shear stiffness G A k. @returns N; infinite without shear
  double shear_stiffness() const;
  /// The rotary inertia for each metre, rho I. @returns kg m; 0 for Euler and Bernoulli
  double rotary_inertia() const;
  /// The unit of the link's frequencies, w_s = sqrt(E I / (rho A L^4)). @returns rad/s
  double frequency_scale() const;
};

/// The reason why a description is not a beam, with the value and what is allowed.
///
/// @param beam the beam
/// @returns the reason; nothing if it is a beam
std::optional<std::string> problem(const Beam& beam);

}  // namespace linkwright::flexible
