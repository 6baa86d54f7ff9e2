#include "linkwright/optimise/statistics.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/parallel.h"

namespace linkwright::optimise {

double quantile(std::span<const double> sorted, double p) {
  LINKWRIGHT_REQUIRE(p >= 0 && p <= 1, "quantile {}", p);
  if (sorted.empty()) return nan;
  const double place = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(below);
  if (part == 0 || sorted[below] == sorted[below + 1]) return sorted[below];  // also keeps inf - inf away
  return sorted[below] + part * (sorted[below + 1] - sorted[below]);
}

SeedStatistics statistics(std::span<const SeedOutcome> outcomes, double threshold) {
  SeedStatistics s;
  s.threshold = threshold;
  s.seeds = static_cast<int>(outcomes.size());
  if (outcomes.empty()) return s;
  std::vector<double> costs, evaluations;
  double sum = 0;
  for (const SeedOutcome& outcome : outcomes) {
    const bool feasible = outcome.violation == 0;
    costs.push_back(feasible ? outcome.cost : infinity);
    sum += costs.back();
    evaluations.push_back(static_cast<double>(outcome.evaluations));
    s.feasible += feasible;
    s.successes += feasible && outcome.cost <= threshold;
    s.evaluations += outcome.evaluations;
  }
  std::sort(costs.begin(), costs.end());
  std::sort(evaluations.begin(), evaluations.end());
  s.best = costs.front();
  s.quantile10 = quantile(costs, 0.10);
  s.quantile25 = quantile(costs, 0.25);
  s.median = quantile(costs, 0.50);
  s.quantile75 = quantile(costs, 0.75);
  s.quantile90 = quantile(costs, 0.90);
  s.worst = costs.back();
  s.mean = sum / s.seeds;
  s.success_rate = static_cast<double>(s.successes) / s.seeds;
  s.median_evaluations = quantile(evaluations, 0.5);
  if (s.successes > 0) s.evaluations_per_success = static_cast<double>(s.evaluations) / s.successes;
  return s;
}

std::string seed_name(std::uint64_t seed) { return fmt::format("seed {}", seed); }

namespace {

using Body = math::FunctionRef<double(std::size_t index, std::uint64_t seed)>;
using Save = math::FunctionRef<Value(std::size_t index)>;
using Restore = math::FunctionRef<double(std::size_t index, const Value& value)>;

SeedLoop run_seeds(const SeedRange& seeds, RunContext& context, std::string_view stage, Body body,
                   Checkpoint* checkpoint, Save save, Restore restore) {
  LINKWRIGHT_REQUIRE(seeds.count >= 1, "needs at least one seed, got {}", seeds.count);
  const auto count = static_cast<std::size_t>(seeds.count);
  std::vector<char> ran(count, 0), left(count, 0);  // not bits: written by several threads
  std::atomic<std::size_t> finished{0};
  std::atomic<double> best{infinity};
  std::size_t own = count;
  if (checkpoint)
    for (std::size_t i = 0; i < count; ++i) {
      const Value value = checkpoint->find(seed_name(seeds.first + i));
      if (!value.is_null()) {
        best = std::min(best.load(), restore(i, value));
        ran[i] = 1;
        ++finished;
      } else if (checkpoint->is_left_to_others(i)) {
        left[i] = 1;
        --own;
      }
    }
  parallel_for(count, context.threads(), [&](std::size_t i) {
    if (ran[i] != 0 || left[i] != 0 || (i > 0 && context.interrupted())) return;
    const double cost = body(i, seeds.first + i);
    ran[i] = 1;
    if (checkpoint)
      if (const Value value = save(i); !value.is_null()) checkpoint->keep(seed_name(seeds.first + i), value);
    double least = best.load();
    while (cost < least && !best.compare_exchange_weak(least, cost)) {
    }
    const double now = best.load();
    context.report({.stage = stage,
                    .fraction = static_cast<double>(++finished) / static_cast<double>(own),
                    .best = std::isfinite(now) ? now : nan});
  });
  if (own < count) throw LeftToOthers();
  return {context.interruption(), std::vector<bool>(ran.begin(), ran.end())};
}

}  // namespace

SeedLoop for_each_seed(const SeedRange& seeds, RunContext& context, std::string_view stage, Body body) {
  return run_seeds(
      seeds, context, stage, body, nullptr, [](std::size_t) { return Value(); },
      [](std::size_t, const Value&) { return 0.0; });
}

SeedLoop for_each_seed(const SeedRange& seeds, RunContext& context, std::string_view stage, Body body,
                       Save save, Restore restore) {
  return run_seeds(seeds, context, stage, body, context.checkpoint(), save, restore);
}

SeedsReport minimise_seeds(const Problem& problem, const OptimiserOptions& method,
                           const MinimiseOptions& options, const SeedRange& seeds, double threshold,
                           RunContext& context) {
  LINKWRIGHT_REQUIRE(seeds.count >= 1, "needs at least one seed, got {}", seeds.count);
  MinimiseOptions quiet = options;
  quiet.progress = false;
  std::vector<Report> all(static_cast<std::size_t>(seeds.count));
  const SeedLoop loop =
      for_each_seed(seeds, context, name_of(method.method), [&](std::size_t i, std::uint64_t seed) {
        MinimiseOptions own = quiet;
        if (!own.checkpoint.empty()) own.checkpoint += "/" + seed_name(seed);
        all[i] = minimise(problem, method, own, {.seed = seed}, context);
        return all[i].violation == 0 ? all[i].cost : infinity;
      });

  SeedsReport report;
  std::vector<SeedOutcome> outcomes;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!loop.ran[i]) continue;
    report.seeds.push_back(seeds.first + i);
    outcomes.push_back({all[i].cost, all[i].violation, all[i].evaluations});
    report.reports.push_back(std::move(all[i]));
    const SeedOutcome &best = outcomes[report.best], &last = outcomes.back();
    if (better(last.cost, last.violation, best.cost, best.violation)) report.best = outcomes.size() - 1;
  }
  report.statistics = statistics(outcomes, threshold);
  // An interruption after the last seed was done took nothing away.
  for (const Report& r : report.reports)
    if (r.status == Status::deadline || r.status == Status::cancelled) report.status = r.status;
  if (report.reports.size() < all.size()) report.status = loop.status;
  if (report.status == Status::done && report.statistics.feasible == 0) report.status = Status::infeasible;
  return report;
}

}  // namespace linkwright::optimise
