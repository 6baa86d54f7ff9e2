// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/optimise/combine.h"
#include "linkwright/optimise/minimise.h"
#include "linkwright/suspension/direct/detail/synthesis_model.h"

namespace linkwright::suspension {

DirectEvolution evolve(const DirectTask& task, const DirectOptions& options, std::uint64_t seed,
                       RunContext& context, int members, int generations) {
  const DirectModel model(task, options);
  const std::size_t count = task.objectives.size();
  optimise::Problem problem;
  problem.objectives = count;
  for (const auto& [number, lower, upper] : task.designed)
    problem.variables.push_back({label(task.suspension, number), lower, upper});
  problem.evaluate = [&](const optimise::PopulationView& candidates, std::span<double> cost,
                         std::span<double> violation) {
    Suspension suspension = task.suspension;
    for (std::size_t i = 0; i < candidates.size; ++i) {
      for (std::size_t j = 0; j < model.size(); ++j)
        design_value(suspension, task.designed[j].number) = candidates(j, i);
      const TargetAnswer found = answer(suspension, task.objectives, model.positions(), {});
      violation[i] = 0;
      if (!found.assembled) {
        // More than any limit of an assembled design is missed by, and less the further it gets.
        violation[i] = 1e3 * (2 - found.reached);
        for (std::size_t k = 0; k < count; ++k) cost[i * count + k] = infinity;
        continue;
      }
      const std::vector<double> values =
          objective_values(task.objectives, model.positions(), found.deviations);
      std::copy(values.begin(), values.end(), cost.begin() + static_cast<std::ptrdiff_t>(i * count));
      for (const LimitAnswer& limit : limit_answers(suspension, task.limits, found.positions, {}, {}))
        violation[i] += std::max(0.0, limit.excess);
    }
  };
  optimise::MinimiseOptions stop;
  stop.stop.spread = 1e-5;
  stop.log = false;
  optimise::OptimiserOptions method;
  method.method = optimise::Method::differential_evolution;
  method.differential_evolution.population = members;
  method.differential_evolution.generations = generations;
  const optimise::Problem single =
      options.goal == DirectGoal::priorities ? optimise::by_priority(problem) : optimise::largest(problem);
  const optimise::Report report = optimise::minimise(single, method, stop, {.seed = seed}, context);
  DirectEvolution out;
  Suspension suspension = task.suspension;
  for (std::size_t j = 0; j < model.size(); ++j)
    design_value(suspension, task.designed[j].number) = report.x[j];
  out.found = assess(task, options, suspension);
  out.found.evaluations = report.evaluations;
  out.generations = report.generations;
  if (report.status == Status::deadline || report.status == Status::cancelled)
    out.found.status = report.status;
  return out;
}

}  // namespace linkwright::suspension
