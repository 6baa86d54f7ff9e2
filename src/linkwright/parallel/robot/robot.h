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

/// A matrix with a row and a column for each leg.
using Matrix6 = std::array<std::array<double, max_legs>, max_legs>;
/// A number for each leg.
using Vector6 = std::array<double, max_legs>;

/// The Jacobians of a pose, Jx t = Jq dalpha/dt (Gosselin and Angeles 1990); the leading legs() x legs()
/// block of each matrix counts. The twist t is (vx, vy, vz) of the platform point for a DELTA, (vx, vy) for
/// planar robots, (vx, vy, vz, wx, wy, wz) in base axes for a HEXA.
struct Jacobians {
  std::array<Vec3, max_legs> rod{};     ///< s: arm's end to platform joint (m)
  std::array<Vec3, max_legs> arm{};     ///< u: unit direction of the arm
  std::array<Vec3, max_legs> normal{};  ///< u' = du/dalpha
  std::array<Vec3, max_legs> lever{};   ///< R b: platform point to platform joint, base axes (m)
  Matrix6 platform{};                   ///< Jx, a row a leg: s, or its part in the plane, or s with (R b) x s
  Vector6 drive{};                      ///< diagonal of Jq: l s . u' (m2)
};

/// The Jacobians of a pose. Allocates nothing.
///
/// @param robot the robot
/// @param pose pose of the platform
/// @param angles arm angles that fit the pose (rad), one a leg
/// @returns the Jacobians, and the vectors that they consist of
/// @throws ContractError if there are fewer angles than legs
Jacobians jacobians(const Robot& robot, const Pose& pose, std::span<const double> angles);

/// The Jacobian J = Jx^-1 Jq: twist by arm speeds.
///
/// @param robot the robot
/// @param at Jacobians of the pose
/// @returns the matrix; not finite in a singular pose of type 2
Matrix6 jacobian(const Robot& robot, const Jacobians& at);

/// The solution x of matrix x = right for the leading legs() x legs() block.
///
/// @param robot the robot
/// @param matrix the matrix
/// @param right the right side
/// @returns x; not finite if the block is singular
Vector6 solve(const Robot& robot, const Matrix6& matrix, const Vector6& right);

/// The transpose of the leading legs() x legs() block.
///
/// @param robot the robot
/// @param matrix the matrix
/// @returns the transpose
Matrix6 transposed(const Robot& robot, const Matrix6& matrix);

/// The determinant of Jx: its sign gives the assembly.
///
/// @param robot the robot
/// @param at Jacobians of the pose
/// @returns det Jx; 0 in a singularity of type 2
double determinant(const Robot& robot, const Jacobians& at);

/// The determinant of the leading legs() x legs() block.
///
/// @param robot the robot
/// @param matrix the matrix
/// @returns the determinant
double determinant(const Robot& robot, const Matrix6& matrix);

/// Velocity or acceleration of the platform: of its point, and of its turning, in base axes.
struct Twist {
  Vec3 linear{};   ///< m/s or m/s2
  Vec3 angular{};  ///< rad/s or rad/s2
};

/// The components of a twist or a wrench that count for this robot, in the order of the columns of Jx; the
/// rest is 0.
///
/// @param robot the robot
/// @param linear velocity, acceleration or force (base axes)
/// @param angular angular velocity, angular acceleration or moment (base axes)
/// @returns the components, legs() of them
Vector6 components(const Robot& robot, const Vec3& linear, const Vec3& angular);

/// The twist that has given components; the inverse of `components`.
///
/// @param robot the robot
/// @param components in the order of the columns of Jx
/// @returns the twist
Twist twist(const Robot& robot, const Vector6& components);

/// The arm speeds for a velocity of the platform.
///
/// @param robot the robot
/// @param at Jacobians of the pose
/// @param velocity velocity of the platform
/// @returns rad/s, one a leg; not finite where arm and rod are aligned (type 1)
Vector6 arm_speeds(const Robot& robot, const Jacobians& at, const Twist& velocity);

/// The arm accelerations for a velocity and an acceleration of the platform.
///
/// @param robot the robot
/// @param at Jacobians of the pose
/// @param velocity velocity of the platform
/// @param acceleration acceleration of the platform
/// @returns rad/s2, one a leg; not finite where arm and rod are aligned (type 1)
Vector6 arm_accelerations(const Robot& robot, const Jacobians& at, const Twist& velocity,
                          const Twist& acceleration);

/// The velocity of the platform for arm speeds.
///
/// @param robot the robot
/// @param at Jacobians of the pose
/// @param arm_speeds rad/s, one a leg
/// @returns the velocity; not finite in a singularity of type 2
Twist platform_velocity(const Robot& robot, const Jacobians& at, std::span<const double> arm_speeds);

/// Indices of a pose. Without dimension but for `singular_value` and `manipulability`.
struct Quality {
  /// s . u'/L of each leg: 0 in a singularity of type 1; its magnitude is the input transmission index.
  Vector6 input{};
  /// Cosine between a rod and the velocity that its leg alone gives to its platform joint: output
  /// transmission index, 0 in a singularity of type 2.
  Vector6 output{};
  double transmission = 0;  ///< least of all input and output indices
  /// det of the rods' unit vectors (for a HEXA of the rows [s/L, (R b) x s/(L c)], c the characteristic
  /// length): 0 in a singularity of type 2.
  double rods = 0;
  /// det of the unit vectors along t x s, t the arms' axes: 0 where a platform held by parallelograms may
  /// turn. NaN for robots that turn; for planar robots it is 1.
  double constraint = 0;
  /// Least singular value of the rows t x s/L, in [0, 1], see constraint.h; NaN and 1 as above.
  double constraint_index = 0;
  /// Singular values of J, descending (m; a HEXA's rows of turning are multiplied by c).
  Vector6 singular_value{};
  double condition = 0;       ///< largest over least singular value, infinite in a singularity
  double manipulability = 0;  ///< product of the singular values
};

/// The indices of a pose.
///
/// @param robot the robot
/// @param at Jacobians of the pose
/// @param characteristic_length length (m) that makes the rows of turning of a HEXA comparable with the
///   others; it matters for no other robot
/// @returns the indices
Quality quality(const Robot& robot, const Jacobians& at, double characteristic_length);

/// The length to compare turning with: mean distance of the platform joints from the platform point.
///
/// @param robot the robot
/// @returns the length (m); 1 if all joints are at the platform point
double platform_size(const Robot& robot);

/// The kind of singularity of a pose.
enum class Singularity {
  none,       ///< regular
  type1,      ///< arm and rod of a leg are aligned
  type2,      ///< the rods do not hold the platform
  type3,      ///< types 1 and 2 together
  constraint  ///< the parallelograms do not keep the platform from turning
};
constexpr std::array<EnumName<Singularity>, 5> names(Singularity) {
  return {
      {{Singularity::none, "none", "regular"},
       {Singularity::type1, "type_1",
        "arm and rod of a leg are aligned: working modes meet, the platform "
        "cannot be moved along that rod"},
       {Singularity::type2, "type_2", "the rods do not hold the platform: assembly modes meet"},
       {Singularity::type3, "type_3", "types 1 and 2 together"},
       {Singularity::constraint, "constraint", "the parallelograms do not keep the platform from turning"}}};
}

/// The kind of singularity whose measure of `quality` is at most `limit` in magnitude; for the parallelograms
/// a constraint index of at most constraint_floor (constraint.h).
///
/// @param robot the robot
/// @param quality indices of the pose
/// @param limit magnitude up to which a measure counts as zero
/// @returns the kind, or none
Singularity singularity(const Robot& robot, const Quality& quality, double limit = 1e-6);

}  // namespace linkwright::parallel
