// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/pi_joint/dynamics.h"
#include "linkwright/parallel/pi_joint/screw.h"
#include "linkwright/parallel/pi_joint/stiffness.h"

/// Everything that a Pi-joint does, over its angle: the curves of Milutinovic et al. 2014, figures 8-12 and
/// 15-17, and those of stiffness and weight.
namespace linkwright::parallel {

/// The equipment of a joint, as far as it is known.
struct PiEquipment {
  std::optional<PiDrive> drive;
  std::optional<PiBars> bars;
  double share = 1;  ///< share of the torque at A, see pi_stiffness.h
  std::optional<PiMasses> masses;
  PiLoad load;  ///< load, used with masses
};

/// Values at one angle (SI); NaN where the equipment that they need is not given.
struct PiCurvePoint {
  static constexpr double not_known = nan;
  double angle = 0;             ///< theta
  double diagonal = 0;          ///< d
  double jacobian = 0;          ///< J
  double inverse_jacobian = 0;  ///< 1 / J; infinite at +-pi/2
  double jacobian_slope = 0;    ///< J'
  PiAngles angles;
  PiOutput output = {not_known, not_known, not_known};  ///< output of the drive
  double stiffness = not_known;                         ///< stiffness of the bars
  double inertia = not_known;                           ///< inertia of the masses
  double holding_torque = not_known;                    ///< at rest against gravity and load
  double holding_force = not_known;                     ///< the same along the diagonal
};

std::vector<PiCurvePoint> pi_curves(const PiJoint& joint, const PiEquipment& equipment,
                                    std::span<const double> angles);

}  // namespace linkwright::parallel
