// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/multistart.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/numbers.h"

namespace linkwright::optimise {
namespace {

/// The best point of a search that was interrupted at x.
math::LeastSquaresReport cut_short(math::ResidualFunction function, std::size_t m, std::span<const double> x,
                                   std::int64_t& evaluations) {
  math::LeastSquaresReport out{.status = Status::not_converged, .end = math::LeastSquaresEnd::iterations};
  std::vector<double> residuals(m);
  double sum = 0;
  try {
    ++evaluations;
    if (!function(x, residuals, {})) sum = infinity;
  } catch (const Interrupted&) {
    sum = infinity;
  }
  for (const double r : residuals) sum += r * r;
  out.evaluations = static_cast<int>(evaluations);
  if (std::isfinite(sum))
    out.cost = sum / 2;
  else
    out.status = Status::infeasible;
  return out;
}

}  // namespace

MultistartReport multistart_least_squares(math::ResidualFunction function, std::size_t m, std::size_t n,
                                          std::span<const double> lower, std::span<const double> upper,
                                          StartGenerator generate, const MultistartOptions& options,
                                          const Seed& seed, RunContext& context) {
  LINKWRIGHT_REQUIRE(options.starts >= 1, "starts must be at least 1, got {}", options.starts);
  MultistartReport report;
  math::LeastSquaresWorkspace workspace;
  std::vector<double> x(n);
  double best = infinity;
  for (std::size_t start = 0; start < static_cast<std::size_t>(options.starts); ++start) {
    RandomStream random({seed.seed, seed.run, 0, static_cast<std::uint32_t>(start)});
    if (!generate(start, random, x)) continue;
    std::int64_t evaluations = 0;
    const auto looking = [&](std::span<const double> at, std::span<double> residuals,
                             std::span<double> jacobian) {
      if (evaluations > 0) throw_if_interrupted(context);
      ++evaluations;
      return function(at, residuals, jacobian);
    };
    math::LeastSquaresReport local;
    try {
      local = math::minimise_least_squares(looking, m, x, lower, upper, options.local, workspace);
    } catch (const Interrupted&) {
      local = cut_short(function, m, x, evaluations);
    }
    report.ends.push_back({start, local, x});
    report.evaluations += evaluations;
    if (local.cost < best) {
      best = local.cost;
      report.best = report.ends.size() - 1;
    }
    if (best <= options.target_cost) break;
    if (options.evaluations > 0 && report.evaluations >= options.evaluations) break;
    report.status = context.interruption();
    if (report.status != Status::done) break;
  }
  for (const MultistartEnd& end : report.ends)
    report.reached_best +=
        end.report.cost <= best * (1 + options.same_cost) && end.report.status != Status::infeasible;
  if (report.status == Status::done && report.reached_best == 0) report.status = Status::infeasible;
  return report;
}

}  // namespace linkwright::optimise
