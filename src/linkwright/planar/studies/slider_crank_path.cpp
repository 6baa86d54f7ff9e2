// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/slider_crank_path.h"

#include <algorithm>
#include <variant>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/path_families.h"
#include "linkwright/planar/studies/templates.h"

namespace linkwright::planar {
namespace {

using P = SliderParameter;

void set_objectives(study::ObjectReader& document, SliderPathStudy& s) {
  int paths = 0, strokes = 0;
  for (const auto& o : s.objectives) ++(o.type == SliderObjectiveType::stroke ? strokes : paths);
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

// Where both are free, a guide turned by half a turn with the opposite offset shows the same mechanism from
// the other side.
void set_sides(SliderPathStudy& s) {
  SliderPathProblem& p = s.problem;
  const Range &guide = p.bounds[index(P::guide_angle)], &offset = p.bounds[index(P::offset)];
  const bool complete = guide.upper - guide.lower >= 2 * pi * (1 - 1e-9) && offset.lower == -offset.upper;
  p.search_forward = s.mechanism.branch != SliderSideChoice::backward;
  p.search_backward = s.mechanism.branch == SliderSideChoice::backward ||
                      (s.mechanism.branch == SliderSideChoice::any && !complete);
}

void check_stroke(study::ObjectReader& document, const study::DisplayUnits& units, const SliderPathStudy& s) {
  const SliderPathProblem& p = s.problem;
  if (p.stroke.lower > p.stroke.upper)
    document.error("constraint",
                   fmt::format("the stroke must be at least {} and at most {}",
                               units.text(p.stroke.lower, Dimension::length, 6),
                               units.text(p.stroke.upper, Dimension::length, 6)),
                   "give min less than max");
  const bool limited = std::any_of(s.constraints.begin(), s.constraints.end(), [](const auto& constraint) {
    return constraint.enabled && std::holds_alternative<StrokeLimit>(constraint.limit);
  });
  if ((limited || s.front) && !p.crank_rotates_fully)
    document.error(limited ? "constraint" : "objective", "the stroke is that of a full turn of the crank",
                   "add [[constraint]] type = \"crank_rotates_fully\"");
}

}  // namespace

std::string_view SliderPathKind::example() { return templates::synthesis_slider_crank_path_points(); }
std::span<const study::Absent> SliderPathKind::absent() { return absent_from_slider_crank_paths(); }

void SliderPathKind::set_limit(study::ObjectReader&, const PressureLimit& limit, SliderPathProblem& p) {
  p.max_pressure_angle = std::min(p.max_pressure_angle, limit.max);
}
void SliderPathKind::set_limit(study::ObjectReader& document, const StrokeLimit& limit,
                               SliderPathProblem& p) {
  if (!limit.min && !limit.max)
    document.error("constraint", "the stroke has no limit", "write max_m = ..., min_m = ... or both");
  p.stroke.lower = std::max(p.stroke.lower, limit.min.value_or(0));
  p.stroke.upper = std::min(p.stroke.upper, limit.max.value_or(infinity));
}

void SliderPathKind::complete(study::ObjectReader& document, const study::DisplayUnits& units,
                              SliderPathStudy& s) {
  SliderPathProblem& p = s.problem;
  // Given crank angles are increments from a start angle of 0.
  if (!starts_anywhere(p.timing)) p.bounds[index(P::start_angle)] = {0, 0};
  if (p.timing == Timing::given) p.timing = Timing::increments;
  set_objectives(document, s);
  set_sides(s);
  check_stroke(document, units, s);
}

study::Kind slider_path_kind() { return path_kind<SliderPathKind>(); }

}  // namespace linkwright::planar
