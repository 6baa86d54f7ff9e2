// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "linkwright/core/field.h"
#include "linkwright/flexible/chain.h"

// Flexible links as files hold them.
namespace linkwright::flexible::beam_fields {

/// Length, material and cross-section.
template <class Visitor>
void link(Visitor&& visit, Beam& b) {
  visit(field::length("length", "of the link").between(1e-6, 1e5).required(), b.length);
  visit(field::density("density", "of its material").between(1e-3, 1e6).required(), b.density);
  visit(field::area("area", "of its cross-section").between(1e-15, 1e4).required(), b.area);
  visit(field::second_moment_of_area("second_moment", "of its cross-section, for bending in the plane")
            .between(1e-30, 1e8)
            .required(),
        b.second_moment);
  visit(field::pressure("elastic_modulus", "of its material").between(1, 1e15).required(), b.elastic_modulus);
  visit(field::entry("theory", "what the cross-sections do"), b.theory);
  visit(field::pressure("shear_modulus", "of its material (timoshenko)").not_negative(), b.shear_modulus);
  visit(field::entry("shear_coefficient", "of its cross-section (timoshenko), 5/6 for a rectangle")
            .between(0, 1),
        b.shear_coefficient);
}

/// A mass at the tip.
template <class Visitor>
void tip(Visitor&& visit, Beam& b) {
  visit(field::mass("tip_mass", "fixed to the tip").not_negative(), b.tip_mass);
  visit(field::inertia("tip_inertia", "of it").not_negative(), b.tip_inertia);
}

/// Hub, gravity and what all links share.
template <class Visitor>
void hub(Visitor&& visit, Beam& b) {
  visit(field::length("hub_radius", "axis to the weld").not_negative(), b.hub_radius);
  visit(field::inertia("hub_inertia", "of the hub about its axis").not_negative(), b.hub_inertia);
  visit(field::entry("extensible", "the link may also stretch"), b.extensible);
  visit(field::entry("mass_damping_per_s", "Rayleigh damping by mass").between(0, 1e6), b.mass_damping);
  visit(field::time("stiffness_damping", "Kelvin and Voigt's: damping by stiffness").not_negative(),
        b.stiffness_damping);
  visit(field::stiffness_angular("hub_stiffness", "spring between ground and hub").not_negative(),
        b.hub_stiffness);
  visit(field::damping_angular("hub_damping", "damper between ground and hub").not_negative(), b.hub_damping);
  visit(field::acceleration("gravity", "along -y of the ground; x is the link at angle 0").not_negative(),
        b.gravity);
}

/// For the stress, which is left out without it.
constexpr Field fibre_distance =
    field::length("fibre_distance", "of the outer fibre from the neutral line, for the stress").positive();

}  // namespace linkwright::flexible::beam_fields
