// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/planar/serial_arm/serial_arm.h"

// Motion of a serial arm whose torques are given.
namespace linkwright::planar {

/// Mass matrix (kg m2) of the absolute angles, row-major, n x n, symmetric:
/// mass_matrix * accelerations + (loads without acceleration) = absolute torques.
std::vector<double> mass_matrix(std::span<const ArmElement> arm, std::span<const double> angles);

/// Accelerations (rad/s2) of the absolute angles under absolute torques (N m); gravity along -y (m/s2). Reads
/// angle and rate of each motion and sets its acceleration. Motors in the joints give the absolute torques
/// joint[k] - joint[k + 1].
///
/// `singular` if the mass matrix is not positive definite (a last link without any inertia): accelerations
/// are then NaN. Throws ContractError unless there are as many motions and torques as elements.
Status accelerate(std::span<const ArmElement> arm, std::span<const double> absolute_torques, double gravity,
                  std::span<math::Motion> motion);

}  // namespace linkwright::planar
