// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/run_seeds.h"
#include "linkwright/suspension/corner/hard_points.h"
#include "linkwright/suspension/corner/structure.h"
#include "linkwright/suspension/indirect/corner_deviations.h"
#include "linkwright/suspension/studies/corner_scene.h"
#include "linkwright/suspension/studies/indirect.h"
#include "linkwright/suspension/studies/seven_pose_tables.h"
#include "linkwright/suspension/studies/sweep.h"

namespace linkwright::suspension {
namespace {

constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
double coordinate(const Vec3& v, std::size_t i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

/// The outcome of one seed.
struct SeedRun {
  IndirectSynthesis answer;
  double error = infinity;  ///< m, largest misfit of the joints at the prescribed positions
};

IndirectSynthesis search(const RecommendedIndirect& method, const IndirectTask& task, std::uint64_t seed,
                         bool only, RunContext& context) {
  IndirectOptions options = method.options;
  options.link.progress = options.carrier_pitch.progress = only;
  return synthesise(task, options, seed, context);
}
IndirectSynthesis search(const PublishedIndirect& method, const IndirectTask& task, std::uint64_t seed,
                         bool only, RunContext& context) {
  IndirectEvolutionOptions options = method.options;
  options.method.progress = only;
  return evolve(task, options, seed, context);
}

/// Measures an answer and turns it to the side of the suspension.
SeedRun seed_run_of(const IndirectStudy& s, IndirectSynthesis answer) {
  SeedRun out;
  out.answer = std::move(answer);
  // Measured by the equations of the mechanism, not by the fit.
  if (!has_errors(check_structure(out.answer.suspension)))
    out.error = constraint_error(out.answer.suspension, out.answer.targets).gap;
  if (s.description.suspension.side == Side::right) out.answer.suspension = mirrored(out.answer.suspension);
  return out;
}

SeedRun run_seed(const IndirectStudy& s, std::uint64_t seed, bool only, RunContext& context) {
  return seed_run_of(
      s, std::visit([&](const auto& method) { return search(method, s.task, seed, only, context); },
                    s.optimiser.method));
}

/// A link or coupler that was found, of one of these places; or none.
std::vector<double> numbers_of(const LinkFit& fit) {
  std::vector<double> out{fit.rms, fit.largest};
  for (const std::vector<Vec3>* points : {&fit.link.body, &fit.link.carrier})
    for (const Vec3& p : *points) out.insert(out.end(), {p.x, p.y, p.z});
  return out;
}
std::vector<double> numbers_of(const CouplerFit& fit) {
  const Vec3& p = fit.coupler.point;
  return {fit.rms, fit.largest, fit.offset, fit.coupler.fraction, p.x, p.y, p.z};
}

/// A finished seed as a checkpoint saves it: links, couplers and carrier pitches, not what
/// follows.
Value kept(const SeedRun& run) {
  const auto fits = [](const auto& all) {
    Value out = Value::array();
    for (const auto& fit : all) {
      Value one;
      one["status"] = study::saved_status(fit.status);
      one["numbers"] = pack_numbers(numbers_of(fit));
      if constexpr (std::is_same_v<std::decay_t<decltype(fit)>, CouplerFit>)
        one["looked_for"] = !fit.coupler.name.empty();  // not without the links that it joins
      out.push_back(std::move(one));
    }
    return out;
  };
  std::vector<double> carrier_pitches;
  for (const CarrierTarget& pose : run.answer.targets.poses)
    carrier_pitches.push_back(pose.angles.carrier_pitch);
  Value out;
  out["links"] = fits(run.answer.links);
  out["couplers"] = fits(run.answer.couplers);
  out["carrier_pitches"] = pack_numbers(carrier_pitches);
  out["evaluations"] = run.answer.evaluations;
  out["generations"] = run.answer.generations;
  return out;
}

/// Errors (not less than 0, infinite where nothing was found) and `count` finite numbers, or none.
std::vector<double> load_fit(const Value& value, std::size_t count, std::string_view what) {
  const std::vector<double> numbers = unpack_numbers(load_member(value, "numbers", what), what);
  const auto is_error = [](double e) { return e >= 0; };
  const bool sound =
      (numbers.size() == 2 || numbers.size() == 2 + count) && is_error(numbers[0]) && is_error(numbers[1]) &&
      std::all_of(numbers.begin() + 2, numbers.end(), [](double x) { return std::abs(x) < 1e6; }) &&
      (numbers.size() > 2 || std::isinf(numbers[0]));
  if (!sound)
    throw CheckpointError(fmt::format("{}: a link or coupler does not belong to this suspension", what));
  return numbers;
}

SeedRun restored(const Value& value, const IndirectStudy& s, std::string_view what) {
  IndirectSynthesis ended;
  ended.targets = s.task.targets;
  const Value &links = load_member(value, "links", what), &couplers = load_member(value, "couplers", what);
  if (!links.is_array() || links.as_array().size() != s.task.links.size() || !couplers.is_array() ||
      couplers.as_array().size() != s.task.couplers.size())
    throw CheckpointError(fmt::format("{}: is not what a seed came to", what));
  for (std::size_t l = 0; l < s.task.links.size(); ++l) {
    const LinkTask& task = s.task.links[l];
    const Value& one = links.as_array()[l];
    const std::vector<double> v = load_fit(one, 3 * (task.body.size() + task.carrier.size()), what);
    LinkFit fit{.status = study::load_status(one, what), .link = {}, .rms = v[0], .largest = v[1]};
    if (v.size() > 2) {
      fit.link.name = task.name;
      fit.link.type = task.type;
      fit.link.moved_by_rack = task.moved_by_rack;
      for (std::size_t k = 2; k < v.size(); k += 3)
        (fit.link.body.size() < task.body.size() ? fit.link.body : fit.link.carrier)
            .push_back({v[k], v[k + 1], v[k + 2]});
    }
    ended.links.push_back(std::move(fit));
  }
  for (std::size_t k = 0; k < s.task.couplers.size(); ++k) {
    const CouplerTask& task = s.task.couplers[k];
    const Value& one = couplers.as_array()[k];
    const std::vector<double> v = load_fit(one, 5, what);
    CouplerFit fit{.status = study::load_status(one, what), .coupler = {}, .rms = v[0], .largest = v[1]};
    const Value& looked_for = load_member(one, "looked_for", what);
    if (!looked_for.is_bool() || v.size() == 2)
      throw CheckpointError(fmt::format("{}: coupler '{}' is incomplete", what, task.name));
    if (looked_for.as_bool()) fit.coupler = {.name = task.name, .first = task.first, .second = task.second};
    fit.offset = v[2];
    fit.coupler.fraction = v[3];
    fit.coupler.point = {v[4], v[5], v[6]};
    ended.couplers.push_back(std::move(fit));
  }
  const std::vector<double> carrier_pitches =
      unpack_numbers(load_member(value, "carrier_pitches", what), what);
  if (carrier_pitches.size() != ended.targets.poses.size())
    throw CheckpointError(fmt::format("{}: {} carrier pitches of {} positions", what, carrier_pitches.size(),
                                      ended.targets.poses.size()));
  for (std::size_t i = 0; i < carrier_pitches.size(); ++i) {
    double& carrier_pitch = ended.targets.poses[i].angles.carrier_pitch;
    // Only those that were not prescribed were found.
    if (std::isinf(carrier_pitches[i]) || (!std::isnan(carrier_pitch) && carrier_pitch != carrier_pitches[i]))
      throw CheckpointError(
          fmt::format("{}: carrier pitch {} does not belong to this position", what, carrier_pitches[i]));
    carrier_pitch = carrier_pitches[i];
  }
  ended.evaluations = load_integer(value, "evaluations", 0, study::max_kept_evaluations, what);
  ended.generations = static_cast<int>(load_integer(value, "generations", 0, 1000000000, what));
  return seed_run_of(s, completed(s.task, ended));
}

using IndirectRuns = study::SeedRuns<SeedRun>;

/// Exact ones first, then by what the joints miss.
bool better_run(const SeedRun& a, const SeedRun& b) {
  const bool good = a.answer.status == Status::done, other = b.answer.status == Status::done;
  return good != other ? good : a.error < b.error;
}

/// Calls visit(name, point, box) for every point of the links.
template <class Visit>
void each_point(const IndirectStudy& s, const Suspension& suspension, Visit&& visit) {
  for (std::size_t i = 0; i < suspension.links.size(); ++i) {
    const CornerLink& link = suspension.links[i];
    const LinkTask& task = s.description.links[i];
    const auto one_end = [&](const std::vector<Vec3>& points, const std::vector<PointBox>& boxes,
                             std::string_view end) {
      for (std::size_t k = 0; k < points.size(); ++k)
        visit(fmt::format("{}, {}{}", link.name, end,
                          points.size() > 1 ? fmt::format(" {}", k + 1) : std::string()),
              points[k], boxes[k]);
    };
    one_end(link.body, task.body, "body");
    one_end(link.carrier, task.carrier, "carrier");
  }
  for (std::size_t i = 0; i < suspension.couplers.size() && i < s.description.couplers.size(); ++i)
    visit(suspension.couplers[i].name + ", second end", suspension.couplers[i].point,
          s.description.couplers[i].point);
}

/// The study that analyses the wheel at the prescribed positions, by their travels and racks.
Value study_of(const IndirectStudy& s, const Suspension& suspension) {
  std::vector<double> travels{0}, racks{0};
  for (const CarrierTarget& t : s.task.targets.poses) {
    travels.push_back(t.centre.z - s.task.targets.wheel.centre.z);
    racks.push_back(t.rack);
  }
  return sweep_of_found(s.description, suspension, Driver::wheel_centre_z, std::move(travels),
                        std::move(racks), Driver::wheel_centre_z);
}

study::Solution solution_of(const IndirectStudy& s, const SeedRun& run, std::string scene) {
  study::Solution out;
  out.label = structure_name(structure_of(run.answer.suspension));
  each_point(s, run.answer.suspension, [&](const std::string& name, const Vec3& at, const PointBox& box) {
    for (std::size_t i = 0; i < 3; ++i)
      out.parameters.push_back({fmt::format("{}_{}_m", plain_name(name), axes[i]),
                                fmt::format("{} {}", name, axes[i]), coordinate(at, i),
                                coordinate(box.lower, i), coordinate(box.upper, i)});
  });
  out.objectives["max_constraint_error_m"] = run.error;
  out.objectives["max_structural_error_m"] = run.answer.largest;
  out.classification["structure"] = to_string(out.label);
  out.classification["status"] = to_string(run.answer.status);
  for (const Diagnostic& d : run.answer.findings)
    if (d.severity == Diagnostic::Severity::error) out.defects.push_back(d.message);
  if (!scene.empty()) out.study = study_of(s, run.answer.suspension);
  out.scene = std::move(scene);
  return out;
}

/// Prescribed positions and what the wheel does there at the height and rack of each.
Table poses_table(const CarrierTargets& targets, const Suspension& left) {
  Table table{.name = "poses"};
  const CornerPlan plan = prepare_suspension(left);
  const CornerPosition reference = reference_position(plan);
  const std::array<std::pair<const char*, const char*>, 6> keys{{{"centre_x_m", "wheel centre x"},
                                                                 {"centre_y_m", "wheel centre y"},
                                                                 {"centre_z_m", "wheel centre z"},
                                                                 {"toe_rad", "toe"},
                                                                 {"camber_rad", "camber"},
                                                                 {"carrier_pitch_rad", "carrier pitch"}}};
  std::vector<std::vector<double>> columns(2 + 3 * keys.size());
  for (const CarrierTarget& t : targets.poses) {
    const double travel = t.centre.z - targets.wheel.centre.z;
    const CornerPosition p = reference.status == Status::done
                                 ? solve_position(plan, Driver::wheel_centre_z, {travel, t.rack}, reference)
                                 : reference;
    const WheelAngles a = wheel_angles(Side::left, left.wheel, p.place.carrier.rotation);
    const Vec3 c = p.place.carrier.centre;
    const std::array<double, 6> wanted{t.centre.x,   t.centre.y,      t.centre.z,
                                       t.angles.toe, t.angles.camber, t.angles.carrier_pitch};
    const std::array<double, 6> got{c.x, c.y, c.z, a.toe, a.camber, a.carrier_pitch};
    columns[0].push_back(travel);
    columns[1].push_back(t.rack);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const double now = p.status == Status::done ? got[i] : WheelParameters::missing;
      columns[2 + i].push_back(now);
      columns[2 + keys.size() + i].push_back(wanted[i]);
      columns[2 + 2 * keys.size() + i].push_back(now - wanted[i]);
    }
    table.status.emplace_back(to_string(p.status));
  }
  const auto add = [&](std::string key, std::string label, std::size_t i) {
    table.add(std::move(key), std::move(label), columns[i]);
  };
  add("travel_m", "travel (m)", 0);
  add("rack_m", "rack (m)", 1);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::string key = keys[i].first, name = keys[i].second, unit = i < 3 ? " (m)" : " (rad)";
    add(key, name + unit, 2 + i);
    add("prescribed_" + key, "prescribed " + name + unit, 2 + keys.size() + i);
    add("deviation_" + key, "deviation of " + name + unit, 2 + 2 * keys.size() + i);
  }
  return table;
}

/// A table of how well the positions determine each link.
Table conditioning_table(const IndirectStudy& s, const SeedRun& run) {
  Table table{.name = "conditioning"};
  std::vector<double> rms, largest, strongest, weakest;
  for (std::size_t i = 0; i < s.task.links.size() && i < run.answer.links.size(); ++i) {
    const LinkFit& fit = run.answer.links[i];
    table.names.push_back(s.task.links[i].name);
    rms.push_back(fit.rms);
    largest.push_back(fit.largest);
    double most = WheelParameters::missing, least = most;
    if (carrier_pitch_is_given(run.answer.targets) && std::isfinite(fit.rms)) {
      const LinkConditioning c = conditioning(run.answer.targets, s.task.links[i], fit.link);
      if (!c.singular_values.empty()) most = c.singular_values.front(), least = c.singular_values.back();
    }
    strongest.push_back(most);
    weakest.push_back(least);
  }
  table.add("structural_error_rms_m", "structural error, root mean square (m)", rms);
  table.add("structural_error_max_m", "structural error, largest (m)", largest);
  table.add("largest_singular_value", "largest singular value (error by coordinate)", strongest);
  table.add("smallest_singular_value",
            "smallest singular value: errors of positions move points by its inverse", weakest);
  return table;
}

Table seeds_table(const IndirectRuns& runs) {
  Table table{.name = "seeds"};
  std::vector<double> seed, error, evaluations;
  for (std::size_t i = 0; i < runs.answers.size(); ++i) {
    const SeedRun& r = runs.answers[i];
    seed.push_back(static_cast<double>(runs.seeds[i]));
    error.push_back(std::isfinite(r.error) ? r.error : WheelParameters::missing);
    evaluations.push_back(static_cast<double>(r.answer.evaluations));
    table.status.emplace_back(to_string(r.answer.status));
  }
  table.add("seed", "seed", seed);
  table.add("max_constraint_error_m", "largest constraint error (m)", error);
  table.add("evaluations", "evaluations", evaluations);
  return table;
}

study::Scene scene_of(const IndirectStudy& s, const Suspension& suspension, const std::string& name) {
  double low = 0, high = 0;
  std::vector<double> racks{0};
  const double height = s.task.targets.wheel.centre.z;
  for (const CarrierTarget& t : s.task.targets.poses) {
    low = std::min(low, t.centre.z - height);
    high = std::max(high, t.centre.z - height);
    if (racks.size() < 41) racks.push_back(t.rack);
  }
  std::sort(racks.begin(), racks.end());
  racks.erase(std::unique(racks.begin(), racks.end()), racks.end());
  std::vector<double> travels;
  constexpr int steps = 20;  // each way
  for (int i = -steps; i <= steps; ++i) travels.push_back((i < 0 ? -low : high) * i / steps);
  travels.erase(std::unique(travels.begin(), travels.end()), travels.end());
  const GridPositions grid =
      solve_grid(prepare_suspension(suspension), Driver::wheel_centre_z, travels, racks);
  return corner_scene(
      suspension, name, "wheel travel and rack",
      {Driver::wheel_centre_z, travels, racks, grid.positions, grid.wheels, Driver::wheel_centre_z});
}

void add_statistics(study::Result& result, const IndirectStudy& s, const IndirectRuns& runs) {
  std::vector<optimise::SeedOutcome> outcomes;
  result.log = Value::array();
  for (std::size_t i = 0; i < runs.answers.size(); ++i) {
    const SeedRun& r = runs.answers[i];
    const bool good = r.answer.status == Status::done;
    outcomes.push_back({r.error, good ? 0.0 : 1.0, r.answer.evaluations});
    Value entry = study::seed_entry(runs.seeds[i], r.answer.status, r.error, r.answer.evaluations);
    if (r.answer.generations > 0) entry["generations"] = r.answer.generations;
    entry["history"] = Value::array();
    result.log.push_back(std::move(entry));
  }
  const optimise::SeedStatistics st = optimise::statistics(outcomes, infinity);
  result.statistics["method"] =
      std::visit([](const auto& m) { return choice_word(m).name; }, s.optimiser.method);
  study::write_statistics(result.statistics, st);
}

/// The root mean square within which a link counts as found (m).
double exact_tolerance(const IndirectStudy& s) {
  if (const auto* published = std::get_if<PublishedIndirect>(&s.optimiser.method))
    return published->options.tolerance;
  const IndirectOptions& options = std::get<RecommendedIndirect>(s.optimiser.method).options;
  return carrier_pitch_is_given(s.task.targets) ? options.link.tolerance : options.carrier_pitch.tolerance;
}

/// The largest root mean square of the structural errors of links and couplers (m); infinite where one is not
/// found.
double largest_rms(const IndirectSynthesis& answer) {
  double out = 0;
  for (const LinkFit& fit : answer.links) out = std::max(out, fit.rms);
  for (const CouplerFit& fit : answer.couplers) out = std::max(out, fit.rms);
  return out;
}

/// The least tolerance of two digits that accepts this error, in mm.
double accepting_millimetres(double rms) {
  const double mm = rms * 1e3, step = std::pow(10.0, std::floor(std::log10(mm)) - 1);
  return std::ceil(mm / step) * step;
}

/// Names the coordinates that end at a face of their box.
void warn_of_boxes(study::Result& result, const IndirectStudy& s, const Suspension& suspension,
                   const study::Common& common) {
  constexpr double at_face = 1e-6;  // as a share of the edge
  const study::AddWarning warn{result.diagnostics};
  each_point(s, suspension, [&](const std::string& name, const Vec3& at, const PointBox& box) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double low = coordinate(box.lower, i), high = coordinate(box.upper, i), x = coordinate(at, i);
      if (!(high > low) || (x - low > at_face * (high - low) && high - x > at_face * (high - low))) continue;
      warn(fmt::format("{}: {} lies at the {} face of its box, {}", name, axes[i],
                       x - low < high - x ? "lower" : "upper", common.units.text(x, Dimension::length, 6)),
           "a larger box may give less error");
    }
  });
}

Measured error_of(double value) { return value >= 1e-3 ? millimetres(value) : metres(value, 2); }

}  // namespace

study::Result run_indirect_study(const IndirectStudy& s, const study::Common& common, RunContext& context) {
  study::Result result;
  const IndirectRuns runs = study::run_seeds(
      common.seeds, context, "links",
      [&](std::uint64_t seed) { return run_seed(s, seed, common.seeds.count == 1, context); },
      [](const SeedRun& run) { return run.answer.status; }, [](const SeedRun& run) { return run.error; },
      [](const SeedRun& run) { return kept(run); },
      [&](const Value& value, std::string_view what) { return restored(value, s, what); });
  result.status = runs.status;
  if (runs.answers.empty()) {
    result.headline = "Interrupted before the first seed was done.";
    return result;
  }
  const SeedRun& best = *std::min_element(runs.answers.begin(), runs.answers.end(), better_run);
  const Suspension& suspension = best.answer.suspension;
  const bool assembled = std::isfinite(best.error);
  if (result.status == Status::done) result.status = best.answer.status;
  add_statistics(result, s, runs);
  const std::string scene = assembled ? "solution-1" : "";
  result.solutions.push_back(solution_of(s, best, scene));
  if (assembled) {
    const Suspension left = suspension.side == Side::left ? suspension : mirrored(suspension);
    result.tables.push_back(poses_table(best.answer.targets, left));
    result.scenes.push_back(scene_of(s, suspension, scene));
    const study::AddPlot deviations{result,
                                    {.table = "poses", .x = "travel_m", .style = study::Plot::Style::points}};
    deviations("place-deviations", "Deviations of the wheel centre from the prescribed positions",
               {"deviation_centre_x_m", "deviation_centre_y_m"});
    deviations("angle-deviations", "Deviations of the angles from the prescribed positions",
               {"deviation_toe_rad", "deviation_camber_rad", "deviation_carrier_pitch_rad"});
  }
  result.tables.push_back(hard_point_table(points_of(suspension)));
  add_list_of_found(result, s.description, suspension);
  add_lists(result, s.lists, s.description, suspension);
  result.tables.push_back(conditioning_table(s, best));
  result.tables.push_back(seeds_table(runs));

  using Verdict = study::Fact::Verdict;
  const bool good = best.answer.status == Status::done;
  const std::size_t poses = s.task.targets.poses.size();
  result.headline =
      good ? say("A {} wheel suspension reaches all {} positions; its joints miss them by at most {}.",
                 structure_name(structure_of(suspension)), poses, error_of(best.error))
      : assembled && best.answer.status == Status::not_converged
          ? say("The best {} wheel suspension within the boxes misses the {} positions by at most {}: no "
                "links there take them exactly.",
                structure_name(structure_of(suspension)), poses, error_of(best.error))
      : assembled
          ? say("No exact wheel suspension found ({}): the best one misses the {} positions by at most {}.",
                to_string(best.answer.status), poses, error_of(best.error))
          : say("No wheel suspension found ({}).", to_string(best.answer.status));
  result.facts = {
      {"largest constraint error at the positions", assembled ? Sentence(error_of(best.error)) : "-",
       good ? Verdict::good : Verdict::bad},
      {"structure", structure_name(structure_of(suspension))},
      {"positions", say("{} (at least {} determine the links)", poses, plain_number(best.answer.fewest, 2))},
      {"method", std::string(result.statistics.find("method")->as_string())}};
  study::add_seed_facts(result, "seeds that found exact links", runs.answers.size());
  if (carrier_pitch_is_given(best.answer.targets)) add_seven_poses(result, s, best.answer.targets);
  for (const Diagnostic& d : best.answer.findings) {
    Diagnostic remark = d;
    remark.severity = Diagnostic::Severity::warning;
    result.diagnostics.push_back(std::move(remark));
  }
  if (!carrier_pitch_is_given(s.task.targets))
    study::AddWarning{result.diagnostics}(
        "the positions do not prescribe the carrier pitch: many suspensions move the wheel alike, this is "
        "one "
        "of them");
  if (const double rms = largest_rms(best.answer);
      best.answer.status == Status::not_converged && std::isfinite(rms) && rms > exact_tolerance(s))
    study::AddWarning{result.diagnostics}(
        say("the links are the best in the sense of least squares: they miss the positions by {} (root mean "
            "square), a link counts as exact within {}",
            error_of(rms), error_of(exact_tolerance(s))),
        fmt::format("measured positions have errors of their own: {} accepts these links",
                    std::holds_alternative<RecommendedIndirect>(s.optimiser.method) &&
                            !carrier_pitch_is_given(s.task.targets)
                        ? fmt::format("unknown_carrier_pitch = {{ tolerance_mm = {:.6g} }} in [optimiser]",
                                      accepting_millimetres(rms))
                        : fmt::format("tolerance_mm = {:.6g} in [optimiser]", accepting_millimetres(rms))));
  if (assembled) warn_of_boxes(result, s, suspension, common);
  study::warn_of_missing_seeds(result, runs.answers.size(), common.seeds);
  return result;
}

}  // namespace linkwright::suspension
