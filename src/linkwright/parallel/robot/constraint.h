// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "linkwright/parallel/robot/robot.h"

/// The constraint that keeps the platform of a DELTA from turning. Each of its legs has two rods, joined to
/// elbow and platform at +-h along the axis t of the arm. With the arms locked half the difference of the two
/// rod equations is (t x s) . omega = 0: three such rows C, scaled by the rods' lengths, oppose the
/// turning omega.
namespace linkwright::parallel {

/// Constraint index below which a pose counts as singular, always: what a thousandth of clearance or load
/// would do is multiplied by a thousand there.
inline constexpr double constraint_floor = 1e-3;

/// The constraint in a pose of a DELTA.
struct Constraint {
  /// c = t x s / L of each leg; its length is the cosine of the rod's side swing.
  std::array<Vec3, 3> couple{};
  /// Determinant of their matrix C, in [-1, 1]; changes sign where the platform is free to turn.
  double determinant = 0;
  /// det of the unit vectors along the couples: the same sign; NaN where a parallelogram is flat.
  double unit_determinant = 0;
  /// chi: least singular value of C, in [0, 1]. Rods of a pair that differ by d (m) in length, h half the
  /// width of the parallelograms, turn the platform by at most |d| / (2 h chi); a moment M loads the pairs by
  /// at most |M| / (2 h chi).
  double index = 0;
  Vec3 free_axis{};  ///< unit: about it the platform is held least
};
/// Throws ContractError unless the robot is one of Freedom::space_translation.
Constraint constraint(const Robot& robot, const Jacobians& at);

/// In plain words what makes the platform of a DELTA free to turn in a pose near such a place, and about
/// which axis: "the rods of legs 2 and 3 lie level; the platform can turn about y".
std::string free_turn(const Robot& robot, const Jacobians& at);

}  // namespace linkwright::parallel
