// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/pi_joint/pi_joint.h"

/// Stiffness of the Pi-joint as a truss: a rigid base, and bars OC and BA (arms), CA (coupler) and OA
/// (diagonal) that yield along themselves, with pins at O, B, C, A. The torque T at the output enters as a
/// force T / a across the arms, the share w of it at A and 1 - w at C. The truss is statically determinate,
/// so bar forces follow from equilibrium alone.
namespace linkwright::parallel {

/// Stiffness along the bars (N/m), infinite for a rigid one.
struct PiBars {
  double arm = infinity;       ///< k_a, each of both
  double coupler = infinity;   ///< k_c
  double diagonal = infinity;  ///< k_d, what does not depend on its length
  /// E A of the screw (N): yields in series with k_d by d / (E A), more the longer it is.
  double screw = infinity;
};

/// Says what keeps it from being a truss, with the value; nothing if it is one.
std::optional<std::string> problem(const PiBars& bars);

/// Forces in the bars for a torque of 1 N m at the output (1/m), positive in tension.
struct PiBarForces {
  double arm_base = 0;  ///< OC
  double arm_top = 0;   ///< BA
  double coupler = 0;   ///< CA
  double diagonal = 0;  ///< OA, 1 / J
};

/// At theta in (-pi/2, pi/2) with the share w in [0, 1]. Forces are infinite at the ends, where the diagonal
/// cannot hold the arm.
PiBarForces bar_forces(const PiJoint& joint, double angle, double share = 1);

/// Turn of the output for a torque there (rad/(N m)); infinite at +-pi/2. With rigid arms and coupler
/// 1 / (J^2 k_d).
double compliance(const PiJoint& joint, const PiBars& bars, double angle, double share = 1);

/// Torque for a turn of the output (N m/rad): 1 / compliance, 0 at +-pi/2, infinite for a rigid truss.
double stiffness(const PiJoint& joint, const PiBars& bars, double angle, double share = 1);

}  // namespace linkwright::parallel
