// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/math/motion_law.h"
#include "linkwright/optimise/nlopt_bridge.h"
#include "linkwright/optimise/optimiser.h"
#include "linkwright/optimise/problem.h"
#include "linkwright/planar/balancing/four_bar.h"
#include "linkwright/planar/balancing/mass_redistribution.h"
#include "linkwright/planar/serial_arm/serial_arm.h"

// Joint forces of a serial arm made small by the laws of motion of its drives, by counterweights, or by both
// (Boskovic 2018, section 2.2). Counterweights alone are a convex problem, see `balance`; laws are not.
namespace linkwright::planar {

/// The motion of the arm and its cost: sum over the joints of weight times measure of the size of the joint
/// force, over intervals + 1 samples from start to end of the motion.
struct ArmTask {
  SerialArm arm;
  std::vector<math::MotionLaw> laws;  ///< absolute angles, one a link
  double start = 0, duration = 1;     ///< s
  int intervals = 200;
  double gravity = 0;                     ///< m/s2 along -y
  std::vector<double> weights;            ///< one a joint, >= 0, not all 0
  Measure measure = Measure::rss_over_n;  ///< rss_over_n (Eq. (2.37)) or rms
};

/// The variables of a design.
struct ArmDesign {
  /// Degree of the laws: 6 has one free coefficient a link (a_6), d has d - 5 (a_6 ... a_d), and a_3, a_4,
  /// a_5 follow from rest at both ends (Eqs. (2.42)-(2.47)). 5: laws stay as they are, of whatever kind.
  /// Otherwise all must be Polynomial345; their own higher coefficients do not count.
  int degree = 5;
  double largest_coefficient = 100;  ///< largest of |a_3| ... |a_d|, shares of the stroke
  /// Counterweights, with an angle each. Unknowns are the mass, and the radius unless it is given.
  std::vector<Counterweight> counterweights;
};

/// An arm with laws: the task with a design's unknowns put in.
ArmTask designed(const ArmTask& task, const ArmDesign& design, std::span<const double> x);

/// The cost as a population problem, for published methods: unknowns by name ("a6_1", "a7_1", ...,
/// "<counterweight>_mass_kg", "<counterweight>_radius_m") with their bounds; violation: sum of what a_3, a_4,
/// a_5 exceed their bound by, over the bound. Throws ContractError as `require_valid`.
optimise::Problem arm_problem(const ArmTask& task, const ArmDesign& design);

/// Throws ContractError unless there is one law and one weight a link, at least 2 intervals, a duration above
/// 0, a measure that has the form of a root of squares, a degree of 5 to 20, counterweights with angles and
/// ordered bounds, and something to choose.
void require_valid(const ArmTask& task, const ArmDesign& design);

/// A local minimum and how many starts ended there.
struct ArmMinimum {
  double cost = infinity;
  std::vector<double> x;
  int ends = 0;
};
struct ArmSearchReport {
  Status status = Status::done;  ///< done; infeasible: no start met the bounds; deadline, cancelled
  /// Cheapest first; the first is the answer, the others are what a single local search can be trapped in.
  std::vector<ArmMinimum> minima;
  std::int64_t evaluations = 0;
};
struct ArmSearchOptions {
  int starts = 20;
  double same_cost = 1e-6;  ///< relative: ends this close in cost are the same minimum
  optimise::LocalOptions local = {.max_evaluations = 500};
};

/// The recommended search: SLSQP with exact gradients from random starts. Where counterweights are among the
/// unknowns the cost has a kink wherever a joint is unloaded completely, which is where the best designs lie:
/// norms |R| are then smoothed to sqrt(|R|^2 + e^2), e falling in steps to 1e-9 of the norm without
/// counterweights. The law of a link that does not affect any joint force at a minimum is the one of
/// degree 5.
ArmSearchReport search_arm(const ArmTask& task, const ArmDesign& design, const ArmSearchOptions& options,
                           const optimise::Seed& seed, RunContext& context);

/// The cost at x and, when not empty, its gradient: exact, smoothed by `smoothing` (N) as above.
double arm_cost(const ArmTask& task, const ArmDesign& design, std::span<const double> x,
                std::span<double> gradient = {}, double smoothing = 0);

/// The counterweights as a problem of mass balancing with the laws as they are: convex, with proof.
MassBalancing arm_counterweights(const ArmTask& task, const std::vector<Counterweight>& counterweights);

/// Largest values over the samples: what balancing costs the motors.
struct ArmPeaks {
  double force = 0;            ///< N, of the joint
  double absolute_torque = 0;  ///< N m, motors on the ground
  double joint_torque = 0;     ///< N m, motors in the joints
};
std::vector<ArmPeaks> arm_peaks(const ArmTask& task);

}  // namespace linkwright::planar
