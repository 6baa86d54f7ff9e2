// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <span>

#include "linkwright/planar/serial_arm/serial_arm.h"

// Joint forces and torques of a serial arm whose motion is given.
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
/// mass centres and gravity, which acts along -y in m/s2). `rates` are those of the same arm. The joint
/// forces do not depend on where the motors are mounted. Allocates nothing.
///
/// Throws ContractError unless there are as many rates and loads as elements.
void reactions(std::span<const ArmElement> arm, std::span<const ArmLinkRates> rates, double gravity,
               std::span<ArmJointLoads> loads);

/// Kinetic and potential energy (J) above the x axis.
struct ArmEnergy {
  double kinetic = 0, potential = 0;
};
ArmEnergy energy(std::span<const ArmElement> arm, std::span<const ArmLinkRates> rates, double gravity);

/// Rate (W) at which kinetic and potential energy grow; equal to the sum of absolute_torque * speed over the
/// links.
double energy_rate(std::span<const ArmElement> arm, std::span<const ArmLinkRates> rates, double gravity);

/// Two rods with a payload at the tip, the arm of Boskovic 2018, section 2.2: mass centres in the middle.
struct TwoRods {
  struct Rod {
    double length = 0;   ///< m, > 0
    double mass = 0;     ///< kg, > 0
    double inertia = 0;  ///< kg m2 about the middle
  };
  std::array<Rod, 2> rods;
  double payload = 0;  ///< kg
};
SerialArm serial_arm(const TwoRods& arm);

/// Loads of both joints with redundant coordinates, as the source derives them: each rod replaced by an
/// equimomental pair of masses, forces as multipliers of forbidden displacements of the joints (Boskovic
/// 2018, Eqs. (2.2)-(2.21) and (2.32)). Without gravity. An independent route to check `reactions` with.
///
/// Throws ContractError unless lengths and masses of the rods are positive.
std::array<ArmJointLoads, 2> reactions_redundant(const TwoRods& arm,
                                                 const std::array<math::Motion, 2>& motion);

}  // namespace linkwright::planar
