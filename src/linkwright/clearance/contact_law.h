// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "linkwright/core/field.h"

// Forces between a pin and a bush that press into each other by `depth` (m), which grows at `rate` (m/s).
namespace linkwright::clearance {

/// The model of the energy loss while pin and bush press into each other: the factor a of F = K depth^n (1 +
/// a rate / approach speed).
enum class ContactDamping { lankarani_nikravesh, flores_2011 };
constexpr std::array<EnumName<ContactDamping>, 2> names(ContactDamping) {
  return {{{ContactDamping::lankarani_nikravesh, "lankarani_nikravesh",
            "a = 3 (1 - c^2) / 4 (1990): for coefficients of restitution near 1"},
           {ContactDamping::flores_2011, "flores_2011",
            "a = 8 (1 - c) / (5 c) (Flores, Machado, Silva and Martins 2011): for all of them"}}};
}

struct ContactLaw {
  double stiffness = 0;    ///< K, N/m^n, > 0
  double exponent = 1.5;   ///< n, >= 1
  double restitution = 1;  ///< c: that of the law, in (0, 1]; see effective_restitution
  ContactDamping damping = ContactDamping::flores_2011;
  double friction = 0;  ///< coefficient, >= 0
  /// m/s: friction is zero below the first tangential speed, whole above the second, and linear between
  /// (modified Coulomb friction of Ambrosio).
  double friction_from = 1e-4, friction_whole = 1e-3;
};

/// Throws ContractError for numbers out of range.
void require_valid(const ContactLaw& law);

/// Elastic properties of a material.
struct Elasticity {
  double modulus = 207e9;  ///< Young's, Pa
  double poisson = 0.3;
};
/// K of a pin in a bush (N/m^1.5): 4 / (3 (s_bush + s_pin)) sqrt(R_bush R_pin / (R_bush - R_pin)),
/// s = (1 - poisson^2) / modulus, with the radii in m. Throws ContractError unless 0 < R_pin < R_bush.
double pin_stiffness(double bush_radius, double pin_radius, const Elasticity& bush = {},
                     const Elasticity& pin = {});

/// a of the law, see ContactDamping.
double damping_factor(const ContactLaw& law);

/// Speeds of approach below this count as this in the damping, so that it stays finite (m/s).
inline constexpr double min_approach = 1e-6;

/// N, never negative; zero unless depth > 0. `approach` (m/s) is the rate at the start of the contact.
double normal_force(const ContactLaw& law, double depth, double rate, double approach);
/// The part that gives its energy back: K depth^n.
double elastic_force(const ContactLaw& law, double depth);
double elastic_energy(const ContactLaw& law, double depth);  ///< J

/// N, of the sign of the tangential speed (m/s) that it opposes.
double friction_force(const ContactLaw& law, double normal, double tangential_speed);

/// Speed after over speed before a free impact: solves a (1 + e) = ln((1 + a) / (1 - a e)), whatever the
/// mass, speed, stiffness and exponent.
double effective_restitution(const ContactLaw& law);

/// A free impact by the law, by an elastic one of the same mass, speed, stiffness and exponent.
struct ImpactShape {
  double restitution = 1;  ///< effective_restitution
  double force = 1;        ///< largest force by its largest force
  double depth = 1;        ///< largest depth by its largest depth
};
/// Shape of an impact by a contact law. With u = speed / approach, S(u) = (1 - u) / a - ln((1 + a) / (1 + a
/// u)) / a^2 is the integral of x / (1 + a x) from u to 1, and depth^(n+1) = (n + 1) m v^2 S / K; elastic,
/// S(0) = 1/2.
ImpactShape impact_shape(const ContactLaw& law);
/// Least coefficient of restitution, in hundredths, from which on the effective one of the law differs by no
/// more than `share` of it.
double min_restitution(ContactDamping damping, double share);

/// About how long an impact lasts (s): 3.2 (m^2 / (K^2 v))^(1/5), elastic, exponent 1.5; in general the same
/// for the depth that takes up all energy. `mass` (kg) is the effective one, `approach` in m/s.
double contact_time(const ContactLaw& law, double mass, double approach);

}  // namespace linkwright::clearance
