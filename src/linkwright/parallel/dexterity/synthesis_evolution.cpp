// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "linkwright/core/interruption.h"
#include "linkwright/core/numbers.h"
#include "linkwright/parallel/dexterity/detail/synthesis_model.h"

namespace linkwright::parallel {
namespace {

constexpr std::size_t many_nodes = 1000;  // worth a look at the context

}  // namespace

optimise::Problem population_problem(const DexterityTask& task, const RunContext* context) {
  const auto model = std::make_shared<const DexterityModel>(task, context);
  optimise::Problem out{.variables = design_variables(task)};
  out.evaluate = [model, context](const optimise::PopulationView& candidates, std::span<double> cost,
                                  std::span<double> violation) {
    DexterityModel::Work work;
    std::vector<double> x(candidates.dimension);
    for (std::size_t i = 0; i < candidates.size; ++i) {
      if (i > 0 && model->nodes() > many_nodes) throw_if_interrupted(context);
      for (std::size_t j = 0; j < x.size(); ++j) x[j] = candidates(j, i);
      const DesignedRobot designed = model->designed(x);
      const Extremes extremes = model->extremes(designed, work);
      violation[i] = model->violation(x, extremes);
      const double mean = model->task().goal == DexterityGoal::mean ? model->mean(designed, work, {}) : 0;
      cost[i] = model->cost(x, extremes, mean);
      if (std::isfinite(cost[i])) continue;
      cost[i] = infinity;
      violation[i] += 1;
    }
  };
  return out;
}

DexterityEvolution evolve(const DexterityTask& task, const optimise::OptimiserOptions& method,
                          const optimise::MinimiseOptions& options, std::uint64_t seed, RunContext& context) {
  const DexterityModel model(task);
  DexterityEvolution out;
  out.report =
      optimise::minimise(population_problem(task, &context), method, options, {.seed = seed}, context);
  if (out.report.violation < infinity) out.best = assess(task, out.report.x);
  const std::size_t poses = model.nodes() + (task.goal == DexterityGoal::mean ? model.cells() : 0);
  out.poses = out.report.evaluations * static_cast<std::int64_t>(poses);
  return out;
}

}  // namespace linkwright::parallel
