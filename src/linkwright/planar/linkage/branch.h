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
  double from = 0, to = 0;    ///< values of the input
  std::vector<double> modes;  ///< signs, one a group
};

/// A branch that starts at given modes and follows one input in both directions, as far as it goes.
struct BranchPath {
  Status status = Status::done;  ///< no_assembly: not at the start; then there are no pieces
  double start = 0;
  /// > 0: the branch repeats itself after this change of the input, a whole number of turns, without end; the
  /// pieces are one period from the start on. 0: it runs from `low` to `high`.
  double period = 0;
  RangeEnd low, high;
  std::vector<BranchPiece> pieces;      ///< rising
  std::vector<RangeEnd> change_points;  ///< between pieces, rising; of a period that of its start at its end
};

/// Follows the branch of the modes (signs, one a group) from the value that `inputs` has for `input`, within
/// [from, to] (which hold it) or, when the input is periodic and nothing stops it, without end. At a start
/// that is a change point itself the modes are those of the forward side. The linkage must be in closed form
/// (ContractError).
///
/// Through a double zero f = (x - x0)^2 g of its radicand, the root of a group is smooth as (x - x0) sqrt(g):
/// the sign of the mode flips.
BranchPath branch_path(const LinkagePlan& plan, std::span<const double> inputs, int input,
                       std::span<const double> modes, double from, double to,
                       AtChangePoint policy = AtChangePoint::smooth);

/// The modes of the branch at a value of the input; any number of turns when it is periodic. limit_reached
/// beyond its ends, where the modes stay as they are.
Status modes_at(const BranchPath& path, double value, std::span<double> modes);

/// Position where a joint is at rest while the input continues: the joint reverses (a dead centre of a
/// slider, the toggle of a rocker), or pauses.
struct DeadCentre {
  double input = 0;         ///< rad or m
  double coordinate = 0;    ///< coordinate of the joint (see joint_motion), rad or m
  double acceleration = 0;  ///< acceleration of the joint at unit rate of the input
};
/// Along a branch, the inputs others than the path's own at rest; one period, or all of the path. Dead
/// centres of an output are dead points of the mechanism when that joint is driven. Located to rounding as
/// zeros of the joint's rate. Two zeros closer than half a percent of a piece may be missed.
std::vector<DeadCentre> dead_centres(const Linkage& linkage, const LinkagePlan& plan,
                                     std::span<const double> inputs, int input, const BranchPath& path,
                                     int joint);

}  // namespace linkwright::planar
