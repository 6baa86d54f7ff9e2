// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/parallel/robot/robot.h"

/// The pose that arms of a robot come to when they are led from home: of all that their angles allow, the one
/// of home's assembly.
namespace linkwright::parallel {

struct LedPose {
  /// done; no_assembly or not_converged: the platform cannot follow; singular: on the path the rods do not
  /// hold it, and what is beyond may be another assembly
  Status status = Status::done;
  Pose pose;            ///< at `share`
  double share = 0;     ///< share of the path of the arms that was covered; 1 = all of it
  double residual = 0;  ///< largest error of a rod's length (m)
  int steps = 0;
};

/// All arms turn at once, in proportion, by the smaller rotation from their angles at home to `angles`. Steps
/// are as long as Newton's method ends close to where the velocity of the platform leads; the path ends where
/// the least singular value of the rods' rows falls below rods_floor (regular_ball.h), which is found to 1e-9
/// of it, or their determinant changes its sign. `length` (m) makes the turning of a HEXA comparable.
/// Allocates nothing.
///
/// Throws ContractError when the arms do not fit at home.
LedPose lead_arms(const Robot& robot, const Pose& home, std::span<const double> home_angles,
                  std::span<const double> angles, double length);

}  // namespace linkwright::parallel
