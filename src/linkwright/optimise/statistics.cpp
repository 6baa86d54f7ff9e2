// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/statistics.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

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

PieceLoop for_each_seed(const SeedRange& seeds, RunContext& context, std::string_view stage,
                        math::FunctionRef<double(std::size_t index, std::uint64_t seed)> body) {
  return for_each_piece(static_cast<std::size_t>(seeds.count), context, stage,
                        [&](std::size_t i) { return body(i, seeds.first + i); });
}

PieceLoop for_each_seed(const SeedRange& seeds, RunContext& context, std::string_view stage,
                        math::FunctionRef<double(std::size_t index, std::uint64_t seed)> body,
                        math::FunctionRef<Value(std::size_t index)> save,
                        math::FunctionRef<double(std::size_t index, const Value& value)> restore) {
  return for_each_piece(
      static_cast<std::size_t>(seeds.count), context, stage,
      [&](std::size_t i) { return seed_name(seeds.first + i); },
      [&](std::size_t i) { return body(i, seeds.first + i); }, save, restore);
}

SeedsReport minimise_seeds(const Problem& problem, const OptimiserOptions& method,
                           const MinimiseOptions& options, const SeedRange& seeds, double threshold,
                           RunContext& context) {
  LINKWRIGHT_REQUIRE(seeds.count >= 1, "needs at least one seed, got {}", seeds.count);
  MinimiseOptions quiet = options;
  quiet.progress = false;
  std::vector<Report> all(static_cast<std::size_t>(seeds.count));
  const PieceLoop loop =
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
