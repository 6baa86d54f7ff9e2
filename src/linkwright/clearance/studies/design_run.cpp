// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/clearance/studies/design.h"
#include "linkwright/core/numbers.h"

namespace linkwright::clearance {
namespace {

struct Stage {
  Status status = Status::infeasible;
  std::vector<double> x;
  double cost = infinity;  ///< infinite when infeasible
};

// A population method on one of the two problems of the source.
template <class Method>
Stage by_population(const Method& method, const optimise::Problem& problem, const optimise::Seed& seed,
                    std::string_view stage, ClearanceDesignAnswer& out, RunContext& context) {
  const auto optimiser = optimise::make_optimiser(problem.variables, method.options, seed);
  optimise::MinimiseOptions minimise = method.minimise;
  minimise.checkpoint = fmt::format("{}/{}", optimise::seed_name(seed.seed), stage);
  optimise::Report report = optimise::minimise(problem, *optimiser, method.options.generations,
                                               choice_word(method).name, minimise, context);
  out.evaluations += report.evaluations;
  out.log = std::move(report.log);
  return {report.status, std::move(report.x), report.violation > 0 ? infinity : report.cost};
}

Stage find_lengths(const ClearanceDesignStudy& s, std::uint64_t seed, ClearanceDesignAnswer& out,
                   RunContext& context) {
  return std::visit(
      [&](const auto& method) -> Stage {
        if constexpr (std::is_same_v<std::decay_t<decltype(method)>, RecommendedDesign>) {
          ClearancePathSynthesis found =
              synthesise_clearance_path(s.path, method.starts, {.seed = seed}, context);
          out.evaluations += found.evaluations;
          out.starts = method.starts;
          out.reached = found.reached;
          const bool feasible = !found.x.empty() && found.design.violations.empty();
          return {found.status, std::move(found.x), feasible ? found.design.objective : infinity};
        } else {
          return by_population(method, clearance_path_problem(s.path), {.seed = seed}, "lengths", out,
                               context);
        }
      },
      s.method);
}

Stage find_masses(const ClearanceDesignStudy& s, const ClearanceMassProblem& problem, std::uint64_t seed,
                  ClearanceDesignAnswer& out, RunContext& context) {
  const optimise::Seed stream{.seed = seed, .run = 1};
  return std::visit(
      [&](const auto& method) -> Stage {
        if constexpr (std::is_same_v<std::decay_t<decltype(method)>, RecommendedDesign>) {
          ClearanceMassDesign found = synthesise_clearance_masses(problem, method.starts, stream, context);
          out.evaluations += found.evaluations;
          out.starts = method.starts;
          out.reached = 0;
          const bool good = !found.x.empty() && std::isfinite(found.orbit_error);
          return {found.status, std::move(found.x), good ? found.orbit_error : infinity};
        } else {
          return by_population(method, clearance_mass_problem(problem), stream, "masses", out, context);
        }
      },
      s.method);
}

ClearanceDesignAnswer answer_of(const ClearanceDesignStudy& s, std::uint64_t seed, RunContext& context) {
  ClearanceDesignAnswer out;
  ClearanceMassProblem mass = s.mass;
  if (s.has_path()) {
    Stage lengths = find_lengths(s, seed, out, context);
    out.status = lengths.status;
    out.best.lengths = std::move(lengths.x);
    out.cost = lengths.cost;
    if (s.target == DesignTarget::lengths || study::is_interrupted(out.status) || !std::isfinite(out.cost)) {
      if (s.has_masses()) out.cost = infinity;
      return out;
    }
    mass.model.linkage = clearance_path_design(s.path, out.best.lengths).model.linkage;
    out.cost = infinity;
    // The source asks for a crank that turns fully with the pin at the presumed place only.
    if (!turns_fully(mass.model)) {
      out.status = Status::infeasible;
      return out;
    }
  }
  Stage masses = find_masses(s, mass, seed, out, context);
  out.status = masses.status;
  out.best.masses = std::move(masses.x);
  if (s.target == DesignTarget::masses) {
    out.cost = masses.cost;
    return out;
  }
  if (out.best.masses.empty()) return out;
  if (s.stages == DesignStages::at_once && !study::is_interrupted(out.status)) {
    const ClearanceDesign found = design_clearance_linkage(
        s.path, mass, std::span<const double>(out.best.lengths).first(clearance_length_count),
        out.best.masses, context);
    out.evaluations += found.evaluations;
    out.status = found.status;
    out.log.clear();
    if (found.x.size() == clearance_length_count + clearance_mass_count) {
      out.best.lengths.assign(found.x.begin(), found.x.begin() + clearance_length_count);
      out.best.masses.assign(found.x.begin() + clearance_length_count, found.x.end());
    }
  }
  out.log.clear();  // log of one stage only, while the cost is of both
  const DesignMeasures measured = measure_design(s, out.best, &context);
  if (measured.repeats && std::isfinite(measured.rms)) out.cost = measured.rms;
  if (const Status why = context.interruption(); why != Status::done) out.status = why;
  return out;
}

// The turn from `start`, its rows, and where the tracing point is at the angles of the path.
void follow_turn(const ClearanceDesignStudy& s, const UniformCrank& crank, const LinkState& start,
                 std::span<const double> angles, const RunContext* context, DesignMeasures& out) {
  const double sense = std::copysign(1.0, crank.speed), period = full_turn / std::abs(crank.speed);
  const auto count = static_cast<std::size_t>(s.samples);
  std::vector<std::pair<double, std::size_t>> order;  // time; row, or after the rows the point of the path
  for (std::size_t i = 0; i < count; ++i)
    order.emplace_back(period * static_cast<double>(i) / static_cast<double>(count - 1), i);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    double way = std::fmod(sense * (angles[k] - crank.angle), full_turn);
    if (way < 0) way += full_turn;
    order.emplace_back(way / std::abs(crank.speed), count + k);
  }
  std::sort(order.begin(), order.end());
  std::vector<double> times;
  for (const auto& entry : order) times.push_back(entry.first);
  std::size_t next = 0;
  double least = infinity, weighted = 0, tension = 0;
  out.reached.assign(angles.size(), {infinity, infinity});
  out.run = simulate_clearance(
      out.model, math::ConstantSpeed{crank.angle, crank.speed}, start, times, s.mass.tolerances,
      [&](const ClearanceRow& now) {
        const std::size_t i = order[next++].second;
        if (i >= count) {
          out.reached[i - count] = now.instant->position.point;
          return true;
        }
        out.rows.push_back({now.crank.value, now.time, now.link, *now.instant});
        if (now.instant->tension < least) {
          least = now.instant->tension;
          out.least_at = now.crank.value;
        }
        if (i + 1 < count) {  // the last row is the first one of the next turn
          weighted += now.instant->tension * std::sin(now.link.angle - now.crank.value);
          tension += now.instant->tension;
        }
        return true;
      },
      context);
  out.work_mean = weighted / tension;
}

// Without masses: the clearance link at its presumed phase.
void follow_presumed(const ClearanceDesignStudy& s, DesignMeasures& out) {
  const double first = s.path.crank_angles.empty() ? 0 : s.path.crank_angles[0];
  const double sense =
      s.path.crank_angles.size() > 1 && s.path.crank_angles[1] < s.path.crank_angles[0] ? -1 : 1;
  for (int i = 0; i < s.samples; ++i) {
    DesignRow row;
    row.time = full_turn * i / (s.samples - 1);
    row.crank = first + sense * row.time;
    row.link = {row.crank + s.path.phase, sense};
    row.instant.position = clearance_position(out.model, row.crank, row.link.angle);
    row.instant.status = row.instant.position.status;
    out.rows.push_back(row);
  }
}

}  // namespace

CostName cost_name(const ClearanceDesignStudy& s) {
  if (s.target == DesignTarget::lengths) return {"path_objective_m", "path objective F1 (m)"};
  if (s.target == DesignTarget::both) return {"path_rms_m", "root mean square distance on the motion (m)"};
  return std::holds_alternative<RecommendedDesign>(s.method)
             ? CostName{"orbit_error_rad", "phase objective F2 on the periodic motion (rad)"}
             : CostName{"first_turn_error_rad", "phase objective F2 of the first turn (rad)"};
}

DesignMeasures measure_design(const ClearanceDesignStudy& s, const ClearanceDesignValues& values,
                              const RunContext* context) {
  DesignMeasures out;
  out.model = s.mass.model;
  std::vector<double> angles;
  if (s.has_path()) {
    out.presumed = clearance_path_design(s.path, values.lengths);
    out.model.linkage = out.presumed.model.linkage;
    out.model.clearance = s.path.clearance;
    angles = out.presumed.crank_angles;
  }
  const bool moves = !values.masses.empty();
  if (moves) {
    ClearanceMassProblem mass = s.mass;
    mass.model = out.model;
    out.model = with_masses(out.model, values.masses);
    out.motion = clearance_mass_design(mass, values.masses, context);
    out.repeats = out.motion.status == Status::done;
    follow_turn(s, mass.crank,
                out.repeats ? out.motion.orbit.start(mass.crank)
                            : LinkState{mass.crank.angle + mass.phase, mass.crank.speed},
                angles, context, out);
  } else {
    follow_presumed(s, out);
  }
  if (!s.has_path()) return out;
  double sum = 0;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const std::complex<double> target{s.path.x[k], s.path.y[k]};
    if (!moves)
      out.reached.push_back(clearance_position(out.model, angles[k], angles[k] + s.path.phase).point);
    const double off = std::abs(out.reached[k] - target);
    sum += off * off;
    out.largest = std::max(out.largest, off);
    constexpr int directions = 180;
    for (int i = 0; i < directions; ++i)
      out.anywhere = std::max(
          out.anywhere,
          std::abs(clearance_position(out.model, angles[k], full_turn * i / directions).point - target));
  }
  out.rms = std::sqrt(sum / static_cast<double>(angles.size()));
  return out;
}

Value kept(const ClearanceDesignAnswer& a) {
  Value out;
  out["status"] = study::saved_status(a.status);
  out["lengths"] = pack_numbers(a.best.lengths);
  out["masses"] = pack_numbers(a.best.masses);
  out["cost"] = pack_numbers({&a.cost, 1});
  out["starts"] = a.starts;
  out["reached"] = a.reached;
  out["evaluations"] = a.evaluations;
  out["log"] = study::saved_log(a.log);
  return out;
}

ClearanceDesignAnswer restored(const Value& value, const ClearanceDesignStudy& s, std::string_view what) {
  ClearanceDesignAnswer out;
  out.status = study::load_status(value, what);
  const auto numbers = [&](std::string_view key, std::size_t count) {
    const Value& packed = load_member(value, key, what);
    // A stage that found nothing, or was not come to, has none.
    return unpack_numbers(packed, what).empty() ? std::vector<double>()
                                                : study::load_numbers(value, key, count, what);
  };
  const std::size_t angles = s.path.free_timing ? s.path.x.size() : 0;
  if (s.has_path()) out.best.lengths = numbers("lengths", clearance_length_count + angles);
  if (s.has_masses()) out.best.masses = numbers("masses", clearance_mass_count);
  const std::vector<double> cost = unpack_numbers(load_member(value, "cost", what), what);
  const bool designed =
      (!s.has_path() || !out.best.lengths.empty()) && (!s.has_masses() || !out.best.masses.empty());
  if (cost.size() != 1 || std::isnan(cost[0]) || (std::isfinite(cost[0]) && !designed))
    throw CheckpointError(fmt::format("{}: its cost is none of a design", what));
  out.cost = cost[0];
  out.starts = static_cast<int>(load_integer(value, "starts", 0, 1000000, what));
  out.reached = static_cast<int>(load_integer(value, "reached", 0, 1000000, what));
  out.evaluations = load_integer(value, "evaluations", 0, study::max_kept_evaluations, what);
  out.log = study::load_log(value, what);
  return out;
}

study::Result run_clearance_design(const ClearanceDesignStudy& s, const study::Common& common,
                                   RunContext& context) {
  const ClearanceDesignRuns runs = study::run_seeds(
      common.seeds, context, "designs", [&](std::uint64_t seed) { return answer_of(s, seed, context); },
      [](const ClearanceDesignAnswer& a) { return a.status; },
      [](const ClearanceDesignAnswer& a) { return a.cost; },
      [](const ClearanceDesignAnswer& a) { return kept(a); },
      [&](const Value& value, std::string_view what) { return restored(value, s, what); });
  return report_clearance_design(s, common, runs, context);
}

}  // namespace linkwright::clearance
