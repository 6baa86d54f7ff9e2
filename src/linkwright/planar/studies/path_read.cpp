#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/exact_path.h"
#include "linkwright/planar/studies/path.h"
#include "linkwright/planar/studies/path_families.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {
namespace {

void read_timing(study::ObjectReader& target, const study::DisplayUnits& units, PathStudy& s) {
  const PathTiming& t = s.target.timing;
  s.problem.timing = t.mode;
  s.problem.angles = timed_angles(target, units, t, s.problem.x.size());
  if (t.mode != Timing::equal_steps) return;
  if (!s.problem.angles.empty()) s.problem.step = *t.step;
  s.problem.angles.clear();
}

/// Lengths that never close: one link is longer than the others can be together.
void require_closing(study::ObjectReader& mechanism, const study::DisplayUnits& units, const PathProblem& p) {
  constexpr std::size_t lengths = 4;
  static_assert(index(FourBarParameter::rocker) == lengths - 1);
  double together = 0;
  for (std::size_t j = 0; j < lengths; ++j) together += p.bounds[j].upper;
  for (std::size_t j = 0; j < lengths; ++j)
    if (const double others = together - p.bounds[j].upper; p.bounds[j].lower > others)
      mechanism.error(
          "parameters",
          fmt::format("the bounds do not let the four-bar close: the {} is at least {} long, the other "
                      "links together at most {}",
                      name(FourBarParameter(j)), units.text(p.bounds[j].lower, Dimension::length),
                      units.text(others, Dimension::length)),
          "widen the bounds");
}

void set_bounds(study::ObjectReader& mechanism, const study::DisplayUnits& units, PathStudy& s) {
  if (s.problem.x.size() < 3 || s.problem.x.size() != s.problem.y.size()) return;
  s.problem.bounds = derive_bounds(s.problem.x, s.problem.y);
  for (std::size_t j = 0; j < four_bar_parameter_count; ++j) {
    const auto& range = s.mechanism.parameters.ranges[j];
    if (!range) continue;
    s.problem.bounds[j] = *range;
    if (j <= index(FourBarParameter::rocker) && range->upper <= 0)
      mechanism.error("parameters",
                      fmt::format("{} must be able to be longer than 0", name(FourBarParameter(j))));
  }
  if (s.mechanism.parameters.ranges[index(FourBarParameter::start_angle)] &&
      !starts_anywhere(s.problem.timing))
    mechanism.warning("parameters",
                      fmt::format("start_angle is ignored: the timing is {}", name_of(s.problem.timing)));
  require_closing(mechanism, units, s.problem);
}

// A fixed number or a range for each coordinate of B0; one that is left out is free.
void set_rocker_pivot(PathStudy& s) {
  const std::optional<Range>&x = s.mechanism.parameters.rocker_pivot_x,
        &y = s.mechanism.parameters.rocker_pivot_y;
  if (!x && !y) return;
  constexpr double far = infinity;
  const Range anywhere{-far, far}, across = x.value_or(anywhere), up = y.value_or(anywhere);
  s.problem.rocker_pivot = PackagingBox{across.lower, across.upper, up.lower, up.upper};
}

void set_search(PathStudy& s) {
  PathProblem& p = s.problem;
  p.search_open = s.mechanism.branch != BranchChoice::crossed;
  p.search_crossed = s.mechanism.branch != BranchChoice::open;
  SenseChoice sense = s.mechanism.sense;
  if (sense == SenseChoice::automatic)
    sense = p.timing == Timing::free ? SenseChoice::any : SenseChoice::positive;
  p.search_positive = sense != SenseChoice::negative;
  p.search_negative = sense != SenseChoice::positive;
}

void set_constraints(study::ObjectReader& document, PathStudy& s) {
  PathProblem& p = s.problem;
  p.crank_rotates_fully = false;
  for (const PathConstraint& constraint : s.constraints) {
    if (!is_enabled(document, constraint)) continue;
    if (std::holds_alternative<CrankRotatesFully>(constraint.limit)) p.crank_rotates_fully = true;
    if (std::holds_alternative<NoDefects>(constraint.limit)) s.no_defects = true;
    if (const auto* limit = std::get_if<TransmissionLimit>(&constraint.limit))
      p.min_transmission_angle = std::max(p.min_transmission_angle, limit->min);
    if (const auto* limit = std::get_if<PackagingLimit>(&constraint.limit)) {
      if (limit->x.fixed() || limit->y.fixed())
        document.error("constraint", "the packaging box has no width",
                       "write x_m = { min = ..., max = ... }");
      p.packaging = PackagingBox{limit->x.lower, limit->x.upper, limit->y.lower, limit->y.upper};
    }
  }
  // A closed path is traced by a crank that rotates fully.
  if (p.closed) p.crank_rotates_fully = true;
}

}  // namespace

PathStudy read_path_study(study::ObjectReader& document, const study::Common& common) {
  PathStudy s;
  if (auto mechanism = document.table(field::entry("mechanism").required())) mechanism->read(s.mechanism);
  auto target = document.table(field::entry("target").required());
  if (target) {
    target->read(s.target);
    static_cast<PathTargets&>(s.problem) = read_path_targets(*target, common, s.target);
    read_timing(*target, common.units, s);
  }
  document(field::entry("objective", "what is minimised"), s.objectives);
  if (s.objectives.size() > 1)
    document.error("objective", fmt::format("{} objectives, path synthesis has one", s.objectives.size()),
                   "keep one [[objective]]");
  document(field::entry("constraint", "what must hold"), s.constraints);
  if (auto optimiser = document.table("optimiser")) optimiser->read(s.optimiser);
  if (auto mechanism = document.table("mechanism")) set_bounds(*mechanism, common.units, s);
  set_rocker_pivot(s);
  set_search(s);
  set_constraints(document, s);
  if (target && s.target.fit == PathFit::exact) read_exact_path(document, *target, s);
  return s;
}

study::Kind path_kind() {
  study::Kind kind;
  kind.kind = "synthesis";
  kind.mechanism = "planar.four_bar";
  kind.target = "path_points";
  kind.summary = "four-bar linkage whose coupler point traces a path";
  kind.seeded = true;
  kind.example = templates::synthesis_four_bar_path_points();
  kind.absent = absent_from_four_bar_paths();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "the four-bar"), study::schema_fields<FourBarPathForm>());
    document.property(field::entry("target", "the path"), study::schema_fields<PathTarget>());
    document.property(field::entry("objective", "what is minimised"),
                      study::schema_array(study::schema_fields<PathObjectiveEntry>()));
    document.property(field::entry("constraint", "what must hold"),
                      study::schema_array(study::schema_fields<PathConstraint>()));
    document.property(field::entry("optimiser", "how designs are searched"),
                      study::schema_fields<PathOptimiser>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    const PathStudy s = read_path_study(document, common);
    study::Prepared prepared;
    PathStudy resolved = s;
    const bool exact = s.target.fit == PathFit::exact;
    for (std::size_t j = 0; j < four_bar_parameter_count && !exact; ++j)
      if (j != index(FourBarParameter::start_angle) || starts_anywhere(s.problem.timing))
        resolved.mechanism.parameters.ranges[j] = s.problem.bounds[j];
    write_path_targets(s.problem, resolved.target);
    if (resolved.objectives.empty()) resolved.objectives.emplace_back();
    prepared.canonical["mechanism"] = study::write_fields(resolved.mechanism);
    prepared.canonical["target"] = study::write_fields(resolved.target);
    prepared.canonical["objective"] = study::ObjectWriter::to_value(resolved.objectives);
    prepared.canonical["constraint"] = study::ObjectWriter::to_value(resolved.constraints);
    prepared.canonical["optimiser"] = study::write_fields(resolved.optimiser);
    prepared.run = [s, common, exact](RunContext& context) {
      return exact ? run_exact_path_study(s, common, context) : run_path_study(s, common, context);
    };
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::planar
