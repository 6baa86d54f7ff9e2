#pragma once

#include <string_view>

#include "linkwright/core/field.h"
#include "linkwright/flexible/beam.h"

// Flexible links as files hold them.
namespace linkwright::flexible::beam_fields {

constexpr Field number(std::string_view key, std::string_view summary, Dimension dimension,
                       bool required = false, bool positive = false) {
  return {.key = key,
          .summary = summary,
          .dimension = dimension,
          .minimum = 0,
          .maximum = 1e18,
          .exclusive_minimum = positive,
          .required = required};
}

/// A field of the link: bounds that a body can have, so that all derived values are numbers.
constexpr Field of_link(std::string_view key, std::string_view summary, Dimension dimension, double least,
                        double most) {
  return {.key = key,
          .summary = summary,
          .dimension = dimension,
          .minimum = least,
          .maximum = most,
          .required = true};
}

/// Length, material and cross-section.
template <class Visitor>
void link(Visitor&& visit, Beam& b) {
  using enum Dimension;
  visit(of_link("length", "of the link", length, 1e-6, 1e5), b.length);
  visit(of_link("density", "of its material", density, 1e-3, 1e6), b.density);
  visit(of_link("area", "of its cross-section", area, 1e-15, 1e4), b.area);
  visit(of_link("second_moment", "of its cross-section, for bending in the plane", second_moment_of_area,
                1e-30, 1e8),
        b.second_moment);
  visit(of_link("elastic_modulus", "of its material", pressure, 1, 1e15), b.elastic_modulus);
  visit(Field{.key = "theory", .summary = "what the cross-sections do"}, b.theory);
  visit(number("shear_modulus", "of its material (timoshenko)", pressure), b.shear_modulus);
  visit(Field{.key = "shear_coefficient",
              .summary = "of its cross-section (timoshenko), 5/6 for a rectangle",
              .minimum = 0,
              .maximum = 1},
        b.shear_coefficient);
}

/// A mass at the tip.
template <class Visitor>
void tip(Visitor&& visit, Beam& b) {
  visit(number("tip_mass", "fixed to the tip", Dimension::mass), b.tip_mass);
  visit(number("tip_inertia", "of it", Dimension::inertia), b.tip_inertia);
}

/// Hub, gravity and what all links share.
template <class Visitor>
void hub(Visitor&& visit, Beam& b) {
  using enum Dimension;
  visit(number("hub_radius", "axis to the weld", length), b.hub_radius);
  visit(number("hub_inertia", "of the hub about its axis", inertia), b.hub_inertia);
  visit(Field{.key = "extensible", .summary = "the link may also stretch"}, b.extensible);
  visit(
      Field{.key = "mass_damping_per_s", .summary = "Rayleigh damping by mass", .minimum = 0, .maximum = 1e6},
      b.mass_damping);
  visit(number("stiffness_damping", "Kelvin and Voigt's: damping by stiffness", time), b.stiffness_damping);
  visit(number("hub_stiffness", "spring between ground and hub", stiffness_angular), b.hub_stiffness);
  visit(number("hub_damping", "damper between ground and hub", damping_angular), b.hub_damping);
  visit(number("gravity", "along -y of the ground; x is the link at angle 0", acceleration), b.gravity);
}

/// For the stress, which is left out without it.
constexpr Field fibre_distance =
    number("fibre_distance", "of the outer fibre from the neutral line, for the stress", Dimension::length,
           false, true);

}  // namespace linkwright::flexible::beam_fields
