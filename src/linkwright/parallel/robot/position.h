// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/sentence.h"
#include "linkwright/core/status.h"
#include "linkwright/parallel/robot/robot.h"

/// @file
/// Arm angles from the platform's pose and back.
namespace linkwright::parallel {

/// The sign of s . u' of each leg, 1 or -1: the side of the straight leg on which the elbow is. 2^legs
/// working modes; legs beyond legs() do not count.
using WorkingMode = std::array<int, max_legs>;
/// The working mode whose signs are all 1.
inline constexpr WorkingMode all_positive{1, 1, 1, 1, 1, 1};

/// All working modes of a robot, the first leg changing fastest; all_positive first.
///
/// @param robot the robot
/// @returns 2^legs modes
std::vector<WorkingMode> working_modes(const Robot& robot);

/// The arm angles of a pose.
struct ArmAngles {
  Status status = Status::done;  ///< no_assembly: a leg cannot reach; singular: the arm's place is open
  std::array<double, max_legs> angle{};  ///< rad, in (-pi, pi]; NaN for legs that cannot reach
  int leg = -1;                          ///< first leg with the trouble, from 0; -1 = none
  /// The amount that the leg lacks (m): positive = the joint is too far by so much, negative = too near.
  double shortfall = 0;
};

/// Inverse position: |g - A - l u(alpha)| = L for each leg, solved in closed form. A leg that is straight up
/// to rounding is taken as straight. Allocates nothing.
///
/// @param robot the robot
/// @param pose pose of the platform
/// @param mode working mode
/// @returns the angles, with their status
ArmAngles inverse(const Robot& robot, const Pose& pose, const WorkingMode& mode = all_positive);

/// The working mode of a robot whose arm angles fit its pose.
///
/// @param robot the robot
/// @param pose pose of the platform
/// @param angles arm angles (rad), one a leg
/// @returns the sign of s . u' of each leg; 0 where arm and rod are aligned
/// @throws ContractError if there are fewer angles than legs
WorkingMode working_mode(const Robot& robot, const Pose& pose, std::span<const double> angles);

/// The pose of a platform for given arm angles.
struct Placed {
  /// no_assembly, singular (centres coincide or lie on a line), not_converged; branch_lost: a pose of another
  /// assembly than that of the start, beyond a singularity
  Status status = Status::done;
  Pose pose;            ///< pose of the platform
  double residual = 0;  ///< largest error of a rod's length (m)
  int iterations = 0;   ///< iterations of Newton's method; 0 = closed form
};

/// Direct position of robots that do not turn, in closed form: intersection of spheres or circles about the
/// arms' ends. The sign of the assembly depends on the order of the legs: a DELTA numbered counter-clockwise
/// seen from above whose platform hangs below has -1, a planar robot has its platform on the left of the line
/// from the first to the second elbow with 1. At the very boundary, where both assemblies meet, rounding is
/// forgiven. Allocates nothing.
///
/// @param robot the robot
/// @param angles arm angles (rad), one a leg
/// @param assembly sign of det Jx, 1 or -1, see jacobians.h
/// @returns the pose, with its status
/// @throws ContractError for a robot of Freedom::space (see direct_near and assembly_modes.h), and if there
///   are fewer angles than legs
Placed direct(const Robot& robot, std::span<const double> angles, int assembly);

/// Direct position of any robot from a pose nearby, by Newton's method with the exact Jacobian Jx and halved
/// steps. A pose that does not fit is not_converged, one whose det Jx has another sign than at the start
/// branch_lost: Newton's method has leapt across a singularity. Allocates nothing.
///
/// @param robot the robot
/// @param angles arm angles (rad), one a leg
/// @param start pose nearby
/// @returns the pose, with its status
/// @throws ContractError if there are fewer angles than legs
Placed direct_near(const Robot& robot, std::span<const double> angles, const Pose& start);

/// The joint of a leg at the platform.
///
/// @param robot the robot
/// @param leg index of the leg
/// @param pose pose of the platform
/// @returns its position in base axes (m)
Vec3 platform_joint(const Robot& robot, int leg, const Pose& pose);

/// The end of the arm of a leg.
///
/// @param leg the leg
/// @param angle arm angle (rad)
/// @returns its position in base axes (m)
Vec3 elbow(const Leg& leg, double angle);

/// The reason why a pose has no arm angles: "leg 2 is 3.1 mm too short".
///
/// @param angles arm angles that are not done
/// @returns the sentence
Sentence reason(const ArmAngles& angles);

}  // namespace linkwright::parallel
