// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/sentence.h"
#include "linkwright/core/status.h"
#include "linkwright/parallel/robot/robot.h"

/// Arm angles from the platform's pose and back.
namespace linkwright::parallel {

/// Sign of s . u' of each leg, 1 or -1: on which side of the straight leg the elbow is. 2^legs working modes;
/// legs beyond legs() do not count.
using WorkingMode = std::array<int, max_legs>;
inline constexpr WorkingMode all_positive{1, 1, 1, 1, 1, 1};

/// All working modes of a robot, the first leg changing fastest; all_positive first.
std::vector<WorkingMode> working_modes(const Robot& robot);

struct ArmAngles {
  Status status = Status::done;  ///< no_assembly: a leg cannot reach; singular: the arm's place is open
  std::array<double, max_legs> angle{};  ///< rad, in (-pi, pi]; NaN for legs that cannot reach
  int leg = -1;                          ///< first leg with the trouble, from 0; -1 = none
  /// The amount that the leg lacks (m): positive = the joint is too far by so much, negative = too near.
  double shortfall = 0;
};

/// Inverse position: |g - A - l u(alpha)| = L for each leg, solved in closed form. A leg that is straight
/// up to rounding is taken as straight. Allocates nothing.
ArmAngles inverse(const Robot& robot, const Pose& pose, const WorkingMode& mode = all_positive);

/// Working mode of a robot in a place that fits: sign of s . u' of each leg (0 = arm and rod aligned).
WorkingMode working_mode(const Robot& robot, const Pose& pose, std::span<const double> angles);

struct Placed {
  /// no_assembly, singular (centres coincide or lie on a line), not_converged; branch_lost: a pose of another
  /// assembly than that of the start, beyond a singularity
  Status status = Status::done;
  Pose pose;
  double residual = 0;  ///< largest error of a rod's length (m)
  int iterations = 0;   ///< iterations of Newton's method; 0 = closed form
};

/// Direct position of robots that do not turn, in closed form: intersection of spheres or circles about the
/// arms' ends. `assembly`, 1 or -1, is the sign of det Jx, see jacobians.h; it depends on the order of the
/// legs: a DELTA numbered counter-clockwise seen from above whose platform hangs below has -1, a planar
/// robot has its platform on the left of the line from the first to the second elbow with 1. At the very
/// boundary, where both assemblies meet, rounding is forgiven. Allocates nothing.
///
/// Throws ContractError for a robot of Freedom::space, for which see direct_near and assembly_modes.h.
Placed direct(const Robot& robot, std::span<const double> angles, int assembly);

/// Direct position of any robot from a pose nearby, by Newton's method with the exact Jacobian Jx and halved
/// steps. A pose that does not fit is not_converged, one whose det Jx has another sign than at the start
/// branch_lost: Newton's method has leapt across a singularity.
/// Allocates nothing.
Placed direct_near(const Robot& robot, std::span<const double> angles, const Pose& start);

/// Platform joint of a leg (m).
Vec3 platform_joint(const Robot& robot, int leg, const Pose& pose);
/// End of the arm (m).
Vec3 elbow(const Leg& leg, double angle);

/// "leg 2 is 3.1 mm too short": why a pose has no arm angles.
Sentence reason(const ArmAngles& angles);

}  // namespace linkwright::parallel
