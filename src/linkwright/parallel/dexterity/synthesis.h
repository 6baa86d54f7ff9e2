// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/sentence.h"
#include "linkwright/optimise/minimise.h"
#include "linkwright/parallel/pi_joint/design_synthesis.h"
#include "linkwright/parallel/robot/drives.h"
#include "linkwright/parallel/robot/family.h"
#include "linkwright/parallel/workspace/prescribed_region.h"
#include "linkwright/parallel/workspace/proven_body.h"

/// Dimensions of parallel robots for a prescribed region: as dexterous as possible, or as small as limits
/// allow; alone or together with the Pi-joints that drive their arms.
namespace linkwright::parallel {

enum class DexterityGoal { worst, mean, size };
constexpr std::array<EnumName<DexterityGoal>, 3> names(DexterityGoal) {
  return {{{DexterityGoal::worst, "worst",
            "the minimum local conditioning index of the region as large as possible"},
           {DexterityGoal::mean, "mean", "the mean of it over the region (GCI) as large as possible"},
           {DexterityGoal::size, "size", "arm and rod as short as the limits allow"}}};
}

/// The limits that the robot must keep at every node of the region; at its default a limit asks for nothing
/// but for that of the constraint. The robot always has to reach all nodes, in the assembly that it has in
/// the middle of the region.
struct DexterityLimits {
  double conditioning = 0;  ///< local conditioning index at least, in [0, 1]
  /// Constraint index of a DELTA at least, in [0, 1]; 0 leaves the sign of det C and the floor
  /// (constraint.h). With 0.2 loads and errors of the parallelograms are at most five times those of the best
  /// pose.
  double constraint = 0.2;
  double input = 0;              ///< input transmission index at least, in [0, 1]
  double output = 0;             ///< output transmission index at least, in [0, 1]
  double transmission = 0;       ///< both of them at least, in [0, 1]
  double arm_travel = infinity;  ///< largest less least arm angle, all legs (rad)
  double side_swing = pi / 2;    ///< largest angle of the rods out of the planes of their arms (rad)
  double size = infinity;        ///< arm + rod at most (m)
};

struct DesignRange {
  double lower = 0, upper = 0;  ///< equal: fixed
};

/// Pi-joints whose arms are the arms of the robot, alike for all legs: outward angle of the arm = mounting +
/// mirror theta.
struct PiTravelTask {
  DesignRange mounting{-pi, pi};  ///< rad
  DesignRange ratio{0.05, 0.95};  ///< k
  int mirror = 1;                 ///< or -1
  /// Over the travel of the arms, which follows from the robot: half_travel does not count.
  PiRequirements limits;
};

struct DexterityTask {
  RobotFamily family = RobotFamily::delta;
  std::vector<DesignRange> dimensions;  ///< one a dimension of the family, SI units
  WorkingMode mode = all_positive;      ///< see elbows_out
  double length = 1;                    ///< makes the turning of a HEXA comparable (m), see jacobians.h
  PrescribedRegion region;
  /// Orientations of the platform in which every node is to be reached; those of robots that do not turn, and
  /// of a symmetric part of a region, are the unit matrix alone.
  std::vector<Mat3> orientations{Mat3{}};
  DexterityGoal goal = DexterityGoal::worst;
  DexterityLimits limits;
  std::optional<PiTravelTask> pi_joint;
};

/// Says what keeps it from being a task, with the value; nothing if it is one.
std::optional<std::string> problem(const DexterityTask& task);

/// Names with units and bounds of the design variables: dimensions of the family, then mounting and ratio of
/// the Pi-joints if there are any.
std::vector<optimise::Variable> design_variables(const DexterityTask& task);

enum class DexterityLimit {
  reach,
  conditioning,
  constraint,
  input,
  output,
  side_swing,
  arm_travel,
  size,
  pi_low_end,
  pi_high_end,
  telescoping,
  stroke,
  pi_transmission,
  pi_rate_least,
  pi_rate_most,
};
constexpr std::array<EnumName<DexterityLimit>, 15> names(DexterityLimit) {
  return {
      {{DexterityLimit::reach, "reach", "square of the input transmission index, below 0 beyond reach"},
       {DexterityLimit::conditioning, "conditioning", "local conditioning index"},
       {DexterityLimit::constraint, "constraint", "constraint index of the parallelograms"},
       {DexterityLimit::input, "input", "input transmission index"},
       {DexterityLimit::output, "output", "output transmission index"},
       {DexterityLimit::side_swing, "side_swing", "swing of a rod out of the plane of its arm (rad)"},
       {DexterityLimit::arm_travel, "arm_travel", "largest less least arm angle (rad)"},
       {DexterityLimit::size, "size", "arm and rod together (m)"},
       {DexterityLimit::pi_low_end, "pi_low_end", "least angle of the Pi-joint (rad)"},
       {DexterityLimit::pi_high_end, "pi_high_end", "largest angle of the Pi-joint (rad)"},
       {DexterityLimit::telescoping, "telescoping", "longest to shortest diagonal"},
       {DexterityLimit::stroke, "stroke", "stroke of the diagonal (m)"},
       {DexterityLimit::pi_transmission, "pi_transmission", "transmission angle of the Pi-joint (rad)"},
       {DexterityLimit::pi_rate_least, "pi_rate_least", "diagonal per angle, for torque and resolution (m)"},
       {DexterityLimit::pi_rate_most, "pi_rate_most", "diagonal per angle, for speed (m)"}}};
}

/// The margin of a design against a limit.
struct DexterityStand {
  DexterityLimit limit = DexterityLimit::reach;
  double value = 0, bound = 0;
  bool at_least = false;  ///< value >= bound is asked for, else value <= bound
  double excess = 0;      ///< more than 0: missed, dimensionless
  bool active = false;    ///< met with nothing to spare
  int leg = -1;           ///< leg that is closest to the limit, from 0; -1 = the limit is not of a leg
  Vec3 place{};           ///< position where it is closest (base axes, m), if it is the limit of a pose
};

enum class BoundState { free, at_lower, at_upper, fixed };
constexpr std::array<EnumName<BoundState>, 4> names(BoundState) {
  return {{{BoundState::free, "free"},
           {BoundState::at_lower, "at_lower"},
           {BoundState::at_upper, "at_upper"},
           {BoundState::fixed, "fixed"}}};
}

/// A design at all nodes of the region.
struct DexterityDesign {
  Status status = Status::infeasible;  ///< done, or infeasible: a limit is missed
  Sentence reason;                     ///< says why it is infeasible: "reach is missed by leg 2 at ..."
  std::vector<double> x;               ///< variables, as design_variables
  std::vector<BoundState> bounds;
  Robot robot;
  Drives drives{};       ///< Pi-joints with the travel that is used, where the task has them
  Vec3 origin{};         ///< origin of the region in base axes (m), see prescribed_region.h
  double objective = 0;  ///< least index, mean index, or size (m): what the goal is about
  double violation = 0;  ///< sum of what limits are missed by
  double size = 0;       ///< arm + rod (m)
  double worst = 0;    ///< least local conditioning index of all nodes, below 0 beyond reach or a singularity
  Vec3 worst_place{};  ///< base axes (m)
  double mean = 0;     ///< mean over the cells (GCI); indices below 0 count as they are
  double arm_lowest = 0, arm_highest = 0;  ///< outward angles used (rad)
  std::vector<DexterityStand> limits;
};
/// True if a goal of size has the limits without which the smallest robot is a singular one: conditioning, or
/// transmission, or both input and output.
bool size_is_limited(const DexterityLimits& limits);

/// Throws ContractError for a task with a problem and another number of values than variables.
DexterityDesign assess(const DexterityTask& task, std::span<const double> x);

/// Proves what holds not at the nodes alone, but all over the region and in every orientation: the legs
/// reach, nothing is singular, the assembly is that of the middle, the constraint index is at most 5e-4 below
/// its limit.
BodyProof prove_region(const DexterityTask& task, const DexterityDesign& design);

struct DexterityOptions {
  int draws = 256;        ///< designs drawn to choose starts from
  int starts = 24;        ///< local searches at most
  int confirmations = 3;  ///< end when so many of them found the best; 0 = make all starts
  double same = 1e-7;     ///< relative: ends whose objective differs by less found the same
  int exchanges = 30;     ///< rounds of adding poses that miss a limit, of a local search
  int evaluations = 300;  ///< largest number of evaluations of the local search in one such round
  /// Look between the nodes, too, where a limit is close, and keep to the limits there.
  bool between_nodes = false;
};

/// The end of one start.
struct DexterityStart {
  double objective = nan;
  double violation = infinity;
  int exchanges = 0;             ///< rounds
  int working = 0;               ///< limits at poses that were looked at in the last one
  bool settled = false;          ///< no node misses what the search kept to
  std::int64_t evaluations = 0;  ///< designs
  std::int64_t poses = 0;        ///< poses measured
  std::vector<double> x;
};

struct DexteritySynthesis {
  /// done; infeasible: no start met every limit; deadline or cancelled, with the best so far.
  Status status = Status::infeasible;
  Sentence reason;
  DexterityDesign best;  ///< without x when the run ended before all nodes had been looked at once
  /// The least or most that a search between the nodes found for the goal's or limits' indices of `best`:
  /// what the nodes overlook. Same order as best.limits; NaN for limits that are not of a pose.
  std::vector<double> between_nodes;
  double worst_between_nodes = nan;    ///< least conditioning index
  std::vector<DexterityStart> starts;  ///< in the order in which they were made
  int reached_best = 0;
  std::int64_t evaluations = 0;  ///< designs
  std::int64_t poses = 0;        ///< poses measured
};

/// The best design by sequential quadratic programming with exact derivatives from the best of random starts.
/// The worst pose is sought in epigraph form (minimise_largest.h), and both it and the limits are kept at a
/// working set of poses, to which the worst nodes are added until no node is worse (constraint exchange).
/// Starts run on RunContext::threads() threads; the same bits for any number. Throws ContractError for a task
/// with a problem and options out of range.
DexteritySynthesis synthesise(const DexterityTask& task, const DexterityOptions& options, std::uint64_t seed,
                              RunContext& context);

/// The same task for population methods: candidates rank by the sum of the limits they miss, then by the
/// objective. All nodes are looked at for every candidate.
/// Throws Interrupted out of an evaluation of many nodes when `context` asks for it.
optimise::Problem population_problem(const DexterityTask& task, const RunContext* context = nullptr);

struct DexterityEvolution {
  DexterityDesign best;  ///< without x when the run ended before one was evaluated
  optimise::Report report;
  std::int64_t poses = 0;  ///< poses measured
};
/// A population method for comparison. Throws as `synthesise` and `minimise` do.
DexterityEvolution evolve(const DexterityTask& task, const optimise::OptimiserOptions& method,
                          const optimise::MinimiseOptions& options, std::uint64_t seed, RunContext& context);

}  // namespace linkwright::parallel
