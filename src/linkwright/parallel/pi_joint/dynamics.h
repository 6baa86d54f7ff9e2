// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "linkwright/core/field.h"
#include "linkwright/core/status.h"
#include "linkwright/parallel/pi_joint/pi_joint.h"

/// Dynamics of the Pi-joint: one freedom, so Lagrange's equation of the generalised inertia I(theta) and the
/// potential V(theta). SI units; axes of the joint: x across the base, y along it from O to B.
namespace linkwright::parallel {

struct PiMasses {
  double arm_inertia = 0;    ///< inertia of each arm about its pivot (kg m2)
  double arm_mass = 0;       ///< mass of each arm (kg)
  double arm_centre = 0;     ///< mass centre of each arm from its pivot (m)
  double coupler_mass = 0;   ///< mass of the coupler and of the load on it that does not turn either (kg)
  double nut_mass = 0;       ///< m1, of the part of the diagonal that turns about O (kg)
  double nut_centre = 0;     ///< l1: its mass centre from O (m)
  double nut_inertia = 0;    ///< I1, about its mass centre (kg m2)
  double rod_mass = 0;       ///< m2, of the part of the diagonal that ends at A (kg)
  double rod_centre = 0;     ///< l2: its mass centre from A towards O (m)
  double rod_inertia = 0;    ///< I2, about its mass centre (kg m2)
  double rotor_inertia = 0;  ///< inertia of motor and screw, about the axis of the screw (kg m2)
  double lead = 0;           ///< lead of the screw (m); needed with an inertia of the rotor
};

/// The lead belongs to the screw, not to its masses.
template <class Visitor>
void fields(Visitor&& visit, PiMasses& m) {
  const auto number = [](std::string_view key, std::string_view summary, Dimension dimension,
                         double least = 0) { return field::of(dimension, key, summary).between(least, 1e9); };
  using enum Dimension;
  visit(number("arm_inertia", "of each of both arms about its pivot", inertia), m.arm_inertia);
  visit(number("arm_mass", "of each of both arms", mass), m.arm_mass);
  visit(number("arm_centre", "mass centre of each arm from its pivot", length, -1e9), m.arm_centre);
  visit(number("coupler_mass", "of the coupler", mass), m.coupler_mass);
  visit(number("nut_mass", "of the part of the diagonal that turns about the base", mass), m.nut_mass);
  visit(number("nut_centre", "its mass centre from the base pivot", length, -1e9), m.nut_centre);
  visit(number("nut_inertia", "about its mass centre", inertia), m.nut_inertia);
  visit(number("rod_mass", "of the part of the diagonal that ends at the coupler", mass), m.rod_mass);
  visit(number("rod_centre", "its mass centre from that end", length, -1e9), m.rod_centre);
  visit(number("rod_inertia", "about its mass centre", inertia), m.rod_inertia);
  visit(number("rotor_inertia", "of motor and screw about the axis of the screw", inertia), m.rotor_inertia);
}

/// Says what keeps them from being masses, with the value; nothing if they are masses.
std::optional<std::string> problem(const PiMasses& masses);

/// The external load on the joint.
struct PiLoad {
  double gravity_x = 0;  ///< in axes of the joint (m/s2); for a vertical base (0, -9.81)
  double gravity_y = 0;
  double torque = 0;  ///< on the arms, positive where it increases theta (N m)
};

/// Generalised inertia (kg m2): the kinetic energy is I theta'^2 / 2.
double inertia(const PiJoint& joint, const PiMasses& masses, double angle);
/// dI/dtheta (kg m2).
double inertia_slope(const PiJoint& joint, const PiMasses& masses, double angle);

/// V: energy in the field of gravity, 0 for everything at O, up to a constant of the coupler's shape (J).
double potential(const PiJoint& joint, const PiMasses& masses, const PiLoad& load, double angle);
/// V' = dV/dtheta: torque that holds the joint at rest against gravity (N m).
double gravity_torque(const PiJoint& joint, const PiMasses& masses, const PiLoad& load, double angle);

/// The effort that the drive must give.
struct PiEffort {
  double torque = 0;  ///< T, as a torque on the arms: I theta'' + I' theta'^2 / 2 + V' - load (N m)
  double force = 0;   ///< T / J along the diagonal, positive where it lengthens it (N); infinite or NaN at
                      ///< +-pi/2, where the diagonal cannot give it
};
/// Inverse dynamics: effort for a motion of theta. The force includes what turns the rotor; in front of the
/// screw, the motor's torque is motor_torque of it (pi_screw.h).
PiEffort effort(const PiJoint& joint, const PiMasses& masses, const PiLoad& load, const PiMotion& angle);

/// Direct dynamics: theta'' (rad/s2) by a force along the diagonal at an angle and rate. The joint must have
/// an inertia there; NaN or infinite else.
double acceleration(const PiJoint& joint, const PiMasses& masses, const PiLoad& load, double angle,
                    double rate, double force);

}  // namespace linkwright::parallel
