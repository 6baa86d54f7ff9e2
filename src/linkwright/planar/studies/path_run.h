// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/sentence.h"
#include "linkwright/optimise/minimise.h"
#include "linkwright/optimise/statistics.h"
#include "linkwright/planar/path/checkpoint.h"
#include "linkwright/planar/path/defects.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/path.h"
#include "linkwright/planar/studies/path_reached.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/result.h"
#include "linkwright/study/run_seeds.h"

// The path synthesis study of any mechanism: how it is run over its seeds and reported. D is the description
// of the mechanism.
namespace linkwright::planar {

template <class D>
using PathAnswerOf = PathAnswer<MechanismOf<typename D::Problem>>;

/// The outcome of the seeds, and the name of the method that they ran.
template <class D>
struct PathRuns : study::SeedRuns<PathAnswerOf<D>> {
  std::string method;
};

/// True if the mechanism has a second objective, so that a study may ask for a front.
template <class D>
concept HasFronts = requires(std::vector<typename D::Design> designs) {
  {D::front_of(designs)};
};

/// Least error of a seed (m2); infinite when it found no feasible design.
template <class Answer>
double best_error(const Answer& answer) {
  return answer.designs.empty() || !answer.designs[0].violations.empty() ? infinity : answer.designs[0].error;
}

/// The sum of squares of an answer (m2) as it is written: with decimals that compare, a small one by its
/// digits.
inline Measured path_error(double sum) {
  return sum >= 1e-4 ? measured("m2", sum).fixed(8) : measured("m2", sum);
}

/// A seed succeeds when its error is not above this (m2): close to the best of all seeds, or, where zero is
/// within reach, to zero, for a path of so large a size (m).
inline double success_threshold(double best, double size) {
  constexpr double share_of_best = 1e-4, of_size = 1e-12;
  return best + std::max(share_of_best * best, of_size * size * size);
}

/// The decrease of the least error of a feasible design in a population method.
inline std::vector<SearchPoint> improvements(const std::vector<optimise::GenerationLog>& log) {
  std::vector<SearchPoint> out;
  for (const optimise::GenerationLog& generation : log)
    if (generation.best_violation == 0 && (out.empty() || generation.best_cost < out.back().best))
      out.push_back({generation.evaluations, generation.best_cost});
  return out;
}

/// Ranks what the searches of a seed found, or leaves the front of it; one infeasible design when there is no
/// other.
template <class D>
void conclude(PathAnswerOf<D>& answer, bool front) {
  rank(answer.designs);
  const bool feasible = !answer.designs.empty() && answer.designs[0].violations.empty();
  if constexpr (HasFronts<D>) {
    if (front && feasible) answer.designs = D::front_of(std::move(answer.designs));
    if (front && !feasible && answer.designs.size() > 1) answer.designs.resize(1);
  }
  if (answer.status == Status::done && !feasible) answer.status = Status::infeasible;
}

/// The answer of a seed by a method that searches each branch and sense on its own: `search(what, key, name)`
/// gives the report of one search, `name` is what its checkpoint is called.
template <class D, class Search>
PathAnswerOf<D> search_each(const PathStudy<D>& s, std::uint64_t seed, Search&& search) {
  PathAnswerOf<D> out;
  std::uint32_t part = 0;
  for (const auto& what : crank_searches(s.problem)) {
    const bool first = what.branch == names(what.branch)[0].value;
    if (!first && D::one_branch_is_enough && D::searches(s.problem, names(what.branch)[0].value)) continue;
    const std::string name = fmt::format("{}/{}{}", optimise::seed_name(seed),
                                         first ? "" : fmt::format("{} ", name_of(what.branch)),
                                         what.sense > 0 ? "positive" : "negative");
    const auto report = search(what, optimise::Seed{.seed = seed, .run = part++}, name);
    if (study::is_interrupted(report.status)) out.status = report.status;
    out.evaluations += report.evaluations;
    const auto design = [&](std::span<const double> x) {
      return design_of(s.problem, what.branch, what.sense, x);
    };
    if constexpr (requires { report.x; }) {
      typename D::Design best = design(report.x);
      if (!s.front && (out.designs.empty() || better_design(best, out.designs[0])))
        out.history = improvements(report.log);
      out.designs.push_back(std::move(best));
    }
    for (const optimise::ParetoPoint& point : report.front) out.designs.push_back(design(point.x));
    if (!s.front) rank(out.designs);
  }
  conclude<D>(out, s.front);
  return out;
}

template <class D>
PathAnswerOf<D> run_seed(const Recommended& method, const PathStudy<D>& s, std::uint64_t seed, bool only_seed,
                         RunContext& context) {
  PathSynthesisOptions options = method.options;
  options.seed = seed;
  options.progress = only_seed;  // several at once are reported by the loop over them
  PathAnswerOf<D> best = synthesise_path(s.problem, options, context);
  if constexpr (HasFronts<D>)
    if (s.front && best.status == Status::done) return D::follow_front(s, std::move(best), options, context);
  return best;
}

template <class D, class Options>
PathAnswerOf<D> run_seed(const optimise::PopulationMethod<Options, optimise::Constraints::penalty>& method,
                         const PathStudy<D>& s, std::uint64_t seed, bool only_seed, RunContext& context) {
  return search_each<D>(s, seed, [&](const auto& search, const optimise::Seed& key, const std::string& name) {
    optimise::MinimiseOptions minimise = method.minimise;
    minimise.progress = only_seed;
    minimise.checkpoint = name;
    constexpr bool several = requires(optimise::Problem p) {
      optimise::make_optimiser(p.variables, method.options, key, p.objectives);
    };
    const optimise::Problem problem = D::population_problem(s, search, several, minimise);
    const auto optimiser = [&] {
      if constexpr (several)
        return optimise::make_optimiser(problem.variables, method.options, key, problem.objectives);
      else
        return optimise::make_optimiser(problem.variables, method.options, key);
    }();
    return optimise::minimise(problem, *optimiser, method.options.generations, choice_word(method).name,
                              minimise, context);
  });
}

/// Runs the seeds of a study by the method that it chose.
template <class D>
PathRuns<D> run_path_seeds(const PathStudy<D>& s, const study::Common& common, RunContext& context) {
  std::string method(std::visit([](const auto& m) { return choice_word(m).name; }, s.optimiser.method));
  const bool only_seed = common.seeds.count == 1;
  const auto run = [&](std::uint64_t seed) {
    return std::visit([&](const auto& m) { return run_seed<D>(m, s, seed, only_seed, context); },
                      s.optimiser.method);
  };
  using Answer = PathAnswerOf<D>;
  return {study::run_seeds(
              common.seeds, context, method, run, [](const Answer& answer) { return answer.status; },
              [](const Answer& answer) { return best_error(answer); },
              [](const Answer& answer) { return kept(answer); },
              [&](const Value& value, const std::string& what) { return restored(value, s.problem, what); }),
          method};
}

/// The answers of all seeds: distinct designs, best first, or the front of all. One infeasible design when
/// there is no other.
template <class D>
std::vector<typename D::Design> path_answers(const PathStudy<D>& s, const PathRuns<D>& runs) {
  using Design = typename D::Design;
  std::vector<Design> all, out;
  for (const auto& seed : runs.answers) all.insert(all.end(), seed.designs.begin(), seed.designs.end());
  if (s.no_defects)
    for (Design& d : all)
      for (const Defect& defect : defects(s.problem, d))
        d.violations.push_back({std::string(name_of(defect.kind)), 1});
  rank(all);
  if constexpr (HasFronts<D>)
    if (s.front && !all.empty() && all[0].violations.empty()) return D::front_of_seeds(std::move(all));
  const auto* recommended = std::get_if<Recommended>(&s.optimiser.method);
  const PathSynthesisOptions options = recommended ? recommended->options : PathSynthesisOptions();
  for (Design& d : all) {
    if (!out.empty() && !d.violations.empty()) break;
    keep_distinct(out, std::move(d));
  }
  keep_first(s.problem, out, static_cast<std::size_t>(options.max_solutions));
  return out;
}

/// The crank angles (rad) that a design is shown at: one turn from the first target in its sense of rotation,
/// or the interval that it reaches without being taken apart; `samples` >= 2.
template <PathMechanism M>
std::vector<double> shown_angles(const typename M::Design& design, int samples) {
  LINKWRIGHT_REQUIRE(samples >= 2, "needs at least 2 samples, got {}", samples);
  double from = design.angles[0], to = from + design.sense * 2 * pi;
  const auto reach = M::reach(design.linkage, from);
  if (reach && reach->to - reach->from < 2 * pi * (1 - 1e-12)) {
    from = design.sense > 0 ? reach->from : reach->to;
    to = design.sense > 0 ? reach->to : reach->from;
  }
  std::vector<double> out(static_cast<std::size_t>(samples));
  for (int i = 0; i < samples; ++i) out[static_cast<std::size_t>(i)] = from + (to - from) * i / (samples - 1);
  return out;
}

/// A drawing of a design in motion with the target path.
template <class D>
study::Scene path_scene(const typename D::Problem& p, const typename D::Design& d, std::string name,
                        Sentence title, int samples) {
  study::Scene scene = D::scene(d.linkage, shown_angles<D>(d, samples));
  scene.name = std::move(name);
  scene.title = std::move(title);
  add_targets(scene, p, d.angles, path_errors(p, d));
  return scene;
}

/// The motion of a design over the shown angles.
template <class D>
Table path_motion(const typename D::Design& d, std::string name, int samples) {
  Table table = D::motion(d.linkage, shown_angles<D>(d, samples));
  table.name = std::move(name);
  return table;
}

/// Root mean square of the distances of a design (m).
template <class D>
double rms(const typename D::Problem& p, const typename D::Design& d) {
  return std::sqrt(d.error / static_cast<double>(p.x.size()));
}

/// A design as the next solution of a result: numbers with their bounds, errors, classification and defects;
/// the first ones have a drawing and the study of their motion.
template <class D>
void add_path_solution(study::Result& result, const typename D::Problem& p, const typename D::Design& d,
                       Sentence label, int samples) {
  using P = typename D::Parameter;
  const std::size_t number = result.solutions.size() + 1;
  study::Solution out;
  out.label = std::move(label);
  const auto values = D::values(p, d);
  for (std::size_t j = 0; j < values.size(); ++j) {
    if (j + 1 == values.size() && !D::shows_start(p)) continue;
    const Range& range = p.bounds[j];
    double value = values[j];
    if (is_angle(P(j))) {
      const double turned = value - 2 * pi * std::floor((value - range.lower) / (2 * pi));
      if (turned <= range.upper) value = turned;
    }
    out.parameters.push_back({std::string(name(P(j))) + (is_angle(P(j)) ? "_rad" : "_m"),
                              std::string(words(P(j))[j].label), value, range.lower, range.upper});
  }
  const PathErrors errors = path_errors(p, d);
  out.objectives["path_error_sum_sq_m2"] = d.error;
  out.objectives["path_error_rms_m"] = rms<D>(p, d);
  out.objectives["path_error_max_m"] = *std::max_element(errors.excess.begin(), errors.excess.end());
  Value bounds = Value::array();
  for (const std::string& bound : d.active_bounds) bounds.push_back(bound);
  D::classify_design(p, d, std::move(bounds), out);
  for (const auto& violation : d.violations) out.defects.push_back(optimise::violation_text(violation));
  for (const Defect& defect : defects(p, d))
    out.defects.push_back(say("{}: {}", name_of(defect.kind), defect.text));
  if (number <= D::max_drawn) {
    out.scene = fmt::format("solution-{}", number);
    result.scenes.push_back(path_scene<D>(p, d, out.scene, say("{}: {}", number, out.label), samples));
    out.study = motion_study(D::key, D::analysis_form(d.linkage), shown_angles<D>(d, samples), d.angles);
  }
  result.solutions.push_back(std::move(out));
}

/// A design of an exact synthesis as the next solution: nothing bounds it, and its defects are known.
template <class D, class Exact>
void add_exact_solution(study::Result& result, const typename D::Problem& p, const Exact& exact,
                        Sentence label, int samples) {
  add_path_solution<D>(result, p, exact.design, std::move(label), samples);
  study::Solution& solution = result.solutions.back();
  for (study::Parameter& parameter : solution.parameters)
    parameter.lower = -infinity, parameter.upper = infinity;
  solution.defects.clear();
  for (const Defect& defect : exact.defects)
    solution.defects.push_back(say("{}: {}", name_of(defect.kind), defect.text));
  if (exact.defects.empty())
    for (const auto& violation : exact.design.violations)
      solution.defects.push_back(optimise::violation_text(violation));
}

/// A diagram of a motion.
struct MotionPlot {
  const char *name, *title;
  std::vector<std::string> columns;
};

/// Tables "points" and "motion" with their diagrams, of each design that has a drawing. The best design's
/// have plain names, those of the others carry the number of the solution.
template <class D>
void add_design_tables(study::Result& result, const typename D::Problem& p,
                       const std::vector<typename D::Design>& designs, int samples) {
  using Style = study::Plot::Style;
  for (std::size_t i = 0; i < std::min(designs.size(), D::max_drawn); ++i) {
    const std::string suffix = i == 0 ? "" : fmt::format("-{}", i + 1), scene = result.solutions[i].scene;
    result.tables.push_back(point_table(p, designs[i].angles, path_errors(p, designs[i]), "points" + suffix));
    result.tables.push_back(path_motion<D>(designs[i], "motion" + suffix, samples));
    const study::AddPlot of_points{
        result, {.table = "points" + suffix, .x = "crank_angle_rad", .style = Style::points, .scene = scene}},
        of_motion{result, {.table = "motion" + suffix, .x = "crank_angle_rad", .scene = scene}};
    of_points("errors" + suffix, "Distance from the target points", {"distance_m"});
    for (const MotionPlot& plot : D::motion_plots()) of_motion(plot.name + suffix, plot.title, plot.columns);
  }
}

/// The table "seeds"; `missing`: of a front, the share of the common one that each seed misses, else empty.
template <class D>
Table path_seed_table(const PathRuns<D>& runs, const std::vector<double>& missing) {
  Table seeds{.name = "seeds"};
  std::vector<double> number, error, evaluations;
  for (std::size_t i = 0; i < runs.answers.size(); ++i) {
    const auto& answer = runs.answers[i];
    const double best = best_error(answer);
    number.push_back(static_cast<double>(runs.seeds[i]));
    error.push_back(best == infinity ? nan : best);
    evaluations.push_back(static_cast<double>(answer.evaluations));
    seeds.status.emplace_back(to_string(answer.status));
  }
  seeds.add("seed", "seed", number);
  seeds.add("path_error_sum_sq_m2", "path error, sum of squares (m2)", error);
  if (!missing.empty()) seeds.add("missing", "share of the common front that is missing", missing);
  seeds.add("evaluations", "evaluations", evaluations);
  return seeds;
}

template <class D>
void add_path_statistics(study::Result& result, const PathStudy<D>& s, const PathRuns<D>& runs, double best,
                         const std::vector<double>& missing) {
  // A seed of a front succeeds when so little of what the front of all seeds dominates is missing.
  constexpr double success_of_front = 1e-3;
  std::vector<optimise::SeedOutcome> outcomes;
  result.log = Value::array();
  for (std::size_t i = 0; i < runs.answers.size(); ++i) {
    const auto& seed = runs.answers[i];
    const double error = seed.designs.empty() ? infinity : seed.designs[0].error;
    const double violation = seed.designs.empty() ? infinity : total_violation(seed.designs[0]);
    outcomes.push_back({s.front ? missing[i] : error, violation, seed.evaluations});
    Value entry = study::seed_entry(runs.seeds[i], seed.status, violation > 0 ? nan : error,
                                    seed.evaluations);  // sum of squared distances (m2)
    entry["violation"] = violation;
    if (!HasFronts<D> && !seed.designs.empty()) {
      entry["violations"] = Value::array();
      for (const auto& v : seed.designs[0].violations) entry["violations"].push_back(v.reason);
    }
    study::write_history(entry, seed.history, seed.evaluations);
    result.log.push_back(std::move(entry));
  }
  const double threshold = s.front ? success_of_front : success_threshold(best, path_size(s.problem));
  result.statistics["method"] = runs.method;
  if (HasFronts<D>)
    result.statistics["measure"] = s.front ? "share of the common front that is missing" : "path error, m2";
  study::write_statistics(result.statistics, optimise::statistics(outcomes, threshold));
}

/// Reports the best design, or the front.
template <class D>
study::Result report_path(const PathStudy<D>& s, const study::Common& common, const PathRuns<D>& runs) {
  using Verdict = study::Fact::Verdict;
  study::Result result;
  const auto& p = s.problem;
  const std::vector<typename D::Design> designs = path_answers(s, runs);
  const bool stopped = runs.status != Status::done;
  if (designs.empty()) {
    result.status = stopped ? runs.status : Status::infeasible;
    result.headline = say("No {} found: no start of the search assembles at every point.", D::words.name);
    return result;
  }
  const auto& best = designs[0];
  const bool feasible = best.violations.empty();
  result.status = stopped ? runs.status : feasible ? Status::done : Status::infeasible;
  for (const auto& d : designs) add_path_solution<D>(result, p, d, D::label(p, d), common.output.samples);

  std::vector<double> missing;
  if constexpr (HasFronts<D>)
    if (s.front) missing = D::shortfalls(runs, designs);
  add_path_statistics(result, s, runs, feasible ? best.error : infinity, missing);
  add_design_tables<D>(result, p, designs, common.output.samples);
  if constexpr (HasFronts<D>)
    if (s.front && feasible) D::add_front(result, p, designs);
  result.tables.push_back(path_seed_table<D>(runs, missing));
  D::add_cognates(result, best);
  D::add_published(result, s, designs);

  const PathErrors errors = path_errors(p, best);
  const Sentence caution = feasible ? D::caution(p, designs) : Sentence();
  if (feasible) {
    result.headline = D::headline(s, designs, errors) + caution;
  } else {
    std::string reasons;
    for (const auto& v : best.violations) reasons += (reasons.empty() ? "" : ", ") + v.reason;
    result.headline = say("No design meets every constraint; the nearest one violates {}.", reasons);
  }
  const study::AddFact fact{result.facts};
  fact(s.front ? "least path error (sum of squares)" : "path error (sum of squares)", path_error(best.error),
       !feasible         ? Verdict::bad
       : caution.empty() ? Verdict::good
                         : Verdict::plain);
  fact("root mean square distance",
       rms<D>(p, best) <= exact_share * path_size(p) ? millimetres(0) : length_by_size(rms<D>(p, best)));
  result.facts.push_back(worst_fact(p, errors));
  D::add_facts(result, s, designs);
  fact("method", runs.method);
  study::add_seed_facts(
      result, s.front ? "runs that reached the common front" : "runs that reached the best solution",
      runs.answers.size());
  study::warn_of_missing_seeds(result, runs.answers.size(), common.seeds);
  D::add_warnings(result, p, best);
  return result;
}

template <class D>
study::Result run_path_study(const PathStudy<D>& s, const study::Common& common, RunContext& context) {
  return report_path(s, common, run_path_seeds(s, common, context));
}

}  // namespace linkwright::planar
