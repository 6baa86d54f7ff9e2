#pragma once

#include <optional>
#include <vector>

#include "linkwright/planar/four_bar/reactions.h"
#include "linkwright/planar/linkage/smooth_branch.h"

namespace linkwright::planar {

/// The same linkage as bodies ground, crank, coupler and rocker with the joints O1 to O4, the crank driven at
/// O1 (its input is the frame angle plus the crank angle). Without masses it has motion only. `gravity`
/// (m/s2) acts along -y.
Linkage linkage_of(const FourBar& four_bar, const FourBarMasses* masses, double gravity);

/// What is known of a four-bar at one crank angle.
struct FourBarInstant {
  FourBarPosition pose;
  FourBarRates rates;
  FourBarReactions forces;  ///< without masses all NaN, with the status of the rates
  /// Stands where its branches meet and goes on: pose, rates and forces are limits from both sides. Forces
  /// that grow without bound are NaN, and the status of all is singular; so are rates where the motion has a
  /// kink.
  bool change_point = false;
};

/// A four-bar along one of its branches while the crank turns. Where all links lie in line, or the crank pin
/// on the rocker's pivot, the branches meet and cross (parallelograms, kites): what it does there is a
/// choice, `at_change_point`, as of any linkage (see branch_path).
class FourBarBranch {
 public:
  /// `four_bar.branch` is that of the crank angle `from` (rad); where this is a change point, that beyond it.
  /// `to` is the other end of what will be asked. Without masses forces are not computed.
  FourBarBranch(const FourBar& four_bar, std::optional<FourBarMasses> masses, double gravity, double from,
                double to, AtChangePoint at_change_point);

  /// At a crank angle (rad), speed (rad/s) and acceleration (rad/s2). The status of pose and rates is
  /// limit_reached beyond a change point at which the motion stops.
  FourBarInstant at(double angle, double speed, double acceleration) const;

  /// Crank angles at which branches meet along the branch, in (-pi, pi], each once.
  std::vector<double> change_points() const;

 private:
  bool meets_at(double input) const;
  bool limits(const InputMotion& input, FourBarInstant& out) const;

  FourBar four_bar_;
  std::optional<FourBarMasses> masses_;
  double gravity_ = 0;
  AtChangePoint at_change_point_;
  Linkage linkage_;
  LinkagePlan plan_;
  std::vector<double> modes_;       ///< of the linkage on `four_bar_.branch`
  std::optional<BranchPath> path_;  ///< of a linkage whose branches meet
};

}  // namespace linkwright::planar
