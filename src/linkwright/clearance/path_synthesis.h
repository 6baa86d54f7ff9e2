// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/core/field.h"
#include "linkwright/core/run_context.h"
#include "linkwright/optimise/multistart.h"
#include "linkwright/optimise/problem.h"

// Lengths of a four-bar whose tracing point is to meet a path although its crank pin has clearance: the first
// stage of Varedi et al. 2014.
namespace linkwright::clearance {

/// The design variables in the order of the variables, Eq. (16): L1 ... L4, distance and angle of the
/// tracing point in the coupler's frame, crank pivot, direction of the ground link.
enum class ClearanceLength : std::size_t {
  ground,
  crank,
  coupler,
  rocker,
  point_distance,
  pivot_x,
  pivot_y,
  point_angle,
  frame_angle
};
inline constexpr std::size_t clearance_length_count = 9;
constexpr std::size_t index(ClearanceLength l) { return static_cast<std::size_t>(l); }

struct ClearancePathProblem {
  std::vector<double> x, y;  ///< target points, m
  /// rad, absolute, one a point: prescribed, or about where to look for them.
  std::vector<double> crank_angles;
  /// The angles are variables, too, in the order of the points, each within `angle_range` of its own.
  bool free_timing = false;
  double angle_range = 0.2;  ///< rad
  double clearance = 0;      ///< m
  double phase = 0;          ///< rad: the clearance link is taken to be so much ahead of the crank
  planar::Branch branch = planar::Branch::open;
  std::array<Range, clearance_length_count> bounds{};
  bool crank_turns_fully = true;  ///< Grashof's condition with the crank the shortest link, Eqs. (17)-(19)
};

/// Throws ContractError unless points, angles and bounds fit together and are finite.
void require_valid(const ClearancePathProblem& problem);

/// 9, or 9 and one a point with free timing.
std::size_t variables(const ClearancePathProblem& problem);

struct ClearancePathDesign {
  ClearanceFourBar model;  ///< without masses
  std::vector<double> crank_angles;
  double objective = 0;  ///< m: root of the sum of squared distances over the number of points, Eq. (23)
  double rms = 0;        ///< m: root of the mean squared distance; both infinite where it does not assemble
  std::vector<Violation> violations;  ///< empty = feasible
};
/// The design that the variables describe, with its path error.
ClearancePathDesign clearance_path_design(const ClearancePathProblem& problem, std::span<const double> x);
/// The variables of a linkage. The point_angle is in (-pi, pi].
std::vector<double> path_variables(const ClearancePathProblem& problem, const planar::FourBar& linkage);

/// For population methods: cost = objective (m). Constraints: no_assembly, crank_turns_fully, crank_shortest,
/// order (of free angles). As a penalty of 1000 mm for each, as the source has it, minimise with
/// Constraints::penalty and the weight 1 m.
optimise::Problem clearance_path_problem(const ClearancePathProblem& problem);

struct ClearancePathSynthesis {
  Status status = Status::done;  ///< done, infeasible, deadline or cancelled
  std::vector<double> x;
  ClearancePathDesign design;
  int reached = 0;  ///< starts that ended there
  std::int64_t evaluations = 0;
};
/// The recommended method: Levenberg-Marquardt with the exact Jacobian from `starts` places of the bounds;
/// the best feasible end. Deterministic for a seed.
ClearancePathSynthesis synthesise_clearance_path(const ClearancePathProblem& problem, int starts,
                                                 const optimise::Seed& seed, RunContext& context);
/// One such search from x, in place.
math::LeastSquaresReport polish_clearance_path(const ClearancePathProblem& problem, std::span<double> x);

/// Residuals (x, y of each point, m) and Jacobian of the variables, see math::ResidualFunction.
bool clearance_path_residuals(const ClearancePathProblem& problem, std::span<const double> x,
                              std::span<double> residuals, std::span<double> jacobian);

/// Length of the crank with which a linkage with clearance whose link leads by `phase` does exactly what it
/// does without clearance, at crank angles that are less by `shift` (rad): L2 + r e^(i phase) is the crank
/// then. NaN where there is none.
struct EquivalentCrank {
  double length = 0, shift = 0;
};
EquivalentCrank equivalent_crank(double crank, double clearance, double phase);

}  // namespace linkwright::clearance
