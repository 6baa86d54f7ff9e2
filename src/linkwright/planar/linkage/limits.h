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
  double value = 0;  ///< value of the input (rad or m)
  EndKind kind = EndKind::bound;
  std::vector<int> groups;  ///< groups that reach their limit or change point there; rising
};

/// A stretch of the input in which the linkage assembles in one combination of modes. At its ends it meets
/// the ranges of the other modes of the groups named there.
struct InputRange {
  RangeEnd from, to;
  bool full_turn = false;     ///< closes on itself: the input turns fully
  std::vector<double> modes;  ///< signs, one a group; +1 of groups without modes
  int circuit = 0;            ///< from 1
};

/// The ranges in which a linkage assembles while one input moves and the others stay.
struct InputLimits {
  int input = 0;
  bool rotary = true;
  double from = 0, to = 0;         ///< range that was asked for
  bool closed = false;             ///< from and to are one full turn of a periodic input
  std::vector<InputRange> ranges;  ///< by modes (plus first), then by input; over all modes
  /// Connected sets of configurations: positions of one circuit can be reached from each other without taking
  /// the linkage apart, those of different circuits cannot (while the input stays in what was asked for).
  int circuits = 0;
};

/// Ranges of all combinations of assembly modes, and circuits. `inputs` are the values of all inputs, the
/// one of `input` does not matter. When [from, to] is one full turn of an input that is periodic, ranges that
/// run across its ends are joined, and `to` of such a range lies beyond the turn.
///
/// Throws ContractError when the plan is not in closed form (see LinkageAssembly::limits) or has more than
/// 4096 ranges.
InputLimits input_limits(const LinkagePlan& plan, std::span<const double> inputs, int input, double from,
                         double to);

/// The range in which an input value lies with these modes (whole turns do not matter when the limits are
/// closed); nullptr when it does not assemble there.
const InputRange* range_at(const InputLimits& limits, std::span<const double> modes, double value);

/// The part of the input range that assembles with the given modes (rad or m), a full turn at most.
double assembly_range(const InputLimits& limits, std::span<const double> modes);

/// For messages: "assembles from 12.3 to 147.9 deg", "assembles over the full turn", "assembles from 0 to 10
/// mm and from 30 to 40 mm", "assembles nowhere from 0.0 to 90.0 deg", for the given modes.
Sentence assembly_range_text(const InputLimits& limits, std::span<const double> modes);

/// For messages: "at 103.2 deg short by 3.1 mm ('coupler + rocker')", of a motion that failed at this value;
/// for a motion that is done, or of which no gap is known, what its status means.
Sentence assembly_gap_text(const LinkagePlan& plan, const LinkageMotion& motion, int input, double value);

/// The modes in words: "coupler + rocker plus, link + ram minus"; "only one mode" when no group has modes.
std::string mode_text(const LinkagePlan& plan, std::span<const double> modes);

}  // namespace linkwright::planar
