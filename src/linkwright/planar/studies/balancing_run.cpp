// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/optimise/statistics.h"
#include "linkwright/planar/balancing/four_bar.h"
#include "linkwright/planar/studies/balancing.h"
#include "linkwright/planar/studies/four_bar_balancing.h"
#include "linkwright/planar/studies/mass_balancing.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/run_seeds.h"

namespace linkwright::planar {
namespace {

// A seed succeeds when it comes this close to the best of all seeds, relative.
constexpr double success_share = 1e-4;
// Solutions with a drawing of their own.
constexpr std::size_t max_drawn = 15;

using Runs = study::SeedRuns<BalancingRun>;

double best_cost(const BalancingRun& run) {
  return run.designs.empty() || run.designs.front().violation > 0 ? infinity : run.designs.front().cost;
}

BalancingTask task_of(const BalancingStudy& s, const std::shared_ptr<const MassStudy>& masses) {
  BalancingTask task;
  for (const study::DesignVariable& n : s.designed.numbers) {
    task.variables.push_back({n.key, n.lower, n.upper});
    task.initial.push_back(n.initial);
  }
  task.objectives = s.objectives;
  task.constraints = s.constraints;
  task.closes = closes(s);
  std::vector<std::string> columns;
  for (const BalancingGoal& o : s.objectives) columns.push_back(o.quantity);
  for (const BalancingLimit& c : s.constraints) columns.push_back(c.quantity);
  if (masses) task.table = mass_table(masses, columns);
  if (!task.table)
    task.table = [&s, columns](std::span<const double> x) { return design_table(s, x, columns); };
  return task;
}

Runs run_seeds(const BalancingStudy& s, const BalancingProblem& problem, const study::Common& common,
               const ExactBalancing& exact, RunContext& context) {
  return study::run_seeds(
      common.seeds, context, method_name(s.optimiser.method),
      [&](std::uint64_t seed) {
        return balance(problem, s.optimiser, exact, seed, optimise::seed_name(seed), common.seeds.count == 1,
                       context);
      },
      [](const BalancingRun& run) { return run.status; }, best_cost,
      [](const BalancingRun& run) { return kept(run); },
      [&](const Value& value, std::string_view what) { return restored(value, problem, s.optimiser, what); });
}

/// The answers of all seeds: the best one; of a front, the front of all.
std::vector<BalancedDesign> answers(const BalancingStudy& s, const Runs& runs) {
  std::vector<BalancedDesign> all;
  for (const BalancingRun& run : runs.answers) all.insert(all.end(), run.designs.begin(), run.designs.end());
  if (s.optimiser.combine == Combine::front) {
    std::vector<BalancedDesign> front = front_of(std::move(all));
    // Best first, by the mean of all objectives.
    std::stable_sort(front.begin(), front.end(),
                     [](const BalancedDesign& a, const BalancedDesign& b) { return a.cost < b.cost; });
    return front;
  }
  const auto best = std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return optimise::better(a.cost, a.violation, b.cost, b.violation);
  });
  return best == all.end() ? std::vector<BalancedDesign>() : std::vector<BalancedDesign>{*best};
}

Sentence change_of(double before, double after) {
  if (!(before != 0)) return "was 0";
  const double share = after / before - 1;
  return percent(share).fixed(std::abs(share) < 0.1 ? 2 : 1).with_sign();
}

// "kinetic energy (J)" and "J" of a column.
std::string label_of(const Table& table, const std::string& key) {
  const Column* c = table.find(key);
  return c && !c->label.empty() ? c->label : key;
}

// "shaking force" of "shaking_force_N", whose label is "shaking force (N)".
std::string name_of_column(const Table& table, const std::string& key) {
  std::string name = label_of(table, key);
  if (const auto unit = split_unit(key)) {
    const std::string bracket = " (" + readable_unit(unit->unit->suffix) + ")";
    if (const std::size_t at = name.find(bracket); at != std::string::npos) name.erase(at, bracket.size());
    if (name == key) name = std::string(unit->base);
  }
  return name;
}

// A value of a column, which is in SI.
Measured in_unit_of(const std::string& key, double value, int digits) {
  const auto unit = split_unit(key);
  return unit ? measured(unit->unit->suffix, value, digits).spelled() : plain_number(value, digits);
}

// "largest shaking force"
std::string name_of_measure(Measure measure, const std::string& name) {
  switch (measure) {
    case Measure::rss_over_n:
      return "root of squares over n of " + name;
    case Measure::rms:
      return "root mean square of " + name;
    case Measure::mean_abs:
      return "mean size of " + name;
    case Measure::max_abs:
      return "largest " + name;
    case Measure::maximum:
      return "maximum of " + name;
    case Measure::minimum:
      return "minimum of " + name;
    case Measure::range:
      return "range of " + name;
  }
  return name;
}

// A column is a force, torque, power or energy: what balancing is about.
bool is_load(const std::string& key) {
  const auto unit = split_unit(key);
  return unit && (unit->unit->suffix == "N" || unit->unit->suffix == "N_m" || unit->unit->suffix == "W" ||
                  unit->unit->suffix == "J");
}

// "crank mass" of "mass.crank.mass_kg".
std::string words_of(const std::string& key) {
  std::string text;
  std::size_t begin = 0;
  for (std::size_t k = 0; begin <= key.size(); ++k) {
    const std::size_t dot = std::min(key.find('.', begin), key.size());
    std::string part = key.substr(begin, dot - begin);
    begin = dot + 1;
    if ((k == 0 && dot != key.size()) || part == "attached") continue;  // the table, which says nothing new
    if (dot == key.size()) part = study::base_of(part);
    text += (text.empty() ? "" : " ") + part;
  }
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

class Report {
 public:
  Report(const BalancingStudy& s, const study::Common& common, const BalancingProblem& problem,
         const Runs& runs, RunContext& context)
      : s_(s), p_(problem), runs_(runs), designs_(answers(s, runs)) {
    if (designs_.empty()) return;
    before_ = design_analysis(s, common, p_.task.initial, context);
    after_ = design_analysis(s, common, designs_.front().x, context);
    if (before_.tables.empty() || after_.tables.empty()) {  // numbers that are good one by one, not together
      designs_.clear();
      return;
    }
    for (std::size_t i = 1; i < std::min(designs_.size(), max_drawn); ++i)
      others_.push_back(design_analysis(s, common, designs_[i].x, context));
  }

  study::Result make() {
    statistics();
    if (designs_.empty()) {
      result_.status = study::is_interrupted(runs_.status) ? runs_.status : Status::infeasible;
      result_.headline = "No design found: no candidate has an answer over the whole sweep.";
      return std::move(result_);
    }
    const bool feasible = designs_.front().violation == 0;
    result_.status = study::is_interrupted(runs_.status) ? runs_.status
                     : feasible                          ? Status::done
                                                         : Status::infeasible;
    solutions();
    scenes();
    tables();
    changes();
    plots();
    facts();
    for (const Diagnostic& d : after_.diagnostics) result_.diagnostics.push_back(d);
    return std::move(result_);
  }

 private:
  const Table& initial() const { return before_.tables.front(); }
  const Table& balanced() const { return after_.tables.front(); }

  study::Solution solution_of(const BalancedDesign& d, std::size_t number) const {
    study::Solution out;
    if (designs_.size() > 1)
      for (std::size_t k = 0; k < d.ratios.size() && k < 4; ++k)
        out.label += say("{}{}", k ? " / " : "", plain_number(d.ratios[k]).fixed(3));
    else
      out.label = "balanced";
    for (std::size_t j = 0; j < d.x.size(); ++j) {
      const optimise::Variable& v = p_.task.variables[j];
      out.parameters.push_back({v.name,
                                fmt::format("{} (initially {:.6g})", words_of(v.name), p_.task.initial[j]),
                                d.x[j], v.lower, v.upper});
    }
    out.objectives["cost"] = d.cost;
    for (std::size_t k = 0; k < d.ratios.size(); ++k) out.objectives[ratio_key(k)] = d.ratios[k];
    out.classification["active_bounds"] = Value::array();
    for (const std::string& limit : d.active) out.classification["active_bounds"].push_back(limit);
    if (d.violation > 0)
      out.defects.push_back(say("violates constraints by {}", plain_number(d.violation, 3)));
    if (number <= max_drawn) {
      out.scene = fmt::format("solution-{}", number);
      out.study = design_tables(s_, d.x);
    }
    return out;
  }
  // "O1_x_N_rss_over_n_ratio"
  std::string ratio_key(std::size_t k) const {
    const BalancingGoal& o = p_.task.objectives[k];
    return fmt::format("{}_{}_ratio", o.quantity, name_of(o.measure));
  }

  void solutions() {
    for (std::size_t i = 0; i < designs_.size(); ++i)
      result_.solutions.push_back(solution_of(designs_[i], i + 1));
  }

  void scenes() {
    const auto add = [&](const study::Result& analysis, std::string name, Sentence title) {
      if (analysis.scenes.empty()) return;
      study::Scene scene = analysis.scenes.front();
      scene.name = std::move(name);
      scene.title = std::move(title);
      result_.scenes.push_back(std::move(scene));
    };
    add(after_, "solution-1", designs_.size() > 1 ? "1: " + result_.solutions[0].label : "balanced");
    for (std::size_t i = 0; i < others_.size(); ++i)
      add(others_[i], fmt::format("solution-{}", i + 2),
          say("{}: {}", i + 2, result_.solutions[i + 1].label));
    add(before_, "initial", "initial design");
  }

  void tables() {
    Table sweep = balanced();
    sweep.name = "balanced";
    result_.tables.push_back(sweep);
    Table first = initial();
    first.name = "initial";
    result_.tables.push_back(first);
    // Both in one table, for overlays. The first column is the input.
    Table overlay{.name = "overlay", .columns{}, .status{}};
    overlay.columns.push_back(balanced().columns.front());
    for (const Column& c : balanced().columns) {
      const Column* old = initial().find(c.key);
      if (!old || !is_load(c.key) || old->values.size() != c.values.size()) continue;
      overlay.add(c.key, "balanced: " + c.label, c.values);
      overlay.add("initial_" + c.key, "initial: " + c.label, old->values);
    }
    result_.tables.push_back(std::move(overlay));
    if (designs_.size() > 1) {
      Table front{.name = "front", .columns{}, .status{}};
      std::vector<double> column(designs_.size());
      for (std::size_t i = 0; i < designs_.size(); ++i) column[i] = static_cast<double>(i + 1);
      front.add("solution", "solution", column);
      for (std::size_t k = 0; k < p_.problem.objectives; ++k) {
        for (std::size_t i = 0; i < designs_.size(); ++i) column[i] = designs_[i].ratios[k];
        front.add(ratio_key(k), goal_label(k), column);
      }
      result_.tables.push_back(std::move(front));
    }
    Table seeds{.name = "seeds", .columns{}, .status{}};
    std::vector<double> number, cost, evaluations;
    for (std::size_t i = 0; i < runs_.answers.size(); ++i) {
      const double best = best_cost(runs_.answers[i]);
      number.push_back(static_cast<double>(runs_.seeds[i]));
      cost.push_back(std::isfinite(best) ? best : nan);
      evaluations.push_back(static_cast<double>(runs_.answers[i].evaluations));
      seeds.status.emplace_back(to_string(runs_.answers[i].status));
    }
    seeds.add("seed", "seed", number);
    seeds.add("cost", "cost", cost);
    seeds.add("evaluations", "evaluations", evaluations);
    result_.tables.push_back(std::move(seeds));
  }
  std::string goal_label(std::size_t k) const {
    const BalancingGoal& o = p_.task.objectives[k];
    return name_of_measure(o.measure, name_of_column(balanced(), o.quantity)) + " over reference";
  }

  // Every load by every measure, what was asked for first.
  void changes() {
    const auto add = [&](const std::string& key, Measure m, bool wanted) {
      const Column *now = balanced().find(key), *old = initial().find(key);
      if (!now || !old) return;
      result_.changes.push_back({.quantity = key,
                                 .label = now->label,
                                 .measure = std::string(name_of(m)),
                                 .before = measure(m, old->values, p_.task.closes),
                                 .after = measure(m, now->values, p_.task.closes),
                                 .wanted = wanted});
    };
    for (const BalancingGoal& o : p_.task.objectives) add(o.quantity, o.measure, true);
    const auto asked = [&](const std::string& key, Measure m) {
      return std::any_of(p_.task.objectives.begin(), p_.task.objectives.end(),
                         [&](const BalancingGoal& o) { return o.quantity == key && o.measure == m; });
    };
    for (const Column& c : balanced().columns)
      if (is_load(c.key))
        for (Measure m : {Measure::rms, Measure::mean_abs, Measure::max_abs})
          if (!asked(c.key, m)) add(c.key, m, false);
  }

  void plots() {
    const study::AddPlot front{result_,
                               {.table = "front", .x = ratio_key(0), .style = study::Plot::Style::points}},
        plot{result_, {.table = "overlay", .x = balanced().columns.front().key, .scene = "solution-1"}};
    for (std::size_t k = 1; k < std::min<std::size_t>(p_.problem.objectives, 4); ++k)
      front(fmt::format("front-{}", k),
            "Front: " + p_.task.objectives[k].quantity + " against " + p_.task.objectives[0].quantity,
            {ratio_key(k)});
    // Loads that were asked for come first, then the others; magnitudes and components.
    std::vector<std::string> keys;
    for (const BalancingGoal& o : p_.task.objectives)
      if (std::find(keys.begin(), keys.end(), o.quantity) == keys.end()) keys.push_back(o.quantity);
    for (const Column& c : balanced().columns)
      if (is_load(c.key) && std::find(keys.begin(), keys.end(), c.key) == keys.end() && keys.size() < 24)
        keys.push_back(c.key);
    const Table& overlay = *result_.table("overlay");
    for (const std::string& key : keys)
      if (overlay.find(key)) plot("overlay-" + key, label_of(balanced(), key), {key, "initial_" + key});
    for (const std::string& key : keys) {
      if (!key.ends_with("_x_N")) continue;
      std::string other = key;
      other.replace(other.size() - 3, 1, "y");
      if (overlay.find(key) && overlay.find(other))
        plot("polar-" + key.substr(0, key.size() - 4), words_of(key.substr(0, key.size() - 4)) + ", polar",
             {key, other, "initial_" + key, "initial_" + other}, study::Plot::Style::polar);
    }
  }

  void statistics() {
    std::vector<optimise::SeedOutcome> outcomes;
    double best = infinity;
    result_.log = Value::array();
    for (std::size_t i = 0; i < runs_.answers.size(); ++i) {
      const BalancingRun& run = runs_.answers[i];
      const double cost = best_cost(run);
      best = std::min(best, cost);
      outcomes.push_back({cost, std::isfinite(cost) ? 0.0 : 1.0, run.evaluations});
      Value entry =
          study::seed_entry(runs_.seeds[i], run.status, std::isfinite(cost) ? cost : nan, run.evaluations);
      study::write_history(entry, run.history, run.evaluations);
      result_.log.push_back(std::move(entry));
    }
    const optimise::SeedStatistics st = optimise::statistics(outcomes, best * (1 + success_share));
    Value& out = result_.statistics;
    out["method"] = method_name(s_.optimiser.method);
    out["combine"] = name_of(s_.optimiser.combine);
    study::write_statistics(out, st);
  }

  void facts() {
    using Verdict = study::Fact::Verdict;
    const BalancedDesign& d = designs_.front();
    const study::AddFact fact{result_.facts};
    Sentence told;
    const std::vector<double> values = goal_values(p_.task, balanced()),
                              old = goal_values(p_.task, initial());
    for (std::size_t k = 0; k < values.size(); ++k) {
      const BalancingGoal& o = p_.task.objectives[k];
      const Sentence change = change_of(old[k], values[k]);
      const std::string name = name_of_measure(o.measure, name_of_column(balanced(), o.quantity));
      fact(name,
           say("{}, was {} ({})", in_unit_of(o.quantity, values[k], 6), in_unit_of(o.quantity, old[k], 6),
               change),
           values[k] < old[k]   ? Verdict::good
           : values[k] > old[k] ? Verdict::bad
                                : Verdict::plain);
      if (k < 3) told += say("{}{} {}", k ? ", " : "", name, change);
    }
    if (designs_.size() > 1)
      result_.headline =
          say("A front of {} designs; the one with the least mean has {}.", designs_.size(), told);
    else if (d.violation > 0)
      result_.headline = say("No design meets every constraint; the nearest one has {}.", told);
    else
      result_.headline = say("Balanced: {}{}.", told, values.size() > 3 ? " and so on" : "");
    // The cost of balancing: the drive, and mass.
    for (const Column& c : balanced().columns) {
      const Column* before = initial().find(c.key);
      const bool drive = c.key.find("drive_torque") != std::string::npos ||
                         c.key.find("drive_force") != std::string::npos ||
                         c.key.ends_with("torque_joint_N_m");
      if (!drive || !before) continue;
      const double now = max_abs(c.values), then = max_abs(before->values);
      fact(
          "largest " + name_of_column(balanced(), c.key),
          say("{}, was {} ({})", in_unit_of(c.key, now, 5), in_unit_of(c.key, then, 5), change_of(then, now)),
          now > then * 1.001 ? Verdict::bad : Verdict::plain);
    }
    double mass = 0, old_mass = 0;
    bool any = false;
    for (std::size_t j = 0; j < d.x.size(); ++j) {
      const study::DesignVariable& n = s_.designed.numbers[j];
      if (!n.unit.unit || n.unit.dimension != Dimension::mass) continue;
      any = true;
      mass += n.unit.unit->to_si(d.x[j]);
      old_mass += n.unit.unit->to_si(n.initial);
    }
    if (any)
      fact("designed masses together",
           say("{}, was {} ({})", measured("kg", mass, 5), measured("kg", old_mass, 5),
               measured("kg", mass - old_mass).with_sign()));
    const std::vector<std::string>& limits = d.active;
    if (!d.proof.empty()) fact("proof", d.proof, Verdict::good);
    if (const Sentence balance = complete_balance(); !balance.empty())
      fact("complete force balance would take", balance);
    // All, with their prices, are with the solution.
    constexpr std::size_t told_limits = 4;
    Sentence text;
    for (std::size_t i = 0; i < std::min(limits.size(), told_limits); ++i)
      text += (i ? ", " : "") + limits[i].substr(0, limits[i].find(" ("));
    if (limits.size() > told_limits) text += say(" and {} more", limits.size() - told_limits);
    fact("active bounds", text.empty() ? Sentence("none") : text).number =
        count_of(static_cast<double>(limits.size()));
    fact("method",
         fmt::format("{}, combine {}", method_name(s_.optimiser.method), name_of(s_.optimiser.combine)));
    study::add_seed_facts(result_, "runs that reached the best solution", runs_.answers.size(), false);
  }

  // The complete balance of a four-bar, in closed form: additions to the answer for a shaking force of its
  // weight alone.
  Sentence complete_balance() const {
    if (s_.mechanism->type != std::string_view("planar.four_bar")) return {};
    const FourBarMechanism m = four_bar_of(s_, designs_.front().x);
    const Counterweights w =
        balancing_counterweights(m.linkage, *m.masses, m.linkage.crank, m.linkage.rocker);
    const auto text = [](const PointMass& p) {
      return say("{} at {}, {}", measured("kg", p.mass, 3), millimetres(p.distance),
                 degrees_of(p.angle).fixed(1));
    };
    return say("crank {}, rocker {}", text(w.crank), text(w.rocker));
  }

  const BalancingStudy& s_;
  const BalancingProblem& p_;
  const Runs& runs_;
  std::vector<BalancedDesign> designs_;
  study::Result before_, after_;
  std::vector<study::Result> others_;
  study::Result result_;
};

}  // namespace

study::Result run_balancing_study(const BalancingStudy& s, const study::Common& common, RunContext& context) {
  std::string why;
  const std::shared_ptr<const MassStudy> masses = mass_study(s, why);
  BalancingProblem problem = balancing_problem(task_of(s, masses));
  if (!masses)
    if (auto fast = four_bar_problem(s, problem)) problem.problem = std::move(*fast);
  const ExactBalancing exact = masses ? exact_balancing(masses, problem, why) : ExactBalancing();
  if (!exact && std::holds_alternative<ConvexBalancing>(s.optimiser.method)) {
    study::Result refused;
    refused.status = Status::infeasible;
    refused.headline = say("This is not a convex problem: {}.", why);
    refused.diagnostics.push_back({Diagnostic::Severity::error,
                                   {},
                                   {},
                                   "optimiser.method",
                                   to_string(refused.headline),
                                   "take method = \"recommended\""});
    return refused;
  }
  // Candidates with many rows take long, and a generation or the neighbours of a gradient are many of them.
  BalancingProblem searched = problem;
  searched.problem = optimise::interruptible(std::move(searched.problem), context);
  const Runs runs = run_seeds(s, searched, common, exact, context);
  // The report is made whether or not time is left.
  RunContext unhurried;
  study::Result result = Report(s, common, problem, runs, unhurried).make();
  study::warn_of_missing_seeds(result, runs.answers.size(), common.seeds);
  return result;
}

}  // namespace linkwright::planar
