// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "linkwright/planar/linkage/limits.h"

namespace linkwright::planar {

/// Part of an input's range in which a group can be assembled.
struct Stretch {
  double from = 0, to = 0;
  EndKind from_kind = EndKind::bound, to_kind = EndKind::bound;
};

/// Finds where one group can be assembled while one input moves and the others stay. Make one a plan in
/// closed form and use it for many groups and stretches.
class GroupScan {
 public:
  /// Throws ContractError when the plan is not in closed form, or inputs do not fit.
  GroupScan(const LinkagePlan& plan, std::span<const double> inputs, int input);

  /// Stretches of [from, to], rising, in which `group` can be assembled while the groups before it are in
  /// the given modes (signs, one a group; those from `group` on are not used). The groups before must
  /// assemble on all of (from, to). Limits are simple zeros of the group's radicand, change points double
  /// ones; both are located to rounding: double zeros as zeros of the radicand's derivative. A double zero
  /// counts when the group's pins come within 1e-11 of their distance there. Two limits that are closer than
  /// half a percent of the stretch may be missed, with what lies between them.
  std::vector<Stretch> stretches(std::size_t group, std::span<const double> modes, double from, double to);

 private:
  struct Closure {
    double value;      // >= 0: assembles; NaN where a group before fails
    double slope;      // derivative by the input
    double closeness;  // to a zero, as a share of lengths
  };
  // Closure of a group that assembles wherever those before it do.
  static constexpr Closure no_limit{1, 0, 1};
  Closure closure(std::size_t group, double input);
  bool touches_at_end(std::size_t group, double end, double inward);

  std::vector<LinkagePlan> levels_;  // the plan up to each group
  std::vector<LinkageMotion> motions_;
  std::vector<InputMotion> inputs_;
  std::size_t input_;
};

/// True if a full turn of the input brings the same position: it turns, and gears turn by whole turns with
/// it.
bool periodic(const LinkagePlan& plan, int input);

}  // namespace linkwright::planar
