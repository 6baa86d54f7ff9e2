// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/run_context.h"
#include "linkwright/planar/dyads/designs.h"

namespace linkwright::planar {

/// The linkage that leads a body through poses and points that determine it: RR and RR, RR and PR, RR and RP.
enum class MixedPoseLinkage { four_bar, slider_crank, inverted_slider_crank };

/// Poses, of which two at least have a rotation, the others are points that the origin of the body passes.
struct MixedPoses {
  std::span<const BodyPose> poses;
  std::span<const PoseDemand> demands;  ///< demands, which say which poses have a rotation
};

/// The linkages with finitely many solutions: four-bars where twice the poses beside the first and the points
/// are 8 together, both kinds of slider-cranks where they are 7; none otherwise, and for five poses without
/// points.
std::span<const MixedPoseLinkage> linkages_of(const MixedPoses& target);

/// Solutions that generic poses and points have, complex ones with them: four-bars 30, 201, 1112 for 4 poses
/// and 2 points, 3 and 4, 2 and 6; slider-cranks 6, 42, 202 and inverted ones 6, 56, 448 for 4 and 1, 3 and
/// 3, 2 and 5. By monodromy, not a theorem; two orders of links are one.
std::size_t mixed_pose_solutions(MixedPoseLinkage linkage, std::size_t poses);

struct MixedPoseSolutions {
  Status status = Status::done;  ///< not_converged: paths were lost; or interrupted
  int whole = 0;                 ///< solutions that generic poses and points have
  int finite = 0, infinite = 0, lost = 0;
  int singular = 0;              ///< ends where solutions meet
  std::vector<GuidedPair> real;  ///< real solutions, with the rotations at the points; a slide second
};

/// All linkages of a kind that lead a body through poses and its origin through points, by
/// following the solutions of a generic complex problem, which are found at the first use and kept. Throws
/// ContractError unless it is among `linkages_of`, poses are finite, and no point is at the place of another
/// or of a pose.
MixedPoseSolutions solve_mixed_poses(const MixedPoses& target, MixedPoseLinkage linkage, RunContext& context);

}  // namespace linkwright::planar
