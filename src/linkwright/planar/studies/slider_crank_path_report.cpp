// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/optimise/combine.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/path/slider_crank/samples.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/studies/path_run.h"
#include "linkwright/planar/studies/slider_crank_path.h"

namespace linkwright::planar {
namespace {

// A front goes down to this share of the stroke of the design with the least error, unless limits say more.
constexpr double shortest_stroke = 0.4;

SliderPathScales scales_of(const SliderPathStudy& s) {
  const double size = path_size(s.problem);
  SliderPathScales scales{size * size, size};
  for (const auto& o : s.objectives)
    (o.type == SliderObjectiveType::stroke ? scales.stroke : scales.error) /= o.weight;
  return scales;
}

optimise::PagmoOptions pagmo(const optimise::Nsga2Options& o) {
  return {.method = optimise::PagmoMethod::nsga2, .nsga2 = o};
}
optimise::PagmoOptions pagmo(const optimise::MoeadOptions& o) {
  return {.method = optimise::PagmoMethod::moead, .moead = o};
}

}  // namespace

template <class D, class Options>
SliderPathSynthesis run_seed(const FrontMethod<Options>& method, const PathStudy<D>& s, std::uint64_t seed,
                             bool only_seed, RunContext& context) {
  return search_each<D>(s, seed, [&](const auto& search, const optimise::Seed& key, const std::string& name) {
    optimise::FrontOptions options = method.front;
    options.progress = only_seed;
    options.checkpoint = name;
    return optimise::minimise_with_pagmo(
        slider_path_front_problem(s.problem, search.branch, search.sense, scales_of(s)),
        pagmo(method.options), options, key, context);
  });
}

optimise::Problem SliderPathKind::population_problem(const SliderPathStudy& s,
                                                     const CrankSearch<SliderSide>& search, bool several,
                                                     optimise::MinimiseOptions& minimise) {
  if (!s.front) return path_population_problem(s.problem, search.branch, search.sense);
  minimise.front = std::max<std::size_t>(4, static_cast<std::size_t>(s.optimiser.front));
  const optimise::Problem problem =
      slider_path_front_problem(s.problem, search.branch, search.sense, scales_of(s));
  // The front of a method of one objective is what it met on its search to the least sum.
  const std::vector<double> both = {1, 1};  // weights are in the scales
  return several ? problem : optimise::weighted_sum(problem, both);
}

SliderPathSynthesis SliderPathKind::follow_front(const SliderPathStudy& s, SliderPathSynthesis best,
                                                 const PathSynthesisOptions& options, RunContext& context) {
  const double longest = best.designs[0].stroke;
  const double shortest =
      s.problem.stroke.lower > 0 ? std::min(longest, s.problem.stroke.lower) : shortest_stroke * longest;
  std::vector<double> strokes;
  for (int i = 1; i < s.optimiser.front; ++i)
    strokes.push_back(longest + (shortest - longest) * i / (s.optimiser.front - 1));
  SliderPathSynthesis front = synthesise_slider_front(s.problem, strokes, options, context);
  front.designs.push_back(std::move(best.designs[0]));
  front.evaluations += best.evaluations;
  conclude<SliderPathKind>(front, true);
  return front;
}

std::vector<SliderPathDesign> SliderPathKind::front_of(std::vector<SliderPathDesign> designs) {
  return slider_front_of(std::move(designs));
}

std::vector<SliderPathDesign> SliderPathKind::front_of_seeds(std::vector<SliderPathDesign> designs) {
  // Designs of two seeds for one stroke differ by rounding.
  std::vector<SliderPathDesign> front;
  for (SliderPathDesign& d : front_of(std::move(designs)))
    if (front.empty() || front.back().stroke - d.stroke > tolerance::same_design * d.stroke ||
        d.error - front.back().error > tolerance::same_design * d.error)
      front.push_back(std::move(d));
  return front;
}

std::vector<double> SliderPathKind::shortfalls(const PathRuns<SliderPathKind>& runs,
                                               const std::vector<SliderPathDesign>& designs) {
  std::vector<double> out(runs.answers.size(), 1);
  if (!designs[0].violations.empty()) return out;
  const double max_error = 1.1 * designs.back().error, max_stroke = 1.1 * designs.front().stroke;
  const auto area = [&](const std::vector<SliderPathDesign>& front) {
    double sum = 0, above = max_stroke;
    // By rising error: each point adds the strip between its stroke and the one before it.
    for (const SliderPathDesign& d : front) {
      if (!d.violations.empty() || d.error >= max_error || d.stroke >= above) continue;
      sum += (max_error - d.error) * (above - d.stroke);
      above = d.stroke;
    }
    return sum;
  };
  const double whole = area(designs);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = std::max(0.0, 1 - area(runs.answers[i].designs) / whole);
  return out;
}

void SliderPathKind::add_front(study::Result& result, const SliderPathProblem& p,
                               const std::vector<SliderPathDesign>& designs) {
  Table front{.name = "front"};
  std::vector<double> number, error, way, distance, pressure;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    number.push_back(static_cast<double>(i + 1));
    error.push_back(designs[i].error);
    way.push_back(designs[i].stroke);
    distance.push_back(rms<SliderPathKind>(p, designs[i]));
    pressure.push_back(greatest_pressure_angle(designs[i].linkage.parameters));
  }
  front.add("solution", "solution", std::move(number));
  front.add("stroke_m", "stroke (m)", std::move(way));
  front.add("path_error_sum_sq_m2", "path error, sum of squares (m2)", std::move(error));
  front.add("path_error_rms_m", "path error, root mean square (m)", std::move(distance));
  front.add("max_pressure_angle_rad", "greatest pressure angle (rad)", std::move(pressure));
  result.tables.push_back(std::move(front));
  result.plots.insert(result.plots.begin(), {.name = "front",
                                             .title = "Front: path error against stroke",
                                             .table = "front",
                                             .x = "stroke_m",
                                             .y = {"path_error_sum_sq_m2"},
                                             .style = study::Plot::Style::points});
}

study::Scene SliderPathKind::scene(SliderCrankMechanism mechanism, const std::vector<double>& angles) {
  // A crank that a search has shrunk to nothing leaves its pins apart by what nobody sees.
  constexpr double visible = 1e-6;
  mechanism.parameters.crank = std::max(mechanism.parameters.crank, visible * mechanism.parameters.rod);
  const planar::Linkage linkage = slider_crank(mechanism);
  const PlanResult planned = plan_linkage(linkage);
  LINKWRIGHT_REQUIRE(planned.problems.empty(), "a slider-crank of crank {} and rod {} has no plan",
                     mechanism.parameters.crank, mechanism.parameters.rod);
  LinkageMotion motion(planned.plan);
  std::vector<LinkageRecord> records;
  for (const double angle : angles) {
    const InputMotion input{angle, 0, 0};
    solve_motion(planned.plan, std::span(&input, 1), motion);
    records.push_back(record_of(linkage, planned.plan, motion, nullptr, angle));
  }
  // The tracing point is the last one of the rod; on the crank pin it is the first.
  const int rod = 2, points = static_cast<int>(linkage.bodies[rod].points.size());
  const BodyPoint tracing{rod, points > 2 ? 2 : 0};
  return linkage_scene(linkage, planned.plan, records, {tracing}, "crank_angle_rad", "crank angle");
}

Table SliderPathKind::motion(const SliderCrankMechanism& mechanism, const std::vector<double>& angles) {
  Table table;
  std::vector<double> rod, way, pressure, x, y;
  for (const double angle : angles) {
    const SliderCrankPose pose = slider_crank_pose(mechanism, angle);
    rod.push_back(pose.rod_angle);
    way.push_back(pose.displacement);
    pressure.push_back(pose.pressure_angle);
    x.push_back(pose.point.real());
    y.push_back(pose.point.imag());
    table.status.emplace_back(to_string(pose.status));
  }
  math::unwrap_angles(rod);
  table.add("crank_angle_rad", "crank angle (rad)", angles);
  table.add("rod_angle_rad", "rod angle (rad)", std::move(rod));
  table.add("slider_m", "displacement of the slider along the guide (m)", std::move(way));
  table.add("pressure_angle_rad", "pressure angle between rod and guide (rad)", std::move(pressure));
  table.add("point_x_m", "tracing point x (m)", std::move(x));
  table.add("point_y_m", "tracing point y (m)", std::move(y));
  return table;
}

std::vector<MotionPlot> SliderPathKind::motion_plots() {
  return {{"displacement", "Displacement of the slider", {"slider_m"}},
          {"pressure", "Pressure angle between rod and guide", {"pressure_angle_rad"}}};
}

Value SliderPathKind::analysis_form(const SliderCrankMechanism& mechanism) {
  return study::write_fields(mechanism);
}

Sentence SliderPathKind::label(const SliderPathProblem& p, const SliderPathDesign& d) {
  if (std::isnan(d.stroke)) return Sentence(name_of(d.linkage.branch));
  return say("stroke {}, {} rms", length_by_size(d.stroke), length_by_size(rms<SliderPathKind>(p, d)));
}

bool SliderPathKind::shows_start(const SliderPathProblem& p) {
  return !p.free_timing() && !p.bounds[index(Parameter::start_angle)].fixed();
}

void SliderPathKind::classify_design(const SliderPathProblem&, const SliderPathDesign& d, Value active_bounds,
                                     study::Solution& out) {
  // The tracing point as the analysis of the same mechanism takes it.
  const SliderCrankForm& f = d.linkage.parameters;
  out.parameters.push_back({"rod_u_m", "tracing point along rod", f.rod_u, -infinity, infinity});
  out.parameters.push_back({"rod_v_m", "tracing point across", f.rod_v, -infinity, infinity});
  out.objectives["stroke_m"] = d.stroke;
  const double size = f.crank + f.rod + std::abs(f.offset);
  out.classification["branch"] = name_of(d.linkage.branch);
  out.classification["sense"] = d.sense > 0 ? "positive" : "negative";
  out.classification["crank_rotates_fully"] = rotation_margin(f) >= -tolerance::feasibility * size;
  out.classification["rotation_margin_m"] = rotation_margin(f);
  out.classification["max_pressure_angle_rad"] = greatest_pressure_angle(f);
  out.classification["active_bounds"] = std::move(active_bounds);
}

void SliderPathKind::add_cognates(study::Result& result, const SliderPathDesign& best) {
  Table table{.name = "cognates"};
  constexpr std::string_view keys[] = {
      "crank_m",   "rod_m",   "offset_m", "guide_angle_rad", "pivot_x_m",
      "pivot_y_m", "rod_u_m", "rod_v_m",  "same_timing",     "crank_rotates_fully"};
  for (std::string_view key : keys) table.add(std::string(key), std::string(key));
  const auto row = [&](const SliderCrankForm& f, bool same) {
    const double values[] = {
        f.crank,   f.rod,   f.offset, f.guide_angle,    f.pivot_x,
        f.pivot_y, f.rod_u, f.rod_v,  same ? 1.0 : 0.0, std::isnan(stroke(f)) ? 0.0 : 1.0};
    for (std::size_t j = 0; j < std::size(values); ++j) table.columns[j].values.push_back(values[j]);
  };
  const SliderCrankForm& f = best.linkage.parameters;
  row(f, true);
  // A tracing point on the crank pin leaves none, nor does one that lies there but for rounding.
  if (std::hypot(f.rod_u, f.rod_v) > 1e-9 * f.rod)
    row(slider_crank_cognate(best.linkage, best.angles[0]).parameters, false);
  result.tables.push_back(std::move(table));
}

void SliderPathKind::add_published(study::Result& result, const SliderPathStudy& s,
                                   const std::vector<SliderPathDesign>& designs) {
  if (!designs[0].violations.empty()) return;
  const SliderPathProblem& p = s.problem;
  const SliderPathProblem known = eighteen_slider_points();
  if (p.free_timing() || p.x != known.x || p.y != known.y || p.angles.size() != known.angles.size()) return;
  for (std::size_t k = 0; k < known.angles.size(); ++k)
    if (std::abs(p.angles[k] - known.angles[k]) > 1e-12) return;
  const std::string source = "Boskovic 2018, ";
  for (const PublishedSliderCrank& published : published_slider_cranks()) {
    if (!s.front && published.label != "Table 4.2") continue;
    std::vector<double> angles;
    for (const double offset : known.angles) angles.push_back(published.start_angle + offset);
    const SliderPathDesign d = measure(known, published.linkage, 1, angles);
    result.comparisons.push_back({published.label + ", design re-evaluated: path error, m2",
                                  source + published.label, published.published_error, d.error,
                                  "not reproduced",
                                  "agrees to 0.3 to 0.6 %, which rounding does not explain"});
    result.comparisons.push_back({published.label + ": stroke, m", source + published.label,
                                  published.published_stroke, d.stroke, "corrected",
                                  "the number printed is the abscissa of the tracing point at the start"});
    double least = infinity;
    for (const SliderPathDesign& own : designs)
      if (!s.front || own.stroke <= d.stroke * (1 + 1e-9)) least = std::min(least, own.error);
    if (std::isfinite(least))
      result.comparisons.push_back(
          {published.label + (s.front ? ": path error of this study at no longer a stroke, m2"
                                      : ": path error of this study, m2"),
           source + published.label, published.published_error, least,
           least < published.published_error ? "improved" : "not reached", ""});
  }
}

Sentence SliderPathKind::headline(const SliderPathStudy& s, const std::vector<SliderPathDesign>& designs,
                                  const PathErrors& errors) {
  const SliderPathProblem& p = s.problem;
  const SliderPathDesign &best = designs[0], &shortest = designs.back();
  const auto distance = [&](const SliderPathDesign& d) { return length_by_size(rms<SliderPathKind>(p, d)); };
  if (!s.front)
    return say("A slider-crank {}{}.", how_near(p, errors, best.error),
               std::isnan(best.stroke) ? Sentence() : say(", stroke {}", length_by_size(best.stroke)));
  return designs.size() > 1
             ? say("A front of {} slider-cranks: from a stroke of {} at {} root mean square to {} at {}.",
                   designs.size(), length_by_size(best.stroke), distance(best),
                   length_by_size(shortest.stroke), distance(shortest))
             : say("One slider-crank is the best in path error and stroke: {} root mean square, {}.",
                   distance(best), length_by_size(best.stroke));
}

study::Fact pressure_fact(double pressure) {
  using Verdict = study::Fact::Verdict;
  return {"greatest pressure angle", degrees_of(pressure).fixed(1),
          pressure > steep_pressure ? Verdict::bad : Verdict::plain};
}

void SliderPathKind::add_facts(study::Result& result, const SliderPathStudy& s,
                               const std::vector<SliderPathDesign>& designs) {
  const SliderPathDesign& best = designs[0];
  if (std::isnan(best.stroke)) return;
  const bool front = s.front && best.violations.empty() && designs.size() > 1;
  result.facts.push_back({"stroke of the slider", front ? say("{}, down to {}", length_by_size(best.stroke),
                                                              length_by_size(designs.back().stroke))
                                                        : length_by_size(best.stroke)});
  result.facts.push_back(pressure_fact(greatest_pressure_angle(best.linkage.parameters)));
}

void SliderPathKind::add_warnings(study::Result& result, const SliderPathProblem&,
                                  const SliderPathDesign& d) {
  warn_of_pressure({result.diagnostics}, greatest_pressure_angle(d.linkage.parameters));
}

void warn_of_pressure(const study::AddWarning& warn, double pressure) {
  if (pressure > steep_pressure)
    warn(say("the rod comes to {} from the guide: it presses the slider against it there",
             degrees_of(pressure).fixed(1)),
         "limit it: [[constraint]] type = \"pressure_angle\", max_deg = 60");
}

template study::Result run_path_study(const SliderPathStudy&, const study::Common&, RunContext&);

}  // namespace linkwright::planar
