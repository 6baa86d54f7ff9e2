// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/synthesis.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/suspension/corner/structure.h"
#include "linkwright/suspension/indirect/link_fit_motion.h"
#include "linkwright/suspension/indirect/pose_completion.h"
#include "linkwright/suspension/indirect/seven_poses.h"

namespace linkwright::suspension {
namespace {

bool interrupted(Status status) { return status == Status::deadline || status == Status::cancelled; }

/// A synthesis in progress: the results of links and couplers, and what that means.
class Assembly {
 public:
  explicit Assembly(const IndirectTask& task) : task_(task) {
    for (const CouplerTask& c : task.couplers)
      LINKWRIGHT_REQUIRE(
          c.first >= 0 && c.second >= 0 && std::max(c.first, c.second) < static_cast<int>(task.links.size()),
          "coupler '{}': links {} and {} of {}", c.name, c.first, c.second, task.links.size());
    result.targets = task.targets;
    result.suspension.wheel = task.targets.wheel;
    result.suspension.rack_direction = task.targets.rack_direction;
    result.links.resize(task.links.size());
    result.couplers.resize(task.couplers.size());
    if (!carrier_pitch_is_given(task.targets)) settle_carrier_pitch();
  }

  bool can_go_on() const { return rod_assembles_; }
  bool carrier_pitch_is_open() const { return !carrier_pitch_is_given(result.targets); }

  /// Takes links and couplers of a joint search to the places `at`.
  template <class Joint>
  void take(const Joint& joint, std::span<const std::size_t> links, std::span<const std::size_t> couplers,
            double tolerance) {
    for (std::size_t l = 0; l < links.size(); ++l) {
      LinkFit& fit = result.links[links[l]];
      fit.link = joint.links[l];
      set_errors(fit, joint.link_errors[l], tolerance, joint.status);
    }
    for (std::size_t k = 0; k < couplers.size(); ++k) {
      CouplerFit& fit = result.couplers[couplers[k]];
      const CouplerTask& task = task_.couplers[couplers[k]];
      fit.coupler = joint.couplers[k];
      fit.coupler.first = task.first, fit.coupler.second = task.second;
      const CornerLink& first = result.links[static_cast<std::size_t>(task.first)].link;
      fit.offset = fit.coupler.fraction * norm(first.carrier[0] - first.body[0]);
      set_errors(fit, joint.coupler_errors[k], tolerance, joint.status);
    }
    result.evaluations += joint.evaluations;
  }

  IndirectSynthesis finish(RunContext& context) {
    result.status = rod_assembles_ ? Status::done : Status::infeasible;
    const auto worsen = [&](Status status) {
      if (status == Status::done || interrupted(result.status)) return;
      if (interrupted(status) || status == Status::infeasible || result.status == Status::done)
        result.status = status;
    };
    for (const LinkFit& fit : result.links) {
      result.suspension.links.push_back(fit.link);
      result.largest = std::max(result.largest, fit.largest);
      worsen(fit.status);
    }
    for (const CouplerFit& fit : result.couplers) {
      result.suspension.couplers.push_back(fit.coupler);
      result.largest = std::max(result.largest, fit.largest);
      worsen(fit.status);
    }
    if (result.status != Status::done && context.interrupted()) result.status = context.interruption();
    count_positions();
    const bool complete = std::all_of(result.links.begin(), result.links.end(),
                                      [](const LinkFit& fit) { return std::isfinite(fit.rms); }) &&
                          std::all_of(result.couplers.begin(), result.couplers.end(),
                                      [](const CouplerFit& fit) { return std::isfinite(fit.rms); });
    if (complete) {
      const Diagnostics structure = check_structure(result.suspension);
      result.findings.insert(result.findings.end(), structure.begin(), structure.end());
      if (result.status == Status::done && has_errors(structure)) result.status = Status::singular;
    }
    return std::move(result);
  }

  /// The links that share couplers with others, and all the others one by one.
  std::vector<std::vector<std::size_t>> groups(bool together) const {
    std::vector<std::size_t> group(task_.links.size());
    for (std::size_t l = 0; l < group.size(); ++l) group[l] = together ? 0 : l;
    for (bool changed = true; changed;) {
      changed = false;
      for (const CouplerTask& c : task_.couplers) {
        std::size_t &a = group[static_cast<std::size_t>(c.first)],
                    &b = group[static_cast<std::size_t>(c.second)];
        changed = changed || a != b;
        a = b = std::min(a, b);
      }
    }
    std::vector<std::vector<std::size_t>> out;
    for (std::size_t g = 0; g < group.size(); ++g) {
      std::vector<std::size_t> members;
      for (std::size_t l = 0; l < group.size(); ++l)
        if (group[l] == g) members.push_back(l);
      if (!members.empty()) out.push_back(std::move(members));
    }
    return out;
  }
  /// Tasks of a group; couplers count links within it. `places` are those of its couplers.
  std::vector<LinkTask> links_of(std::span<const std::size_t> group) const {
    std::vector<LinkTask> out;
    for (const std::size_t l : group) out.push_back(task_.links[l]);
    return out;
  }
  std::vector<CouplerTask> couplers_of(std::span<const std::size_t> group,
                                       std::vector<std::size_t>& places) const {
    std::vector<CouplerTask> out;
    const auto within = [&](int link) {
      return static_cast<int>(std::find(group.begin(), group.end(), static_cast<std::size_t>(link)) -
                              group.begin());
    };
    for (std::size_t k = 0; k < task_.couplers.size(); ++k) {
      CouplerTask c = task_.couplers[k];
      c.first = within(c.first), c.second = within(c.second);
      if (c.first == static_cast<int>(group.size())) continue;
      out.push_back(c);
      places.push_back(k);
    }
    return out;
  }

  IndirectSynthesis result;

 private:
  template <class Fit>
  static void set_errors(Fit& fit, const ErrorTotals& errors, double tolerance, Status ended) {
    fit.rms = errors.rms();
    fit.largest = errors.largest;
    fit.status = fit.rms <= tolerance ? Status::done : interrupted(ended) ? ended : Status::not_converged;
  }

  void settle_carrier_pitch() {
    for (const LinkTask& link : task_.links) {
      if (link.type != LinkType::US && link.type != LinkType::SS) continue;
      const LinkCoordinates coordinates(link);
      if (!coordinates.free().empty()) continue;
      PoseCompletion made = complete(task_.targets, coordinates.middle(), PoseParameter::carrier_pitch);
      rod_assembles_ = made.status == Status::done;
      if (rod_assembles_)
        result.targets = std::move(made.targets);
      else
        result.findings.push_back(
            {.severity = Diagnostic::Severity::error,
             .key = fmt::format("link.{}", link.name),
             .message = fmt::format("cannot keep its length at position {}: it misses by {:.3g} m",
                                    made.position + 1, made.shortfall),
             .hint = "move its points, or leave the carrier pitch to the synthesis"});
      return;
    }
  }

  void count_positions() {
    int all = 0, equations = static_cast<int>(task_.couplers.size());
    const bool open = !carrier_pitch_is_given(task_.targets);
    for (const LinkTask& link : task_.links) {
      const int unknowns = static_cast<int>(LinkCoordinates(link).free().size());
      all += unknowns;
      equations += constraints(link.type);
      if (!open) result.fewest = std::max(result.fewest, fewest_positions(unknowns, constraints(link.type)));
    }
    if (open) {  // all links count, couplers with their offset and point
      for (const CouplerTask& c : task_.couplers)
        all += 1 + (c.point.lower.x < c.point.upper.x) + (c.point.lower.y < c.point.upper.y) +
               (c.point.lower.z < c.point.upper.z);
      result.fewest = fewest_positions(all, equations, 5);
    }
    CarrierTargets counted = task_.targets;
    for (CarrierTarget& pose : counted.poses)
      if (std::isnan(pose.angles.carrier_pitch)) pose.angles.carrier_pitch = 0;
    const auto given = static_cast<double>(link_motion(counted, false).size() + 1);
    if (given < result.fewest)
      result.findings.push_back(
          {.severity = Diagnostic::Severity::warning,
           .key = "target",
           .message =
               fmt::format("{} positions, the reference included, leave a family of exact solutions", given),
           .hint = fmt::format("{:.3g} positions determine the links", std::ceil(result.fewest))});
  }

  const IndirectTask& task_;
  bool rod_assembles_ = true;
};

/// Further starts of links that share a coupler, and of each link within one; a start's random numbers are
/// those of runs that no single link has.
constexpr std::uint32_t group_starts = 12, group_run_stride = 1000;
constexpr int starts_of_a_group_link = 8;

/// Rods that fit seven positions exactly, found when they are first asked for.
class ExactRods {
 public:
  ExactRods(const CarrierTargets& targets, std::uint64_t seed) : targets_(targets), seed_(seed) {}

  std::span<const CornerLink> of(bool moved_by_rack, std::vector<CornerLink>& arms) {
    auto& rods = rods_[moved_by_rack ? 1 : 0];
    if (!rods) {
      rods.emplace();
      if (link_motion(targets_, moved_by_rack).size() >= 6) {
        const SevenPoseReport found = seven_pose_rods(targets_, moved_by_rack, seed_);
        for (const SevenPoseRod& rod : found.rods) rods->push_back(rod.link);
        arms.insert(arms.end(), found.arms.begin(), found.arms.end());
      }
    }
    return *rods;
  }

 private:
  const CarrierTargets& targets_;
  std::uint64_t seed_;
  std::array<std::optional<std::vector<CornerLink>>, 2> rods_;
};

LinkFit find_link(const LinkTask& task, std::uint32_t run, const LinkFitOptions& options,
                  std::span<const CornerLink> exact, ExactRods& rods, IndirectSynthesis& result,
                  std::uint64_t seed, RunContext& context) {
  LinkFit fit = fit_link(result.targets, task, options, exact, seed, context, run);
  const bool rod = task.type == LinkType::US || task.type == LinkType::SS;
  if (fit.status == Status::done || !rod || context.interrupted()) return fit;
  std::vector<CornerLink> starts(rods.of(task.moved_by_rack, result.arms).begin(),
                                 rods.of(task.moved_by_rack, result.arms).end());
  for (CornerLink& start : starts) start.type = task.type, start.name = task.name;
  LinkFit second = fit_link_from(starts, result.targets, task, options, exact, context);
  second.starts += fit.starts;
  second.duplicates += fit.duplicates;
  second.evaluations += fit.evaluations;
  if (second.rms < fit.rms) return second;
  fit.starts = second.starts, fit.duplicates = second.duplicates, fit.evaluations = second.evaluations;
  return fit;
}

std::vector<std::size_t> all_places(std::size_t count) {
  std::vector<std::size_t> out(count);
  for (std::size_t i = 0; i < count; ++i) out[i] = i;
  return out;
}

/// A group of links and their couplers as one start found them.
struct GroupStart {
  std::vector<CornerLink> links;
  std::vector<Coupler> couplers;
};

/// Another start of a group: every link that is to be found from starts of its own, then the couplers.
/// Nothing if a link or a coupler is not found at all.
std::optional<GroupStart> another_start(const CarrierTargets& targets, std::span<const LinkTask> links,
                                        std::span<const CouplerTask> couplers, const LinkFitOptions& options,
                                        std::uint64_t seed, std::uint32_t run, std::int64_t& evaluations,
                                        RunContext& context) {
  GroupStart out;
  LinkFitOptions quick = options;
  quick.starts = std::min(options.starts, starts_of_a_group_link);
  for (std::size_t l = 0; l < links.size(); ++l) {
    const LinkFit fit =
        fit_link(targets, links[l], quick, {}, seed, context, run + static_cast<std::uint32_t>(l));
    evaluations += fit.evaluations;
    if (!std::isfinite(fit.rms)) return std::nullopt;
    out.links.push_back(fit.link);
  }
  for (const CouplerTask& coupler : couplers) {
    const CouplerFit fit = fit_coupler(targets, out.links, coupler, options.tolerance);
    if (!std::isfinite(fit.rms)) return std::nullopt;
    out.couplers.push_back(fit.coupler);
  }
  return out;
}

/// Links that share couplers, all together, from where they are, and where that is not exact from other
/// starts: positions may determine the links poorly, so that each by itself ends at an exact place that
/// leaves no exact coupler within its box.
void refine(const IndirectTask& task, const LinkFitOptions& options, Assembly& assembly, std::uint64_t seed,
            RunContext& context) {
  for (const std::vector<std::size_t>& group : assembly.groups(false)) {
    std::vector<std::size_t> places;
    const std::vector<CouplerTask> couplers = assembly.couplers_of(group, places);
    if (couplers.empty()) continue;
    bool exact = true, there = true;
    std::vector<CornerLink> links;
    std::vector<Coupler> found;
    for (const std::size_t l : group) {
      const LinkFit& fit = assembly.result.links[l];
      exact = exact && fit.status == Status::done;
      there = there && std::isfinite(fit.rms);
      links.push_back(fit.link);
    }
    for (const std::size_t k : places) {
      const CouplerFit& fit = assembly.result.couplers[k];
      exact = exact && fit.status == Status::done;
      there = there && std::isfinite(fit.rms);
      found.push_back(fit.coupler);
    }
    if (exact || !there) continue;
    const std::vector<LinkTask> tasks = assembly.links_of(group);
    const CarrierPitchFitOptions carrier_pitch{.tolerance = options.tolerance, .distinct_links = 0};
    CarrierPitchFit best = fit_together(task.targets, tasks, couplers, links, found, carrier_pitch);
    for (std::uint32_t s = 1; s <= group_starts; ++s) {
      if (best.rms <= options.tolerance || context.interrupted()) break;
      const auto start = another_start(task.targets, tasks, couplers, options, seed, s * group_run_stride,
                                       assembly.result.evaluations, context);
      if (!start) continue;
      CarrierPitchFit next =
          fit_together(task.targets, tasks, couplers, start->links, start->couplers, carrier_pitch);
      // `take` counts those of the one that is taken.
      if (next.rms < best.rms) std::swap(next, best);
      assembly.result.evaluations += next.evaluations;
    }
    if (!best.links.empty()) assembly.take(best, group, places, options.tolerance);
  }
}

}  // namespace

IndirectSynthesis synthesise(const IndirectTask& task, const IndirectOptions& options, std::uint64_t seed,
                             RunContext& context) {
  Assembly assembly(task);
  IndirectSynthesis& result = assembly.result;
  if (!assembly.can_go_on()) return assembly.finish(context);
  if (assembly.carrier_pitch_is_open()) {
    const CarrierPitchFit fit = fit_with_unknown_carrier_pitch(
        task.targets, task.links, options.carrier_pitch, seed, context, task.couplers);
    result.targets = fit.targets;
    if (!fit.links.empty())
      assembly.take(fit, all_places(task.links.size()), all_places(task.couplers.size()),
                    fit.status == Status::done ? fit.largest : options.carrier_pitch.tolerance);
    for (LinkFit& link : result.links) link.starts = fit.starts, link.duplicates = fit.refused;
    return assembly.finish(context);
  }
  std::vector<CornerLink> exact;
  ExactRods rods(result.targets, seed);
  for (std::size_t l = 0; l < task.links.size(); ++l) {
    LinkFit& fit = result.links[l];
    if (l > 0 && context.interrupted()) {
      fit.link = LinkCoordinates(task.links[l]).middle();
      fit.status = context.interruption();
      continue;
    }
    fit = find_link(task.links[l], static_cast<std::uint32_t>(l), options.link, exact, rods, result, seed,
                    context);
    result.evaluations += fit.evaluations;
    if (fit.status == Status::done) exact.push_back(fit.link);
    if (options.link.progress)
      context.report({.stage = "links",
                      .fraction = static_cast<double>(l + 1) / static_cast<double>(task.links.size()),
                      .best = std::isfinite(fit.rms) ? fit.rms : nan});
  }
  std::vector<CornerLink> links;
  for (const LinkFit& fit : result.links) links.push_back(fit.link);
  for (std::size_t k = 0; k < task.couplers.size(); ++k) {
    const CouplerTask& coupler = task.couplers[k];
    if (std::isfinite(result.links[static_cast<std::size_t>(coupler.first)].rms) &&
        std::isfinite(result.links[static_cast<std::size_t>(coupler.second)].rms))
      result.couplers[k] = fit_coupler(result.targets, links, coupler, options.link.tolerance);
  }
  IndirectTask complete = task;
  complete.targets = result.targets;
  refine(complete, options.link, assembly, seed, context);
  return assembly.finish(context);
}

IndirectSynthesis completed(const IndirectTask& task, const IndirectSynthesis& ended) {
  LINKWRIGHT_REQUIRE(ended.links.size() == task.links.size() && ended.couplers.size() == task.couplers.size(),
                     "{} links and {} couplers of {} and {}", ended.links.size(), ended.couplers.size(),
                     task.links.size(), task.couplers.size());
  Assembly assembly(task);
  IndirectSynthesis& result = assembly.result;
  result.links = ended.links;
  result.couplers = ended.couplers;
  result.targets = ended.targets;
  result.evaluations = ended.evaluations;
  result.generations = ended.generations;
  RunContext nobody;
  return assembly.finish(nobody);
}

IndirectSynthesis evolve(const IndirectTask& task, const IndirectEvolutionOptions& options,
                         std::uint64_t seed, RunContext& context) {
  LINKWRIGHT_REQUIRE(options.tolerance > 0, "tolerance {} m", options.tolerance);
  Assembly assembly(task);
  IndirectSynthesis& result = assembly.result;
  if (!assembly.can_go_on()) return assembly.finish(context);
  const auto groups = assembly.groups(options.together || assembly.carrier_pitch_is_open());
  CarrierTargets found = result.targets;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::vector<std::size_t> places;
    const std::vector<CouplerTask> couplers = assembly.couplers_of(groups[g], places);
    EvolutionOptions method = options.method;
    if (!method.checkpoint.empty()) method.checkpoint += fmt::format("/links {}", g + 1);
    const Evolution run = evolve_links(result.targets, assembly.links_of(groups[g]), couplers, method,
                                       {.seed = seed, .run = static_cast<std::uint32_t>(g)}, context);
    result.generations += run.generations;
    if (std::isfinite(run.objective)) {
      assembly.take(run, groups[g], places, options.tolerance);
      found = run.targets;
    } else {  // links with points that coincide, or a dyad that never assembled
      result.evaluations += run.evaluations;
      for (std::size_t l = 0; l < groups[g].size(); ++l) result.links[groups[g][l]].link = run.links[l];
    }
    for (const std::size_t l : groups[g]) result.links[l].starts = 1;
  }
  result.targets = found;
  return assembly.finish(context);
}

}  // namespace linkwright::suspension
