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
#include "linkwright/core/units.h"
#include "linkwright/study/design_variables.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/run_seeds.h"
#include "linkwright/suspension/corner/hard_points.h"
#include "linkwright/suspension/corner/structure.h"
#include "linkwright/suspension/studies/corner_scene.h"
#include "linkwright/suspension/studies/direct.h"
#include "linkwright/suspension/studies/sweep.h"

namespace linkwright::suspension {
namespace {

/// A seed succeeds when it comes this close to the best of all, as a share of it.
constexpr double success_share = 1e-4;

const DirectOptions& options_of(const DirectStudy& s) {
  return std::visit([](const auto& m) -> const DirectOptions& { return m.options; }, s.optimiser.method);
}

DirectSynthesis search(const RecommendedDirect& method, const DirectTask& task, std::uint64_t seed,
                       RunContext& context) {
  return synthesise(task, method.options, seed, context);
}
DirectSynthesis search(const PublishedDirect& method, const DirectTask& task, std::uint64_t seed,
                       RunContext& context) {
  return evolve(task, method.options, seed, context, method.population, method.generations).found;
}

/// One figure for what the goal minimises. By priorities it is the largest deviation, although the order of
/// answers goes by objectives met: see better.
double cost_of(const DirectSynthesis& answer, const DirectOptions& options) {
  if (!answer.answer.assembled) return infinity;
  switch (options.goal) {
    case DirectGoal::largest:
    case DirectGoal::priorities:
      return answer.largest;
    case DirectGoal::least_squares:
      return answer.half_sum_of_squares;
    case DirectGoal::one:
      return answer.objectives.at(static_cast<std::size_t>(options.one));
  }
  return infinity;
}

/// True if `a` is the better answer.
bool better(const DirectSynthesis& a, const DirectSynthesis& b, const DirectOptions& options) {
  const bool good = a.status == Status::done, other = b.status == Status::done;
  if (good != other) return good;
  if (options.goal == DirectGoal::priorities && good) return optimise::better(a.key, b.key);
  return cost_of(a, options) < cost_of(b, options);
}

using Runs = study::SeedRuns<DirectSynthesis>;

/// A finished seed as a checkpoint saves it: the design, not what it achieves.
Value kept(const DirectSynthesis& answer) {
  Value out;
  out["status"] = study::saved_status(answer.status);
  out["shares"] = pack_numbers(answer.shares);
  out["assembled"] = answer.assembled;
  out["reached_best"] = answer.reached_best;
  out["evaluations"] = answer.evaluations;
  return out;
}

DirectSynthesis restored(const Value& value, const DirectStudy& s, std::string_view what) {
  constexpr double rounding = 1e-9;
  const std::vector<double> shares = study::load_numbers(value, "shares", s.task.designed.size(), what);
  if (!std::all_of(shares.begin(), shares.end(),
                   [](double u) { return std::abs(u - 0.5) <= 0.5 + rounding; }))
    throw CheckpointError(fmt::format("{}: its design lies outside of the ranges", what));
  DirectSynthesis out = assess(s.task, options_of(s), shares);
  out.status = study::load_status(value, what);
  out.assembled = static_cast<int>(load_integer(value, "assembled", 0, 1000000, what));
  out.reached_best = static_cast<int>(load_integer(value, "reached_best", 0, out.assembled, what));
  out.evaluations = load_integer(value, "evaluations", 0, study::max_kept_evaluations, what);
  return out;
}

std::string unit_suffix(const CornerColumn& c, TargetMeasure measure) {
  const auto parts = split_unit(c.key);
  return parts && measure != TargetMeasure::relative_change ? "_" + std::string(parts->unit->suffix)
                                                            : std::string();
}

/// "toe", "toe_change", "track_relative_change"
std::string curve_name(const CurveForm& c) {
  std::string name = study::base_of(c.column->key);
  if (c.measure != TargetMeasure::value) name += "_" + std::string(name_of(c.measure));
  return name;
}

/// The order of the study's curves among the rows of an answer, which go by objectives.
std::vector<std::vector<std::size_t>> rows_of_curves(const DirectStudy& s, const TargetPositions& positions) {
  std::vector<std::vector<std::size_t>> out(s.curves.size());
  for (std::size_t r = 0; r < positions.rows.size(); ++r) {
    const auto& row = positions.rows[r];
    const std::string& objective = s.task.objectives[row.objective].name;
    std::size_t seen = 0;
    for (std::size_t c = 0; c < s.curves.size(); ++c)
      if (s.curves[c].objective == objective && seen++ == row.curve) out[c].push_back(r);
  }
  return out;
}

/// The diagram of a target's table, against the rack if that alone moves, else against the travel.
study::Plot target_plot(const Table& table, const std::string& quantity, std::string_view words,
                        const CurveForm& c) {
  const auto varies = [](const std::vector<double>& v) {
    return std::any_of(v.begin(), v.end(), [&](double x) { return x != v.front(); });
  };
  const bool by_rack = varies(c.racks) && !varies(c.travels);
  const auto& x = by_rack ? c.racks : c.travels;
  const bool one_curve = !(varies(c.racks) && varies(c.travels)) && std::is_sorted(x.begin(), x.end());
  study::Plot plot{
      .name = table.name,
      .title = fmt::format("{} over {}: target, achieved and initial", words, by_rack ? "rack" : "travel"),
      .table = table.name,
      .x = by_rack ? "rack_m" : "travel_m",
      .y = {quantity, "target_" + quantity, "initial_" + quantity},
      .style = one_curve ? study::Plot::Style::line : study::Plot::Style::points,
      .scene = "solution-1",
      .bands = {}};
  if (one_curve) plot.bands.push_back({"lower_" + quantity, "upper_" + quantity, "tolerance"});
  return plot;
}

void add_curves(study::Result& result, const DirectStudy& s, const DirectSynthesis& best,
                const DirectSynthesis& before) {
  const auto rows = rows_of_curves(s, best.positions);
  for (std::size_t i = 0; i < s.curves.size(); ++i) {
    const CurveForm& c = s.curves[i];
    const std::string name = curve_name(c), unit = unit_suffix(*c.column, c.measure);
    const auto same = std::count_if(s.curves.begin(), s.curves.begin() + static_cast<std::ptrdiff_t>(i),
                                    [&](const CurveForm& o) { return curve_name(o) == name; });
    Table table{.name = "target-" + name + (same > 0 ? fmt::format("-{}", same + 1) : std::string())};
    std::vector<double> achieved, initial, lower, upper, deviation;
    for (std::size_t k = 0; k < c.values.size(); ++k) {
      const std::size_t row = rows[i].at(k);
      const double allowed = tolerance_of(c.tolerance, c.values[k]);
      achieved.push_back(best.answer.assembled ? best.answer.achieved[row] : WheelParameters::missing);
      initial.push_back(before.answer.assembled ? before.answer.achieved[row] : WheelParameters::missing);
      lower.push_back(c.values[k] - allowed);
      upper.push_back(c.values[k] + allowed);
      deviation.push_back((achieved.back() - c.values[k]) / allowed);
    }
    const auto add = [&](std::string key, std::string label, std::vector<double> values) {
      table.add(std::move(key), std::move(label), std::move(values));
    };
    const std::string words(words_of(*c.column));
    add("travel_m", "travel (m)", c.travels);
    add("rack_m", "rack (m)", c.racks);
    add(name + unit, words + ", achieved", achieved);
    add("target_" + name + unit, words + ", target", c.values);
    add("lower_" + name + unit, words + ", least allowed", lower);
    add("upper_" + name + unit, words + ", most allowed", upper);
    add("deviation", "deviation in tolerances", deviation);
    add("initial_" + name + unit, words + ", initial design", initial);
    // A target at one position is a row of its table, not a curve.
    if (c.values.size() > 1) result.plots.push_back(target_plot(table, name + unit, words, c));
    result.tables.push_back(std::move(table));
  }
}

/// The standard curves of a design over the travels of the targets.
Table direct_sweep_table(const DirectStudy& s, const Suspension& suspension, std::string name,
                         std::span<const double> travels) {
  Table table{.name = std::move(name)};
  const std::array<double, 1> racks{0};
  const GridPositions grid = solve_grid(prepare_suspension(suspension), s.task.driver, travels, racks);
  table.add("travel_m", "travel (m)", {travels.begin(), travels.end()});
  for (const CornerColumn& c : corner_columns()) {
    std::vector<double> values;
    for (std::size_t i = 0; i < travels.size(); ++i)
      values.push_back(value_of(c, {grid.positions[i], grid.wheels[i], s.lock}));
    if (std::any_of(values.begin(), values.end(), [](double v) { return !std::isnan(v); }))
      table.add(std::string(c.key), std::string(c.label), std::move(values));
  }
  if (std::any_of(s.curves.begin(), s.curves.end(), [](const CurveForm& c) { return c.motion; })) {
    const MotionPlan plan = prepare_motions(suspension, {});
    std::vector<MotionDerivatives> motions;
    for (const CornerPosition& p : grid.positions)
      motions.push_back(p.status == Status::done ? motion_derivatives(plan, p)
                                                 : MotionDerivatives{.status = p.status});
    for (const CurveForm& c : s.curves) {
      if (!c.motion || table.find(c.column->key)) continue;
      std::vector<double> values;
      for (const MotionDerivatives& m : motions)
        values.push_back(m.status == Status::done ? value_of(*c.motion, m.motions)
                                                  : WheelParameters::missing);
      table.add(std::string(c.column->key), std::string(c.column->label), std::move(values));
    }
  }
  for (const CornerPosition& p : grid.positions) table.status.emplace_back(to_string(p.status));
  return table;
}

struct Range1 {
  std::vector<double> travels, racks;
};
Range1 range_of(const DirectStudy& s) {
  double low = 0, high = 0;
  Range1 out;
  out.racks.push_back(0);
  for (const CurveForm& c : s.curves)
    for (std::size_t i = 0; i < c.travels.size(); ++i) {
      low = std::min(low, c.travels[i]);
      high = std::max(high, c.travels[i]);
      out.racks.push_back(c.racks[i]);
      out.racks.push_back(-c.racks[i]);  // rack displacement of the other wheel
    }
  constexpr int steps = 20;  // each way
  for (int i = -steps; i <= steps; ++i) out.travels.push_back((i < 0 ? -low : high) * i / steps);
  for (auto* values : {&out.travels, &out.racks}) {
    for (double& v : *values) v += 0.0;  // no -0
    std::sort(values->begin(), values->end());
    values->erase(std::unique(values->begin(), values->end()), values->end());
  }
  if (out.racks.size() > 41) out.racks = {out.racks.front(), 0, out.racks.back()};
  return out;
}

void add_designs(study::Result& result, const DirectStudy& s, const DirectSynthesis& best,
                 const DirectSynthesis& before) {
  const Range1 range = range_of(s);
  result.tables.push_back(direct_sweep_table(s, best.suspension, "sweep", range.travels));
  if (before.answer.assembled)
    result.tables.push_back(direct_sweep_table(s, s.task.suspension, "initial", range.travels));
  const study::AddPlot plot{result,
                            {.table = "sweep",
                             .x = "travel_m",
                             .scene = "solution-1",
                             .baseline = before.answer.assembled ? "initial" : ""}};
  for (const auto& [key, title] : std::initializer_list<std::pair<const char*, const char*>>{
           {"toe_rad", "Toe over travel"},
           {"camber_rad", "Camber over travel"},
           {"half_track_change_m", "Half-track change over travel"},
           {"roll_centre_height_m", "Roll-centre height over travel"},
           {"caster_rad", "Caster over travel"},
           {"motion_ratio", "Motion ratio of the spring over travel"},
           {"wheel_rate_N_per_m", "Wheel rate over travel"}})
    plot(std::string("sweep-") + key, title, {key});
  const GridPositions grid =
      solve_grid(prepare_suspension(best.suspension), s.task.driver, range.travels, range.racks);
  result.scenes.push_back(
      corner_scene(best.suspension, "solution-1", "the design found",
                   {s.task.driver, range.travels, range.racks, grid.positions, grid.wheels, s.lock}));
}

study::Solution solution_of(const DirectStudy& s, const DirectSynthesis& best) {
  study::Solution out;
  out.label = structure_name(structure_of(best.suspension));
  for (std::size_t i = 0; i < s.task.designed.size(); ++i) {
    const DesignVariable& d = s.task.designed[i];
    const std::string name = label(s.task.suspension, d.number);
    out.parameters.push_back({plain_name(name) + "_m", name, best.x.at(i), d.lower, d.upper});
  }
  for (std::size_t i = 0; i < best.objectives.size(); ++i)
    out.objectives[plain_name(s.task.objectives[i].name) + "_largest_deviation"] = best.objectives[i];
  out.objectives["largest_deviation"] = best.largest;
  out.objectives["half_sum_of_squares"] = best.half_sum_of_squares;
  out.classification["structure"] = to_string(out.label);
  out.classification["objectives_met"] = static_cast<std::int64_t>(
      std::count_if(best.objectives.begin(), best.objectives.end(), [](double v) { return v <= 1; }));
  out.classification["active_targets"] = static_cast<std::int64_t>(best.active.size());
  if (!best.reason.empty()) out.defects.push_back(best.reason);
  for (const LimitAnswer& l : best.limits)
    if (l.excess > 1e-9) out.defects.push_back(say("{}: missed by {}", l.name, millimetres(l.excess)));
  out.scene = best.answer.assembled ? "solution-1" : "";
  const Range1 range = range_of(s);
  out.study = sweep_of_found(s.description, best.suspension, s.task.driver, range.travels,
                             {range.racks.front(), 0, range.racks.back()}, s.lock);
  return out;
}

void add_statistics(study::Result& result, const DirectStudy& s, const Runs& runs, double best) {
  std::vector<optimise::SeedOutcome> outcomes;
  result.log = Value::array();
  Table seeds{.name = "seeds"};
  std::vector<double> number, cost, evaluations, assembled, reached;
  for (std::size_t i = 0; i < runs.answers.size(); ++i) {
    const DirectSynthesis& a = runs.answers[i];
    const double value = cost_of(a, options_of(s));
    outcomes.push_back({value, a.status == Status::done ? 0.0 : 1.0, a.evaluations});
    Value entry = study::seed_entry(runs.seeds[i], a.status, value, a.evaluations);
    entry["history"] = Value::array();
    result.log.push_back(std::move(entry));
    number.push_back(static_cast<double>(runs.seeds[i]));
    cost.push_back(std::isfinite(value) ? value : WheelParameters::missing);
    evaluations.push_back(static_cast<double>(a.evaluations));
    assembled.push_back(a.assembled);
    reached.push_back(a.reached_best);
    seeds.status.emplace_back(to_string(a.status));
  }
  seeds.add("seed", "seed", number);
  seeds.add("goal", "value of the goal", cost);
  seeds.add("evaluations", "evaluations", evaluations);
  seeds.add("starts_assembled", "starts that assembled", assembled);
  seeds.add("starts_at_best_least_squares", "of them, starts that reached the best least squares", reached);
  result.tables.push_back(std::move(seeds));
  const optimise::SeedStatistics st = optimise::statistics(outcomes, best + success_share * std::abs(best));
  result.statistics["method"] =
      std::visit([](const auto& m) { return choice_word(m).name; }, s.optimiser.method);
  result.statistics["goal"] = name_of(options_of(s).goal);
  study::write_statistics(result.statistics, st);
}

Table directions_table(const DirectStudy& s, const DirectSynthesis& best) {
  Table table{.name = "weak_directions"};
  for (const DesignVariable& d : s.task.designed) table.names.push_back(label(s.task.suspension, d.number));
  for (std::size_t k = best.singular_values.size(); k-- > 0;)
    table.add(fmt::format("direction_{}", k + 1),
              fmt::format("direction {} (share of its range), singular value {:.3g}", k + 1,
                          best.singular_values[k]),
              best.directions.at(k));
  return table;
}

}  // namespace

study::Result run_direct_study(const DirectStudy& s, const study::Common& common, RunContext& context) {
  study::Result result;
  const DirectOptions& options = options_of(s);
  const DirectSynthesis before = assess(s.task, options, s.task.suspension);
  const Runs runs = study::run_seeds(
      common.seeds, context, "designs",
      [&](std::uint64_t seed) {
        return std::visit([&](const auto& method) { return search(method, s.task, seed, context); },
                          s.optimiser.method);
      },
      [](const DirectSynthesis& answer) { return answer.status; },
      [&](const DirectSynthesis& answer) { return cost_of(answer, options); },
      [](const DirectSynthesis& answer) { return kept(answer); },
      [&](const Value& value, std::string_view what) { return restored(value, s, what); });
  result.status = runs.status;
  if (runs.answers.empty()) {
    result.headline = "Interrupted before the first seed was done.";
    return result;
  }
  const DirectSynthesis& best = *std::min_element(
      runs.answers.begin(), runs.answers.end(),
      [&](const DirectSynthesis& a, const DirectSynthesis& b) { return better(a, b, options); });
  if (result.status == Status::done) result.status = best.status;
  if (!best.answer.assembled) {
    result.headline =
        "No design found: " + (best.reason.empty() ? Sentence("no start assembles") : best.reason) + ".";
    add_statistics(result, s, runs, infinity);
    return result;
  }
  result.solutions.push_back(solution_of(s, best));
  add_curves(result, s, best, before);
  add_designs(result, s, best, before);
  result.tables.push_back(hard_point_table(points_of(best.suspension)));
  add_list_of_found(result, s.description, best.suspension);
  add_lists(result, s.lists, s.description, best.suspension);
  result.tables.push_back(directions_table(s, best));
  add_statistics(result, s, runs, cost_of(best, options));
  for (std::size_t i = 0; i < best.objectives.size(); ++i)
    result.changes.push_back(
        {.quantity = s.task.objectives[i].name,
         .label = s.task.objectives[i].name + " (tolerances)",
         .measure = "largest deviation",
         .before = before.answer.assembled ? before.objectives.at(i) : WheelParameters::missing,
         .after = best.objectives[i],
         .wanted = true});

  using Verdict = study::Fact::Verdict;
  const auto met =
      std::count_if(best.objectives.begin(), best.objectives.end(), [](double v) { return v <= 1; });
  const bool all = met == static_cast<std::ptrdiff_t>(best.objectives.size());
  result.headline = all ? say("All targets are met: the largest deviation is {} of its tolerance.",
                              plain_number(best.largest))
                        : say("{} of {} objectives are met; the largest deviation is {} tolerances.", met,
                              best.objectives.size(), plain_number(best.largest));
  for (std::size_t i = 0; i < best.objectives.size(); ++i)
    result.facts.push_back(
        {s.task.objectives[i].name + ", largest deviation",
         say("{} tolerances{}", plain_number(best.objectives[i]).fixed(6),
             before.answer.assembled ? say(" (before: {})", plain_number(before.objectives.at(i)))
                                     : Sentence()),
         best.objectives[i] <= 1 ? Verdict::good : Verdict::bad});
  result.facts.push_back({"half sum of squared deviations", plain_number(best.half_sum_of_squares).fixed(6)});
  result.facts.push_back(
      {"active targets", say("{} for {} design variables", best.active.size(), s.task.designed.size())});
  result.facts.push_back({"method", std::string(result.statistics.find("method")->as_string())});
  study::add_seed_facts(result, "runs that reached the best solution", runs.answers.size(), false);
  const study::AddWarning warn{result.diagnostics};
  if (!before.answer.assembled)
    warn(
        "the initial design does not assemble at every position of the targets: there is nothing to compare "
        "with");
  for (std::size_t i = 0; i < s.task.designed.size(); ++i) {
    const DesignVariable& d = s.task.designed[i];
    const double span = d.upper - d.lower;
    if (best.x[i] - d.lower < 1e-6 * span || d.upper - best.x[i] < 1e-6 * span)
      warn(fmt::format("{} lies at its limit, {}", label(s.task.suspension, d.number),
                       d.number.kind == DesignKind::coupler_fraction
                           ? fmt::format("{:.6g}", best.x[i])
                           : common.units.text(best.x[i], Dimension::length, 6)),
           "a larger box may give more");
  }
  study::warn_of_missing_seeds(result, runs.answers.size(), common.seeds);
  return result;
}

}  // namespace linkwright::suspension
