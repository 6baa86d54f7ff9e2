#include "linkwright/optimise/multistart.h"

#include "linkwright/core/check.h"

namespace linkwright::optimise {

MultistartReport multistart_least_squares(math::ResidualFunction function, std::size_t m, std::size_t n,
                                          std::span<const double> lower, std::span<const double> upper,
                                          StartGenerator generate, const MultistartOptions& options,
                                          const Seed& seed, RunContext& context) {
  LINKWRIGHT_REQUIRE(options.starts >= 1, "starts must be at least 1, got {}", options.starts);
  MultistartReport report;
  math::LeastSquaresWorkspace workspace;
  std::vector<double> x(n);
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t start = 0; start < static_cast<std::size_t>(options.starts); ++start) {
    RandomStream random({seed.seed, seed.run, 0, static_cast<std::uint32_t>(start)});
    if (!generate(start, random, x)) continue;
    const auto local = math::minimise_least_squares(function, m, x, lower, upper, options.local, workspace);
    report.ends.push_back({start, local, x});
    report.evaluations += local.evaluations;
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
