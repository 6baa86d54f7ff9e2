// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/balancing/four_bar_synthesis.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace linkwright::planar {
namespace {

using optimise::SmoothEnd;
using optimise::SmoothOptions;
using optimise::SmoothReport;

constexpr double first_softening = 1e-3, last_softening = 1e-9;
constexpr std::size_t followed = 8;  // ends
constexpr double cap_tolerance = 1e-6;

bool has_kinks(const FourBarBalancing& b) {
  return std::any_of(b.objectives.begin(), b.objectives.end(),
                     [](const BalancingObjective& o) { return !properties(o.measure).quadratic; });
}

// Cost and violation without rounding.
void measure_exactly(const FourBarBalancing& b, const SmoothOptions& options, SmoothReport& report) {
  const std::size_t m = b.objectives.size();
  const FourBarMachine machine =
      four_bar_machine(std::span<const double, four_bar_number_count>(report.x), b.branch);
  std::vector<double> values(m + report.constraints.size());
  balancing_values(b, {&machine, 1}, values);
  report.cost = options.goal == optimise::SmoothGoal::mean ? 0 : -HUGE_VAL;
  double most = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k >= m) {
      most = std::max(most, values[k]);
      continue;
    }
    const bool mean = options.goal == optimise::SmoothGoal::mean;
    const double weight = !options.weights.empty() ? options.weights[k]
                          : mean                   ? 1 / static_cast<double>(m)
                                                   : 1;
    report.cost = mean ? report.cost + weight * values[k] : std::max(report.cost, weight * values[k]);
    if (!options.caps.empty() && values[k] > options.caps[k] * (1 + cap_tolerance))
      most = std::max(most, values[k] - options.caps[k]);
  }
  report.violation = most > options.local.constraint_tolerance ? most : 0;
  report.objectives.assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(m));
  report.constraints.assign(values.begin() + static_cast<std::ptrdiff_t>(m), values.end());
}

}  // namespace

SmoothReport balance_four_bar(const FourBarBalancing& b, const SmoothOptions& options,
                              const optimise::Seed& seed, RunContext& context) {
  if (!has_kinks(b)) return minimise_smooth(balancing_problem(b), options, seed, context);

  SmoothReport rough = minimise_smooth(balancing_problem(b, first_softening), options, seed, context);
  std::vector<std::size_t> order(rough.ends.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t c) {
    const SmoothEnd &first = rough.ends[a], &second = rough.ends[c];
    return optimise::better(first.cost, first.violation, second.cost, second.violation);
  });
  order.resize(std::min(order.size(), followed));

  SmoothReport best = rough;
  measure_exactly(b, options, best);
  for (const std::size_t k : order) {
    if (best.status == Status::deadline || best.status == Status::cancelled) break;
    std::vector<double> x = rough.ends[k].x;
    for (double softening = first_softening / 4; softening > last_softening; softening /= 4) {
      SmoothReport report = minimise_smooth_from(balancing_problem(b, softening), options, x, context);
      best.evaluations += report.evaluations;
      const bool interrupted = report.status == Status::deadline || report.status == Status::cancelled;
      if (interrupted) best.status = report.status;
      x = report.x;
      measure_exactly(b, options, report);
      if (optimise::better(report.cost, report.violation, best.cost, best.violation)) {
        best.x = report.x;
        best.objectives = report.objectives;
        best.constraints = report.constraints;
        best.cost = report.cost;
        best.violation = report.violation;
        best.active = report.active;
        best.stationarity = report.stationarity;
      }
      if (interrupted) break;
    }
  }
  if (best.status != Status::deadline && best.status != Status::cancelled)
    best.status = best.violation > 0 ? Status::infeasible : Status::done;
  return best;
}

}  // namespace linkwright::planar
