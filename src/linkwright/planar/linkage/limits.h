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

}  // namespace linkwright::planar
