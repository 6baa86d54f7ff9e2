// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <span>

#include "linkwright/planar/serial_arm/serial_arm.h"

/// @file
/// Joint forces and torques of a serial arm whose motion is given.
namespace linkwright::planar {

/// The loads in the own joint of one link.
struct ArmJointLoads {
  std::complex<double> force;  ///< force of the link before (or the ground) on this link (N), global frame
  /// Torque on this link when all motors are mounted on the ground: the generalised force of the absolute
  /// angle (N m).
  double absolute_torque = 0;
  /// Torque when each motor is mounted on the link before: sum of the absolute torques from this link
  /// outwards (N m).
  double joint_torque = 0;
};

/// Loads of all joints in one pass inwards (Boskovic 2018, Eqs. (2.33)-(2.36) for any number of links, any
/// mass centres and gravity). The joint forces do not depend on where the motors are mounted. Allocates
/// nothing.
///
/// @param arm the links, from the base outwards
/// @param rates rates of the same arm, one a link
/// @param gravity acceleration of free fall (m/s2), along -y
/// @param loads receives the loads, one a link
/// @throws ContractError unless there are as many rates and loads as elements and the gravity is finite
void reactions(std::span<const ArmElement> arm, std::span<const ArmLinkRates> rates, double gravity,
               std::span<ArmJointLoads> loads);

/// Kinetic and potential energy (J) above the x axis.
struct ArmEnergy {
  double kinetic = 0,  ///< J
      potential = 0;   ///< J, zero at the x axis
};

/// Kinetic and potential energy of an arm.
///
/// @param arm the links, from the base outwards
/// @param rates rates of the same arm, one a link
/// @param gravity acceleration of free fall (m/s2), along -y
/// @returns both energies
/// @throws ContractError unless there are as many rates as elements
ArmEnergy energy(std::span<const ArmElement> arm, std::span<const ArmLinkRates> rates, double gravity);

/// The rate at which kinetic and potential energy grow; equal to the sum of absolute_torque * speed over the
/// links.
///
/// @param arm the links, from the base outwards
/// @param rates rates of the same arm, one a link
/// @param gravity acceleration of free fall (m/s2), along -y
/// @returns W
/// @throws ContractError unless there are as many rates as elements
double energy_rate(std::span<const ArmElement> arm, std::span<const ArmLinkRates> rates, double gravity);

/// Two rods with a payload at the tip, the arm of Boskovic 2018, section 2.2: mass centres in the middle.
struct TwoRods {
  /// One of the rods.
  struct Rod {
    double length = 0;   ///< m, > 0
    double mass = 0;     ///< kg, > 0
    double inertia = 0;  ///< kg m2 about the middle, >= 0
  };
  std::array<Rod, 2> rods;  ///< from the base outwards
  double payload = 0;       ///< kg, at the tip
};

/// The two rods as a serial arm, with the payload as an attached mass.
///
/// @param arm the rods
/// @returns the arm
SerialArm serial_arm(const TwoRods& arm);

/// Loads of both joints with redundant coordinates, as the source derives them: each rod replaced by an
/// equimomental pair of masses, forces as multipliers of forbidden displacements of the joints (Boskovic
/// 2018, Eqs. (2.2)-(2.21) and (2.32)). Without gravity. An independent route to check `reactions` with.
///
/// @param arm the rods
/// @param motion absolute angles of the rods (rad) with rates and accelerations
/// @returns the loads of both joints
/// @throws ContractError unless lengths and masses of the rods are positive
std::array<ArmJointLoads, 2> reactions_redundant(const TwoRods& arm,
                                                 const std::array<math::Motion, 2>& motion);

}  // namespace linkwright::planar
