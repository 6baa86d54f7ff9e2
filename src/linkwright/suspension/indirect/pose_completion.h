// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"
#include "linkwright/suspension/corner/carrier_poses.h"
#include "linkwright/suspension/corner/suspension.h"

/// Positions of the carrier that leave one of their six parameters open, and a rod that determines it.
namespace linkwright::suspension {

enum class PoseParameter { centre_x, centre_y, centre_z, toe, camber, carrier_pitch };
constexpr std::array<EnumName<PoseParameter>, 6> names(PoseParameter) {
  return {{{PoseParameter::centre_x, "centre_x", "wheel centre along the vehicle"},
           {PoseParameter::centre_y, "centre_y", "wheel centre across the vehicle"},
           {PoseParameter::centre_z, "centre_z", "height of the wheel centre"},
           {PoseParameter::toe, "toe", "toe"},
           {PoseParameter::camber, "camber", "camber"},
           {PoseParameter::carrier_pitch, "carrier_pitch", "turn of the carrier about the wheel's axis"}}};
}
double value_of(const CarrierTarget& pose, PoseParameter parameter);
void set_value(CarrierTarget& pose, PoseParameter parameter, double value);

/// The values of a parameter for which the rod keeps its length: both solutions.
struct RodSolution {
  /// done; no_assembly: the rod is too long or too short whatever the parameter is; singular: the parameter
  /// does not move the end of the rod.
  Status status = Status::done;
  double value = 0;      ///< rad or m: the solution nearer to the value expected
  double other = 0;      ///< the other one
  double shortfall = 0;  ///< m: by what the rod misses, at least
};

/// Solves the constraint of a US or SS link at one position for one parameter (Poznanovic 2016, eq (67) less
/// the length, which is missing there) in closed form: a quadratic for a coordinate of the centre, A cos + B
/// sin = C for an angle. `expected` chooses between the solutions; NaN = the value of the reference pose.
/// Throws ContractError for other links, and when another parameter is missing, too.
RodSolution solve_for(const CarrierTargets& targets, const CarrierTarget& pose, const CornerLink& rod,
                      PoseParameter parameter, double expected = nan);

/// In which order positions that miss a parameter are settled: each after the one that it is nearest to, the
/// reference pose first. Where a rod passes a dead point both solutions meet, and only where the motion comes
/// from distinguishes them.
struct SettlingStep {
  std::size_t position = 0;
  int before = -1;       ///< the position it is nearest to; -1 = the reference pose
  int before_that = -1;  ///< the one that was nearest to that
  double ahead = 0;      ///< steps from the one to the other that lead on to this position
  /// Extrapolates the value here from those at the two positions before.
  double expected(double value_before, double value_before_that) const {
    return value_before + ahead * (value_before - value_before_that);
  }
};
std::vector<SettlingStep> settling_order(const CarrierTargets& targets, PoseParameter parameter);

/// Positions made complete.
struct PoseCompletion {
  Status status = Status::done;  ///< done; no_assembly, singular: what was wrong first
  int position = -1;             ///< the position where it was
  double shortfall = 0;          ///< m: the largest of all
  CarrierTargets targets;        ///< targets; without a solution the parameter is still missing
};

/// Determines a parameter at every position where it is NaN by a rod whose points are adopted
/// (section 5.3.5.1): what is left is a synthesis from complete positions, link by link.
PoseCompletion complete(const CarrierTargets& targets, const CornerLink& rod, PoseParameter parameter);

/// Carrier and one rod as a dyad of a revolute and a spherical joint (section 5.3.5.3, equations 69 to 74).
struct RsDyad {
  Status status = Status::done;  ///< no_assembly: |g| is larger than the root of e^2 + f^2
  double e = 0, f = 0, g = 0;    ///< m2: e cos + f sin + g = 0
  /// rad: turn of the carrier about the wheel's axis after that axis was turned by the smallest rotation, the
  /// smaller one and the other one. This is not the carrier pitch, whose zero is another (the source takes
  /// them for equal); `rotation` knows both.
  double relative = 0, other = 0;
  Mat3 rotation;  ///< rotation of the carrier from the reference, by `relative` (74)
};

/// The dyad at one position, whose carrier pitch is not looked at. With atan2 instead of the arccosine
/// (70) and of the quotient (73), which are inexact or undefined where the axis hardly turns and where g = e.
RsDyad rs_dyad(const CarrierTargets& targets, const CarrierTarget& pose, const CornerLink& rod);

}  // namespace linkwright::suspension
