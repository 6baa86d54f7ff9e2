// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// Rounding of the closed forms grows with the square of one over the distance from a change point, and along
/// chains of groups. What is smooth on a branch (accelerations, inertia, velocities) is therefore
/// interpolated there, from nodes on both sides: off by about 5e-14 (width / 0.05)^8 of the eighth
/// derivative.
struct ChangeZone {
  static constexpr double width = 0.08;  ///< half of it, rad or sizes of the linkage
  static constexpr std::array<double, 8> nodes{-2.5, -2, -1.5, -1, 1, 1.5, 2, 2.5};  ///< in half widths
  using Weights = std::array<double, nodes.size()>;
  /// Weights of the nodes' values for the value at x, in half widths from the change point (Lagrange).
  static Weights interpolation(double x);
};

/// The smooth branch that the only input of a linkage moves it on, with its change points.
class SmoothBranch {
 public:
  /// The branch of `modes` at `value`; followed without end when it repeats itself, else over two turns (or
  /// four sizes) in both directions. As branch_path for what cannot be; see path().status.
  SmoothBranch(const LinkagePlan& plan, double value, std::span<const double> modes);

  const BranchPath& path() const { return path_; }
  bool has_change_points() const { return !path_.change_points.empty(); }
  /// Half width of the zones about change points, rad or m: less than ChangeZone::width where the nodes would
  /// come near to another change point or an end.
  double half_width() const { return half_width_; }
  /// Puts the modes at a value into the motion.
  void set_modes(double value, LinkageMotion& motion) const { modes_at(path_, value, motion.modes); }

  struct Near {
    double value = infinity;
    const RangeEnd* end = nullptr;  ///< null: there is none
  };
  /// The change point nearest to a value, whole turns included.
  Near nearest(double value) const;
  /// The next one beyond a value, upwards (sense 1) or downwards (-1).
  Near next(double value, double sense) const;

 private:
  template <class Distance>
  Near best(double value, Distance&& distance) const;

  BranchPath path_;
  double half_width_ = 0;
};

/// Motion and forces at a change point of a linkage with one input in closed form: the limits from both sides
/// of the branch that continues smoothly through it. `path` is a branch with a change point at `value`,
/// `input` the motion of the input there. Places and rates go into `motion`; where `linkage` is given (forces
/// are wanted), forces go into `forces`, with NaN for those that grow without bound, and then the status
/// singular. False, and the motion is unusable, when there is no such limit.
bool limit_at_change(const LinkagePlan& plan, const BranchPath& path, double value, const InputMotion& input,
                     LinkageMotion& motion, const Linkage* linkage, LinkageForces& forces);

}  // namespace linkwright::planar
