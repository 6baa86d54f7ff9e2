// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/dynamics.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"

namespace linkwright::parallel {

namespace {

// Everything that the equation of motion takes from one angle.
struct Shape {
  double d, j, j_slope;          // diagonal, J, J'
  double direction, turn, bend;  // phi, phi', phi''
};

Shape shape_at(const PiJoint& joint, double angle) {
  const auto [turn, bend] = direction_slopes(joint, angle);
  return {.d = diagonal(joint, angle),
          .j = jacobian(joint, angle),
          .j_slope = jacobian_slope(joint, angle),
          .direction = angles(joint, angle).diagonal_direction,
          .turn = turn,
          .bend = bend};
}

// (2 pi / h)^2 I_r: the mass that the rotor is, seen from the diagonal.
double rotor_mass(const PiMasses& m) {
  const double gearing = 2 * pi / m.lead;
  return m.rotor_inertia == 0 ? 0 : m.rotor_inertia * gearing * gearing;
}

// About O or A: what turns with phi whatever the length of the diagonal.
double turning_inertia(const PiMasses& m) {
  return m.nut_inertia + m.nut_mass * m.nut_centre * m.nut_centre + m.rod_inertia;
}

double inertia(const PiJoint& joint, const PiMasses& m, const Shape& s) {
  const double reach = s.d - m.rod_centre;
  return 2 * m.arm_inertia + m.coupler_mass * joint.arm * joint.arm +
         (turning_inertia(m) + m.rod_mass * reach * reach) * s.turn * s.turn +
         (m.rod_mass + rotor_mass(m)) * s.j * s.j;
}

double inertia_slope(const PiMasses& m, const Shape& s) {
  const double reach = s.d - m.rod_centre;
  return 2 * (turning_inertia(m) + m.rod_mass * reach * reach) * s.turn * s.bend +
         2 * m.rod_mass * reach * s.j * s.turn * s.turn + 2 * (m.rod_mass + rotor_mass(m)) * s.j * s.j_slope;
}

// First moments (kg m) of what moves along u(theta) and along u(phi).
struct FirstMoments {
  double arms, drive;
};
FirstMoments moments(const PiJoint& joint, const PiMasses& m, const Shape& s) {
  return {2 * m.arm_mass * m.arm_centre + m.coupler_mass * joint.arm,
          m.nut_mass * m.nut_centre + m.rod_mass * (s.d - m.rod_centre)};
}

double gravity_torque(const PiJoint& joint, const PiMasses& m, const PiLoad& load, double angle,
                      const Shape& s) {
  const auto [arms, drive] = moments(joint, m, s);
  const double x = load.gravity_x, y = load.gravity_y;
  const double along = x * std::cos(s.direction) + y * std::sin(s.direction);
  const double across = y * std::cos(s.direction) - x * std::sin(s.direction);
  return -(arms * (y * std::cos(angle) - x * std::sin(angle)) + drive * s.turn * across +
           m.rod_mass * s.j * along);
}

}  // namespace

std::optional<std::string> problem(const PiMasses& m) {
  const auto bad = [](double value) { return !(value >= 0 && std::isfinite(value)); };
  for (const auto& [value, what] : {std::pair{m.arm_inertia, "inertia of an arm = {} kg m2"},
                                    {m.arm_mass, "mass of an arm = {} kg"},
                                    {m.coupler_mass, "mass of the coupler = {} kg"},
                                    {m.nut_mass, "mass of the part at O = {} kg"},
                                    {m.nut_inertia, "inertia of the part at O = {} kg m2"},
                                    {m.rod_mass, "mass of the part at A = {} kg"},
                                    {m.rod_inertia, "inertia of the part at A = {} kg m2"},
                                    {m.rotor_inertia, "inertia of the rotor = {} kg m2"}})
    if (bad(value)) return fmt::format(fmt::runtime(what), value);
  for (const auto& [value, what] : {std::pair{m.arm_centre, "mass centre of an arm at {} m"},
                                    {m.nut_centre, "mass centre of the part at O at {} m"},
                                    {m.rod_centre, "mass centre of the part at A at {} m"}})
    if (!std::isfinite(value)) return fmt::format(fmt::runtime(what), value);
  // The mass centre has the least inertia.
  const double least = m.arm_mass * m.arm_centre * m.arm_centre;
  if (m.arm_inertia < least * (1 - tolerance::closure))
    return fmt::format("inertia of an arm about its pivot = {} kg m2, less than that of its mass, {} kg m2",
                       m.arm_inertia, least);
  if (m.rotor_inertia > 0 && !(m.lead > 0 && std::isfinite(m.lead)))
    return fmt::format("inertia of the rotor with a lead of {} m", m.lead);
  return {};
}

double inertia(const PiJoint& joint, const PiMasses& masses, double angle) {
  return inertia(joint, masses, shape_at(joint, angle));
}

double inertia_slope(const PiJoint& joint, const PiMasses& masses, double angle) {
  return inertia_slope(masses, shape_at(joint, angle));
}

double potential(const PiJoint& joint, const PiMasses& masses, const PiLoad& load, double angle) {
  const Shape s = shape_at(joint, angle);
  const auto [arms, drive] = moments(joint, masses, s);
  return -(load.gravity_x * (arms * std::cos(angle) + drive * std::cos(s.direction)) +
           load.gravity_y * (arms * std::sin(angle) + drive * std::sin(s.direction)));
}

double gravity_torque(const PiJoint& joint, const PiMasses& masses, const PiLoad& load, double angle) {
  return gravity_torque(joint, masses, load, angle, shape_at(joint, angle));
}

PiEffort effort(const PiJoint& joint, const PiMasses& masses, const PiLoad& load, const PiMotion& angle) {
  const Shape s = shape_at(joint, angle.value);
  const double torque = inertia(joint, masses, s) * angle.acceleration +
                        0.5 * inertia_slope(masses, s) * angle.rate * angle.rate +
                        gravity_torque(joint, masses, load, angle.value, s) - load.torque;
  return {.torque = torque, .force = torque / s.j};
}

double acceleration(const PiJoint& joint, const PiMasses& masses, const PiLoad& load, double angle,
                    double rate, double force) {
  const Shape s = shape_at(joint, angle);
  return (s.j * force + load.torque - gravity_torque(joint, masses, load, angle, s) -
          0.5 * inertia_slope(masses, s) * rate * rate) /
         inertia(joint, masses, s);
}

}  // namespace linkwright::parallel
