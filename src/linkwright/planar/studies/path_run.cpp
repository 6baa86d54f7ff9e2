#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/core/units.h"
#include "linkwright/math/angles.h"
#include "linkwright/optimise/statistics.h"
#include "linkwright/planar/four_bar/classify.h"
#include "linkwright/planar/four_bar/cognates.h"
#include "linkwright/planar/path/checkpoint.h"
#include "linkwright/planar/path/defects.h"
#include "linkwright/planar/path/four_bar/eighteen_points.h"
#include "linkwright/planar/path/four_bar/usability.h"
#include "linkwright/planar/studies/four_bar_path.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/path_reached.h"
#include "linkwright/planar/studies/path_scene.h"
#include "linkwright/planar/studies/path_seeds.h"
#include "linkwright/planar/studies/path_solution.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/run_seeds.h"

namespace linkwright::planar {
namespace {

using Runs = PathRuns<PathSynthesis>;

PathSynthesis run_seed(const Recommended& method, const FourBarPathStudy& s, std::uint64_t seed,
                       bool only_seed, RunContext& context) {
  PathSynthesisOptions options = method.options;
  options.seed = seed;
  options.progress = only_seed;  // several at once are reported by the loop over them
  return synthesise_path(s.problem, options, context);
}

template <class Options>
PathSynthesis run_seed(const optimise::PopulationMethod<Options, optimise::Constraints::penalty>& method,
                       const FourBarPathStudy& s, std::uint64_t seed, bool only_seed, RunContext& context) {
  PathSynthesis out;
  std::uint32_t part = 0;
  for (double sense : {1.0, -1.0}) {
    if (!(sense > 0 ? s.problem.search_positive : s.problem.search_negative)) continue;
    // One branch is enough: the cognate on the other one has the same crank angles and the same error.
    const Branch branch = s.problem.search_open ? Branch::open : Branch::crossed;
    const optimise::Problem problem = path_population_problem(s.problem, branch, sense);
    optimise::MinimiseOptions minimise = method.minimise;
    minimise.progress = only_seed;
    minimise.checkpoint = optimise::seed_name(seed) + (sense > 0 ? "/positive" : "/negative");
    const auto optimiser =
        optimise::make_optimiser(problem.variables, method.options, {.seed = seed, .run = part++});
    const optimise::Report report = optimise::minimise(problem, *optimiser, method.options.generations,
                                                       choice_word(method).name, minimise, context);
    if (study::is_interrupted(report.status)) out.status = report.status;
    PathDesign design = path_design(s.problem, branch, sense, report.x);
    if (out.designs.empty() || optimise::better(design.error, total_violation(design), out.designs[0].error,
                                                total_violation(out.designs[0])))
      out.history = improvements(report.log);
    out.designs.push_back(std::move(design));
    out.evaluations += report.evaluations;
  }
  rank(out.designs);
  if (out.status == Status::done && !out.designs[0].violations.empty()) out.status = Status::infeasible;
  return out;
}

// Distinct designs of all seeds, best first.
std::vector<PathDesign> distinct_designs(const FourBarPathStudy& s, const Runs& runs) {
  std::vector<PathDesign> all;
  for (const PathSynthesis& seed : runs.answers)
    all.insert(all.end(), seed.designs.begin(), seed.designs.end());
  if (s.no_defects)
    for (PathDesign& d : all)
      for (const Defect& defect : defects(s.problem, d))
        d.violations.push_back({std::string(name_of(defect.kind)), 1});
  rank(all);
  const auto* recommended = std::get_if<Recommended>(&s.optimiser.method);
  const PathSynthesisOptions options = recommended ? recommended->options : PathSynthesisOptions();
  const auto most = static_cast<std::size_t>(options.max_solutions);
  std::vector<PathDesign> out;
  for (PathDesign& d : all) {
    if (!out.empty() && !d.violations.empty()) break;  // one infeasible answer only when there is no other
    if (!std::any_of(out.begin(), out.end(), [&](const PathDesign& o) {
          return o.sense == d.sense && same_linkage(o.linkage, d.linkage);
        }))
      out.push_back(std::move(d));
  }
  keep_first(s.problem, out, most);
  return out;
}

void add_statistics(study::Result& result, const Runs& runs, double best, double size) {
  std::vector<optimise::SeedOutcome> outcomes;
  result.log = Value::array();
  for (std::size_t i = 0; i < runs.answers.size(); ++i) {
    const PathSynthesis& seed = runs.answers[i];
    const double error = seed.designs.empty() ? infinity : seed.designs[0].error;
    const double violation = seed.designs.empty() ? infinity : total_violation(seed.designs[0]);
    outcomes.push_back({error, violation, seed.evaluations});
    Value entry = study::seed_entry(runs.seeds[i], seed.status, violation > 0 ? nan : error,
                                    seed.evaluations);  // sum of squared distances (m2)
    entry["violation"] = violation;
    if (!seed.designs.empty()) {
      entry["violations"] = Value::array();
      for (const auto& v : seed.designs[0].violations) entry["violations"].push_back(v.reason);
    }
    study::write_history(entry, seed.history, seed.evaluations);
    result.log.push_back(std::move(entry));
  }
  const optimise::SeedStatistics st = optimise::statistics(outcomes, success_threshold(best, size));
  Value& out = result.statistics;
  out["method"] = runs.method;
  study::write_statistics(out, st);
}

bool is_eighteen_points(const FourBarPathStudy& s) {
  const PathProblem known = eighteen_points();
  const PathTiming& timing = s.target.timing;
  return s.problem.x == known.x && s.problem.y == known.y && timing.mode == Timing::equal_steps &&
         std::abs(*timing.step - known.step) < 1e-12;
}

void add_published(study::Result& result, const FourBarPathStudy& s, double best) {
  if (!is_eighteen_points(s)) return;
  const PathProblem& p = s.problem;
  const std::string source = "Boskovic 2018, Table 4.1";
  for (const PublishedPathDesign& published : eighteen_point_designs()) {
    std::vector<double> angles;
    for (std::size_t k = 0; k < p.x.size(); ++k) angles.push_back(published.start_angle + point_angle(p, k));
    const double ours = measure(p, published.linkage, 1, angles).error;
    result.comparisons.push_back({published.label + ", design re-evaluated", source,
                                  published.published_error, ours, published.verdict, published.note});
  }
  constexpr double published_best = 0.00908, best_known = 0.009028884631;
  if (std::isfinite(best)) {
    const bool better = best < published_best, equal = std::abs(best - best_known) <= 1e-7;
    result.comparisons.push_back({"best of this study", source, published_best, best,
                                  better ? "improved" : "not reached",
                                  equal ? "the best design known: both branches, joined by a timed cognate"
                                        : fmt::format("the best design known has {:.9f}", best_known)});
  }
}

std::string_view short_name(DrawbackKind kind) {
  switch (kind) {
    case DrawbackKind::transmission:
      return "low transmission angle";
    case DrawbackKind::crowded:
      return "crowded points";
    case DrawbackKind::bound:
      return "a link at its bound";
    case DrawbackKind::locks:
      return "locks at both ends";
  }
  return {};
}

// The reason why the best design is of little use, and the design that is better in use; empty = it is
// usable.
Sentence caution(const PathProblem& p, const std::vector<PathDesign>& designs) {
  Sentence out;
  for (const Drawback& drawback : drawbacks(p, designs[0]))
    out += (out.empty() ? " But " : "; ") + drawback.text;
  if (out.empty()) return out;
  for (std::size_t i = 1; i < designs.size(); ++i)
    if (drawbacks(p, designs[i]).empty())
      return say("{}. The best one without such drawbacks is solution {}, a {}: it {}.", out, i + 1,
                 called(designs[i]), how_near(p, path_errors(p, designs[i]), designs[i].error));
  return out + ". No design without such drawbacks was found.";
}

void warn_of_transmission(study::Result& result, const PathProblem& p, const PathDesign& d) {
  const double mu = judged_transmission(p, d), limit = math::degrees(p.min_transmission_angle);
  if (math::degrees(mu) >= 20) return;
  study::AddWarning{result.diagnostics}(
      say("the transmission angle falls to {}{}: the linkage transmits force badly there",
          degrees_of(mu).fixed(1),
          p.closed                ? ""
          : p.crank_rotates_fully ? " over the full turn"
                                  : " on the path"),
      limit > 0 ? say("raise the limit of [[constraint]] type = \"transmission_angle\": min_deg is {}",
                      plain_number(limit, 6))
                : "limit it: [[constraint]] type = \"transmission_angle\", min_deg = 30");
}

void add_cognates(study::Result& result, const PathDesign& best) {
  Table table{.name = "cognates"};
  FourBar numbers;
  fields(
      [&](const Field& field, double&) {
        const std::string key = si_key(field.key, field.dimension);
        table.add(key, key);
      },
      numbers);
  table.add("same_timing", "same_timing");
  const auto row = [&](FourBar l, bool same_timing) {
    std::size_t i = 0;
    fields([&](const Field&, double& value) { table.columns[i++].values.push_back(value); }, l);
    table.columns[i].values.push_back(same_timing ? 1.0 : 0.0);
  };
  row(best.linkage, true);
  for (const Cognate& cognate : cognates(best.linkage, best.angles[0]))
    row(cognate.linkage, cognate.same_timing);
  result.tables.push_back(std::move(table));
}

}  // namespace

study::Result FourBarPathKind::run(const FourBarPathStudy& s, const study::Common& common,
                                   RunContext& context) {
  study::Result result;
  const Runs runs =
      run_path_seeds(s, common, context, [&](const auto& method, std::uint64_t seed, bool only_seed) {
        return run_seed(method, s, seed, only_seed, context);
      });
  const std::vector<PathDesign> designs = distinct_designs(s, runs);
  if (designs.empty()) {
    result.status = runs.status == Status::done ? Status::infeasible : runs.status;
    result.headline = "No four-bar found: no start of the search assembles at every point.";
    return result;
  }
  const PathDesign& best = designs[0];
  const bool feasible = best.violations.empty();
  result.status = runs.status != Status::done ? runs.status : feasible ? Status::done : Status::infeasible;

  for (std::size_t i = 0; i < designs.size(); ++i) {
    result.solutions.push_back(path_solution(s.problem, designs[i], i + 1, common.output.samples));
    result.scenes.push_back(path_scene(s.problem, designs[i], result.solutions[i].scene,
                                       say("{}: {}", i + 1, result.solutions[i].label),
                                       common.output.samples));
  }
  add_statistics(result, runs, feasible ? best.error : infinity, path_size(s.problem));
  add_design_tables(result, s.problem, designs, common.output.samples);
  result.tables.push_back(path_seed_table(runs, {}));
  add_cognates(result, best);
  add_published(result, s, feasible ? best.error : infinity);

  const double rms = std::sqrt(best.error / static_cast<double>(s.problem.x.size()));
  const PathErrors errors = path_errors(s.problem, best);
  using Verdict = study::Fact::Verdict;
  const Sentence but = feasible ? caution(s.problem, designs) : Sentence();
  if (feasible) {
    result.headline = say("A {} {}.{}", called(best), how_near(s.problem, errors, best.error), but);
  } else {
    std::string reasons;
    for (const auto& v : best.violations) reasons += (reasons.empty() ? "" : ", ") + v.reason;
    result.headline = say("No design meets every constraint; the nearest one violates {}.", reasons);
  }
  result.facts = {
      {"path error (sum of squares)", path_error(best.error),
       !feasible     ? Verdict::bad
       : but.empty() ? Verdict::good
                     : Verdict::plain},
      {"root mean square distance",
       rms <= exact_share * path_size(s.problem) ? millimetres(0) : length_by_size(rms)},
      worst_fact(s.problem, errors),
      {"type", result.solutions[0].label},
      transmission_fact(s.problem, best),
      {"method", runs.method},
  };
  study::add_seed_facts(result, "runs that reached the best solution", runs.answers.size());
  study::warn_of_missing_seeds(result, runs.answers.size(), common.seeds);
  if (!but.empty()) {
    std::string names;
    for (const Drawback& drawback : drawbacks(s.problem, best)) {
      const std::string name(short_name(drawback.kind));
      if (names.find(name) == std::string::npos) names += (names.empty() ? "" : ", ") + name;
    }
    result.facts.push_back({"drawbacks", names, Verdict::bad});
  }
  warn_of_transmission(result, s.problem, best);
  return result;
}

}  // namespace linkwright::planar
