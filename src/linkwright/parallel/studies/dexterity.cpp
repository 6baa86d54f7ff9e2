// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/dexterity.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <variant>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/parallel/studies/robot_scene.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/run_seeds.h"

namespace linkwright::parallel {
namespace {

struct Answer {
  Status status = Status::infeasible;
  DexterityDesign best;
  std::vector<double> between_nodes;
  double worst_between_nodes = std::nan("");
  std::int64_t evaluations = 0;
  int starts = 0, reached_best = 0;
  std::vector<optimise::GenerationLog> log;
};
using Runs = study::SeedRuns<Answer>;

bool larger_is_better(DexterityGoal goal) { return goal != DexterityGoal::size; }
/// The cost to be minimised.
double cost_of(DexterityGoal goal, const Answer& a) {
  if (a.best.x.empty() || a.best.violation > 0) return infinity;
  return larger_is_better(goal) ? -a.best.objective : a.best.objective;
}

Answer answer_of(const DexterityStudy& s, std::uint64_t seed, RunContext& context) {
  Answer out;
  if (const auto* recommended = std::get_if<RecommendedDexterity>(&s.method)) {
    DexteritySynthesis found = synthesise(s.task, recommended->options, seed, context);
    out.status = found.status;
    out.best = std::move(found.best);
    out.between_nodes = std::move(found.between_nodes);
    out.worst_between_nodes = found.worst_between_nodes;
    out.evaluations = found.evaluations;
    out.starts = static_cast<int>(found.starts.size());
    out.reached_best = found.reached_best;
    return out;
  }
  std::visit(
      [&](const auto& method) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(method)>, RecommendedDexterity>) {
          const optimise::Problem problem = population_problem(s.task, &context);
          const auto optimiser = optimise::make_optimiser(problem.variables, method.options, {.seed = seed});
          optimise::MinimiseOptions minimise = method.minimise;
          minimise.checkpoint = optimise::seed_name(seed) + "/population";
          optimise::Report report = optimise::minimise(problem, *optimiser, method.options.generations,
                                                       choice_word(method).name, minimise, context);
          if (report.violation < infinity) out.best = assess(s.task, report.x);
          out.status = report.status == Status::done ? out.best.status : report.status;
          out.evaluations = report.evaluations;
          out.log = std::move(report.log);
        }
      },
      s.method);
  return out;
}

/// A finished seed as a checkpoint saves it: the design variables, not what they achieve.
Value kept(const Answer& a) {
  Value out;
  out["status"] = study::saved_status(a.status);
  out["x"] = pack_numbers(a.best.x);
  out["between_nodes"] = pack_numbers(a.between_nodes);
  out["worst_between_nodes"] = pack_numbers({&a.worst_between_nodes, 1});
  out["starts"] = a.starts;
  out["reached_best"] = a.reached_best;
  out["evaluations"] = a.evaluations;
  out["log"] = study::saved_log(a.log);
  return out;
}

Answer restored(const Value& value, const DexterityStudy& s, std::string_view what) {
  Answer out;
  out.status = study::load_status(value, what);
  if (!unpack_numbers(load_member(value, "x", what), what).empty()) {
    const std::vector<optimise::Variable> variables = design_variables(s.task);
    const std::vector<double> x = study::load_numbers(value, "x", variables.size(), what);
    for (std::size_t j = 0; j < x.size(); ++j)
      if (!(x[j] >= variables[j].lower && x[j] <= variables[j].upper))
        throw CheckpointError(fmt::format("{}: {} is {}, out of its range", what, variables[j].name, x[j]));
    out.best = assess(s.task, x);
  }
  // NaN where nothing was looked for between the nodes.
  out.between_nodes = unpack_numbers(load_member(value, "between_nodes", what), what);
  const std::vector<double> worst = unpack_numbers(load_member(value, "worst_between_nodes", what), what);
  if (worst.size() != 1 || out.between_nodes.size() > out.best.limits.size())
    throw CheckpointError(fmt::format("{}: what lies between the nodes is missing", what));
  out.worst_between_nodes = worst[0];
  out.starts = static_cast<int>(load_integer(value, "starts", 0, 1000000, what));
  out.reached_best = static_cast<int>(load_integer(value, "reached_best", 0, out.starts, what));
  out.evaluations = load_integer(value, "evaluations", 0, study::max_kept_evaluations, what);
  out.log = study::load_log(value, what);
  return out;
}

Table limits_table(const Answer& a) {
  Table table{.name = "limits"};
  std::vector<double> value, bound, between, active, x, y, z;
  for (std::size_t i = 0; i < a.best.limits.size(); ++i) {
    const DexterityStand& l = a.best.limits[i];
    for (const auto& entry : names(DexterityLimit{}))
      if (entry.value == l.limit)
        table.names.emplace_back(fmt::format("{}, {}", entry.summary, l.at_least ? "at least" : "at most"));
    value.push_back(l.value);
    bound.push_back(l.bound);
    between.push_back(i < a.between_nodes.size() ? a.between_nodes[i] : std::nan(""));
    active.push_back(l.active);
    x.push_back(l.place.x);
    y.push_back(l.place.y);
    z.push_back(l.place.z);
  }
  table.add("value", "value (SI units)", value);
  table.add("bound", "limit", bound);
  table.add("between_nodes", "worst between the nodes", between);
  table.add("active", "active", active);
  table.add("x_m", "closest at x (m)", x);
  table.add("y_m", "closest at y (m)", y);
  table.add("z_m", "closest at z (m)", z);
  return table;
}

Table seeds_table(const DexterityStudy& s, const Runs& runs) {
  Table table{.name = "seeds"};
  std::vector<double> seed, objective, evaluations;
  for (std::size_t i = 0; i < runs.answers.size(); ++i) {
    const Answer& a = runs.answers[i];
    seed.push_back(static_cast<double>(runs.seeds[i]));
    objective.push_back(std::isfinite(cost_of(s.task.goal, a)) ? a.best.objective : std::nan(""));
    evaluations.push_back(static_cast<double>(a.evaluations));
    table.status.emplace_back(to_string(a.status));
  }
  table.add("seed", "seed", seed);
  table.add("objective", "objective", objective);
  table.add("evaluations", "designs looked at", evaluations);
  return table;
}

void add_statistics(study::Result& result, const DexterityStudy& s, const Runs& runs, double best) {
  std::vector<optimise::SeedOutcome> outcomes;
  result.log = Value::array();
  for (std::size_t i = 0; i < runs.answers.size(); ++i) {
    const Answer& a = runs.answers[i];
    const double cost = cost_of(s.task.goal, a);
    outcomes.push_back({cost, std::isfinite(cost) ? 0.0 : 1.0, a.evaluations});
    Value entry = study::seed_entry(runs.seeds[i], a.status, cost, a.evaluations);
    Value history = Value::array();
    double last = infinity;
    for (const optimise::GenerationLog& g : a.log) {
      if (!(g.best_cost < last)) continue;
      last = g.best_cost;
      Value step;
      step["evaluations"] = g.evaluations;
      step["best"] = g.best_cost;
      history.push_back(std::move(step));
    }
    entry["history"] = std::move(history);
    result.log.push_back(std::move(entry));
  }
  const optimise::SeedStatistics st = optimise::statistics(outcomes, best + 1e-6 * std::abs(best));
  result.statistics["method"] = std::visit([](const auto& m) { return choice_word(m).name; }, s.method);
  study::write_statistics(result.statistics, st, larger_is_better(s.task.goal) ? -1 : 1);
}

/// A place of the whole region by shares of its coordinates, in base axes (m).
Vec3 place_in(const PrescribedRegion& region, const Vec3& origin, const std::array<double, 3>& part) {
  PrescribedRegion whole = region;
  whole.symmetric = false;
  std::array<double, 3> at{};
  for (int k = 0; k < coordinates(whole.shape); ++k) {
    const CoordinateRange r = coordinate_range(whole, k);
    const auto i = static_cast<std::size_t>(k);
    at[i] = r.lower + (r.upper - r.lower) * part[i];
  }
  return origin + place(whole, at);
}

/// The middle of the region: polar coordinates begin there.
Vec3 middle(const PrescribedRegion& region, const Vec3& origin) {
  const bool polar = region.shape == RegionShape::cylinder || region.shape == RegionShape::circle;
  return place_in(region, origin, {polar ? 0 : 0.5, polar ? 0 : 0.5, 0.5});
}

Value mechanism_of(const DexterityStudy& s, const DexterityDesign& best) {
  Value out;
  const auto take = [&](const auto& form) {
    out["type"] = fmt::format("parallel.{}", name_of(s.task.family));
    Value written = study::write_fields(form);
    for (Value::Member& member : written.as_object()) out[member.key] = std::move(member.value);
  };
  const std::vector<double>& of = best.x;  // dimensions of the family come first
  switch (s.task.family) {
    case RobotFamily::delta:
      // Only the difference of the radii matters: all of it is at the base.
      take(DeltaForm{.base_radius = of[0], .platform_radius = 0, .arm = of[1], .rod = of[2], .legs = {}});
      break;
    case RobotFamily::hexa:
      take(HexaForm{{.base_radius = of[0],
                     .base_offset = of[1],
                     .platform_radius = of[2],
                     .platform_angle = of[3],
                     .arm = of[4],
                     .rod = of[5]}});
      break;
    case RobotFamily::five_bar:
      take(PlanarForm{{{.base = {-of[0], 0}, .arm = of[1], .rod = of[2], .platform = {}},
                       {.base = {of[0], 0}, .arm = of[1], .rod = of[2], .platform = {}}}});
      break;
  }
  out["working_mode"] = Value::array();
  for (int i = 0; i < best.robot.legs(); ++i) {
    out["working_mode"].push_back(static_cast<std::int64_t>(s.task.mode[i]));
    if (!s.task.pi_joint) continue;
    const Drive& d = best.drives[static_cast<std::size_t>(i)];
    Value drive;
    drive["type"] = name_of(d.type);
    drive["ratio"] = d.ratio;
    drive["mounting_rad"] = d.mounting;
    drive["mirrored"] = d.mirror < 0;
    out["drive"].push_back(std::move(drive));
  }
  return out;
}

/// The robot at home in the middle of the region, with that pose and the worst one; null when it does not
/// reach them.
Value study_of(const DexterityStudy& s, const DexterityDesign& best) {
  const Vec3 centre = middle(s.task.region, best.origin);
  Value out;
  out["mechanism"] = mechanism_of(s, best);
  out["home"]["position_m"] = Value(std::vector<double>{centre.x, centre.y, centre.z});
  for (const auto& [name, at] : {std::pair{"middle of the region", centre}, {"worst", best.worst_place}}) {
    if (inverse(best.robot, Pose{at}, s.task.mode).status != Status::done) return {};
    Value pose;
    pose["name"] = name;
    pose["position_m"] = Value(std::vector<double>{at.x, at.y, at.z});
    out["pose"].push_back(std::move(pose));
  }
  return out;
}

study::Solution solution_of(const DexterityStudy& s, const Answer& a) {
  study::Solution out{.label = std::string(name_of(s.task.family))};
  const auto variables = design_variables(s.task);
  for (std::size_t i = 0; i < a.best.x.size() && i < variables.size(); ++i)
    out.parameters.push_back(
        {variables[i].name, variables[i].name, a.best.x[i], variables[i].lower, variables[i].upper});
  out.objectives["objective"] = a.best.objective;
  out.objectives["worst_conditioning"] = a.best.worst;
  out.objectives["mean_conditioning"] = a.best.mean;
  out.objectives["size_m"] = a.best.size;
  out.objectives["violation"] = a.best.violation;
  out.classification = Value::object();
  if (!a.best.reason.empty()) out.defects.push_back(a.best.reason);
  out.scene = "region";
  out.study = study_of(s, a.best);
  return out;
}

/// The robot with its tool going round the rim of the region.
study::Scene scene_of(const DexterityStudy& s, const DexterityDesign& best) {
  std::vector<Vec3> way;
  const auto corner = [&](double first, double second, double third) {
    return place_in(s.task.region, best.origin, {first, second, third});
  };
  constexpr int steps = 60;
  for (const double depth : {0.0, 1.0})
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      switch (s.task.region.shape) {
        case RegionShape::cylinder:
          way.push_back(corner(1, t, depth));
          break;
        case RegionShape::circle:
          way.push_back(corner(1, t, 0));
          break;
        case RegionShape::box:
        case RegionShape::rectangle: {
          const double side = 4 * t;
          const auto ramp = [](double x) { return std::clamp(x, 0.0, 1.0); };
          const double x = ramp(side) - ramp(side - 2), y = ramp(side - 1) - ramp(side - 3);
          way.push_back(corner(x, y, depth));
          break;
        }
      }
    }
  std::vector<RobotSample> samples;
  std::vector<double> length;
  double sum = 0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (i > 0) sum += std::max(1e-9, norm(way[i] - way[i - 1]));
    const Pose pose{way[i]};
    const ArmAngles angles = inverse(best.robot, pose, s.task.mode);
    samples.push_back({angles.status, pose, angles.angle});
    length.push_back(sum);
  }
  return robot_scene(best.robot, best.drives,
                     {"region", "around the region", "distance_m", "distance along the rim"}, length,
                     samples);
}

Sentence objective_text(DexterityGoal goal, double value) {
  if (goal == DexterityGoal::size) return say("arm and rod {} together", millimetres(value));
  return say("{} conditioning index {}", goal == DexterityGoal::mean ? "mean" : "minimum",
             plain_number(value).fixed(6));
}

}  // namespace

study::Result run_dexterity_study(const DexterityStudy& s, const study::Common& common, RunContext& context) {
  study::Result result;
  const Runs runs = study::run_seeds(
      common.seeds, context, "designs", [&](std::uint64_t seed) { return answer_of(s, seed, context); },
      [](const Answer& a) { return a.status; }, [&](const Answer& a) { return cost_of(s.task.goal, a); },
      [](const Answer& a) { return kept(a); },
      [&](const Value& value, std::string_view what) { return restored(value, s, what); });
  result.status = runs.status;
  const auto better = [&](const Answer& a, const Answer& b) {
    const double first = cost_of(s.task.goal, a), second = cost_of(s.task.goal, b);
    return first != second ? first < second : a.best.violation < b.best.violation;
  };
  const auto found = std::min_element(runs.answers.begin(), runs.answers.end(), better);
  if (found == runs.answers.end() || found->best.x.empty()) {
    result.headline = "Interrupted before the first design.";
    return result;
  }
  const Answer& a = *found;
  if (result.status == Status::done) result.status = a.status;
  add_statistics(result, s, runs, cost_of(s.task.goal, a));
  result.solutions.push_back(solution_of(s, a));
  result.tables.push_back(limits_table(a));
  result.tables.push_back(seeds_table(s, runs));
  using Verdict = study::Fact::Verdict;
  const bool good = a.best.status == Status::done;
  const study::AddFact fact{result.facts};
  const auto variables = design_variables(s.task);
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const bool angle = variables[i].name.ends_with("_rad"), length = variables[i].name.ends_with("_m");
    std::string label = variables[i].name.substr(0, variables[i].name.size() - (angle ? 4 : length ? 2 : 0));
    std::replace(label.begin(), label.end(), '_', ' ');
    fact(std::move(label), angle    ? degrees_of(a.best.x[i]).fixed(4)
                           : length ? millimetres(a.best.x[i]).fixed(3)
                                    : plain_number(a.best.x[i]).fixed(5));
  }
  fact("minimum conditioning index", plain_number(a.best.worst).fixed(6));
  fact("mean conditioning index", plain_number(a.best.mean).fixed(6));
  fact("arm and rod together", millimetres(a.best.size).fixed(3));
  fact("arm angles used",
       say("{} to {}", degrees_of(a.best.arm_lowest).fixed(2), degrees_of(a.best.arm_highest).fixed(2)));
  if (s.task.pi_joint)
    fact("diagonals used", [&] {
      const Drive& d = a.best.drives[0];
      const PiJoint joint{a.best.robot.leg[0].arm, d.ratio};
      return say("{} to {}", millimetres(diagonal(joint, d.lowest)).fixed(3).sharing_unit(),
                 millimetres(diagonal(joint, d.highest)).fixed(3));
    }());
  if (s.task.family == RobotFamily::delta)
    for (const DexterityStand& l : a.best.limits)
      if (l.limit == DexterityLimit::constraint)
        fact("minimum constraint index", plain_number(l.value).fixed(6),
             l.excess <= 0 || l.active ? Verdict::good : Verdict::bad);
  if (s.transmission_put_in)
    fact("limit put in",
         "transmission index at least 0.3: without a limit of conditioning or transmission the "
         "smallest robot is a singular one");
  BodyProof proof;
  if (good) {
    proof = prove_region(s.task, a.best);
    fact("whole region free of singularities",
         proof.proven     ? "proven, also between the nodes"
         : proof.violated ? say("no: at {} the constraint index misses its limit, or it is singular",
                                coordinates_of(*proof.violated))
                          : say("not proven within {} poses; the nodes are", proof.looks),
         proof.proven     ? Verdict::good
         : proof.violated ? Verdict::bad
                          : Verdict::plain);
    if (proof.violated && result.status == Status::done) result.status = Status::infeasible;
  }
  std::string held;
  for (const DexterityStand& l : a.best.limits)
    if (l.active) held += fmt::format("{}{}", held.empty() ? "" : ", ", name_of(l.limit));
  if (!held.empty()) fact("held back by", held);
  if (a.starts > 0) fact("local searches that reached it", say("{} of {}", a.reached_best, a.starts));
  if (runs.answers.size() > 1)
    fact("runs that reached it", study::successful_seeds(result, runs.answers.size()));
  result.scenes.push_back(scene_of(s, a.best));
  result.headline =
      proof.violated ? say("The best design misses the constraint index, or is singular, between the nodes, "
                           "at {}: ask for more nodes.",
                           coordinates_of(*proof.violated))
      : good
          ? say("Best {} found: {}.", name_of(s.task.family), objective_text(s.task.goal, a.best.objective))
          : say("No design meets every limit: {}.", a.best.reason);
  return result;
}

}  // namespace linkwright::parallel
