// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/planar/dyads/dyad.h"

// Checks that a body on two dyads, one of them driven, passes its poses in one motion.
namespace linkwright::planar {

/// The reason why a linkage does not pass them so.
enum class PoseDefect { none, branch, circuit, order };
constexpr std::array<EnumName<PoseDefect>, 4> names(PoseDefect) {
  return {{{PoseDefect::none, "none", "passes the poses in one motion"},
           {PoseDefect::branch, "branch", "the poses are on both sides of a dead point"},
           {PoseDefect::circuit, "circuit", "between two poses the drive would leave where it assembles"},
           {PoseDefect::order, "order", "the poses are met in another order"}}};
}

/// The passage of a linkage of two dyads through poses. The drive turns an RR dyad about its fixed pivot, or
/// moves a PR or RP dyad along its slide; its coordinate is the direction from the fixed to the moving pivot
/// (rad), or the place on the slide (m): of the pivot along i n from the foot of the ground's or body's
/// origin on the line.
struct Passage {
  PoseDefect defect = PoseDefect::none;
  int from = 0, to = 0;       ///< branch, circuit: numbers of the poses, from 0, between which it is
  std::vector<double> drive;  ///< coordinate of the drive at each pose; steady over the poses without defect
  /// Least angle between the bodies of the other pair (rad, [0, pi/2]) from the first to the last pose; at
  /// the poses alone when there is a defect. It is the transmission angle of a four-bar, and what the
  /// pressure angle of a slide lacks of a right angle.
  double pair_angle = 0;
  bool drive_turns = false;  ///< the driven dyad can turn round
  double side = 0;           ///< +1, -1: assembly branch at the first pose
};

/// The passage through poses that both dyads hold, two at least. Throws ContractError for fewer.
Passage passage(std::span<const BodyPose> poses, const GuidingDyad& driver, const GuidingDyad& other);

}  // namespace linkwright::planar
