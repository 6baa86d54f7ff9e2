#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "linkwright/flexible/chain.h"
#include "linkwright/flexible/drive.h"
#include "linkwright/flexible/input_shaping.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/study/kind.h"

// The simulation of a hub with an elastic link: what its file holds, how it is read, run and reported.
namespace linkwright::flexible {

namespace beam_fields {

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

/// Of the link: what a body can have, so that all that follows from it are numbers.
constexpr Field of_link(std::string_view key, std::string_view summary, Dimension dimension, double least,
                        double most) {
  return {.key = key,
          .summary = summary,
          .dimension = dimension,
          .minimum = least,
          .maximum = most,
          .required = true};
}

}  // namespace beam_fields

/// `[mechanism]`.
struct HubLinkForm {
  Beam beam;
  std::optional<double> fibre_distance;
};
template <class Visitor>
void fields(Visitor&& visit, HubLinkForm& form) {
  using beam_fields::number;
  using enum Dimension;
  Beam& b = form.beam;
  using beam_fields::of_link;
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
  visit(number("tip_mass", "fixed to the tip", mass), b.tip_mass);
  visit(number("tip_inertia", "of it", inertia), b.tip_inertia);
  visit(number("hub_radius", "axis to the weld", Dimension::length), b.hub_radius);
  visit(number("hub_inertia", "of the hub about its axis", inertia), b.hub_inertia);
  visit(Field{.key = "extensible", .summary = "the link may also stretch"}, b.extensible);
  visit(
      Field{.key = "mass_damping_per_s", .summary = "Rayleigh damping by mass", .minimum = 0, .maximum = 1e6},
      b.mass_damping);
  visit(number("stiffness_damping", "Kelvin and Voigt's: damping by stiffness", time), b.stiffness_damping);
  visit(number("hub_stiffness", "spring between ground and hub", stiffness_angular), b.hub_stiffness);
  visit(number("hub_damping", "damper between ground and hub", damping_angular), b.hub_damping);
  visit(number("gravity", "along -y of the ground; x is the link at angle 0", acceleration), b.gravity);
  visit(number("fibre_distance", "of the outer fibre from the neutral line, for the stress",
               Dimension::length, false, true),
        form.fibre_distance);
}

/// `[drive]`: what turns the hub.
struct SpinUpForm {
  SpinUp law;
};
template <class Visitor>
void fields(Visitor&& visit, SpinUpForm& f) {
  visit(Field{.key = "speed",
              .summary = "that is reached",
              .dimension = Dimension::speed_angular,
              .minimum = -1e6,
              .maximum = 1e6,
              .required = true},
        f.law.rate);
  visit(beam_fields::number("duration", "within which it is reached", Dimension::time, true, true),
        f.law.duration);
}
constexpr Word choice_word(const SpinUpForm&) {
  return {"spin_up", "from rest to a steady speed without a jump of the acceleration"};
}

struct TurnForm {
  double angle = 0, duration = 1;
};
template <class Visitor>
void fields(Visitor&& visit, TurnForm& f) {
  visit(Field{.key = "angle",
              .summary = "by which the hub turns",
              .dimension = Dimension::angle,
              .minimum = -1e4,
              .maximum = 1e4,
              .required = true},
        f.angle);
  visit(beam_fields::number("duration", "of the turn", Dimension::time, true, true), f.duration);
}
constexpr Word choice_word(const TurnForm&) { return {"turn", "from rest to rest by a polynomial 3-4-5"}; }

struct SinePulseForm {
  SinePulse law;
};
template <class Visitor>
void fields(Visitor&& visit, SinePulseForm& f) {
  visit(Field{.key = "torque",
              .summary = "amplitude",
              .dimension = Dimension::torque,
              .minimum = -1e12,
              .maximum = 1e12,
              .required = true},
        f.law.torque);
  visit(beam_fields::number("duration", "of the period, after which there is no torque", Dimension::time,
                            true, true),
        f.law.duration);
}
constexpr Word choice_word(const SinePulseForm&) {
  return {"sine_torque", "one period of a sine as torque, then none"};
}

struct FreeForm {
  double angle = 0, speed = 0;
};
template <class Visitor>
void fields(Visitor&& visit, FreeForm& f) {
  visit(Field{.key = "angle",
              .summary = "of the hub at the start",
              .dimension = Dimension::angle,
              .minimum = -1e4,
              .maximum = 1e4},
        f.angle);
  visit(Field{.key = "speed",
              .summary = "of the hub at the start",
              .dimension = Dimension::speed_angular,
              .minimum = -1e6,
              .maximum = 1e6},
        f.speed);
}
constexpr Word choice_word(const FreeForm&) { return {"none", "no drive: it swings or turns freely"}; }

struct ShapingForm {
  Shaper shaper = Shaper::zv;
  std::optional<double> frequency;
  double damping = 0;
  int mode = 1;
};
template <class Visitor>
void fields(Visitor&& visit, ShapingForm& f) {
  visit(Field{.key = "shaper", .summary = "which impulses"}, f.shaper);
  visit(Field{.key = "mode", .summary = "vibration that is not to be excited", .minimum = 1, .maximum = 5},
        f.mode);
  visit(Field{.key = "frequency",
              .summary = "of the vibration; default: computed for the mode",
              .dimension = Dimension::frequency,
              .minimum = 0,
              .maximum = 1e9,
              .exclusive_minimum = true},
        f.frequency);
  visit(Field{.key = "damping", .summary = "ratio of the vibration", .minimum = 0, .maximum = 0.99},
        f.damping);
}

struct HubDriveForm {
  std::variant<SpinUpForm, TurnForm, SinePulseForm, FreeForm> law;
  std::optional<ShapingForm> shaping;
};
template <class Visitor>
void fields(Visitor&& visit, HubDriveForm& d) {
  visit(Field{.key = "law", .summary = "what turns the hub"}, d.law);
  visit(Field{.key = "shaping", .summary = "the drive in shares that cancel a vibration"}, d.shaping);
}

/// `[simulation]`.
struct HubSimulationForm {
  double end = 0, step = 0.005;
  int divisions = 4, modes = 3;
  Kinematics kinematics = Kinematics::chord_consistent;
  bool extrapolate = true;
  std::optional<double> tolerance;
  bool compare_divisions = true;
};
template <class Visitor>
void fields(Visitor&& visit, HubSimulationForm& s) {
  visit(beam_fields::number("end", "time to which it is followed", Dimension::time, true, true), s.end);
  visit(beam_fields::number("step", "longest step of the integration", Dimension::time, false, true), s.step);
  visit(Field{.key = "divisions", .summary = "of the link, two cells each", .minimum = 1, .maximum = 1000},
        s.divisions);
  visit(Field{.key = "kinematics", .summary = "how the joints of the chain move"}, s.kinematics);
  visit(Field{.key = "extrapolate", .summary = "with half the step, too, and to the limit of both"},
        s.extrapolate);
  visit(beam_fields::number("tolerance", "halve the step until the tip moves by no more", Dimension::length,
                            false, true),
        s.tolerance);
  visit(Field{.key = "modes", .summary = "frequencies in the table of modes", .minimum = 1, .maximum = 20},
        s.modes);
  visit(
      Field{.key = "compare_divisions", .summary = "again with twice the divisions, and tell the difference"},
      s.compare_divisions);
}

/// A simulation as read.
struct HubLinkStudy {
  HubLinkForm mechanism;
  HubDriveForm drive;
  HubSimulationForm simulation;
  int samples = 361;
};

/// "simulation" of "flexible.hub_link".
study::Kind hub_link_kind();
/// Integrates and reports; what was reached is kept, whatever ends it.
study::Result run_hub_link(const HubLinkStudy& study, RunContext& context);

}  // namespace linkwright::flexible
