// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/exact/designs.h"
#include "linkwright/planar/exact/slider_designs.h"
#include "linkwright/planar/studies/exact_findings.h"
#include "linkwright/planar/studies/path_run.h"
#include "linkwright/planar/studies/slider_crank_path.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t exact_slider_points = 8;
constexpr const char* search_sliders = "fit = \"least_squares\" searches for the nearest slider-cranks";
// Number of the nearest candidates that are drawn if there are no answers.
constexpr std::size_t min_sliders_drawn = 6;

bool is_answer(const ExactSliderDesign& d) { return d.defects.empty() && d.design.violations.empty(); }

// A study may ask for the slider behind the crank pin: the same mechanism with its guide turned around.
void show_from_behind(SliderCrankMechanism& mechanism) {
  mechanism.branch = SliderSide::backward;
  mechanism.parameters.offset = -mechanism.parameters.offset;
  mechanism.parameters.guide_angle = math::wrap_angle(mechanism.parameters.guide_angle + pi);
}

Table slider_design_table(const std::vector<ExactSliderDesign>& designs) {
  constexpr std::array<std::string_view, 4> severities = {"done", "order", "circuit", "branch"};
  Table table{.name = "designs"};
  std::vector<double> number, rotates, pressure, stroke;
  std::vector<std::string> keys;
  SliderCrankForm first;
  fields([&](const Field& field, double&) { keys.push_back(si_key(field.key, field.dimension)); }, first);
  std::vector<std::vector<double>> columns(keys.size());
  for (const ExactSliderDesign& d : designs) {
    number.push_back(static_cast<double>(number.size() + 1));
    SliderCrankForm form = d.design.linkage.parameters;
    std::size_t j = 0;
    fields([&](const Field&, double& value) { columns[j++].push_back(value); }, form);
    rotates.push_back(std::isnan(d.design.stroke) ? 0 : 1);
    stroke.push_back(d.design.stroke);
    pressure.push_back(severity(d.defects) < 2 ? d.pressure_angle : nan);
    table.status.emplace_back(severities[at(severity(d.defects))]);
  }
  table.add("design", "design", std::move(number));
  for (std::size_t j = 0; j < keys.size(); ++j) table.add(keys[j], keys[j], std::move(columns[j]));
  table.add("crank_rotates_fully", "the crank rotates fully (1 = yes)", std::move(rotates));
  table.add("stroke_m", "stroke (m)", std::move(stroke));
  table.add("max_pressure_angle_rad", "greatest pressure angle on the path (rad)", std::move(pressure));
  return table;
}

}  // namespace

void SliderPathKind::read_exact(study::ObjectReader& document, study::ObjectReader& target,
                                SliderPathStudy& s) {
  SliderPathProblem& p = s.problem;
  const char* key = key_of(s.target);
  if (!check_exact_targets(target, s.target, p, search_sliders)) return;
  if (!std::holds_alternative<Recommended>(s.optimiser.method))
    document.error("optimiser", "fit = \"exact\" finds all solutions, there is nothing to search",
                   "remove the method");
  if (s.front)
    document.error("objective", "fit = \"exact\" has no front: every solution passes the points",
                   "limit the stroke: [[constraint]] type = \"stroke\"");
  if (auto mechanism = document.table("mechanism"))
    for (std::size_t j = 0; j < slider_parameter_count; ++j)
      if (s.mechanism.parameters.ranges[j])
        mechanism->error(
            "parameters",
            fmt::format("{} is given, fit = \"exact\" leaves no number of the slider-crank to choose",
                        name(SliderParameter(j))),
            fmt::format("leave it out, or use what searches: {}", search_sliders));
  if (!p.free_timing())
    target.error("timing", "fit = \"exact\" of a slider-crank meets its points at any crank angles",
                 fmt::format("write mode = \"free\", or use what searches: {}", search_sliders));
  const std::size_t n = p.x.size();
  if (n >= 3 && n != exact_slider_points)
    target.error(
        key,
        n < exact_slider_points
            ? fmt::format("{} points are passed by infinitely many slider-cranks, fit = \"exact\" takes {}",
                          n, exact_slider_points)
            : fmt::format("{} points are more than a slider-crank passes exactly, which are {}", n,
                          exact_slider_points),
        fmt::format("give {}, or use what searches: {}", exact_slider_points, search_sliders));
  if (n < 3 || n != p.y.size()) return;
  if (n == exact_slider_points) check_exact_points(target, key, p.x, p.y);
  // All that solves the problem is an answer, whatever its size.
  double far = path_size(p);
  for (std::size_t k = 0; k < n; ++k) far = std::max({far, std::abs(p.x[k]), std::abs(p.y[k])});
  for (std::size_t j = 0; j < slider_parameter_count; ++j)
    p.bounds[j] = is_angle(SliderParameter(j)) ? Range{-pi, pi} : Range{-1e12 * far, 1e12 * far};
}

study::Result SliderPathKind::run_exact(const SliderPathStudy& s, const study::Common& common,
                                        RunContext& context) {
  const SliderPathProblem& p = s.problem;
  std::vector<std::complex<double>> points;
  for (std::size_t k = 0; k < p.x.size(); ++k) points.emplace_back(p.x[k], p.y[k]);
  const SliderPointSolutions solved =
      solve_slider_points(std::span(points).first<exact_slider_points>(), context);
  ExactFindings found{.mechanism = "slider-crank",
                      .what = "complex solutions for eight points",
                      .whole = static_cast<int>(slider_point_solutions)};
  if (solved.status == Status::deadline || solved.status == Status::cancelled) found.stopped = solved.status;
  found.classes = solved.finite;
  found.real_classes = static_cast<int>(solved.real.size());
  found.infinite = solved.infinite;
  found.singular = solved.singular;
  found.lost = solved.lost;
  found.completeness = completeness_of(found);

  std::vector<ExactSliderDesign> designs = exact_designs(p, solved);
  std::erase_if(designs, [&](const ExactSliderDesign& d) {
    return !(d.design.sense > 0 ? p.search_positive : p.search_negative);
  });
  std::stable_partition(designs.begin(), designs.end(), is_answer);
  found.designs = static_cast<int>(designs.size());
  const std::array<int*, 4> by_severity = {&found.defect_free, &found.order, &found.circuit, &found.branch};
  std::vector<std::vector<int>> orders;
  for (ExactSliderDesign& d : designs) {
    ++*by_severity[at(severity(d.defects))];
    found.answers += is_answer(d);
    orders.push_back(passing_order(p, d));
    if (!p.search_forward) show_from_behind(d.design.linkage);
  }

  study::Result result;
  const ExactVerdict verdict = judge(found);
  result.status = verdict.status;
  Sentence best;
  if (found.answers > 0) {
    const SliderPathDesign& d = designs[0].design;
    best = std::isnan(d.stroke) ? Sentence("one whose crank rocks")
                                : say("one with a stroke of {}", length_by_size(d.stroke));
  }
  result.headline = found_text(found) + " " + answer_text(found, "these", best);

  Table counts{.name = "counts"};
  counts.status = {"done"};
  counts.add("classes", "finite solutions", {static_cast<double>(found.classes)});
  counts.add("real_classes", "real solutions", {static_cast<double>(found.real_classes)});
  add_design_counts(counts, found);
  add_path_counts(counts, found);
  result.tables.push_back(std::move(counts));
  result.tables.push_back(slider_design_table(designs));

  // The answers, and where they are few those that another order of the points would make one; without either
  // the nearest.
  std::vector<SliderPathDesign> drawn;
  for (std::size_t i = 0; i < designs.size() && i < SliderPathKind::max_drawn; ++i) {
    const ExactSliderDesign& d = designs[i];
    if (i >= found.answers && (i >= min_sliders_drawn || (severity(d.defects) > 1 && found.answers > 0)))
      break;
    drawn.push_back(d.design);
    add_exact_solution<SliderPathKind>(result, p, d,
                                       std::isnan(d.design.stroke)
                                           ? Sentence("the crank rocks")
                                           : say("stroke {}", length_by_size(d.design.stroke)),
                                       common.output.samples);
  }
  add_design_tables<SliderPathKind>(result, p, drawn, common.output.samples);

  result.statistics["method"] = "exact";
  result.statistics["outcome"] = verdict.outcome;
  result.statistics["completeness"] = name_of(found.completeness);
  const study::AddFact fact{result.facts};
  fact("found", say("{} of {} solutions", found.classes, found.whole),
       found.completeness == Completeness::incomplete ? study::Fact::Verdict::bad
                                                      : study::Fact::Verdict::plain);
  fact("real", say("{}", found.real_classes));
  add_design_facts(fact, found);
  const study::AddWarning warn{result.diagnostics};
  if (found.answers > 0) {
    const double pressure = designs[0].pressure_angle;
    result.facts.push_back(pressure_fact(pressure));
    warn_of_pressure(warn, pressure);
  }
  add_path_facts(fact, found);
  if (found.defect_free == 0) offer_order(warn, found, orders);
  warn_of_missing_solutions(warn, found);
  return result;
}

}  // namespace linkwright::planar
