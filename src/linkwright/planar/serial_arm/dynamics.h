// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/planar/serial_arm/serial_arm.h"

/// @file
/// Motion of a serial arm whose torques are given.
namespace linkwright::planar {

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

}  // namespace linkwright::planar
