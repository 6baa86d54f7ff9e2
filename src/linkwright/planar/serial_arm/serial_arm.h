// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <span>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/math/motion_law.h"
#include "linkwright/planar/link_mass.h"

/// @file
/// Open chains of links joined by revolute joints: model, positions and rates. Link k = 0, 1, ... has its own
/// joint O_k+1 (O1 joins the first link to the ground) and carries the next one, or the tip, at the end of
/// its line. Angles of links are absolute: counter-clockwise from the x axis, not from the link before.
namespace linkwright::planar {

/// One link of an arm with the masses fixed to it.
struct ArmLink {
  double length = 0;                ///< m, own joint to next joint or tip, > 0
  LinkMass body;                    ///< the link itself
  std::vector<PointMass> attached;  ///< masses fixed to it
};

/// An open chain of links.
struct SerialArm {
  std::complex<double> base{0};  ///< joint O1 (m)
  std::vector<ArmLink> links;    ///< from the base outwards
};

/// A link as the equations of motion see it.
struct ArmElement {
  double length = 0;    ///< m
  BaseParameters base;  ///< base parameters of the link with the masses fixed to it
};

/// The links of an arm as the equations of motion need them.
///
/// @param arm the arm
/// @returns one element for each link
/// @throws ContractError if there is no link, a length is not positive and finite, or a mass is wrong (see
///   base_parameters)
std::vector<ArmElement> elements(const SerialArm& arm);

/// A point in motion, global frame: m, m/s, m/s2.
struct ArmPointMotion {
  std::complex<double> position{0},  ///< m
      velocity{0},                   ///< m/s
      acceleration{0};               ///< m/s2
};

/// A link in motion.
struct ArmLinkRates {
  std::complex<double> direction;  ///< e^(i angle) of the link line
  double speed = 0,                ///< absolute, rad/s
      acceleration = 0;            ///< absolute, rad/s2
  ArmPointMotion joint;            ///< the link's own joint
};

/// The motion of a point of a link.
///
/// @param link the link in motion
/// @param place the point in the frame of the link (m): own joint in the origin, link line along x
/// @returns its motion in the global frame
ArmPointMotion point(const ArmLinkRates& link, std::complex<double> place);

/// Rates of all links from their absolute angles, outwards from the base. The tip is point(rates.back(),
/// length of the last link). Allocates nothing.
///
/// @param arm the links, from the base outwards
/// @param base position of the joint O1, global (m)
/// @param motion absolute angle, rate and acceleration of each link (rad, rad/s, rad/s2); the jerk is not
///   used
/// @param rates receives the rates, one a link
/// @throws ContractError unless there are as many motions and rates as elements
void rates(std::span<const ArmElement> arm, std::complex<double> base, std::span<const math::Motion> motion,
           std::span<ArmLinkRates> rates);

/// Mass matrix of the absolute angles: mass_matrix * accelerations + (loads without acceleration) = absolute
/// torques.
///
/// @param arm the links, from the base outwards
/// @param angles absolute angles of the links (rad)
/// @returns kg m2, row-major, n x n, symmetric
/// @throws ContractError unless there are as many angles as elements
std::vector<double> mass_matrix(std::span<const ArmElement> arm, std::span<const double> angles);

/// Accelerations (rad/s2) of the absolute angles under absolute torques. Reads angle and rate of each motion
/// and sets its acceleration. Motors in the joints give the absolute torques joint[k] - joint[k + 1].
///
/// `singular` if the mass matrix is not positive definite (a last link without any inertia): accelerations
/// are then NaN.
///
/// @param arm the links, from the base outwards
/// @param absolute_torques torques of the absolute angles (N m), one a link
/// @param gravity acceleration of free fall (m/s2), along -y
/// @param motion angles and rates, one a link; receives the accelerations (rad/s2)
/// @returns done or singular
/// @throws ContractError unless there are as many motions and torques as elements
Status accelerate(std::span<const ArmElement> arm, std::span<const double> absolute_torques, double gravity,
                  std::span<math::Motion> motion);

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
