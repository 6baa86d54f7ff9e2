// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/dyads/family.h"
#include "linkwright/planar/dyads/passage.h"
#include "linkwright/planar/dyads/pose_fit.h"
#include "linkwright/planar/dyads/solve.h"

// Linkages of two dyads that lead a body through poses.
namespace linkwright::planar {

struct PoseProblem {
  std::vector<BodyPose> poses;
  std::array<Prescription, 2> pivots;  ///< prescribed pivots of the two dyads, either of which may drive
  std::vector<GuidingDyadType> types = {GuidingDyadType::rr, GuidingDyadType::pr, GuidingDyadType::rp};
  bool exact = true;                ///< every pose is met; else as near as can be, without prescriptions
  std::vector<PoseDemand> demands;  ///< one for each pose, or none (not exact)
  double angle_length = 0;  ///< m: what a rotation of a radian counts as (not exact); 0 = size of the motion
  int max_designs = 12;
  bool drive_turns = false;  ///< only linkages whose driven dyad can turn round
};
/// Number of conditions that a dyad lacks for a finite number of solutions; up to max_open_numbers are
/// swept.
int freedoms(const PoseProblem& problem, std::size_t dyad);

/// Largest number of poses that may be met exactly beside others; five leave nothing to choose.
inline constexpr int max_exact_demands = 4;

struct PoseDesign {
  GuidingDyad driver, other;
  std::vector<BodyPose> reached;  ///< poses in which the linkage holds the body, next to each given pose
  Passage passage;
  double distance = 0;    ///< m, greatest distance of the body's origin from where it should be
  double rotation = 0;    ///< rad, greatest error of rotation, of poses that have one
  double cost = 0;        ///< see PoseFit; 0 = exact
  double link_ratio = 0;  ///< longest over shortest of links, ground and body, of RR and RR
};

/// Two dyads that hold a body in all of its poses.
struct GuidedPair {
  GuidingDyad first, second;
  std::vector<BodyPose> poses;
};

struct PoseAnswer {
  Status status = Status::done;  ///< deadline and cancelled: of what was looked at by then
  /// Best first: free of defects, then near (not exact), then by pair angle.
  std::vector<PoseDesign> designs;
  /// The finite number that fits both prescriptions, or else those of a sweep.
  std::vector<GuidingDyad> dyads;
  int solutions = 0;       ///< dyads, complex ones included; 0 where they are swept
  int outside = 0;         ///< number of real dyads or pairs that are left out for a pivot outside its region
  bool dependent = false;  ///< poses and prescriptions depend on each other: infinitely many dyads fit
  bool swept = false;
  int pairs = -1;  ///< real pairs of dyads of poses mixed with points, then of so many `solutions`; else -1
  int tried = 0, free = 0;         ///< linkages with a drive, and those without defect
  int swinging = 0;                ///< left out because the driven dyad cannot turn round
  std::array<int, 4> defects{};    ///< numbers of tried ones with each PoseDefect
  std::array<double, 8> misfit{};  ///< misfits of fit_dyads (not exact)
  int starts = 0;                  ///< pairs that were fitted (not exact)
};

/// All linkages of an exact problem, or of its sweeps the best ones that differ; else those next to the
/// poses, which a search finds: from the dyads that fit all poses best, and from those through five at a
/// time, the ones that are met exactly among them and points at random rotations.
///
/// Throws ContractError where `freedoms` are not 0 to 2; for fewer than five poses that are not met exactly;
/// for more than four demands to be exact, or another number of demands than poses.
PoseAnswer find_pose_designs(const PoseProblem& problem, RunContext& context);

/// The linkages of pairs that are known to solve an exact problem, with either dyad driven.
PoseAnswer pose_designs_of(const PoseProblem& problem, std::span<const GuidedPair> pairs,
                           RunContext& context);

}  // namespace linkwright::planar
