// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/link_synthesis.h"

#include <cmath>
#include <memory>
#include <mutex>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::suspension {
namespace {

double objective_of(const ErrorTotals& t, ErrorTotal total) {
  return total == ErrorTotal::sum ? t.sum : t.mean();
}

/// Evaluators for as many threads as ask at once.
class Evaluators {
 public:
  explicit Evaluators(const CornerErrors& first) : first_(first) {}

  std::unique_ptr<CornerErrors> take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return std::make_unique<CornerErrors>(first_);
    auto out = std::move(free_.back());
    free_.pop_back();
    return out;
  }
  void give_back(std::unique_ptr<CornerErrors> evaluator) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(evaluator));
  }

 private:
  CornerErrors first_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<CornerErrors>> free_;
};

optimise::Problem problem_of(const CornerErrors& errors, ErrorTotal total) {
  optimise::Problem problem;
  for (std::size_t j = 0; j < errors.unknowns(); ++j)
    problem.variables.push_back({errors.unknown_names()[j], errors.lower()[j], errors.upper()[j]});
  const auto pool = std::make_shared<Evaluators>(errors);
  problem.evaluate = [pool, total](const optimise::PopulationView& candidates, std::span<double> cost,
                                   std::span<double> violation) {
    auto evaluator = pool->take();
    std::vector<double> x(evaluator->unknowns()), rows(evaluator->rows());
    for (std::size_t i = 0; i < candidates.size; ++i) {
      for (std::size_t j = 0; j < x.size(); ++j) x[j] = candidates(j, i);
      const bool there = evaluator->evaluate(x, rows, {});
      const double shortfall = evaluator->shortfall();
      violation[i] = there ? 0 : shortfall > 0 ? shortfall : 1;
      cost[i] = there ? objective_of(evaluator->totals(rows), total) : infinity;
    }
    pool->give_back(std::move(evaluator));
  };
  problem.explain = [pool](std::span<const double> x) {
    auto evaluator = pool->take();
    std::vector<double> rows(evaluator->rows());
    std::vector<Violation> out;
    if (!evaluator->evaluate(x, rows, {})) {
      const double shortfall = evaluator->shortfall();
      out.push_back(shortfall > 0 ? Violation{"dyad_assembles", shortfall} : Violation{"points_apart", 1});
    }
    pool->give_back(std::move(evaluator));
    return out;
  };
  return problem;
}

}  // namespace

optimise::Problem suspension_problem(const CarrierTargets& targets, std::span<const LinkTask> links,
                                     std::span<const CouplerTask> couplers, CarrierPitchTechnique technique,
                                     double largest_carrier_pitch, ErrorTotal total) {
  return problem_of(CornerErrors(targets, links, couplers, technique, largest_carrier_pitch), total);
}

optimise::Problem link_problem(const CarrierTargets& targets, const LinkTask& task, ErrorTotal total) {
  LINKWRIGHT_REQUIRE(carrier_pitch_is_given(targets), "link '{}': a position does not give the carrier pitch",
                     task.name);
  return suspension_problem(targets, {&task, 1}, {}, CarrierPitchTechnique::each, 0.5, total);
}

double link_objective(const CarrierTargets& targets, const CornerLink& link, ErrorTotal total) {
  LINKWRIGHT_REQUIRE(carrier_pitch_is_given(targets), "link '{}': a position does not give the carrier pitch",
                     link.name);
  const LinkTask task = given_link(link);
  CornerErrors errors(targets, {&task, 1});
  std::vector<double> rows(errors.rows());
  if (!errors.evaluate({}, rows, {})) return infinity;
  return objective_of(errors.totals(rows), total);
}

Evolution evolve_links(const CarrierTargets& targets, std::span<const LinkTask> links,
                       std::span<const CouplerTask> couplers, const EvolutionOptions& options,
                       const optimise::Seed& seed, RunContext& context) {
  CornerErrors errors(targets, links, couplers, options.technique, options.largest_carrier_pitch);
  optimise::MinimiseOptions minimise;
  minimise.stop.spread = options.spread > 0 ? options.spread : errors.unknowns() < 30 ? 1e-5 : 1e-4;
  minimise.log = false;
  minimise.progress = options.progress;
  minimise.checkpoint = options.checkpoint;
  std::vector<double> x;
  Evolution out;
  if (errors.unknowns() > 0) {
    const optimise::Problem problem = problem_of(errors, ErrorTotal::mean);
    optimise::OptimiserOptions method;
    method.method = optimise::Method::differential_evolution;
    method.differential_evolution = options.method;
    const optimise::Report report = optimise::minimise(problem, method, minimise, seed, context);
    out.status = report.status;
    out.generations = report.generations;
    out.evaluations = report.evaluations;
    x = report.x;
  }
  std::vector<double> rows(errors.rows());
  const bool there = errors.evaluate(x, rows, {});
  out.links = errors.links();
  out.couplers = errors.couplers();
  out.targets = errors.targets();
  for (std::size_t l = 0; l < out.links.size(); ++l) out.link_errors.push_back(errors.link_totals(l, rows));
  for (std::size_t k = 0; k < out.couplers.size(); ++k)
    out.coupler_errors.push_back(errors.coupler_totals(k, rows));
  out.objective = there ? errors.totals(rows).mean() : infinity;
  return out;
}

}  // namespace linkwright::suspension
