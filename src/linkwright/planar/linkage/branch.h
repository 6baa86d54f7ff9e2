// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "linkwright/planar/linkage/limits.h"

namespace linkwright::planar {

/// The behaviour of a linkage at a change point, where its assembly modes meet (a parallelogram when all
/// links lie in line).
enum class AtChangePoint {
  smooth,    ///< continues without a kink: the modes of the groups that meet there change sign
  stop,      ///< the motion ends there: the branch is a choice that has not been made
  keep_sign  ///< the modes keep their signs: the other branch, with a kink in the velocities
};
constexpr std::array<EnumName<AtChangePoint>, 3> names(AtChangePoint) {
  return {{{AtChangePoint::smooth, "smooth", "continues smoothly: the assembly mode changes sign"},
           {AtChangePoint::stop, "stop", "ends the motion"},
           {AtChangePoint::keep_sign, "keep_sign", "keeps the sign of the mode: with a kink"}}};
}

/// Piece of a branch on which the modes stay.
struct BranchPiece {
  double from = 0,            ///< value of the input at its lower end (rad or m)
      to = 0;                 ///< value at its upper end
  std::vector<double> modes;  ///< signs, one a group
};

/// A branch that starts at given modes and follows one input in both directions, as far as it goes.
struct BranchPath {
  Status status = Status::done;  ///< no_assembly: not at the start; then there are no pieces
  double start = 0;              ///< value of the input at the start (rad or m)
  /// > 0: the branch repeats itself after this change of the input, a whole number of turns, without end; the
  /// pieces are one period from the start on. 0: it runs from `low` to `high`.
  double period = 0;
  RangeEnd low,                         ///< lower end
      high;                             ///< upper end
  std::vector<BranchPiece> pieces;      ///< rising
  std::vector<RangeEnd> change_points;  ///< between pieces, rising; of a period that of its start at its end
};

/// Follows the branch of the modes (signs, one a group) from the value that `inputs` has for `input`, within
/// [from, to] (which hold it) or, when the input is periodic and nothing stops it, without end. At a start
/// that is a change point itself the modes are those of the forward side. The linkage must be in closed form.
///
/// Through a double zero f = (x - x0)^2 g of its radicand, the root of a group is smooth as (x - x0) sqrt(g):
/// the sign of the mode flips.
///
/// @param plan the plan of the linkage
/// @param inputs values of all inputs (rad or m)
/// @param input index of the input that moves
/// @param modes signs of the assembly modes at the start, one a group
/// @param from lower bound of the input (rad or m)
/// @param to upper bound of the input (rad or m)
/// @param policy the behaviour at change points
/// @returns the branch
/// @throws ContractError if the plan is not in closed form, numbers of inputs or modes do not fit, or the
///   start does not lie in [from, to]
BranchPath branch_path(const LinkagePlan& plan, std::span<const double> inputs, int input,
                       std::span<const double> modes, double from, double to,
                       AtChangePoint policy = AtChangePoint::smooth);

/// The modes of the branch at a value of the input; any number of turns when it is periodic.
///
/// @param path the branch; it must have pieces
/// @param value value of the input (rad or m)
/// @param modes receives the signs, one a group; beyond the ends of the branch those at the end
/// @returns done, or limit_reached beyond the ends
/// @throws ContractError if the branch has no pieces, or `modes` has not one number a group
Status modes_at(const BranchPath& path, double value, std::span<double> modes);

/// Position where a joint is at rest while the input continues: the joint reverses (a dead centre of a
/// slider, the toggle of a rocker), or pauses.
struct DeadCentre {
  double input = 0;         ///< rad or m
  double coordinate = 0;    ///< coordinate of the joint (see joint_motion), rad or m
  double acceleration = 0;  ///< acceleration of the joint at unit rate of the input
};

/// The dead centres of a joint along a branch, the other inputs at rest; over one period, or all of the path.
/// Dead centres of an output are dead points of the mechanism when that joint is driven. Located to rounding
/// as zeros of the joint's rate. Two zeros closer than half a percent of a piece may be missed.
///
/// @param linkage the linkage
/// @param plan its plan
/// @param inputs values of all inputs (rad or m); that of `input` is ignored
/// @param input index of the input that moves
/// @param path the branch
/// @param joint index of the joint whose dead centres are looked for
/// @returns the dead centres by rising input
/// @throws ContractError if the numbers of inputs do not fit, or there is no such joint
std::vector<DeadCentre> dead_centres(const Linkage& linkage, const LinkagePlan& plan,
                                     std::span<const double> inputs, int input, const BranchPath& path,
                                     int joint);

}  // namespace linkwright::planar
