// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/optimise/problem.h"
#include "linkwright/planar/path/task.h"

/// @file
/// The properties that path synthesis needs of a mechanism, and the functions that follow from them.
namespace linkwright::planar {

/// A mechanism whose tracing point follows a path as its crank turns. `Problem` is a PathTask with bounds of
/// the parameters, of which the last one is the start angle; `Design` is a TracedPath of `Linkage`, whose
/// member `branch` is an enumeration of two. A mechanism is one folder beside this file that satisfies this
/// concept.
template <class M>
concept PathMechanism = requires(const typename M::Problem& problem, typename M::Design& design,
                                 const typename M::Linkage& linkage, typename M::Linkage& changed,
                                 typename M::Branch branch, std::span<const double> x, double angle) {
  requires std::derived_from<typename M::Problem, PathTask>;
  requires std::derived_from<typename M::Design, TracedPath<typename M::Linkage>>;
  { name(typename M::Parameter{}) } -> std::convertible_to<std::string_view>;
  { is_angle(typename M::Parameter{}) } -> std::same_as<bool>;
  { M::words } -> std::convertible_to<MechanismWords>;
  /// The part of a linkage that has its numbers, in a field list. A checkpoint saves the branch, these
  /// numbers and the sense, at the index `kept_sense`.
  {fields([](const Field&, double&) {}, M::form(changed))};
  { M::kept_sense } -> std::convertible_to<std::size_t>;
  /// The linkage of a branch with the parameters x; links of length zero become the shortest ones.
  { M::linkage(branch, x) } -> std::same_as<typename M::Linkage>;
  /// Its parameters; the start angle 0 where it is no variable.
  { M::values(problem, design)[0] } -> std::convertible_to<double>;
  /// True if a parameter has a meaning; an angle has none at a distance of zero.
  { M::matters(typename M::Parameter{}, x) } -> std::same_as<bool>;
  { M::trace(linkage, angle) } -> std::same_as<TracedPoint>;
  { M::turn(linkage) } -> std::same_as<CrankTurn>;
  /// The crank angles around one that are reached without taking it apart, a full turn from there when the
  /// crank rotates fully; nothing where it does not assemble.
  { M::reach(linkage, angle) } -> std::same_as<std::optional<CrankInterval>>;
  { M::searches(problem, branch) } -> std::same_as<bool>;
  /// Adds violations of the limits of the mechanism to a design whose error is known.
  {M::add_limits(problem, design)};
};

/// The mechanism of a problem.
template <class Problem>
using MechanismOf = typename Problem::Mechanism;

/// A branch and a sense of crank rotation to search.
template <class Branch>
struct CrankSearch {
  Branch branch;  ///< branch of the linkage
  double sense;   ///< +1 or -1
};

/// The branches and senses to search for a problem, positive sense first.
///
/// @param problem the problem
/// @returns one entry for each combination that the problem searches
template <class Problem>
auto crank_searches(const Problem& problem) {
  using Branch = typename MechanismOf<Problem>::Branch;
  std::vector<CrankSearch<Branch>> out;
  for (const double sense : {1.0, -1.0})
    for (const auto& branch : names(Branch{}))
      if (problem.searches(sense) && MechanismOf<Problem>::searches(problem, branch.value))
        out.push_back({branch.value, sense});
  return out;
}

/// Adds a violation to a design where it is above tolerance::feasibility, or is not a number.
///
/// @param design the design
/// @param reason name of the constraint
/// @param amount violation, dimensionless
template <class Mechanism>
void add_violation(TracedPath<Mechanism>& design, const char* reason, double amount) {
  if (amount > tolerance::feasibility || std::isnan(amount)) design.violations.push_back({reason, amount});
}

/// Checks the task of a problem and its bounds.
///
/// @param p the problem
/// @throws ContractError unless the task is valid and the bounds are ordered and finite
template <class Problem>
void require_valid_bounds(const Problem& p) {
  using P = typename MechanismOf<Problem>::Parameter;
  require_valid_task(p);
  for (std::size_t j = 0; j < p.bounds.size(); ++j)
    LINKWRIGHT_REQUIRE(std::isfinite(p.bounds[j].lower) && std::isfinite(p.bounds[j].upper) &&
                           p.bounds[j].lower <= p.bounds[j].upper &&
                           (!is_link(P(j)) || p.bounds[j].upper > 0),
                       "bounds of {} are {} to {}", name(P(j)), p.bounds[j].lower, p.bounds[j].upper);
}

/// Measures a linkage at crank angles against a problem: error, constraints by name (no_assembly, those of
/// the mechanism, bounds), active bounds.
///
/// @param problem the problem
/// @param linkage the linkage
/// @param sense sense of crank rotation along the order of the points, +1 or -1
/// @param angles crank angle at each target point (rad), unwrapped
/// @returns the design with its error and violations
/// @throws ContractError unless the problem is valid and there is one angle for each point
template <class Problem>
auto measure_path(const Problem& problem, const typename MechanismOf<Problem>::Linkage& linkage, double sense,
                  std::vector<double> angles) {
  using M = MechanismOf<Problem>;
  using P = typename M::Parameter;
  static_assert(PathMechanism<M>);
  require_valid(problem);
  LINKWRIGHT_REQUIRE(angles.size() == problem.x.size(), "{} angles for {} points", angles.size(),
                     problem.x.size());
  typename M::Design d;
  d.linkage = linkage;
  d.sense = sense;
  d.angles = std::move(angles);

  double gap = 0;
  for (std::size_t k = 0; k < problem.x.size(); ++k) {
    const TracedPoint point = M::trace(linkage, d.angles[k]);
    gap = std::max(gap, point.gap);
    const TargetMiss miss = target_miss(problem, k, point.at.real(), point.at.imag());
    const double square = miss.x * miss.x + miss.y * miss.y;
    d.error += std::isnan(square) ? infinity : square;
  }
  // A design without an error is never feasible, whatever the tolerance of the other constraints.
  const CrankTurn turn = M::turn(linkage);
  if (!std::isfinite(d.error)) d.violations.push_back({"no_assembly", gap > 0 ? gap / turn.size : 1});
  if (problem.crank_rotates_fully) add_violation(d, "crank_rotates_fully", -turn.margin / turn.size);
  M::add_limits(problem, d);

  const auto values = M::values(problem, d);
  double out_of_bounds = 0;
  for (std::size_t j = 0; j < values.size(); ++j) {
    if (j + 1 == values.size() && !starts_anywhere(problem.timing)) continue;
    if (!M::matters(P(j), values)) continue;
    const Range& range = problem.bounds[j];
    double value = is_angle(P(j)) ? math::into_range(values[j], range.lower, range.upper) : values[j];
    // A fixed angle is met from both sides.
    if (is_angle(P(j)) && range.fixed()) value = range.lower + math::wrap_angle(values[j] - range.lower);
    const double width = range.fixed() ? std::max(1.0, std::abs(range.lower)) : range.upper - range.lower;
    out_of_bounds = std::max({out_of_bounds, (range.lower - value) / width, (value - range.upper) / width});
    const double near = tolerance::active_bound * width;
    if (!range.fixed() && !(is_angle(P(j)) && width >= 2 * pi * (1 - 1e-9)) &&
        (value <= range.lower + near || value >= range.upper - near))
      d.active_bounds.emplace_back(name(P(j)));
  }
  add_violation(d, "bounds", out_of_bounds);
  return d;
}

/// Sorts designs, best first, by the feasibility rules.
///
/// @param designs the designs
template <class Design>
void rank_by_error(std::vector<Design>& designs) {
  std::stable_sort(designs.begin(), designs.end(),
                   [](const Design& a, const Design& b) { return better_design(a, b); });
}

/// Adds a design, or replaces the same linkage by it where it is better.
///
/// @param designs the designs so far
/// @param design the design to add
template <class Design>
void keep_distinct(std::vector<Design>& designs, Design design) {
  for (Design& other : designs) {
    if (other.sense != design.sense || !same_linkage(other.linkage, design.linkage)) continue;
    if (better_design(design, other)) other = std::move(design);
    return;
  }
  designs.push_back(std::move(design));
}

/// Removes all designs but the first ones.
///
/// @param designs the designs, best first
/// @param most number of designs that stay
template <class Problem, class Design>
void keep_first(const Problem&, std::vector<Design>& designs, std::size_t most) {
  if (designs.size() > most) designs.resize(most);
}

/// The tracing point of a design at the targets, and its distances from them.
///
/// @param problem the problem
/// @param design the design
/// @returns points and distances, one a target
/// @throws ContractError unless the design has an angle for each target
template <class Problem>
requires PathMechanism<MechanismOf<Problem>> PathErrors
path_errors(const Problem& problem, const typename MechanismOf<Problem>::Design& design) {
  std::vector<std::complex<double>> reached;
  for (const double angle : design.angles)
    reached.push_back(MechanismOf<Problem>::trace(design.linkage, angle).at);
  return path_errors(problem, reached);
}

/// Number of parameters that are variables: the start angle is one unless crank angles are given or free.
///
/// @param problem the problem
/// @returns the number of variables but for crank angles of free timing
template <class Problem>
std::size_t variable_parameters(const Problem& problem) {
  return problem.bounds.size() - (starts_anywhere(problem.timing) ? 0 : 1);
}

/// The parameters as unknowns of a population, and every crank angle where timing is free; the kernels
/// evaluate the objective.
///
/// @param problem the problem
/// @param branch the branch that is searched
/// @param sense the sense of crank rotation, +1 or -1
/// @param objective the objective as laid out for the kernels
/// @returns the problem for a population method
template <class Problem, class Objective>
optimise::Problem population_problem(const Problem& problem, typename MechanismOf<Problem>::Branch branch,
                                     double sense, Objective objective) {
  using P = typename MechanismOf<Problem>::Parameter;
  optimise::Problem out;
  for (std::size_t j = 0; j < variable_parameters(problem); ++j)
    out.variables.push_back({std::string(name(P(j))) + (is_angle(P(j)) ? "_rad" : "_m"),
                             problem.bounds[j].lower, problem.bounds[j].upper});
  if (problem.free_timing())
    for (std::size_t k = 0; k < problem.x.size(); ++k)
      out.variables.push_back({"crank_angle_" + std::to_string(k + 1) + "_rad", 0, 2 * pi});
  out.evaluate = [laid_out = std::make_shared<const Objective>(std::move(objective))](
                     const optimise::PopulationView& candidates, std::span<double> cost,
                     std::span<double> violation) { evaluate(*laid_out, candidates, cost, violation); };
  out.explain = [problem, branch, sense](std::span<const double> x) {
    return design_of(problem, branch, sense, x).violations;
  };
  return out;
}

/// Turns a candidate of the population problem into a design.
///
/// @param problem the problem
/// @param branch the branch that is searched
/// @param sense the sense of crank rotation, +1 or -1
/// @param x the variables of the candidate
/// @returns the design
/// @throws ContractError unless there are as many values as variables
template <class Problem>
auto design_of(const Problem& problem, typename MechanismOf<Problem>::Branch branch, double sense,
               std::span<const double> x) {
  const std::size_t points = problem.x.size(), first = problem.bounds.size() - 1;
  const std::size_t expected = variable_parameters(problem) + (problem.free_timing() ? points : 0);
  LINKWRIGHT_REQUIRE(x.size() == expected, "{} values for {} variables", x.size(), expected);
  std::vector<double> angles(points);
  for (std::size_t k = 0; k < points; ++k) {
    if (!problem.free_timing()) {
      angles[k] = (starts_anywhere(problem.timing) ? x[first] : 0.0) + sense * point_angle(problem, k);
    } else {
      // Unwrapped: each angle is the next one in the sense of rotation.
      const double step = k == 0 ? 0 : sense * (x[first + k] - x[first + k - 1]);
      angles[k] = k == 0 ? x[first] : angles[k - 1] + sense * (step - 2 * pi * std::floor(step / (2 * pi)));
    }
  }
  return measure(problem, MechanismOf<Problem>::linkage(branch, x), sense, std::move(angles));
}

}  // namespace linkwright::planar
