#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/exact_slider_crank_path.h"
#include "linkwright/planar/studies/path_families.h"
#include "linkwright/planar/studies/slider_crank_path.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {
namespace {

using P = SliderParameter;

void read_timing(study::ObjectReader& target, const study::DisplayUnits& units, SliderPathStudy& s) {
  s.problem.timing = s.target.timing.mode == Timing::free ? Timing::free : Timing::increments;
  s.problem.angles = timed_angles(target, units, s.target.timing, s.problem.x.size());
}

void set_bounds(study::ObjectReader& mechanism, SliderPathStudy& s) {
  if (s.problem.x.size() < 3 || s.problem.x.size() != s.problem.y.size()) return;
  s.problem.bounds = derive_slider_bounds(s.problem.x, s.problem.y);
  for (std::size_t j = 0; j < slider_parameter_count; ++j) {
    const auto& range = s.mechanism.parameters.ranges[j];
    if (!range) continue;
    s.problem.bounds[j] = *range;
    if ((P(j) == P::crank || P(j) == P::rod) && range->upper <= 0)
      mechanism.error("parameters", fmt::format("{} must be able to be longer than 0", name(P(j))));
  }
  if (starts_anywhere(s.target.timing.mode)) return;
  if (s.mechanism.parameters.ranges[index(P::start_angle)])
    mechanism.warning("parameters",
                      fmt::format("start_angle is ignored: the timing is {}", name_of(s.target.timing.mode)));
  s.problem.bounds[index(P::start_angle)] = {0, 0};
}

void set_search(SliderPathStudy& s) {
  SliderPathProblem& p = s.problem;
  // A guide turned by half a turn with the opposite offset shows the same mechanism from the other side.
  const Range &guide = p.bounds[index(P::guide_angle)], &offset = p.bounds[index(P::offset)];
  const bool complete = guide.upper - guide.lower >= 2 * pi * (1 - 1e-9) && offset.lower == -offset.upper;
  p.search_forward = s.mechanism.branch != SliderSideChoice::backward;
  p.search_backward = s.mechanism.branch == SliderSideChoice::backward ||
                      (s.mechanism.branch == SliderSideChoice::any && !complete);
  SenseChoice sense = s.mechanism.sense;
  if (sense == SenseChoice::automatic) sense = p.free_timing() ? SenseChoice::any : SenseChoice::positive;
  p.search_positive = sense != SenseChoice::negative;
  p.search_negative = sense != SenseChoice::positive;
}

void set_constraints(study::ObjectReader& document, const study::DisplayUnits& units, SliderPathStudy& s) {
  SliderPathProblem& p = s.problem;
  p.crank_rotates_fully = false;
  bool limited = false;
  for (const SliderPathConstraint& constraint : s.constraints) {
    if (!is_enabled(document, constraint)) continue;
    if (std::holds_alternative<CrankRotatesFully>(constraint.limit)) p.crank_rotates_fully = true;
    if (std::holds_alternative<NoDefects>(constraint.limit)) s.no_defects = true;
    if (const auto* limit = std::get_if<PressureLimit>(&constraint.limit))
      p.max_pressure_angle = std::min(p.max_pressure_angle, limit->max);
    if (const auto* limit = std::get_if<StrokeLimit>(&constraint.limit)) {
      limited = true;
      if (!limit->min && !limit->max)
        document.error("constraint", "the stroke has no limit", "write max_m = ..., min_m = ... or both");
      p.stroke.lower = std::max(p.stroke.lower, limit->min.value_or(0));
      p.stroke.upper = std::min(p.stroke.upper, limit->max.value_or(infinity));
    }
  }
  if (p.stroke.lower > p.stroke.upper)
    document.error("constraint",
                   fmt::format("the stroke must be at least {} and at most {}",
                               units.text(p.stroke.lower, Dimension::length, 6),
                               units.text(p.stroke.upper, Dimension::length, 6)),
                   "give min less than max");
  // A closed path is traced by a crank that rotates fully.
  if (p.closed) p.crank_rotates_fully = true;
  if ((limited || s.front) && !p.crank_rotates_fully)
    document.error(limited ? "constraint" : "objective", "the stroke is that of a full turn of the crank",
                   "add [[constraint]] type = \"crank_rotates_fully\"");
}

void set_objectives(study::ObjectReader& document, SliderPathStudy& s) {
  int paths = 0, strokes = 0;
  for (const SliderObjectiveEntry& o : s.objectives)
    ++(o.type == SliderObjectiveType::stroke ? strokes : paths);
  if (paths > 1 || strokes > 1)
    document.error("objective", "an objective is given twice", "keep each of them once");
  else if (strokes == 1 && paths == 0)
    document.error("objective", "the stroke alone says nothing about the path",
                   "add [[objective]] type = \"path.sum_squared_distance\", or limit the stroke by a "
                   "constraint instead");
  s.front = strokes == 1;
  const auto* nsga2 = std::get_if<FrontMethod<optimise::Nsga2Options>>(&s.optimiser.method);
  const auto* moead = std::get_if<FrontMethod<optimise::MoeadOptions>>(&s.optimiser.method);
  if ((nsga2 || moead) && !s.front)
    document.error("optimiser",
                   fmt::format("{} gives fronts of several objectives", nsga2 ? "nsga2" : "moead"),
                   "add [[objective]] type = \"slider.stroke\", or take another method");
  if (nsga2 && nsga2->options.population % 4 != 0)
    document.error("optimiser", fmt::format("nsga2 has a population of {}", nsga2->options.population),
                   "its population must be a multiple of 4");
  if (moead && moead->options.neighbours >= moead->options.population)
    document.error("optimiser",
                   fmt::format("moead has {} neighbours in a population of {}", moead->options.neighbours,
                               moead->options.population),
                   "take fewer neighbours or a larger population");
}

}  // namespace

SliderPathStudy read_slider_path_study(study::ObjectReader& document, const study::Common& common) {
  SliderPathStudy s;
  if (auto mechanism = document.table(field::entry("mechanism").required())) mechanism->read(s.mechanism);
  if (auto target = document.table(field::entry("target").required())) {
    target->read(s.target);
    static_cast<PathTargets&>(s.problem) = read_path_targets(*target, common, s.target);
    read_timing(*target, common.units, s);
  }
  document(field::entry("objective", "what is minimised"), s.objectives);
  document(field::entry("constraint", "what must hold"), s.constraints);
  if (auto optimiser = document.table("optimiser")) optimiser->read(s.optimiser);
  if (auto mechanism = document.table("mechanism")) set_bounds(*mechanism, s);
  set_objectives(document, s);
  set_search(s);
  set_constraints(document, common.units, s);
  if (s.target.fit == SliderPathFit::exact)
    if (auto target = document.table("target")) read_exact_slider_path(document, *target, s);
  return s;
}

study::Kind slider_path_kind() {
  study::Kind kind;
  kind.kind = "synthesis";
  kind.mechanism = "planar.slider_crank";
  kind.target = "path_points";
  kind.summary =
      "slider-crank with an inclined, offset guide whose rod point traces a path, also with a short stroke";
  kind.seeded = true;
  kind.example = templates::synthesis_slider_crank_path_points();
  kind.absent = absent_from_slider_crank_paths();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "the slider-crank"),
                      study::schema_fields<SliderPathMechanism>());
    document.property(field::entry("target", "the path"), study::schema_fields<SliderPathTarget>());
    document.property(field::entry("objective", "what is minimised"),
                      study::schema_array(study::schema_fields<SliderObjectiveEntry>()));
    document.property(field::entry("constraint", "what must hold"),
                      study::schema_array(study::schema_fields<SliderPathConstraint>()));
    document.property(field::entry("optimiser", "how designs are searched"),
                      study::schema_fields<SliderPathOptimiser>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    const SliderPathStudy s = read_slider_path_study(document, common);
    study::Prepared prepared;
    SliderPathStudy resolved = s;
    const bool exact = s.target.fit == SliderPathFit::exact;
    for (std::size_t j = 0; j < slider_parameter_count && !exact; ++j)
      if (P(j) != P::start_angle || starts_anywhere(s.target.timing.mode))
        resolved.mechanism.parameters.ranges[j] = s.problem.bounds[j];
    write_path_targets(s.problem, resolved.target);
    if (resolved.objectives.empty()) resolved.objectives.emplace_back();
    prepared.canonical["mechanism"] = study::write_fields(resolved.mechanism);
    prepared.canonical["target"] = study::write_fields(resolved.target);
    prepared.canonical["objective"] = study::ObjectWriter::to_value(resolved.objectives);
    prepared.canonical["constraint"] = study::ObjectWriter::to_value(resolved.constraints);
    prepared.canonical["optimiser"] = study::write_fields(resolved.optimiser);
    prepared.run = [s, common, exact](RunContext& context) {
      return exact ? run_exact_slider_path_study(s, common, context)
                   : run_slider_path_study(s, common, context);
    };
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::planar
