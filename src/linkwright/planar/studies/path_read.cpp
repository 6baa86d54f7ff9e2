#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/exact_path.h"
#include "linkwright/planar/studies/path.h"
#include "linkwright/planar/studies/templates.h"
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

// The key that the targets stand at.
const char* key_of(const PathTarget& target) {
  return target.gates ? "gates" : target.points_file ? "points_file" : "points";
}

// The points or, in their place, the middles of gates.
PathPoints read_targets(study::ObjectReader& target, const study::Common& common, PathStudy& s) {
  PathPoints targets;
  if (!s.target.gates) {
    read_path_targets(target, common, s.target, targets);
    return targets;
  }
  const bool has_points = target.has(Field{.key = "points", .summary = {}, .dimension = Dimension::length});
  if (has_points || target.has("points_file")) {
    target.error("gates",
                 fmt::format("the target has both gates and {}", has_points ? "points" : "points_file"),
                 "keep one of them; a gate whose posts agree is a point");
    return targets;
  }
  for (const PathGate& gate : *s.target.gates) {
    targets.x.push_back(0.5 * (gate.from[0] + gate.to[0]));
    targets.y.push_back(0.5 * (gate.from[1] + gate.to[1]));
    targets.gate_x.push_back(0.5 * (gate.to[0] - gate.from[0]));
    targets.gate_y.push_back(0.5 * (gate.to[1] - gate.from[1]));
  }
  check_path_targets(target, "gates", targets);
  return targets;
}

void read_tolerances(study::ObjectReader& target, const PathTarget& form, PathPoints& targets) {
  if (form.tolerance && form.tolerances) {
    target.error("tolerances", "the target has both tolerance and tolerances", "keep one of them");
    return;
  }
  if (!form.tolerance && !form.tolerances) return;
  if (!targets.tolerance.empty()) {
    target.error(form.tolerance ? "tolerance" : "tolerances", "the points file also has tolerances",
                 "keep the key or the column");
    return;
  }
  if (form.tolerance) targets.tolerance.assign(targets.x.size(), *form.tolerance);
  if (!form.tolerances) return;
  if (targets.x.size() >= 3 && form.tolerances->size() != targets.x.size()) {
    target.error("tolerances",
                 fmt::format("{} tolerances for {} targets", form.tolerances->size(), targets.x.size()),
                 "give one for each, or tolerance for all");
    return;
  }
  targets.tolerance = *form.tolerances;
}

// Targets with their tolerances; what the study gives for a closing target goes with it.
void set_targets(study::ObjectReader& target, const study::Common& common, PathStudy& s) {
  PathPoints targets = read_targets(target, common, s);
  read_tolerances(target, s.target, targets);
  const std::size_t n = targets.x.size();
  if (n > 0) {
    PathTiming& t = s.target.timing;
    const std::optional<double> rotation = turned(t, n);
    if (leave_out_closing_target(target, key_of(s.target), s.target.closed, rotation, targets) && rotation &&
        is_one_turn(*rotation))
      leave_out_closing_angle(t);
  }
  PathProblem& p = s.problem;
  p.x = std::move(targets.x), p.y = std::move(targets.y);
  p.gate_x = std::move(targets.gate_x), p.gate_y = std::move(targets.gate_y);
  p.tolerance = std::move(targets.tolerance);
}

// The targets as they are met: points or gates, with one tolerance for all or one for each.
void resolve_targets(const PathProblem& p, PathTarget& target) {
  target.points_file.reset();
  target.points.reset();
  target.gates.reset();
  const std::size_t n = std::min(p.x.size(), p.y.size());
  if (p.gate_x.empty()) {
    target.points.emplace();
    for (std::size_t k = 0; k < n; ++k) target.points->push_back({p.x[k], p.y[k]});
  } else {
    target.gates.emplace();
    for (std::size_t k = 0; k < n; ++k)
      target.gates->push_back({.from = {p.x[k] - p.gate_x[k], p.y[k] - p.gate_y[k]},
                               .to = {p.x[k] + p.gate_x[k], p.y[k] + p.gate_y[k]}});
  }
  if (!target.tolerance && !p.tolerance.empty()) target.tolerances = p.tolerance;
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
  p.closed = s.target.closed;
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
  if (auto mechanism = document.table(Field{.key = "mechanism", .summary = {}, .required = true}))
    mechanism->read(s.mechanism);
  auto target = document.table(Field{.key = "target", .summary = {}, .required = true});
  if (target) {
    target->read(s.target);
    set_targets(*target, common, s);
    read_timing(*target, common.units, s);
  }
  document(Field{.key = "objective", .summary = "what is minimised"}, s.objectives);
  if (s.objectives.size() > 1)
    document.error("objective", fmt::format("{} objectives, path synthesis has one", s.objectives.size()),
                   "keep one [[objective]]");
  document(Field{.key = "constraint", .summary = "what must hold"}, s.constraints);
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
  kind.schema = [](study::SchemaWriter& document) {
    document.property(Field{.key = "mechanism", .summary = "the four-bar"},
                      study::schema_fields<PathMechanism>());
    document.property(Field{.key = "target", .summary = "the path"}, study::schema_fields<PathTarget>());
    document.property(Field{.key = "objective", .summary = "what is minimised"},
                      study::schema_array(study::schema_fields<PathObjectiveEntry>()));
    document.property(Field{.key = "constraint", .summary = "what must hold"},
                      study::schema_array(study::schema_fields<PathConstraint>()));
    document.property(Field{.key = "optimiser", .summary = "how designs are searched"},
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
    resolve_targets(s.problem, resolved.target);
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
