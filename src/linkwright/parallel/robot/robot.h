// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/sentence.h"
#include "linkwright/core/status.h"
#include "linkwright/math/vector3.h"

/// @file
/// Parallel robots of legs that are an arm, turned by a drive at the base, and a rod of constant length to
/// the platform: DELTA, HEXA, planar five-bars (5R) and the planar platform of constant orientation. Base
/// axes: z up; planar robots lie in the x-y plane. m, rad.
namespace linkwright::parallel {

using math::Mat3;
using math::Vec3;

/// The coordinates of a point in words: "0.1, 0.2, -0.75 m".
///
/// @param place the point (m)
/// @returns the text
Sentence coordinates_of(const Vec3& place);

/// The freedom of the platform, which fixes the number of legs.
enum class Freedom {
  space_translation,  ///< three displacements: a DELTA, 3 legs
  space,              ///< all six freedoms: a HEXA, 6 legs
  plane_translation   ///< two displacements in the x-y plane, 2 legs
};

/// Leg i: the arm is at A + l u(alpha) with u = cos(alpha) e + sin(alpha) w, the rod continues from its end
/// to the platform joint g = p + R b. Its angle alpha is positive about e x w.
struct Leg {
  Vec3 base;            ///< A: pivot of the arm (m)
  Vec3 ahead{1, 0, 0};  ///< e: unit direction of the arm at angle 0
  Vec3 aside{0, 1, 0};  ///< w: unit direction of the arm at 90 deg, across e
  double arm = 0;       ///< l > 0 (m)
  double rod = 0;       ///< L > 0 (m)
  Vec3 platform{};      ///< b: joint at the platform, in axes of the platform (m)
};

/// Largest number of legs.
inline constexpr int max_legs = 6;

/// A robot of 3 (space_translation), 6 (space) or 2 (plane_translation) equal or different legs.
struct Robot {
  Freedom freedom = Freedom::space_translation;  ///< freedom of the platform
  std::array<Leg, max_legs> leg{};               ///< the first legs() count

  /// The number of legs. @returns 2, 3 or 6
  int legs() const { return freedom == Freedom::space ? 6 : freedom == Freedom::space_translation ? 3 : 2; }
};

/// The pose of the platform: its point p (m) and its axes seen from the base. Only robots of Freedom::space
/// turn; for the others the rotation must be the unit matrix.
struct Pose {
  Vec3 position;    ///< platform point p, m
  Mat3 rotation{};  ///< axes of the platform, as columns, in base axes
};

/// A displacement of a platform: by at most so much.
struct Displaced {
  double shift = 0;  ///< displacement of its point (m)
  double turn = 0;   ///< rotation, rad; of robots that turn
};

/// Symmetric DELTA. Legs are at `azimuth` (rad, counter-clockwise from x, seen from above); arm angles are
/// positive downwards, the platform hangs below. Only base_radius - platform_radius matters.
struct DeltaDimensions {
  double base_radius = 0;      ///< m, axis of the robot to the arms' pivots
  double platform_radius = 0;  ///< m, platform point to the rods' joints
  double arm = 0;              ///< m
  double rod = 0;              ///< m
  std::array<double, 3> azimuth{0, 2.0943951023931953, 4.1887902047863905};  ///< directions of the legs, rad
};

/// A symmetric DELTA.
///
/// @param dimensions its dimensions
/// @returns the robot
Robot delta(const DeltaDimensions& dimensions);

/// Symmetric HEXA: pairs of legs at 0, 120 and 240 deg; legs of a pair in the order -, +.
struct HexaDimensions {
  double base_radius = 0;      ///< m, axis of the robot to the middle of a pair's pivots
  double base_offset = 0;      ///< m, half the distance of a pair's pivots
  double platform_radius = 0;  ///< m, platform point to the rods' joints
  double platform_angle = 0;   ///< rad, half the angle between a pair's joints, seen from the platform point
  double arm = 0;              ///< m
  double rod = 0;              ///< m
};

/// A symmetric HEXA.
///
/// @param dimensions its dimensions
/// @returns the robot
Robot hexa(const HexaDimensions& dimensions);

/// A leg of a planar robot: arm angle counter-clockwise from x.
struct PlanarLeg {
  double base_x = 0,  ///< pivot of the arm, m
      base_y = 0;     ///< pivot of the arm, m
  double arm = 0,     ///< length of the arm, m
      rod = 0;        ///< length of the rod, m
  /// Joint seen from the platform point, x (m); both coordinates 0: the rods meet in the platform point (5R).
  double platform_x = 0,
         platform_y = 0;  ///< the same, y (m)
};

/// A five-bar (5R), or with platform joints the two-freedom platform of constant orientation.
///
/// @param first the first leg
/// @param second the second leg
/// @returns the robot
Robot planar(const PlanarLeg& first, const PlanarLeg& second);

/// The reason why a description is not a robot, with the leg (from 1) and the value.
///
/// @param robot the robot
/// @returns the reason; nothing if it is a robot
std::optional<std::string> problem(const Robot& robot);

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
