#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/optimise/statistics.h"
#include "linkwright/planar/path/defects.h"
#include "linkwright/planar/path/slider_crank/samples.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/path_reached.h"
#include "linkwright/planar/studies/slider_crank_path.h"
#include "linkwright/planar/studies/slider_crank_path_scene.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/run_seeds.h"

namespace linkwright::planar {
namespace {

// A seed of a front succeeds when so little of what the front of all seeds dominates is missing.
constexpr double success_of_front = 1e-3;

class Report {
 public:
  Report(const SliderPathStudy& s, const study::Common& common, const SliderPathRuns& runs)
      : s_(s), p_(s.problem), common_(common), runs_(runs), designs_(slider_path_answers(s, runs)) {}

  study::Result make() {
    const bool stopped = runs_.status != Status::done;
    if (designs_.empty()) {
      result_.status = stopped ? runs_.status : Status::infeasible;
      result_.headline = "No slider-crank found: no start of the search assembles at every point.";
      return std::move(result_);
    }
    feasible_ = designs_[0].violations.empty();
    result_.status = stopped ? runs_.status : feasible_ ? Status::done : Status::infeasible;
    for (const SliderPathDesign& d : designs_)
      add_slider_solution(result_, p_, d, common_,
                          std::isnan(d.stroke)
                              ? Sentence(name_of(d.linkage.branch))
                              : say("stroke {}, {} rms", length_by_size(d.stroke), length_by_size(rms(d))));
    statistics();
    tables();
    if (feasible_) comparisons();
    facts();
    return std::move(result_);
  }

 private:
  using Verdict = study::Fact::Verdict;
  double rms(const SliderPathDesign& d) const {
    return std::sqrt(d.error / static_cast<double>(p_.x.size()));
  }

  // Shortfall of a front: the share of the area dominated by the front of all seeds that a seed misses. The
  // worst of both objectives on that front, a tenth further, is the point from which it is counted.
  std::vector<double> shortfalls() const {
    std::vector<double> out(runs_.answers.size(), 1);
    if (!feasible_) return out;
    const double most_error = 1.1 * designs_.back().error, most_stroke = 1.1 * designs_.front().stroke;
    const auto area = [&](const std::vector<SliderPathDesign>& front) {
      double sum = 0, above = most_stroke;
      // By rising error: each point adds the strip between its stroke and the one before it.
      for (const SliderPathDesign& d : front) {
        if (!d.violations.empty() || d.error >= most_error || d.stroke >= above) continue;
        sum += (most_error - d.error) * (above - d.stroke);
        above = d.stroke;
      }
      return sum;
    };
    const double whole = area(designs_);
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = std::max(0.0, 1 - area(runs_.answers[i].designs) / whole);
    return out;
  }

  void statistics() {
    std::vector<optimise::SeedOutcome> outcomes;
    if (s_.front) missing_ = shortfalls();
    result_.log = Value::array();
    for (std::size_t i = 0; i < runs_.answers.size(); ++i) {
      const SliderPathSynthesis& run = runs_.answers[i];
      const double violation = run.designs.empty() ? infinity : total_violation(run.designs[0]);
      const double error = run.designs.empty() ? infinity : run.designs[0].error;
      outcomes.push_back({s_.front ? missing_[i] : error, violation, run.evaluations});
      Value entry = study::seed_entry(runs_.seeds[i], run.status, violation > 0 ? nan : error,
                                      run.evaluations);  // sum of squared distances (m2)
      entry["violation"] = violation;
      study::write_history(entry, run.history, run.evaluations);
      result_.log.push_back(std::move(entry));
    }
    const double size = path_size(p_), best = feasible_ ? designs_[0].error : infinity;
    const double threshold = s_.front ? success_of_front : success_threshold(best, size);
    const optimise::SeedStatistics st = optimise::statistics(outcomes, threshold);
    result_.statistics["method"] = runs_.method;
    result_.statistics["measure"] = s_.front ? "share of the common front that is missing" : "path error, m2";
    study::write_statistics(result_.statistics, st);
  }

  void tables() {
    add_slider_design_tables(result_, p_, designs_, common_.output.samples);
    if (s_.front && feasible_) front_table();
    result_.tables.push_back(path_seed_table(runs_, missing_));
    cognates();
  }

  void front_table() {
    Table front{.name = "front", .columns{}, .status{}};
    std::vector<double> number, error, way, distance, pressure;
    for (std::size_t i = 0; i < designs_.size(); ++i) {
      number.push_back(static_cast<double>(i + 1));
      error.push_back(designs_[i].error);
      way.push_back(designs_[i].stroke);
      distance.push_back(rms(designs_[i]));
      pressure.push_back(greatest_pressure_angle(designs_[i].linkage.parameters));
    }
    front.add("solution", "solution", std::move(number));
    front.add("stroke_m", "stroke (m)", std::move(way));
    front.add("path_error_sum_sq_m2", "path error, sum of squares (m2)", std::move(error));
    front.add("path_error_rms_m", "path error, root mean square (m)", std::move(distance));
    front.add("max_pressure_angle_rad", "greatest pressure angle (rad)", std::move(pressure));
    result_.tables.push_back(std::move(front));
    result_.plots.insert(result_.plots.begin(), {.name = "front",
                                                 .title = "Front: path error against stroke",
                                                 .table = "front",
                                                 .x = "stroke_m",
                                                 .y = {"path_error_sum_sq_m2"},
                                                 .style = study::Plot::Style::points});
  }

  // The best mechanism and the other one with the same curve.
  void cognates() {
    const SliderPathDesign& best = designs_[0];
    Table table{.name = "cognates", .columns{}, .status{}};
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
    result_.tables.push_back(std::move(table));
  }

  void comparisons() {
    const SliderPathProblem known = eighteen_slider_points();
    if (p_.free_timing() || p_.x != known.x || p_.y != known.y || p_.angles.size() != known.angles.size())
      return;
    for (std::size_t k = 0; k < known.angles.size(); ++k)
      if (std::abs(p_.angles[k] - known.angles[k]) > 1e-12) return;
    const std::string source = "Boskovic 2018, ";
    for (const PublishedSliderCrank& published : published_slider_cranks()) {
      if (!s_.front && published.label != "Table 4.2") continue;
      std::vector<double> angles;
      for (const double offset : known.angles) angles.push_back(published.start_angle + offset);
      const SliderPathDesign d = measure(known, published.linkage, 1, angles);
      result_.comparisons.push_back({published.label + ", design re-evaluated: path error, m2",
                                     source + published.label, published.published_error, d.error,
                                     "not reproduced",
                                     "agrees to 0.3 to 0.6 %, which rounding does not explain"});
      result_.comparisons.push_back({published.label + ": stroke, m", source + published.label,
                                     published.published_stroke, d.stroke, "corrected",
                                     "the number printed is the abscissa of the tracing point at the start"});
      double least = infinity;
      for (const SliderPathDesign& own : designs_)
        if (!s_.front || own.stroke <= d.stroke * (1 + 1e-9)) least = std::min(least, own.error);
      if (std::isfinite(least))
        result_.comparisons.push_back(
            {published.label + (s_.front ? ": path error of this study at no longer a stroke, m2"
                                         : ": path error of this study, m2"),
             source + published.label, published.published_error, least,
             least < published.published_error ? "improved" : "not reached", ""});
    }
  }

  void facts() {
    const SliderPathDesign& best = designs_[0];
    const PathErrors errors = path_errors(p_, best);
    const double pressure = greatest_pressure_angle(best.linkage.parameters);
    const study::AddFact fact{result_.facts};
    if (!feasible_) {
      std::string reasons;
      for (const auto& v : best.violations) reasons += (reasons.empty() ? "" : ", ") + v.reason;
      result_.headline = say("No design meets every constraint; the nearest one violates {}.", reasons);
    } else if (s_.front) {
      const SliderPathDesign& shortest = designs_.back();
      result_.headline =
          designs_.size() > 1
              ? say("A front of {} slider-cranks: from a stroke of {} at {} root mean square to {} at {}.",
                    designs_.size(), length_by_size(best.stroke), length_by_size(rms(best)),
                    length_by_size(shortest.stroke), length_by_size(rms(shortest)))
              : say("One slider-crank is the best in path error and stroke: {} root mean square, {}.",
                    length_by_size(rms(best)), length_by_size(best.stroke));
    } else {
      result_.headline =
          say("A slider-crank {}{}.", how_near(p_, errors, best.error),
              std::isnan(best.stroke) ? Sentence() : say(", stroke {}", length_by_size(best.stroke)));
    }
    fact(s_.front ? "least path error (sum of squares)" : "path error (sum of squares)",
         path_error(best.error), feasible_ ? Verdict::good : Verdict::bad);
    fact("root mean square distance",
         rms(best) <= exact_share * path_size(p_) ? millimetres(0) : length_by_size(rms(best)));
    result_.facts.push_back(worst_fact(p_, errors));
    if (!std::isnan(best.stroke)) {
      fact("stroke of the slider",
           s_.front && feasible_ && designs_.size() > 1
               ? say("{}, down to {}", length_by_size(best.stroke), length_by_size(designs_.back().stroke))
               : length_by_size(best.stroke));
      fact("greatest pressure angle", degrees_of(pressure).fixed(1),
           pressure > steep_pressure ? Verdict::bad : Verdict::plain);
    }
    fact("method", runs_.method);
    study::add_seed_facts(
        result_, s_.front ? "runs that reached the common front" : "runs that reached the best solution",
        runs_.answers.size());
    const study::AddWarning warn{result_.diagnostics};
    study::warn_of_missing_seeds(result_, runs_.answers.size(), common_.seeds);
    warn_of_pressure(warn, pressure);
  }

  const SliderPathStudy& s_;
  const SliderPathProblem& p_;
  const study::Common& common_;
  const SliderPathRuns& runs_;
  const std::vector<SliderPathDesign> designs_;
  bool feasible_ = false;
  std::vector<double> missing_;
  study::Result result_;
};

}  // namespace

void add_slider_solution(study::Result& result, const SliderPathProblem& p, const SliderPathDesign& d,
                         const study::Common& common, Sentence label) {
  const std::size_t number = result.solutions.size() + 1;
  const bool with_start = !p.free_timing() && !p.bounds[index(SliderParameter::start_angle)].fixed();
  const double rms = std::sqrt(d.error / static_cast<double>(p.x.size()));
  constexpr std::array<std::string_view, slider_parameter_count> labels = {
      "crank length",
      "rod length",
      "tracing point, distance from crank pin",
      "tracing point, angle from rod",
      "guide direction",
      "offset of the guide",
      "crank pivot x",
      "crank pivot y",
      "start angle"};
  study::Solution out;
  out.label = std::move(label);
  const auto values = SliderCrankPath::values(p, d);
  for (std::size_t j = 0; j < slider_parameter_count; ++j) {
    const auto parameter = SliderParameter(j);
    if (parameter == SliderParameter::start_angle && !with_start) continue;
    const Range& range = p.bounds[j];
    double value = values[j];
    if (is_angle(parameter)) {
      const double turned = value - 2 * pi * std::floor((value - range.lower) / (2 * pi));
      if (turned <= range.upper) value = turned;
    }
    out.parameters.push_back({std::string(name(parameter)) + (is_angle(parameter) ? "_rad" : "_m"),
                              std::string(labels[j]), value, range.lower, range.upper});
  }
  // The tracing point as the analysis of the same mechanism takes it.
  const SliderCrankForm& f = d.linkage.parameters;
  out.parameters.push_back({"rod_u_m", "tracing point along rod", f.rod_u, -infinity, infinity});
  out.parameters.push_back({"rod_v_m", "tracing point across", f.rod_v, -infinity, infinity});
  const PathErrors errors = path_errors(p, d);
  out.objectives["path_error_sum_sq_m2"] = d.error;
  out.objectives["path_error_rms_m"] = rms;
  out.objectives["path_error_max_m"] = *std::max_element(errors.excess.begin(), errors.excess.end());
  out.objectives["stroke_m"] = d.stroke;
  const double size = f.crank + f.rod + std::abs(f.offset);
  out.classification["branch"] = name_of(d.linkage.branch);
  out.classification["sense"] = d.sense > 0 ? "positive" : "negative";
  out.classification["crank_rotates_fully"] = rotation_margin(f) >= -tolerance::feasibility * size;
  out.classification["rotation_margin_m"] = rotation_margin(f);
  out.classification["max_pressure_angle_rad"] = greatest_pressure_angle(f);
  out.classification["active_bounds"] = Value::array();
  for (const std::string& bound : d.active_bounds) out.classification["active_bounds"].push_back(bound);
  for (const auto& violation : d.violations) out.defects.push_back(violation_text(violation));
  for (const Defect& defect : defects(p, d))
    out.defects.push_back(say("{}: {}", name_of(defect.kind), defect.text));
  if (number <= most_drawn_sliders) {
    out.scene = fmt::format("solution-{}", number);
    result.scenes.push_back(
        slider_path_scene(p, d, out.scene, say("{}: {}", number, out.label), common.output.samples));
    out.study = motion_study("planar.slider_crank", study::write_fields(d.linkage),
                             shown_angles(d, common.output.samples), d.angles);
  }
  result.solutions.push_back(std::move(out));
}

void add_slider_design_tables(study::Result& result, const SliderPathProblem& p,
                              const std::vector<SliderPathDesign>& designs, int samples) {
  using Style = study::Plot::Style;
  for (std::size_t i = 0; i < std::min(designs.size(), most_drawn_sliders); ++i) {
    // The best design's tables have plain names, those of the others carry the number of the solution.
    const std::string suffix = i == 0 ? "" : fmt::format("-{}", i + 1), scene = result.solutions[i].scene;
    result.tables.push_back(point_table(p, designs[i].angles, path_errors(p, designs[i]), "points" + suffix));
    result.tables.push_back(slider_motion_table(designs[i], "motion" + suffix, samples));
    const study::AddPlot of_points{
        result, {.table = "points" + suffix, .x = "crank_angle_rad", .style = Style::points, .scene = scene}},
        of_motion{result, {.table = "motion" + suffix, .x = "crank_angle_rad", .scene = scene}};
    of_points("errors" + suffix, "Distance from the target points", {"distance_m"});
    of_motion("displacement" + suffix, "Displacement of the slider", {"slider_m"});
    of_motion("pressure" + suffix, "Pressure angle between rod and guide", {"pressure_angle_rad"});
  }
}

void warn_of_pressure(const study::AddWarning& warn, double pressure) {
  if (pressure > steep_pressure)
    warn(say("the rod comes to {} from the guide: it presses the slider against it there",
             degrees_of(pressure).fixed(1)),
         "limit it: [[constraint]] type = \"pressure_angle\", max_deg = 60");
}

study::Result report_slider_path(const SliderPathStudy& s, const study::Common& common,
                                 const SliderPathRuns& runs) {
  return Report(s, common, runs).make();
}

}  // namespace linkwright::planar
