#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/optimise/problem.h"
#include "linkwright/planar/four_bar.h"

namespace linkwright::planar {

/// How the crank angle is tied to the target points.
enum class Timing {
  free,         ///< each point is met at any crank angle, in the order of the points
  equal_steps,  ///< crank angle of point i = start angle + i step
  given,        ///< crank angle of each point is given
};
constexpr std::array<EnumName<Timing>, 3> names(Timing) {
  return {{{Timing::free, "free", "each point is met at any crank angle, in order"},
           {Timing::equal_steps, "equal_steps", "crank angle of point i = start angle + i step"},
           {Timing::given, "given", "the crank angle of each point is given"}}};
}

/// The designed quantities, in the order of the variables of the ten-unknown problem.
enum FourBarParameter : std::size_t {
  ground, crank, coupler, rocker, coupler_u, coupler_v, pivot_x, pivot_y, frame_angle, start_angle, four_bar_parameter_count
};

/// Rectangle that must hold both fixed pivots (metres).
struct PackagingBox {
  double x_min = 0, x_max = 0, y_min = 0, y_max = 0;
};

/// A four-bar is to trace points with its coupler point.
struct PathProblem {
  std::vector<double> x, y;  ///< target points (m), at least 3; a closed path does not repeat its first point at the end
  bool closed = true;
  Timing timing = Timing::free;
  double step = 0;             ///< rad, equal_steps
  std::vector<double> angles;  ///< rad, given: one a point, relative to the ground link

  /// Bounds (or fixed values) of the ten parameters; start_angle is used by equal_steps only. See derive_bounds.
  std::array<Range, four_bar_parameter_count> bounds{};

  bool search_open = true, search_crossed = true;          ///< branches to search
  bool search_positive = true, search_negative = false;    ///< senses of crank rotation: +1 = the signs of step and angles as given

  bool crank_rotates_fully = true;
  double min_transmission_angle = 0;  ///< rad; 0 = no limit
  std::optional<PackagingBox> packaging;
};

/// Bounds that follow from the path when the study gives none: lengths up to 50 times the size of the path (its
/// bounding-box diagonal), pivots and coupler point as far.
std::array<Range, four_bar_parameter_count> derive_bounds(const std::vector<double>& x, const std::vector<double>& y);

/// A design with what it achieves.
struct PathDesign {
  FourBar linkage;
  double sense = 1;             ///< +1 or -1: sense of crank rotation along the order of the points
  std::vector<double> angles;   ///< crank angle at each target point (rad), unwrapped in the order of the points
  double error = 0;             ///< sum of squared distances (m2), Boskovic 2018 Eq. (4.4)
  std::vector<optimise::Violation> violations;  ///< of the constraints of the problem; empty = feasible
  std::vector<std::string> active_bounds;       ///< keys of parameters at a bound
};

/// Coupler point at each target (m), and its distance to it.
struct PathErrors {
  std::vector<double> x, y, distance;
};
PathErrors path_errors(const PathProblem& problem, const PathDesign& design);

/// The ten-unknown problem (nine when the angles are given; 9 + points when timing is free, then every crank angle is
/// an unknown) on one branch and sense, for population methods; cost = sum of squared distances (m2), evaluated by
/// SIMD kernels. Violations: crank_rotates_fully, no_assembly, transmission_angle, order, packaging.
optimise::Problem path_population_problem(const PathProblem& problem, Branch branch, double sense);
/// Turns a candidate of that problem into a design.
PathDesign path_design(const PathProblem& problem, Branch branch, double sense, std::span<const double> x);

/// Options of the recommended method.
struct PathSynthesisOptions {
  std::uint64_t seed = 1;
  int starts = 0;         ///< local searches per kind and sense; 0 = chosen from the timing
  int max_solutions = 8;  ///< distinct designs to return
};
template <class Visitor>
void fields(Visitor&& visit, PathSynthesisOptions& o) {
  visit(Field{.key = "starts", .summary = "local searches; 0 = chosen from the problem", .minimum = 0, .maximum = 1e6}, o.starts);
  visit(Field{.key = "max_solutions", .summary = "distinct designs to return", .minimum = 1, .maximum = 100}, o.max_solutions);
}

/// Answer of one seed.
struct PathSynthesis {
  Status status = Status::done;      ///< done, infeasible, deadline or cancelled
  std::vector<PathDesign> designs;   ///< distinct, best first; feasible ones before infeasible ones
  std::int64_t evaluations = 0;
  std::vector<double> history;       ///< best error after each local search
};

/// The recommended method. Prescribed and relative timing: the linear unknowns (scale, rotation, position, tracing
/// point) are eliminated (variable projection), full crank rotation holds by construction, and Levenberg-Marquardt
/// with the exact Jacobian runs from many starts. Free timing: starts by matching random curves to the path by arc length, then
/// Levenberg-Marquardt in all unknowns. Where a bound or limit is active, an augmented Lagrangian finishes.
PathSynthesis synthesise_path(const PathProblem& problem, const PathSynthesisOptions& options, RunContext& context);

}  // namespace linkwright::planar
