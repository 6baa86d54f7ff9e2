#include "linkwright/optimise/minimise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linkwright/optimise/parallel.h"

namespace linkwright::optimise {
namespace {

constexpr std::size_t evaluation_block = 256;  // a multiple of 8, see PopulationView::slice
constexpr std::size_t longest_reserved_log = 1 << 16;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void evaluate(const Problem& problem, const PopulationView& candidates, std::span<double> cost,
              std::span<double> violation, int threads) {
  if (threads == 1 || candidates.size <= evaluation_block)
    return problem.evaluate(candidates, cost, violation);
  const std::size_t blocks = (candidates.size + evaluation_block - 1) / evaluation_block;
  parallel_for(blocks, threads, [&](std::size_t block) {
    const std::size_t first = block * evaluation_block,
                      count = std::min(evaluation_block, candidates.size - first);
    problem.evaluate(candidates.slice(first, count), cost.subspan(first, count),
                     violation.subspan(first, count));
  });
}

GenerationLog summarise(std::span<const double> cost, std::span<const double> violation,
                        std::vector<double>& feasible) {
  feasible.clear();
  double sum = 0;
  for (std::size_t i = 0; i < cost.size(); ++i)
    if (violation[i] == 0) {
      feasible.push_back(cost[i]);
      sum += cost[i];
    }
  GenerationLog entry = {.median = nan, .mean = nan};
  const std::size_t n = feasible.size();
  entry.violated = 1 - static_cast<double>(n) / static_cast<double>(cost.size());
  if (n == 0) return entry;
  const auto middle = feasible.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(feasible.begin(), middle, feasible.end());
  entry.median = n % 2 == 1 ? *middle : (*middle + *std::max_element(feasible.begin(), middle)) / 2;
  entry.mean = sum / static_cast<double>(n);
  return entry;
}

/// Largest distance of a member to x.
double spread(const PopulationView& members, std::span<const double> x, std::vector<double>& squares) {
  std::fill(squares.begin(), squares.end(), 0.0);
  for (std::size_t j = 0; j < members.dimension; ++j)
    for (std::size_t i = 0; i < members.size; ++i) {
      const double d = members(j, i) - x[j];
      squares[i] += d * d;
    }
  return std::sqrt(*std::max_element(squares.begin(), squares.end()));
}

}  // namespace

Report minimise(const Problem& problem, Optimiser& optimiser, int generations, std::string_view name,
                const MinimiseOptions& options, RunContext& context) {
  require_in_range("minimise", options);
  const StopCriteria& stop = options.stop;
  LINKWRIGHT_REQUIRE(generations >= 1, "{} generations", generations);
  LINKWRIGHT_REQUIRE(optimiser.dimension() == problem.variables.size(),
                     "an optimiser of {} variables for a problem of {}", optimiser.dimension(),
                     problem.variables.size());
  const std::size_t n = optimiser.population();
  const bool penalty = options.constraints == Constraints::penalty;
  std::vector<double> cost(n), violation(n), merit(penalty ? n : 0), none(penalty ? n : 0), scratch(n);
  Report report;
  report.x.resize(optimiser.dimension());
  if (options.log)
    report.log.reserve(std::min<std::size_t>(static_cast<std::size_t>(generations), longest_reserved_log));

  int unimproved = 0;
  Status interruption = Status::done;
  while (report.stop_reason.empty()) {
    const PopulationView candidates = optimiser.ask();
    evaluate(problem, candidates, cost, violation, context.threads());
    if (penalty) {
      for (std::size_t i = 0; i < n; ++i)
        merit[i] = cost[i] + (violation[i] > 0 ? options.penalty_weight : 0);
      optimiser.tell(merit, none);
    } else {
      optimiser.tell(cost, violation);
    }
    ++report.generations;
    report.evaluations += static_cast<std::int64_t>(n);
    if (optimiser.improved()) {
      report.cost = cost[optimiser.best_candidate()];
      report.violation = violation[optimiser.best_candidate()];
      std::copy(optimiser.best().begin(), optimiser.best().end(), report.x.begin());
      unimproved = 0;
    } else {
      ++unimproved;
    }
    if (options.log) {
      GenerationLog entry = summarise(cost, violation, scratch);
      scratch.resize(n);
      entry.evaluations = report.evaluations;
      entry.best_cost = report.cost;
      entry.best_violation = report.violation;
      report.log.push_back(entry);
    }
    if (options.progress)
      context.report({.stage = name,
                      .fraction = static_cast<double>(report.generations) / generations,
                      .best = report.cost});

    if (report.violation == 0 && report.cost <= stop.target_cost)
      report.stop_reason = fmt::format("target cost {} reached", stop.target_cost);
    else if (stop.spread > 0 && (optimiser.improved() || optimiser.equalled()) &&
             spread(optimiser.members(), report.x, scratch) < stop.spread)
      report.stop_reason = fmt::format("every member within {} of the best", stop.spread);
    else if (stop.stagnation > 0 && unimproved >= stop.stagnation)
      report.stop_reason = fmt::format("no better candidate in {} generations", unimproved);
    else if (report.generations >= generations)
      report.stop_reason = fmt::format("{} generations", report.generations);
    else if (stop.evaluations > 0 && report.evaluations + static_cast<std::int64_t>(n) > stop.evaluations)
      report.stop_reason = fmt::format("another generation would exceed {} evaluations", stop.evaluations);
    else if (interruption = context.interruption(); interruption != Status::done)
      report.stop_reason = interruption == Status::deadline ? "time limit reached" : "cancelled";
  }
  report.status = interruption != Status::done ? interruption
                  : report.violation > 0       ? Status::infeasible
                                               : Status::done;
  return report;
}

Report minimise(const Problem& problem, const OptimiserOptions& method, const MinimiseOptions& options,
                const Seed& seed, RunContext& context) {
  const auto optimiser = make_optimiser(problem.variables, method, seed);
  const int limit = options.stop.generations > 0 ? options.stop.generations : generations(method);
  return minimise(problem, *optimiser, limit, name_of(method.method), options, context);
}

}  // namespace linkwright::optimise
