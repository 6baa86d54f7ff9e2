#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/optimise/combine.h"
#include "linkwright/optimise/statistics.h"
#include "linkwright/planar/path/checkpoint.h"
#include "linkwright/planar/path/defects.h"
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

// Name of the population of a branch and sense in the checkpoint.
std::string population_name(std::uint64_t seed, const CrankSearch<SliderSide>& search) {
  return optimise::seed_name(seed) + (search.branch == SliderSide::forward ? "/" : "/backward ") +
         (search.sense > 0 ? "positive" : "negative");
}

// The answer of a seed from what its searches came to: all of them, or the front; one infeasible design when
// there is no other.
void settle(SliderPathSynthesis& run, bool front) {
  rank(run.designs);
  const bool feasible = !run.designs.empty() && run.designs[0].violations.empty();
  if (front && feasible) run.designs = slider_front_of(std::move(run.designs));
  if (front && !feasible && run.designs.size() > 1) run.designs.resize(1);
  if (run.status == Status::done && !feasible) run.status = Status::infeasible;
}

SliderPathSynthesis run_seed(const Recommended& method, const SliderPathStudy& s, std::uint64_t seed,
                             bool only_seed, RunContext& context) {
  PathSynthesisOptions options = method.options;
  options.seed = seed;
  options.progress = only_seed;  // several at once are reported by the loop over them
  SliderPathSynthesis best = synthesise_slider_path(s.problem, options, context);
  if (!s.front || best.status != Status::done) return best;
  const double longest = best.designs[0].stroke;
  const double shortest =
      s.problem.stroke.lower > 0 ? std::min(longest, s.problem.stroke.lower) : shortest_stroke * longest;
  std::vector<double> strokes;
  for (int i = 1; i < s.optimiser.front; ++i)
    strokes.push_back(longest + (shortest - longest) * i / (s.optimiser.front - 1));
  SliderPathSynthesis front = synthesise_slider_front(s.problem, strokes, options, context);
  front.designs.push_back(std::move(best.designs[0]));
  front.evaluations += best.evaluations;
  settle(front, true);
  return front;
}

template <class Options>
SliderPathSynthesis run_seed(
    const optimise::PopulationMethod<Options, optimise::Constraints::penalty>& method,
    const SliderPathStudy& s, std::uint64_t seed, bool only_seed, RunContext& context) {
  SliderPathSynthesis out;
  std::uint32_t part = 0;
  for (const CrankSearch<SliderSide>& search : crank_searches(s.problem)) {
    const optimise::Seed key{.seed = seed, .run = part++};
    optimise::MinimiseOptions minimise = method.minimise;
    minimise.progress = only_seed;
    minimise.checkpoint = population_name(seed, search);
    optimise::Problem problem;
    std::unique_ptr<optimise::Optimiser> optimiser;
    if (s.front) {
      minimise.front = std::max<std::size_t>(4, static_cast<std::size_t>(s.optimiser.front));
      problem = slider_path_front_problem(s.problem, search.branch, search.sense, scales_of(s));
      // The front of a method of one objective is what it met on its search to the least sum.
      if constexpr (requires {
                      optimise::make_optimiser(problem.variables, method.options, key, std::size_t{2});
                    }) {
        optimiser = optimise::make_optimiser(problem.variables, method.options, key, problem.objectives);
      } else {
        const std::vector<double> both = {1, 1};  // weights are in the scales
        problem = optimise::weighted_sum(problem, both);
        optimiser = optimise::make_optimiser(problem.variables, method.options, key);
      }
    } else {
      problem = slider_path_population_problem(s.problem, search.branch, search.sense);
      optimiser = optimise::make_optimiser(problem.variables, method.options, key);
    }
    const optimise::Report report = optimise::minimise(problem, *optimiser, method.options.generations,
                                                       choice_word(method).name, minimise, context);
    if (study::is_interrupted(report.status)) out.status = report.status;
    out.evaluations += report.evaluations;
    SliderPathDesign design = slider_path_design(s.problem, search.branch, search.sense, report.x);
    if (!s.front && (out.designs.empty() || better_design(design, out.designs[0])))
      out.history = improvements(report.log);
    out.designs.push_back(std::move(design));
    for (const optimise::ParetoPoint& point : report.front)
      out.designs.push_back(slider_path_design(s.problem, search.branch, search.sense, point.x));
    if (!s.front) rank(out.designs);
  }
  settle(out, s.front);
  return out;
}

optimise::PagmoOptions pagmo(const optimise::Nsga2Options& o) {
  return {.method = optimise::PagmoMethod::nsga2, .nsga2 = o};
}
optimise::PagmoOptions pagmo(const optimise::MoeadOptions& o) {
  return {.method = optimise::PagmoMethod::moead, .moead = o};
}

template <class Options>
SliderPathSynthesis run_seed(const FrontMethod<Options>& method, const SliderPathStudy& s, std::uint64_t seed,
                             bool only_seed, RunContext& context) {
  SliderPathSynthesis out;
  std::uint32_t part = 0;
  for (const CrankSearch<SliderSide>& search : crank_searches(s.problem)) {
    optimise::FrontOptions options = method.front;
    options.progress = only_seed;
    options.checkpoint = population_name(seed, search);
    const optimise::FrontReport report = optimise::minimise_with_pagmo(
        slider_path_front_problem(s.problem, search.branch, search.sense, scales_of(s)),
        pagmo(method.options), options, {.seed = seed, .run = part++}, context);
    if (study::is_interrupted(report.status)) out.status = report.status;
    out.evaluations += report.evaluations;
    for (const optimise::ParetoPoint& point : report.front)
      out.designs.push_back(slider_path_design(s.problem, search.branch, search.sense, point.x));
  }
  settle(out, true);
  return out;
}

}  // namespace

SliderPathRuns run_slider_path_seeds(const SliderPathStudy& s, const study::Common& common,
                                     RunContext& context) {
  return run_path_seeds(s, common, context, [&](const auto& method, std::uint64_t seed, bool only_seed) {
    return run_seed(method, s, seed, only_seed, context);
  });
}

std::vector<SliderPathDesign> slider_path_answers(const SliderPathStudy& s, const SliderPathRuns& runs) {
  std::vector<SliderPathDesign> all;
  for (const SliderPathSynthesis& seed : runs.answers)
    all.insert(all.end(), seed.designs.begin(), seed.designs.end());
  if (s.no_defects)
    for (SliderPathDesign& d : all)
      for (const Defect& defect : defects(s.problem, d))
        d.violations.push_back({std::string(name_of(defect.kind)), 1});
  rank(all);
  if (all.empty()) return all;
  if (!all[0].violations.empty()) {
    all.resize(1);
    return all;
  }
  if (s.front) {
    // Designs of two seeds for one stroke differ by rounding.
    std::vector<SliderPathDesign> front;
    for (SliderPathDesign& d : slider_front_of(std::move(all)))
      if (front.empty() || front.back().stroke - d.stroke > tolerance::same_design * d.stroke ||
          d.error - front.back().error > tolerance::same_design * d.error)
        front.push_back(std::move(d));
    return front;
  }
  const auto* recommended = std::get_if<Recommended>(&s.optimiser.method);
  const PathSynthesisOptions options = recommended ? recommended->options : PathSynthesisOptions();
  std::vector<SliderPathDesign> out;
  for (SliderPathDesign& d : all) {
    if (out.size() == static_cast<std::size_t>(options.max_solutions) || !d.violations.empty()) break;
    if (std::none_of(out.begin(), out.end(), [&](const SliderPathDesign& o) {
          return o.sense == d.sense && same_linkage(o.linkage, d.linkage);
        }))
      out.push_back(std::move(d));
  }
  return out;
}

study::Result SliderPathKind::run(const SliderPathStudy& s, const study::Common& common,
                                  RunContext& context) {
  return report_slider_path(s, common, run_slider_path_seeds(s, common, context));
}

}  // namespace linkwright::planar
