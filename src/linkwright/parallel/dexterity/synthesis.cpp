// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/dexterity/synthesis.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/parallel/dexterity/detail/synthesis_search.h"

namespace linkwright::parallel {
namespace {

constexpr int round_starts = 4;  ///< between looks at what was found
/// Number of poses in a draw: so many are worth a look at the context.
constexpr std::size_t many_poses = 1000;

struct Drawn {
  std::vector<double> unknowns;
  double cost = 0, violation = 0;
};

/// A design drawn at random, at a few of the nodes; what follows from its dimensions is not left to chance.
Drawn draw(const DexterityModel& model, std::uint64_t seed, int index, DexterityModel::Work& work) {
  RandomStream random({.seed = seed, .individual = static_cast<std::uint32_t>(index)});
  const DexterityTask& task = model.task();
  std::vector<double> x;
  for (const DesignRange& range : task.dimensions) x.push_back(random.uniform(range.lower, range.upper));
  const DesignedRobot designed = model.designed(x);
  const Extremes extremes = model.extremes(designed, work, true);
  if (task.pi_joint) {
    const double ratio = random.uniform(task.pi_joint->ratio.lower, task.pi_joint->ratio.upper);
    const auto [low, high] = model.travel(extremes);
    const double half = std::min((high - low) / 2, pi / 2);
    const double mounting = (low + high) / 2 - task.pi_joint->mirror * best_centre({1, ratio}, half);
    x.push_back(std::clamp(mounting, task.pi_joint->mounting.lower, task.pi_joint->mounting.upper));
    x.push_back(ratio);
  }
  Drawn out{.unknowns = model.unknowns_of(x, extremes)};
  const double mean = task.goal == DexterityGoal::mean ? extremes.conditioning.value : 0;
  out.cost = model.cost(out.unknowns, extremes, mean);
  out.violation = model.violation(x, extremes);
  return out;
}

/// True if this is the limit of a leg that does not reach a node.
bool is_out_of_reach(const DexterityStand& stand) {
  return (stand.limit == DexterityLimit::reach || stand.limit == DexterityLimit::input) && stand.value < 0;
}

Sentence described(const DexterityStand& stand) {
  const Measured leg = at_place("leg", count_of(stand.leg + 1));
  if (is_out_of_reach(stand))
    return say("leg {} does not reach {}, and the whole region is required", leg,
               coordinates_of(stand.place));
  Sentence text = say("{} is {}, {} {} is required", name_of(stand.limit), plain_number(stand.value, 6),
                      stand.at_least ? "at least" : "at most", plain_number(stand.bound, 6));
  const bool of_pose =
      stand.limit == DexterityLimit::conditioning || stand.limit == DexterityLimit::constraint;
  if (stand.leg >= 0)
    text += say(", at leg {} in {}", leg, coordinates_of(stand.place));
  else if (of_pose)
    text += say(", at {}", coordinates_of(stand.place));
  return text;
}

void add_stands(const DexterityModel& model, const Extremes& extremes, std::span<const double> unknowns,
                DexterityDesign& out) {
  constexpr double nothing_to_spare = 1e-6;
  const auto finish = [&](DexterityStand stand) {
    stand.active = std::abs(stand.excess) <= nothing_to_spare;
    out.limits.push_back(stand);
  };
  const auto of_pose = [&](DexterityLimit limit, PoseLimit::Kind kind, bool at_least, auto&& extreme_of,
                           auto&& value_of, double bound) {
    DexterityStand stand{.limit = limit, .bound = bound, .at_least = at_least, .excess = -HUGE_VAL};
    for (int i = 0; i < model.entries(kind); ++i) {
      const Extreme& extreme = extreme_of(i);
      const double g = model.limit(kind, extreme, unknowns);
      if (g <= stand.excess) continue;
      stand.excess = g;
      stand.value = value_of(extreme.value);
      stand.leg = model.entries(kind) == 1 ? -1 : i;
      stand.place = out.origin + model.at(extreme.pose).place;
    }
    finish(stand);
  };
  const auto same = [](double v) { return v; };
  const auto input_of = [&](int i) -> const Extreme& { return extremes.input_square[i]; };
  if (model.bound(PoseLimit::input) > 0)
    of_pose(
        DexterityLimit::input, PoseLimit::input, true, input_of,
        [](double v) { return v > 0 ? std::sqrt(v) : v; }, model.bound(PoseLimit::input));
  else
    of_pose(DexterityLimit::reach, PoseLimit::input, true, input_of, same, 0);
  if (model.wants(PoseLimit::conditioning))
    of_pose(
        DexterityLimit::conditioning, PoseLimit::conditioning, true,
        [&](int) -> const Extreme& { return extremes.conditioning; }, same,
        model.bound(PoseLimit::conditioning));
  if (model.wants(PoseLimit::constraint))
    of_pose(
        DexterityLimit::constraint, PoseLimit::constraint, true,
        [&](int) -> const Extreme& { return extremes.constraint; }, same, model.bound(PoseLimit::constraint));
  if (model.wants(PoseLimit::output))
    of_pose(
        DexterityLimit::output, PoseLimit::output, true,
        [&](int i) -> const Extreme& { return extremes.output[i]; }, same, model.bound(PoseLimit::output));
  if (model.wants(PoseLimit::side_swing))
    of_pose(
        DexterityLimit::side_swing, PoseLimit::side_swing, false,
        [&](int i) -> const Extreme& { return extremes.side[i]; },
        [](double v) { return std::asin(std::min(1.0, v)); }, model.task().limits.side_swing);
  std::vector<DexterityModel::Whole> whole;
  model.whole(unknowns, whole, nullptr);
  for (std::size_t k = 0; k < whole.size(); ++k) {
    // Only that end of a Pi-joint counts which has less to spare.
    if (k > 0 && whole[k].limit == whole[k - 1].limit && whole[k].excess <= whole[k - 1].excess) continue;
    if (k > 0 && whole[k].limit == whole[k - 1].limit) out.limits.pop_back();
    finish({.limit = whole[k].limit,
            .value = whole[k].value,
            .bound = whole[k].bound,
            .at_least = whole[k].at_least,
            .excess = whole[k].excess});
  }
}

void add_drives(const DexterityModel& model, const DesignedRobot& designed, std::span<const double> unknowns,
                DexterityDesign& out) {
  const auto& pi_joint = model.task().pi_joint;
  if (!pi_joint) return;
  const double mounting = unknowns[model.mounting()];
  for (int i = 0; i < model.legs(); ++i) {
    const int mirror = pi_joint->mirror;
    const double a = mirror * (out.arm_lowest - mounting), b = mirror * (out.arm_highest - mounting);
    out.drives[i] = {.type = DriveType::pi_joint,
                     .ratio = unknowns[model.ratio()],
                     .mounting = arm_angle_of(designed, i, mounting),
                     .mirror = mirror * designed.sense[i],
                     .lowest = std::min(a, b),
                     .highest = std::max(a, b)};
  }
}

DexterityDesign assessed(const DexterityModel& model, std::span<const double> x, const Extremes& extremes) {
  const DexterityTask& task = model.task();
  DexterityModel::Work work;
  DexterityDesign out;
  out.x.assign(x.begin(), x.end());
  const std::vector<optimise::Variable> variables = design_variables(task);
  for (std::size_t j = 0; j < x.size(); ++j) {
    const auto& [name, lower, upper] = variables[j];
    const double close = 1e-7 * (upper - lower);
    out.bounds.push_back(lower == upper          ? BoundState::fixed
                         : x[j] <= lower + close ? BoundState::at_lower
                         : x[j] >= upper - close ? BoundState::at_upper
                                                 : BoundState::free);
  }
  const DesignedRobot designed = model.designed(x);
  out.robot = designed.robot;
  out.origin = designed.offset * designed.ahead;
  const std::vector<double> unknowns = model.unknowns_of(x, extremes);
  const DexterityModel::Travel travel = model.travel(extremes);
  out.arm_lowest = travel.low, out.arm_highest = travel.high;
  out.size = x[designed.arm()] + x[designed.rod()];
  out.worst = extremes.conditioning.value;
  out.worst_place = out.origin + model.at(extremes.conditioning.pose).place;
  try {
    out.mean = model.mean(designed, work, {});
  } catch (const Interrupted&) {
    out.mean = nan;  // the rest is known
  }
  out.objective = task.goal == DexterityGoal::size   ? out.size
                  : task.goal == DexterityGoal::mean ? out.mean
                                                     : out.worst;
  add_stands(model, extremes, unknowns, out);
  add_drives(model, designed, unknowns, out);
  out.violation = model.violation(x, extremes);
  out.status = out.violation > 0 ? Status::infeasible : Status::done;
  if (out.violation > 0) {
    const auto most = std::max_element(out.limits.begin(), out.limits.end(),
                                       [](const auto& a, const auto& b) { return a.excess < b.excess; });
    // Out of reach no other index has a meaning.
    const auto reach = std::find_if(out.limits.begin(), out.limits.end(), is_out_of_reach);
    out.reason = described(reach != out.limits.end() ? *reach : *most);
  }
  return out;
}

DexterityDesign assessed(const DexterityModel& model, std::span<const double> x) {
  DexterityModel::Work work;
  return assessed(model, x, model.extremes(model.designed(x), work));
}

/// Looks for poses between the nodes that miss a limit.
void look_between(const DexterityModel& model, RunContext& context, DexteritySynthesis& out) {
  const DexterityDesign& best = out.best;
  const DesignedRobot designed = model.designed(best.x);
  constexpr double close = 0.02;
  const auto worst_of = [&](PoseLimit::Kind kind) {
    const bool more = kind == PoseLimit::side_swing;
    double worst = more ? -HUGE_VAL : HUGE_VAL;
    for (int i = 0; i < model.entries(kind); ++i) {
      const double found = between_nodes(model, designed, kind, i, close, context, out.poses)[0].value;
      worst = more ? std::max(worst, found) : std::min(worst, found);
    }
    return worst;
  };
  out.worst_between_nodes = worst_of(PoseLimit::conditioning);
  for (const DexterityStand& stand : best.limits) {
    double value = nan;
    if (stand.limit == DexterityLimit::conditioning) value = out.worst_between_nodes;
    if (stand.limit == DexterityLimit::constraint) value = worst_of(PoseLimit::constraint);
    if (stand.limit == DexterityLimit::reach) value = worst_of(PoseLimit::input);
    if (stand.limit == DexterityLimit::input) value = std::sqrt(std::max(0.0, worst_of(PoseLimit::input)));
    if (stand.limit == DexterityLimit::output) value = worst_of(PoseLimit::output);
    if (stand.limit == DexterityLimit::side_swing)
      value = std::asin(std::min(1.0, worst_of(PoseLimit::side_swing)));
    out.between_nodes.push_back(value);
  }
}

}  // namespace

std::vector<optimise::Variable> design_variables(const DexterityTask& task) {
  std::vector<optimise::Variable> out;
  const auto family = dimensions(task.family);
  for (std::size_t j = 0; j < family.size(); ++j)
    out.push_back({fmt::format("{}_{}", family[j].name, family[j].is_angle ? "rad" : "m"),
                   task.dimensions[j].lower, task.dimensions[j].upper});
  if (task.pi_joint) {
    out.push_back({"mounting_rad", task.pi_joint->mounting.lower, task.pi_joint->mounting.upper});
    out.push_back({"ratio", task.pi_joint->ratio.lower, task.pi_joint->ratio.upper});
  }
  return out;
}

DexterityDesign assess(const DexterityTask& task, std::span<const double> x) {
  const DexterityModel model(task);
  const std::size_t count = design_variables(task).size();
  LINKWRIGHT_REQUIRE(x.size() == count, "{} values for {} design variables", x.size(), count);
  return assessed(model, x);
}

BodyProof prove_region(const DexterityTask& task, const DexterityDesign& design) {
  const auto trouble = problem(task);
  LINKWRIGHT_REQUIRE(!trouble, "{}", trouble.value_or(""));
  const PrescribedRegion& r = task.region;
  const bool round = r.shape == RegionShape::cylinder || r.shape == RegionShape::circle;
  const Vec3 middle = design.origin + middle_of(r);
  Body body{.shape = r.shape == RegionShape::cylinder ? InscribedShape::cylinder
                     : r.shape == RegionShape::circle ? InscribedShape::ball
                                                      : InscribedShape::box,
            .centre = middle,
            .half = {r.width / 2, round ? r.width / 2 : r.length / 2, r.height / 2}};
  if (is_planar(r.shape)) body.half = {r.width / 2, round ? r.width / 2 : r.height / 2, 0};
  BodyProof out{.proven = true};
  for (const Mat3& rotation : task.orientations) {
    const auto home =
        trouble_task(design.robot, {middle, rotation}, task.mode, task.length, task.limits.constraint);
    if (!home) return {.violated = middle};
    const BodyProof found = prove(*home, body, rotation);
    out.looks += found.looks;
    out.proven = out.proven && found.proven;
    if (found.violated && !out.violated) out.violated = found.violated;
  }
  return out;
}

DexteritySynthesis synthesise(const DexterityTask& task, const DexterityOptions& options, std::uint64_t seed,
                              RunContext& context) {
  LINKWRIGHT_REQUIRE(options.draws >= 1 && options.starts >= 1 && options.confirmations >= 0 &&
                         options.exchanges >= 1 && options.evaluations >= 1 && options.same >= 0,
                     "draws {}, starts {}, confirmations {}, exchanges {}, evaluations {}, same {}",
                     options.draws, options.starts, options.confirmations, options.exchanges,
                     options.evaluations, options.same);
  const DexterityModel model(task, &context);
  DexteritySynthesis out;
  std::vector<Drawn> drawn(options.draws);
  constexpr int part = 32;
  optimise::parallel_for((drawn.size() + part - 1) / part, context.threads(), [&](std::size_t p) {
    DexterityModel::Work work;
    for (std::size_t i = p * part; i < std::min(drawn.size(), (p + 1) * part); ++i) {
      if (i > 0 && model.poses(true) > many_poses && context.interrupted()) return;
      drawn[i] = draw(model, seed, static_cast<int>(i), work);
    }
  });
  std::erase_if(drawn, [](const Drawn& d) { return d.unknowns.empty(); });
  out.evaluations = static_cast<std::int64_t>(drawn.size());
  out.poses = out.evaluations * static_cast<std::int64_t>(model.poses(true));
  std::stable_sort(drawn.begin(), drawn.end(), [](const Drawn& a, const Drawn& b) {
    return optimise::better(a.cost, a.violation, b.cost, b.violation);
  });

  const std::size_t most = std::min(drawn.size(), static_cast<std::size_t>(options.starts));
  const bool size = task.goal == DexterityGoal::size;
  const auto better = [&](const DexterityStart& a, const DexterityStart& b) {
    return optimise::better(size ? a.objective : -a.objective, a.violation, size ? b.objective : -b.objective,
                            b.violation);
  };
  const auto same = [&](const DexterityStart& a, const DexterityStart& best) {
    return a.violation == 0 && best.violation == 0 &&
           std::abs(a.objective - best.objective) <= options.same * std::abs(best.objective);
  };
  Status stop = Status::done;
  std::size_t best = 0;
  std::vector<Descent> ends(most);
  while (out.starts.size() < most && stop == Status::done) {
    const std::size_t first = out.starts.size(), count = std::min<std::size_t>(round_starts, most - first);
    out.starts.resize(first + count);
    optimise::parallel_for(count, context.threads(), [&](std::size_t i) {
      ends[first + i] = descend(model, options, drawn[first + i].unknowns, context);
      out.starts[first + i] = ends[first + i].start;
    });
    for (std::size_t i = first; i < first + count; ++i)
      if (better(out.starts[i], out.starts[best])) best = i;
    out.reached_best = static_cast<int>(std::count_if(
        out.starts.begin(), out.starts.end(), [&](const auto& s) { return same(s, out.starts[best]); }));
    const bool met = out.starts[best].violation == 0;
    context.report({.stage = "starts",
                    .fraction = static_cast<double>(out.starts.size()) / static_cast<double>(most),
                    .best = met ? out.starts[best].objective : nan});
    stop = context.interruption();
    if (options.confirmations > 0 && out.reached_best >= options.confirmations) break;
  }
  for (DexterityStart& start : out.starts) {
    out.evaluations += start.evaluations;
    out.poses += start.poses;
    start.x = model.design_of(start.x);
  }
  if (ends[best].known) {
    out.best = assessed(model, out.starts[best].x, ends[best].extremes);
    out.poses += static_cast<std::int64_t>(model.nodes() + model.cells());
    try {
      if (stop == Status::done) look_between(model, context, out);
    } catch (const Interrupted& why) {
      stop = why.status();
      out.between_nodes.clear();
      out.worst_between_nodes = nan;
    }
  }
  out.status = stop != Status::done ? stop : out.best.status;
  out.reason = out.best.reason;
  return out;
}

}  // namespace linkwright::parallel
