// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>

#include "linkwright/parallel/robot/robot.h"

/// @file
/// First and second order motion, and how far a pose is from singular: Jx t = Jq dalpha/dt (Gosselin and
/// Angeles 1990).
namespace linkwright::parallel {

/// A matrix with a row and a column for each leg.
using Matrix6 = std::array<std::array<double, max_legs>, max_legs>;
/// A number for each leg.
using Vector6 = std::array<double, max_legs>;

/// The Jacobians of a pose; the leading legs() x legs() block of each matrix counts. The twist t is (vx, vy,
/// vz) of the platform point for a DELTA, (vx, vy) for planar robots, (vx, vy, vz, wx, wy, wz) in base axes
/// for a HEXA.
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
