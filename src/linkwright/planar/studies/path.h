#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/optimise/population_methods.h"
#include "linkwright/planar/path/four_bar/synthesis.h"
#include "linkwright/planar/studies/path_points.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"

// The path synthesis study: what its file holds (field lists), how it is read, run and reported.
namespace linkwright::planar {

/// The assembly branches, and below the senses of crank rotation along the points, that are searched.
enum class BranchChoice { any, open, crossed };
constexpr std::array<EnumName<BranchChoice>, 3> names(BranchChoice) {
  return {{{BranchChoice::any, "any", "both branches"},
           {BranchChoice::open, "open",
            "coupler-rocker pin to the left of the line from crank pin to rocker pivot"},
           {BranchChoice::crossed, "crossed", "... to the right"}}};
}
enum class SenseChoice { automatic, any, positive, negative };
constexpr std::array<EnumName<SenseChoice>, 4> names(SenseChoice) {
  return {{{SenseChoice::automatic, "automatic", "positive when crank angles are prescribed, else any"},
           {SenseChoice::any, "any", "both senses"},
           {SenseChoice::positive, "positive", "counter-clockwise, or as the prescribed angles say"},
           {SenseChoice::negative, "negative", "clockwise, or against the prescribed angles"}}};
}

/// `[mechanism.parameters]`: what is left out gets bounds from the path.
struct PathParameters {
  std::array<std::optional<Range>, four_bar_parameter_count> ranges;
  /// Coordinates of B0, which follow from the other parameters.
  std::optional<Range> rocker_pivot_x, rocker_pivot_y;
};
template <class Visitor>
void fields(Visitor&& visit, PathParameters& p) {
  constexpr std::array<std::string_view, four_bar_parameter_count> summaries = {
      "length of the ground link O-B0",
      "length of the crank O-A",
      "length of the coupler A-B",
      "length of the rocker B0-B",
      "tracing point along A->B",
      "tracing point along the left normal of A->B",
      "crank pivot O, x",
      "crank pivot O, y",
      "direction of O->B0",
      "crank angle at the first point, from O->B0 (equal steps)"};
  for (std::size_t j = 0; j < four_bar_parameter_count; ++j) {
    const bool angle = j >= index(FourBarParameter::frame_angle), link = j <= index(FourBarParameter::rocker);
    Field field =
        field::of(angle ? Dimension::angle : Dimension::length, name(FourBarParameter(j)), summaries[j]);
    if (link) field.minimum = 0;
    visit(field, p.ranges[j]);
  }
  visit(field::length("rocker_pivot_x", "where the rocker pivot B0 may be, x"), p.rocker_pivot_x);
  visit(field::length("rocker_pivot_y", "where the rocker pivot B0 may be, y"), p.rocker_pivot_y);
}

struct FourBarPathForm {
  BranchChoice branch = BranchChoice::any;
  SenseChoice sense = SenseChoice::automatic;
  PathParameters parameters;
};
template <class Visitor>
void fields(Visitor&& visit, FourBarPathForm& m) {
  visit(field::entry("branch", "assembly branch to search"), m.branch);
  visit(field::entry("sense", "sense of crank rotation to search"), m.sense);
  visit(field::entry("parameters", "fixed numbers, or { min, max } for design variables"), m.parameters);
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

struct PathTarget : PathTargetForm {
  TracingPoint point = TracingPoint::coupler;
  PathFit fit = PathFit::least_squares;
};
template <class Visitor>
void fields(Visitor&& visit, PathTarget& t) {
  visit(field::entry("point", "point that traces the path"), t.point);
  visit(field::entry("fit", "how the points are met"), t.fit);
  fields(visit, static_cast<PathTargetForm&>(t));
}

/// The quantity that is minimised.
enum class PathObjectiveType { sum_squared_distance };
constexpr std::array<EnumName<PathObjectiveType>, 1> names(PathObjectiveType) {
  return {{{PathObjectiveType::sum_squared_distance, "path.sum_squared_distance",
            "sum over the points of the squared distance (Boskovic 2018 Eq. (4.4))"}}};
}
struct PathObjectiveEntry {
  PathObjectiveType type = PathObjectiveType::sum_squared_distance;
  double weight = 1;
};
template <class Visitor>
void fields(Visitor&& visit, PathObjectiveEntry& o) {
  visit(field::entry("type", "what is minimised").required(), o.type);
  visit(field::entry("weight", "factor").positive(), o.weight);
}

struct CrankRotatesFully {};
template <class Visitor>
void fields(Visitor&&, CrankRotatesFully&) {}
constexpr Word choice_word(const CrankRotatesFully&) {
  return {"crank_rotates_fully", "the crank rotates fully"};
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

/// Always holds for an answer; a study may say so.
struct InOrder {};
template <class Visitor>
void fields(Visitor&&, InOrder&) {}
constexpr Word choice_word(const InOrder&) {
  return {"order", "the points are met one after the other within one turn (always required)"};
}

struct NoDefects {};
template <class Visitor>
void fields(Visitor&&, NoDefects&) {}
constexpr Word choice_word(const NoDefects&) {
  return {"no_defects", "leave out designs with branch, circuit or order defects"};
}

struct PathConstraint {
  std::variant<CrankRotatesFully, InOrder, TransmissionLimit, PackagingLimit, NoDefects> limit;
  bool enabled = true;
};
template <class Visitor>
void fields(Visitor&& visit, PathConstraint& c) {
  visit(field::entry("type", "what is limited").required(), c.limit);
  visit(field::entry("enabled", "false leaves it out"), c.enabled);
}

/// True if a constraint of a path is enabled; the order of the points is one that no study can give up.
template <class Constraint>
bool is_enabled(study::ObjectReader& document, const Constraint& c) {
  if (!c.enabled && std::holds_alternative<InOrder>(c.limit))
    document.error("constraint", "the order of the points cannot be given up",
                   "remove the constraint, or enabled = false");
  return c.enabled;
}

/// `[optimiser]`: the recommended method or a published one.
struct Recommended {
  PathSynthesisOptions options;
};
template <class Visitor>
void fields(Visitor&& visit, Recommended& r) {
  fields(visit, r.options);
}
constexpr Word choice_word(const Recommended&) {
  return {"recommended", "separable form, global search, exact-gradient polish"};
}

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

/// A path synthesis study as read.
struct PathStudy {
  FourBarPathForm mechanism;
  PathTarget target;
  std::vector<PathObjectiveEntry> objectives;
  std::vector<PathConstraint> constraints;
  PathOptimiser optimiser;

  PathProblem problem;      ///< the problem that follows from the above
  bool no_defects = false;  ///< designs with defects are no answers
};

/// "synthesis" of "planar.four_bar" for "path_points".
study::Kind path_kind();

/// Reads the tables of the study; problems go to the reader.
PathStudy read_path_study(study::ObjectReader& document, const study::Common& common);

/// Runs it over the seeds and reports.
study::Result run_path_study(const PathStudy& study, const study::Common& common, RunContext& context);

}  // namespace linkwright::planar
