// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/sentence.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// The event at the end of a range of an input.
enum class EndKind {
  bound,         ///< nothing: the stretch that was asked for ends
  limit,         ///< a group reaches its limit: dead point of the input, both modes meet and turn back
  change_point,  ///< both modes meet and continue: which way is a choice
  singular,  ///< two slides become parallel: the group runs away to infinity, or its place is undetermined
};
constexpr std::array<EnumName<EndKind>, 4> names(EndKind) {
  return {{{EndKind::bound, "bound", "end of the interval that was asked for"},
           {EndKind::limit, "limit", "limit of motion"},
           {EndKind::change_point, "change_point", "the assembly modes coincide"},
           {EndKind::singular, "singular", "slides become parallel"}}};
}

/// End of a range of an input.
struct RangeEnd {
  double value = 0;               ///< value of the input (rad or m)
  EndKind kind = EndKind::bound;  ///< event at the end
  std::vector<int> groups;        ///< groups that reach their limit or change point there; rising
};

/// A stretch of the input in which the linkage assembles in one combination of modes. At its ends it meets
/// the ranges of the other modes of the groups named there.
struct InputRange {
  RangeEnd from,              ///< lower end
      to;                     ///< upper end
  bool full_turn = false;     ///< closes on itself: the input turns fully
  std::vector<double> modes;  ///< signs, one a group; +1 of groups without modes
  int circuit = 0;            ///< from 1
};

/// The ranges in which a linkage assembles while one input moves and the others stay.
struct InputLimits {
  int input = 0;                   ///< index of the input that moves
  bool rotary = true;              ///< the input is an angle
  double from = 0,                 ///< lower end of the interval that was asked for (rad or m)
      to = 0;                      ///< its upper end
  bool closed = false;             ///< from and to are one full turn of a periodic input
  std::vector<InputRange> ranges;  ///< by modes (plus first), then by input; over all modes
  /// Connected sets of configurations: positions of one circuit can be reached from each other without taking
  /// the linkage apart, those of different circuits cannot (while the input stays in what was asked for).
  int circuits = 0;
};

/// The ranges of all combinations of assembly modes, and circuits. When [from, to] is one full turn of an
/// input that is periodic, ranges that run across its ends are joined, and `to` of such a range lies beyond
/// the turn.
///
/// @param plan the plan of the linkage
/// @param inputs values of all inputs (rad or m); that of `input` is ignored
/// @param input index of the input that moves
/// @param from lower end of the interval of the input (rad or m)
/// @param to upper end of the interval (rad or m)
/// @returns ranges and circuits
/// @throws ContractError if the plan is not in closed form (see LinkageAssembly::limits) or has more than
///   4096 ranges, the numbers of inputs do not fit, or from < to is not met by finite numbers
InputLimits input_limits(const LinkagePlan& plan, std::span<const double> inputs, int input, double from,
                         double to);

/// The range in which an input value lies with given modes; whole turns do not matter when the limits are
/// closed.
///
/// @param limits the ranges, which own the result
/// @param modes signs, one a group
/// @param value value of the input (rad or m)
/// @returns the range; null if the linkage does not assemble there
const InputRange* range_at(const InputLimits& limits, std::span<const double> modes, double value);

/// The part of the input interval that assembles with given modes.
///
/// @param limits the ranges
/// @param modes signs, one a group
/// @returns sum of the ranges (rad or m), a full turn at most
double assembly_range(const InputLimits& limits, std::span<const double> modes);

/// The part of the input interval that assembles with given modes, for messages: "assembles from 12.3 to
/// 147.9 deg", "assembles over the full turn", "assembles from 0 to 10 mm and from 30 to 40 mm", "assembles
/// nowhere from 0.0 to 90.0 deg".
///
/// @param limits the ranges
/// @param modes signs, one a group
/// @returns the sentence
Sentence assembly_range_text(const InputLimits& limits, std::span<const double> modes);

/// The reason why a motion failed, for messages: "at 103.2 deg short by 3.1 mm ('coupler + rocker')". A
/// motion that is done, or whose gap is not known, is described by its status.
///
/// @param plan the plan of the linkage
/// @param motion the motion that failed
/// @param input index of the input that moves
/// @param value value of the input at which it failed (rad or m)
/// @returns the sentence
/// @throws ContractError if there is no such input
Sentence assembly_gap_text(const LinkagePlan& plan, const LinkageMotion& motion, int input, double value);

/// The modes in words: "coupler + rocker plus, link + ram minus"; "only one mode" when no group has modes.
///
/// @param plan the plan of the linkage
/// @param modes signs, one a group
/// @returns the text
std::string mode_text(const LinkagePlan& plan, std::span<const double> modes);

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
