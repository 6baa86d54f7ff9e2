// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/path/mechanism.h"
#include "linkwright/planar/studies/path.h"

// Path synthesis of the four-bar.
namespace linkwright::planar {

/// The assembly branches that are searched.
enum class BranchChoice { any, open, crossed };
constexpr std::array<EnumName<BranchChoice>, 3> names(BranchChoice) {
  return {{{BranchChoice::any, "any", "both branches"},
           {BranchChoice::open, "open",
            "coupler-rocker pin to the left of the line from crank pin to rocker pivot"},
           {BranchChoice::crossed, "crossed", "... to the right"}}};
}

constexpr std::array<ParameterWords, four_bar_parameter_count> words(FourBarParameter) {
  return {{{"length of the ground link O-B0", "ground length"},
           {"length of the crank O-A", "crank length"},
           {"length of the coupler A-B", "coupler length"},
           {"length of the rocker B0-B", "rocker length"},
           {"tracing point along A->B", "tracing point along coupler"},
           {"tracing point along the left normal of A->B", "tracing point across"},
           {"crank pivot O, x", "crank pivot x"},
           {"crank pivot O, y", "crank pivot y"},
           {"direction of O->B0", "frame angle"},
           {"crank angle at the first point, from O->B0 (equal steps)", "start angle"}}};
}

struct FourBarPathParameters : PathParameters<FourBarParameter, four_bar_parameter_count> {
  /// Coordinates of B0, which follow from the other parameters.
  std::optional<Range> rocker_pivot_x, rocker_pivot_y;
};
template <class Visitor>
void fields(Visitor&& visit, FourBarPathParameters& p) {
  fields(visit, static_cast<PathParameters<FourBarParameter, four_bar_parameter_count>&>(p));
  visit(field::length("rocker_pivot_x", "where the rocker pivot B0 may be, x"), p.rocker_pivot_x);
  visit(field::length("rocker_pivot_y", "where the rocker pivot B0 may be, y"), p.rocker_pivot_y);
}

/// The criterion by which points are met.
enum class PathFit { least_squares, exact };
constexpr std::array<EnumName<PathFit>, 2> names(PathFit) {
  return {{{PathFit::least_squares, "least_squares", "as near as the four-bars that a search finds come"},
           {PathFit::exact, "exact",
            "exactly, by all four-bars that pass them: nine points, seven with one fixed pivot as numbers, "
            "five with both, as numbers or ranges to choose from, or three to five with crank angles"}}};
}

/// The point that traces.
enum class TracingPoint { coupler };
constexpr std::array<EnumName<TracingPoint>, 1> names(TracingPoint) {
  return {{{TracingPoint::coupler, "coupler", "point (coupler_u, coupler_v) of the coupler"}}};
}

/// The quantity that is minimised.
enum class PathObjectiveType { sum_squared_distance };
constexpr std::array<EnumName<PathObjectiveType>, 1> names(PathObjectiveType) {
  return {{{PathObjectiveType::sum_squared_distance, "path.sum_squared_distance",
            "sum over the points of the squared distance (Boskovic 2018 Eq. (4.4))"}}};
}

struct TransmissionLimit {
  double min = 0;
};
template <class Visitor>
void fields(Visitor&& visit, TransmissionLimit& t) {
  visit(field::angle("min", "least angle between coupler and rocker, folded to 0..90 deg")
            .between(0, 1.5707963267948966)
            .required(),
        t.min);
}
constexpr Word choice_word(const TransmissionLimit&) {
  return {"transmission_angle", "minimum transmission angle"};
}

struct PackagingLimit {
  Range x, y;
};
template <class Visitor>
void fields(Visitor&& visit, PackagingLimit& p) {
  visit(field::length("x", "{ min, max } of both fixed pivots").required(), p.x);
  visit(field::length("y", "{ min, max } of both fixed pivots").required(), p.y);
}
constexpr Word choice_word(const PackagingLimit&) { return {"packaging", "both fixed pivots inside a box"}; }

/// The population methods work on the ten-unknown problem. Violated constraints cost a constant, as Boskovic
/// 2018 Eq. (4.4) has it, unless the study says otherwise.
using PathMethod = optimise::MethodChoice<optimise::Constraints::penalty, Recommended>;
struct PathOptimiser {
  PathMethod method;
};
template <class Visitor>
void fields(Visitor&& visit, PathOptimiser& o) {
  visit(field::entry("method", "how designs are searched"), o.method);
}

struct FourBarPathKind;
using FourBarPathStudy = PathStudy<FourBarPathKind>;

/// What is peculiar to the path synthesis of four-bars.
struct FourBarPathKind : FourBarPath {
  using BranchChoice = planar::BranchChoice;
  using Parameters = FourBarPathParameters;
  using TracingPoint = planar::TracingPoint;
  using Fit = PathFit;
  using Objective = PathObjectiveType;
  using Constraint = PathConstraint<TransmissionLimit, PackagingLimit>;
  using Optimiser = PathOptimiser;
  static constexpr std::string_view key = "planar.four_bar", the_mechanism = "the four-bar",
                                    summary = "four-bar linkage whose coupler point traces a path",
                                    branch_summary = "assembly branch to search";
  static std::string_view example();
  static std::span<const study::Absent> absent();
  static auto bounds(const std::vector<double>& x, const std::vector<double>& y) {
    return derive_bounds(x, y);
  }
  static void set_limit(study::ObjectReader& document, const TransmissionLimit& limit, PathProblem& problem);
  static void set_limit(study::ObjectReader& document, const PackagingLimit& limit, PathProblem& problem);
  /// Checks and sets up what follows from all tables.
  static void complete(study::ObjectReader& document, const study::DisplayUnits& units,
                       FourBarPathStudy& study);
  static void read_exact(study::ObjectReader& document, study::ObjectReader& target, FourBarPathStudy& study);
  static study::Result run_exact(const FourBarPathStudy& study, const study::Common& common,
                                 RunContext& context);

  /// The cognate on the other branch has the same crank angles and the same error.
  static constexpr bool one_branch_is_enough = true;
  static constexpr std::size_t max_drawn = 100;
  static bool shows_start(const PathProblem& problem) { return starts_anywhere(problem.timing); }

  static optimise::Problem population_problem(const FourBarPathStudy& study,
                                              const CrankSearch<planar::Branch>& search, bool several,
                                              optimise::MinimiseOptions& minimise);
  static Value analysis_form(const FourBar& linkage);
  static study::Scene scene(const FourBar& linkage, std::vector<double> crank_angles);
  static Table motion(const FourBar& linkage, const std::vector<double>& crank_angles);
  static std::vector<MotionPlot> motion_plots();
  static Sentence label(const PathProblem& problem, const PathDesign& design);
  /// Its objectives and classification, beside what every mechanism has.
  static void classify_design(const PathProblem& problem, const PathDesign& design, Value active_bounds,
                              study::Solution& out);
  static void add_cognates(study::Result& result, const PathDesign& best);
  static void add_published(study::Result& result, const FourBarPathStudy& study,
                            const std::vector<PathDesign>& designs);
  static Sentence headline(const FourBarPathStudy& study, const std::vector<PathDesign>& designs,
                           const PathErrors& errors);
  static void add_facts(study::Result& result, const FourBarPathStudy& study,
                        const std::vector<PathDesign>& designs);
  static void add_warnings(study::Result& result, const PathProblem& problem, const PathDesign& best);
  /// The reason why the best design is of little use, and the design that is better in use; empty = it is
  /// usable.
  static Sentence caution(const PathProblem& problem, const std::vector<PathDesign>& designs);
};

extern template study::Result run_path_study(const FourBarPathStudy&, const study::Common&, RunContext&);
study::Kind four_bar_path_kind();

/// "crank-rocker (open branch)"
std::string called(const PathDesign& design);

/// Least transmission angle (rad) that a design is judged by: over the whole motion where the crank has to
/// rotate fully, else over what the path uses.
double judged_transmission(const PathProblem& problem, const PathDesign& design);
study::Fact transmission_fact(const PathProblem& problem, const PathDesign& design);

}  // namespace linkwright::planar
