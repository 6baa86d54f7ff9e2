// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/clearance/studies/design.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/study/extremes.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/run_seeds.h"

namespace linkwright::clearance {
namespace {

using Verdict = study::Fact::Verdict;
using Style = study::Plot::Style;

// A seed succeeds when it comes this close to the best of all: a share of the best, or, where zero is within
// reach, a small part of a nanometre or of a degree.
constexpr double success_share = 1e-3, success_absolute = 1e-10;

struct Variable {
  const char *key, *label;
};
constexpr std::array<Variable, clearance_length_count + clearance_mass_count> variables_of_all = {
    {{"ground_m", "ground link (m)"},
     {"crank_m", "crank (m)"},
     {"coupler_m", "coupler (m)"},
     {"rocker_m", "rocker (m)"},
     {"point_distance_m", "tracing point, distance (m)"},
     {"pivot_x_m", "crank pivot x (m)"},
     {"pivot_y_m", "crank pivot y (m)"},
     {"point_angle_rad", "tracing point, angle (rad)"},
     {"frame_angle_rad", "direction of the ground link (rad)"},
     {"coupler_mass_kg", "mass of the coupler (kg)"},
     {"coupler_u_m", "mass centre of the coupler, along (m)"},
     {"coupler_v_m", "mass centre of the coupler, across (m)"},
     {"coupler_inertia_kg_m2", "inertia of the coupler (kg m2)"},
     {"rocker_mass_kg", "mass of the rocker (kg)"},
     {"rocker_u_m", "mass centre of the rocker, along (m)"},
     {"rocker_v_m", "mass centre of the rocker, across (m)"},
     {"rocker_inertia_kg_m2", "inertia of the rocker (kg m2)"}}};

/// "at a crank angle of 123.4°".
Measured crank_angle(double angle) {
  const double rest = std::fmod(angle, full_turn);
  return at_place("crank_angle", degrees_of(rest < 0 ? rest + full_turn : rest).fixed(1));
}

class DesignReporter {
 public:
  DesignReporter(const ClearanceDesignStudy& s, const study::Common& common, const ClearanceDesignRuns& runs,
                 const RunContext& context)
      : s_(s), common_(common), runs_(runs), context_(context) {}

  study::Result report() {
    result_.status = runs_.status;
    const auto best = std::min_element(runs_.answers.begin(), runs_.answers.end(),
                                       [](const auto& a, const auto& b) { return rank(a) < rank(b); });
    study::warn_of_missing_seeds(result_, runs_.answers.size(), common_.seeds);
    if (best == runs_.answers.end() || !complete(*best)) {
      nothing_found();
      return std::move(result_);
    }
    answer_ = &*best;
    if (result_.status == Status::done) result_.status = answer_->status;
    feasible_ = std::isfinite(answer_->cost);
    if (result_.status == Status::done && !feasible_) result_.status = Status::infeasible;
    // For an interrupted search only figures that take hardly any time are computed.
    RunContext last;
    last.set_time_limit(std::chrono::milliseconds(200));
    const RunContext& limit = context_.interrupted() ? last : context_;
    d_ = measure_design(s_, answer_->best, &limit);
    if (s_.reference) before_ = measure_design(s_, *s_.reference, &limit);
    if (const Status why = limit.interruption(); why != Status::done && result_.status == Status::done)
      result_.status = why;
    solution();
    statistics();
    design_table();
    if (s_.has_path()) result_.tables.push_back(design_points(s_, d_, before_ ? &*before_ : nullptr));
    result_.tables.push_back(design_turn(s_, d_, "turn"));
    if (before_ && s_.has_masses()) result_.tables.push_back(design_turn(s_, *before_, "reference"));
    seeds_table();
    if (s_.has_masses())
      for (Table& t : design_linkage_tables(s_, d_)) result_.tables.push_back(std::move(t));
    plots();
    result_.scenes.push_back(design_scene(s_, d_));
    facts();
    changes();
    warnings();
    headline();
    return std::move(result_);
  }

 private:
  // Feasible ones by cost, then those that at least have numbers.
  static std::pair<double, int> rank(const ClearanceDesignAnswer& a) {
    return {a.cost, -static_cast<int>(a.best.lengths.size() + a.best.masses.size())};
  }
  bool complete(const ClearanceDesignAnswer& a) const {
    return (!s_.has_path() || !a.best.lengths.empty()) && (!s_.has_masses() || !a.best.masses.empty());
  }
  std::string_view method() const {
    return std::visit([](const auto& m) { return choice_word(m).name; }, s_.method);
  }
  void nothing_found() {
    if (result_.status == Status::done) result_.status = Status::infeasible;
    if (result_.status != Status::infeasible)
      result_.headline = "Interrupted before the first design.";
    else if (s_.target == DesignTarget::masses)
      result_.headline = "No masses found: none within the bounds press pin and bush together.";
    else
      result_.headline =
          "No design found: no start of the search assembles at every point and rotates its crank fully.";
  }

  // ---- what is designed
  // ---------------------------------------------------------------------------------------

  struct Number {
    Variable name;
    double value = 0, lower = 0, upper = 0, reference = nan;
  };
  std::vector<Number> numbers() const {
    std::vector<Number> out;
    const auto add = [&](std::size_t k, double value, const Range& r, const std::vector<double>* reference,
                         std::size_t at) {
      out.push_back({variables_of_all[k], value, r.lower, r.upper,
                     reference && at < reference->size() ? (*reference)[at] : nan});
    };
    if (s_.has_path())
      for (std::size_t k = 0; k < clearance_length_count; ++k)
        add(k, answer_->best.lengths[k], s_.path.bounds[k], s_.reference ? &s_.reference->lengths : nullptr,
            k);
    if (s_.has_masses())
      for (std::size_t k = 0; k < clearance_mass_count; ++k)
        add(clearance_length_count + k, answer_->best.masses[k], s_.mass.bounds[k],
            s_.reference ? &s_.reference->masses : nullptr, k);
    return out;
  }
  bool lost(const DesignMeasures& d) const { return !(d.run.min_tension > 0); }
  double separation_angle(const DesignMeasures& d) const {
    return s_.mass.crank.angle + s_.mass.crank.speed * d.run.first_separation;
  }
  struct PhaseRange {
    double low, high;  // rad
  };
  // Largest and least phase over the turn, wrapped about the wanted one.
  PhaseRange phases(const DesignMeasures& d) const {
    double low = infinity, high = -infinity;
    for (const DesignRow& r : d.rows) {
      const double phase = phase_of(s_, r);
      low = std::min(low, phase), high = std::max(high, phase);
    }
    return {low, high};
  }
  void solution() {
    study::Solution out;
    out.label = s_.target == DesignTarget::lengths  ? "lengths"
                : s_.target == DesignTarget::masses ? "masses"
                                                    : "lengths and masses";
    for (const Number& n : numbers()) {
      std::string label = n.name.label;
      out.parameters.push_back({n.name.key, label.substr(0, label.rfind(" (")), n.value, n.lower, n.upper});
    }
    out.objectives = Value::object();
    if (s_.has_path()) {
      out.objectives["path_error_rms_m"] = d_.rms;
      out.objectives["path_error_max_m"] = d_.largest;
      out.objectives["path_error_anywhere_m"] = d_.anywhere;
      out.objectives["path_objective_m"] = d_.presumed.objective;
      out.objectives["presumed_path_error_rms_m"] = d_.presumed.rms;
    }
    if (s_.has_masses()) {
      const auto [low, high] = phases(d_);
      out.objectives["orbit_error_rad"] = d_.motion.orbit_error;
      out.objectives["first_turn_error_rad"] = d_.motion.transient_error;
      out.objectives["phase_min_rad"] = low;
      out.objectives["phase_max_rad"] = high;
      out.objectives["least_tension_N"] = d_.run.min_tension;
      out.objectives["least_tension_crank_angle_rad"] = d_.least_at;
      out.objectives["separated_share"] = d_.run.separated;
      out.objectives["start_phase_rad"] = d_.rows.empty() ? nan : phase_of(s_, d_.rows[0]);
      out.objectives["start_link_rate_rad_per_s"] = d_.rows.empty() ? nan : d_.rows[0].link.rate;
    }
    out.classification = Value::object();
    out.classification["branch"] = name_of(d_.model.linkage.branch);
    out.classification["crank_rotates_fully"] = turns_fully(d_.model);
    if (s_.has_masses()) {
      out.classification["contact_kept"] = !lost(d_);
      out.classification["repeats"] = d_.repeats;
    }
    out.classification["active_bounds"] = Value::array();
    for (const Number& n : numbers()) {
      const double close = 1e-6 * (n.upper - n.lower);
      if (n.upper > n.lower && (n.value <= n.lower + close || n.value >= n.upper - close))
        out.classification["active_bounds"].push_back(n.name.key);
    }
    for (const auto& v : d_.presumed.violations) out.defects.push_back(optimise::violation_text(v));
    if (s_.has_masses() && lost(d_)) out.defects.push_back("contact is lost");
    out.scene = "motion";
    if (!d_.rows.empty()) out.study = design_study(s_, d_);
    result_.solutions.push_back(std::move(out));
  }

  void statistics() {
    std::vector<optimise::SeedOutcome> outcomes;
    result_.log = Value::array();
    for (std::size_t i = 0; i < runs_.answers.size(); ++i) {
      const ClearanceDesignAnswer& a = runs_.answers[i];
      outcomes.push_back({a.cost, std::isfinite(a.cost) ? 0.0 : 1.0, a.evaluations});
      Value entry = study::seed_entry(runs_.seeds[i], a.status, a.cost, a.evaluations);
      entry["history"] = Value::array();
      double last = infinity;
      for (const optimise::GenerationLog& g : a.log) {
        if (!(g.best_cost < last) || g.best_violation > 0) continue;
        last = g.best_cost;
        Value step;
        step["evaluations"] = g.evaluations;
        step["best"] = g.best_cost;
        entry["history"].push_back(std::move(step));
      }
      result_.log.push_back(std::move(entry));
    }
    const double best = answer_->cost;
    const optimise::SeedStatistics st =
        optimise::statistics(outcomes, best + std::max(success_share * best, success_absolute));
    Value& out = result_.statistics;
    out["method"] = method();
    out["measure"] = cost_name(s_).key;
    study::write_statistics(out, st);
  }

  // ---- tables
  // -------------------------------------------------------------------------------------------------

  void design_table() {
    Table table{.name = "design"};
    std::vector<double> value, lower, upper, reference;
    for (const Number& n : numbers()) {
      table.names.emplace_back(n.name.label);
      value.push_back(n.value);
      lower.push_back(n.lower);
      upper.push_back(n.upper);
      reference.push_back(n.reference);
    }
    table.add("value", "value (SI units)", value);
    table.add("lower", "lower bound", lower);
    table.add("upper", "upper bound", upper);
    if (s_.reference) table.add("reference", s_.reference_label, reference);
    result_.tables.push_back(std::move(table));
  }

  void seeds_table() {
    Table table{.name = "seeds"};
    std::vector<double> seed, cost, evaluations;
    for (std::size_t i = 0; i < runs_.answers.size(); ++i) {
      const ClearanceDesignAnswer& a = runs_.answers[i];
      seed.push_back(static_cast<double>(runs_.seeds[i]));
      cost.push_back(std::isfinite(a.cost) ? a.cost : nan);
      evaluations.push_back(static_cast<double>(a.evaluations));
      table.status.emplace_back(to_string(a.status));
    }
    table.add("seed", "seed", seed);
    table.add(std::string(cost_name(s_).key), std::string(cost_name(s_).words), cost);
    table.add("evaluations", "evaluations", evaluations);
    result_.tables.push_back(std::move(table));
  }

  // ---- plots and scene
  // ----------------------------------------------------------------------------------------

  void plots() {
    const std::string pale = before_ ? fmt::format(" (pale: {})", s_.reference_label) : "";
    const char* before = before_ ? "reference" : "";
    const study::AddPlot points{result_, {.table = "points", .x = "crank_angle_rad", .scene = "motion"}},
        turn{result_, {.table = "turn", .x = "crank_angle_rad", .scene = "motion", .baseline = before}},
        alone{result_, {.table = "turn", .x = "crank_angle_rad", .baseline = before}};
    points("path", "Path: targets and the points reached", {"target_x_m", "target_y_m", "x_m", "y_m"},
           Style::polar);
    points("errors", "Distance from the target points", {"distance_m", "reference_distance_m"},
           Style::points);
    if (!s_.has_masses()) return;
    turn("phase", "Phase of the clearance link from the crank" + pale, {"phase_rad", "wanted_phase_rad"});
    // Not with the scene, where the last row is the first one again: this angle is larger there by a turn.
    alone("contact-angle", "Contact angle over the turn" + pale,
          {"contact_angle_rad", "wanted_contact_angle_rad"});
    turn("tension", "Tension of the clearance link: contact while positive" + pale, {"tension_N"});
    turn("torque", "Drive torque" + pale, {"drive_torque_N_m"});
  }

  // ---- words
  // --------------------------------------------------------------------------------------------------

  Sentence contact_text(const DesignMeasures& d) const {
    if (!lost(d))
      return say("kept: minimum tension {}, at a crank angle of {}", newtons(d.run.min_tension),
                 crank_angle(d.least_at));
    return say("lost at a crank angle of {}; without contact {} of the turn, minimum tension {} at {}",
               crank_angle(separation_angle(d)), percent(d.run.separated, 3), newtons(d.run.min_tension),
               crank_angle(d.least_at));
  }
  void facts() {
    if (s_.has_path()) {
      study::Extreme worst;
      for (std::size_t k = 0; k < d_.reached.size(); ++k) worst.greatest(off(k), k);
      fact(s_.has_masses() ? "path error on the motion" : "path error with the presumed phase",
           std::isfinite(d_.rms) ? say("root mean square {}, at most {} at point {}", length_by_size(d_.rms),
                                       length_by_size(d_.largest),
                                       at_place("point", count_of(static_cast<double>(worst.row + 1))))
                                 : "not known: the motion does not reach every point",
           feasible_ ? Verdict::good : Verdict::bad);
      if (s_.has_masses())
        fact("path error with the presumed phase",
             say("root mean square {}", length_by_size(d_.presumed.rms)));
      else
        fact("path objective F1", length_by_size(d_.presumed.objective));
      fact("wherever the pin lies in its bush",
           say("at most {} off the points", length_by_size(d_.anywhere)));
    }
    fact("crank rotates fully wherever the pin lies", turns_fully(d_.model) ? "yes" : "no",
         turns_fully(d_.model) ? Verdict::good : Verdict::bad);
    if (s_.has_masses()) {
      fact("contact", contact_text(d_), lost(d_) ? Verdict::bad : Verdict::good);
      const auto [low, high] = phases(d_);
      fact("phase of the clearance link", say("{} to {} over the turn, wanted {}", degrees_of(low).fixed(2),
                                              degrees_of(high).fixed(2), degrees_of(s_.phase())));
      if (d_.repeats)
        fact("phase objective F2",
             say("{} on the periodic motion, {} in the first turn from the wanted phase",
                 measured("rad", d_.motion.orbit_error), measured("rad", d_.motion.transient_error)));
      else
        fact("phase objective F2",
             say("{} in the first turn from the wanted phase", measured("rad", d_.motion.transient_error)));
      fact("mean sine of the phase, by tension",
           say("{}: the work of the pin over a turn", plain_number(d_.work_mean, 2)));
      fact("to simulate it", "tables linkage-points, linkage-masses, linkage-start for clearance.linkage");
    }
    fact("method", std::string(method()));
    if (answer_->starts > 0 && s_.target == DesignTarget::lengths)
      fact("local searches that reached it", say("{} of {}", answer_->reached, answer_->starts));
    study::add_seed_facts(result_, "runs that reached the best solution", runs_.answers.size());
  }
  double off(std::size_t k) const {
    return std::abs(d_.reached[k] - std::complex<double>(s_.path.x[k], s_.path.y[k]));
  }

  void changes() {
    if (!before_) return;
    const auto add = [&](const char* key, const char* label, const char* measure, double before, double after,
                         bool wanted) {
      if (std::isfinite(before) && std::isfinite(after))
        result_.changes.push_back({key, label, measure, before, after, wanted});
    };
    if (s_.has_path()) {
      add("distance_m", "path error (m)", "rms", before_->rms, d_.rms, true);
      add("distance_m", "path error (m)", "max", before_->largest, d_.largest, false);
    }
    if (!s_.has_masses()) return;
    add("phase_rad", "phase objective F2 on the periodic motion (rad)", "rms", before_->motion.orbit_error,
        d_.motion.orbit_error, true);
    add("phase_rad", "phase objective F2 of the first turn (rad)", "rms", before_->motion.transient_error,
        d_.motion.transient_error, true);
    add("tension_N", "tension (N)", "min", before_->run.min_tension, d_.run.min_tension, false);
  }

  void warnings() {
    for (const auto& v : d_.presumed.violations) warn("the design " + optimise::violation_text(v));
    if (!turns_fully(d_.model))
      warn("the crank does not rotate fully with the pin anywhere in its bush",
           "lengthen coupler and rocker, or take a shorter crank");
    const bool passive = s_.target == DesignTarget::lengths || s_.stages == DesignStages::in_turn;
    if (s_.phase() > 0 && passive) {
      const double least = s_.phase() / std::sqrt(double(s_.mass.samples));
      warn(say("a constant phase of {} is impossible: over a turn of a periodic motion the pin does no "
               "work on a passive coupler in contact, so the sine of the phase, weighted by the "
               "tension, has the mean 0{}",
               degrees_of(s_.phase()),
               s_.has_masses() ? say("; no masses come far below F2 = phase / sqrt({}) = {}", s_.mass.samples,
                                     measured("rad", least))
                               : ", and the path differs from the one presumed here"),
           "masses can achieve phase_deg = 0");
    }
    if (!s_.has_masses()) return;
    if (!d_.repeats)
      warn(
          "no periodic motion was found; tables and tension are of the first turn from the wanted "
          "phase",
          "allow more mass at the clearance joint");
    if (d_.run.status != Status::done) warn(fmt::format("the turn ends early: {}", d_.run.message));
    if (lost(d_))
      warn(say("pin and bush separate at a crank angle of {} (minimum tension {} at {}): what follows is "
               "outside of the model",
               crank_angle(separation_angle(d_)), newtons(d_.run.min_tension), crank_angle(d_.least_at)),
           "simulate it with model = \"contact\", or allow a heavier coupler with its mass at the clearance "
           "joint");
  }

  void headline() {
    Sentence& text = result_.headline;
    if (!feasible_) {
      text = "No design meets every condition; the nearest one is shown.";
      return;
    }
    if (s_.has_path()) {
      text = say("The linkage passes the {} points within {} (root mean square {})", d_.reached.size(),
                 length_by_size(d_.largest), length_by_size(d_.rms));
      text += s_.has_masses() ? Sentence(d_.repeats ? " on the periodic motion" : " in the first turn")
                              : say(" if the clearance link leads the crank by {}", degrees_of(s_.phase()));
    } else {
      const auto [low, high] = phases(d_);
      text = say("The clearance link keeps within {} of its phase of {}",
                 degrees_of(std::max(high - s_.phase(), s_.phase() - low), 2), degrees_of(s_.phase()));
    }
    if (s_.has_masses())
      text += lost(d_)
                  ? say(", but pin and bush separate at a crank angle of {}: the design is outside of the "
                        "model",
                        crank_angle(separation_angle(d_)))
                  : say("; pin and bush stay in contact, with {} at least", newtons(d_.run.min_tension));
    text += ".";
  }

  const ClearanceDesignStudy& s_;
  const study::Common& common_;
  const ClearanceDesignRuns& runs_;
  const RunContext& context_;
  const ClearanceDesignAnswer* answer_ = nullptr;
  DesignMeasures d_;
  std::optional<DesignMeasures> before_;
  bool feasible_ = false;
  study::Result result_;
  const study::AddFact fact{result_.facts};
  const study::AddWarning warn{result_.diagnostics};
};

}  // namespace

study::Result report_clearance_design(const ClearanceDesignStudy& study, const study::Common& common,
                                      const ClearanceDesignRuns& runs, const RunContext& context) {
  return DesignReporter(study, common, runs, context).report();
}

}  // namespace linkwright::clearance
