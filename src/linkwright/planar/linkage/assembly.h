// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "linkwright/planar/linkage/curve.h"
#include "linkwright/planar/linkage/limits.h"

namespace linkwright::planar {

/// The range of the inputs: the least and the largest value of each.
struct InputReach {
  std::vector<double> low, high;
};
InputReach reach_of(std::span<const std::vector<InputMotion>> rows);

/// Places a linkage at any inputs on the assembly mode that its drawing shows, in any order of the inputs
/// with the same result. Closed forms know their modes by their signs; what is said here is of groups
/// without.
///
/// The drawing is where the start poses are, at the inputs that they show. Where they do not show all inputs,
/// it is taken to stand where within the reach of the inputs the start poses fit best; without start poses at
/// the lowest inputs. Poses that do not meet the joints are moved onto them by the least displacement. Where
/// nothing assembles so, the mode is the first that a search within the reach meets (see assembly_modes).
///
/// With one input the mode is followed from there over the whole reach beforehand (ModeCurve). With more,
/// each place is reached from the drawing straight through the space of inputs, or, where that path leaves
/// the mode, by one input after the other.
class LinkageAssembly {
 public:
  /// `modes`: signs of the dyads' modes, one a group; those of the plan when empty. `in_sequence`: the places
  /// are asked in the order in which the linkage goes through them, so that with several inputs each is
  /// reached from the last. The plan must outlive this.
  LinkageAssembly(const LinkagePlan& plan, const InputReach& reach,
                  AtChangePoint policy = AtChangePoint::smooth, bool in_sequence = false,
                  std::span<const double> modes = {});

  /// solve_position on the mode. The status of the motion is no_assembly, at the first group without closed
  /// form, where the mode does not reach these inputs; limit_reached where it ends at a change point.
  void place(std::span<const InputMotion> inputs, LinkageMotion& motion);

  /// The range of the mode of a single input, as a list of one; nothing for closed forms and several inputs,
  /// and where nothing assembles. `modes` of the range are those of the plan, whatever general groups have.
  const std::optional<InputLimits>& limits() const { return limits_; }
  /// The curve of a single input; null where there is none.
  const ModeCurve* curve() const { return curve_ ? &*curve_ : nullptr; }
  /// True if some position was found to start from; true for closed forms.
  bool found() const { return closed_ || found_; }
  /// The inputs there.
  std::span<const double> drawn_inputs() const { return anchor_; }

 private:
  bool assembled(const LinkageMotion& motion) const;
  bool try_at(std::span<const double> inputs, std::span<const double> modes);
  bool try_near(std::span<const double> inputs);
  double misfit(std::span<const double> inputs);
  void find(const InputReach& reach);
  void follow_one(const InputReach& reach, AtChangePoint policy);
  bool go(std::span<const double> from, std::span<const PartState<double>> parts, std::span<const double> to,
          LinkageMotion& motion);
  bool reach_out(std::span<const double> to, LinkageMotion& motion);
  void leave_open(std::span<const InputMotion> inputs, Status status, double gap, LinkageMotion& motion);

  const LinkagePlan& plan_;
  bool closed_ = true, found_ = false, in_sequence_ = false;
  std::size_t first_general_ = 0, last_general_ = 0;
  LinkagePlan before_;  ///< the groups before the first without closed form
  std::vector<double> modes_, anchor_, last_;
  std::vector<PartState<double>> parts_, last_parts_;  ///< at the drawing, at the last place
  std::optional<ModeCurve> curve_;
  std::optional<InputLimits> limits_;
  double gap_ = 0;
};

/// The range of the only input that holds the position of the drawing, or the one nearest to it, followed
/// through change points as `policy` says; within [from, to] (rad or m). The drawing stands where the start
/// poses are, else at input 0, or at the end of [from, to] next to it. A pin that turns fully gives one
/// period from there on, whatever [from, to]. Nothing when the linkage assembles nowhere in [from, to].
/// `modes` of the range are those of the plan. Throws ContractError for several inputs and for from >= to.
std::optional<InputRange> assembled_range(const LinkagePlan& plan, double from, double to,
                                          AtChangePoint policy = AtChangePoint::smooth);

}  // namespace linkwright::planar
