// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/pagmo_bridge.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/moead.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/batch_evaluators/member_bfe.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/utils/hypervolume.hpp>
#include <string_view>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/checkpoint.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/optimise/detail/generation_log.h"
#include "linkwright/optimise/evaluate.h"

namespace linkwright::optimise {
namespace {

constexpr double min_violated_cost = 1e79;  // feasible candidates cost less, see cost_by_feasibility_rules

/// Evaluates what pagmo asks for: designs of the free variables only, as pagmo takes none without a range.
class Evaluator {
 public:
  Evaluator(const Problem& problem, const RunContext& context) : problem_(problem), context_(context) {
    for (std::size_t j = 0; j < problem.variables.size(); ++j) {
      const Variable& v = problem.variables[j];
      LINKWRIGHT_REQUIRE(std::isfinite(v.lower) && std::isfinite(v.upper) && v.lower <= v.upper,
                         "bounds of '{}': {} to {}", v.name, v.lower, v.upper);
      if (v.lower < v.upper) {
        free_.push_back(j);
        lower.push_back(v.lower);
        upper.push_back(v.upper);
      }
    }
    LINKWRIGHT_REQUIRE(!free_.empty(), "a problem needs variables with a range");
  }

  std::vector<double> lower, upper;  ///< bounds of the free variables

  std::size_t objectives() const { return problem_.objectives; }

  /// x is design after design; likewise the costs that pagmo receives.
  pagmo::vector_double operator()(const pagmo::vector_double& x) {
    if (evaluations > 0) throw_if_interrupted(context_);  // moead asks for one design after the other
    const std::size_t n = free_.size(), m = problem_.objectives, count = x.size() / n;
    if (candidates_.size() != count) {
      candidates_ = Population(problem_.variables.size(), count);
      for (std::size_t j = 0; j < problem_.variables.size(); ++j)
        std::fill_n(candidates_.row(j), count, problem_.variables[j].lower);
    }
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < n; ++j)
        candidates_(free_[j], i) = std::clamp(x[i * n + j], lower[j], upper[j]);
    cost_.resize(count * m);
    violation_.resize(count);
    evaluate(problem_, candidates_.view(), cost_, violation_, context_);
    pagmo::vector_double told(count * m);
    for (std::size_t i = 0; i < count; ++i) {
      ++evaluations;
      violated += violation_[i] > 0;
      for (std::size_t k = 0; k < m; ++k) {
        LINKWRIGHT_REQUIRE(!std::isnan(cost_[i * m + k]) && violation_[i] >= 0,
                           "objective {} of a candidate: cost {}, violation {}", k, cost_[i * m + k],
                           violation_[i]);
        told[i * m + k] = cost_by_feasibility_rules(cost_[i * m + k], violation_[i]);
      }
      if (violation_[i] < least_violation || least_violated.x.empty()) {
        least_violation = violation_[i];
        least_violated.x.resize(problem_.variables.size());
        candidates_.get(i, least_violated.x);
        least_violated.costs.assign(&cost_[i * m], &cost_[i * m] + m);
      }
    }
    return told;
  }

  ParetoPoint design(const pagmo::vector_double& x, const pagmo::vector_double& costs) const {
    ParetoPoint d = {.costs = costs};
    for (const Variable& v : problem_.variables) d.x.push_back(v.lower);
    for (std::size_t j = 0; j < x.size(); ++j) d.x[free_[j]] = x[j];
    return d;
  }

  /// A design of which nothing is known.
  ParetoPoint nothing() const { return design(lower, pagmo::vector_double(problem_.objectives, infinity)); }

  /// The population that all methods begin with, as Optimiser has it.
  pagmo::vector_double first_population(std::size_t size, const Seed& seed) const {
    pagmo::vector_double x;
    for (std::size_t i = 0; i < size; ++i) {
      RandomStream random({seed.seed, seed.run, 0, static_cast<std::uint32_t>(i)});
      for (const Variable& v : problem_.variables) {
        const double value = std::min(random.uniform(v.lower, v.upper), v.upper);
        if (v.lower < v.upper) x.push_back(value);
      }
    }
    return x;
  }

  std::int64_t evaluations = 0, violated = 0;
  ParetoPoint least_violated;
  double least_violation = infinity;

 private:
  const Problem& problem_;
  const RunContext& context_;
  std::vector<std::size_t> free_;
  Population candidates_;
  std::vector<double> cost_, violation_;
};

/// The problem as pagmo sees it.
struct EvaluatorProblem {
  Evaluator* evaluator = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& x) const { return (*evaluator)(x); }
  pagmo::vector_double batch_fitness(const pagmo::vector_double& x) const { return (*evaluator)(x); }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {evaluator->lower, evaluator->upper};
  }
  pagmo::vector_double::size_type get_nobj() const { return evaluator->objectives(); }
};

/// One generation of a method.
pagmo::algorithm make_algorithm(const PagmoOptions& o, std::size_t free, std::size_t objectives) {
  constexpr unsigned seed = 0;  // seeded before each generation
  if (o.method == PagmoMethod::moead)
    return pagmo::algorithm(pagmo::moead(1, objectives == 2 ? "grid" : "low discrepancy", "tchebycheff",
                                         static_cast<std::size_t>(o.moead.neighbours), 1.0, 0.5, 20, 0.9, 2,
                                         true, seed));
  const double mutation = o.nsga2.mutation > 0 ? o.nsga2.mutation : 1 / static_cast<double>(free);
  pagmo::nsga2 nsga2(1, std::min(o.nsga2.crossover, std::nextafter(1.0, 0.0)), o.nsga2.crossover_index,
                     mutation, o.nsga2.mutation_index, seed);
  nsga2.set_bfe(pagmo::bfe(pagmo::member_bfe()));
  return pagmo::algorithm(std::move(nsga2));
}

/// Members that are feasible.
std::vector<ParetoPoint> feasible(const pagmo::population& members, const Evaluator& evaluator) {
  const std::vector<pagmo::vector_double>&x = members.get_x(), &f = members.get_f();
  std::vector<ParetoPoint> found;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (f[i][0] < min_violated_cost) found.push_back(evaluator.design(x[i], f[i]));
  return found;
}

std::vector<double> min_costs(const std::vector<ParetoPoint>& front, std::size_t objectives) {
  std::vector<double> least(objectives, infinity);
  for (const ParetoPoint& point : front)
    for (std::size_t k = 0; k < objectives; ++k) least[k] = std::min(least[k], point.costs[k]);
  return least;
}

/// A population of pagmo without evaluating it; x is design after design, as are the costs f.
void fill(pagmo::population& members, std::size_t population, const pagmo::vector_double& x,
          const pagmo::vector_double& f) {
  const std::size_t n = x.size() / population, m = f.size() / population;
  for (std::size_t i = 0; i < population; ++i)
    members.push_back({&x[i * n], &x[i * n] + n}, {&f[i * m], &f[i * m] + m});
}

void append(std::vector<double>& to, std::span<const double> numbers) {
  to.insert(to.end(), numbers.begin(), numbers.end());
}

/// Saves a minimisation in the checkpoint of the run under one name.
class FrontKeeper {
 public:
  FrontKeeper(Checkpoint* checkpoint, const std::string& name)
      : checkpoint_(name.empty() ? nullptr : checkpoint), name_(name) {
    if (checkpoint_) interval_ = checkpoint_->interval();
  }

  /// Loads the saved state, if there is one.
  void restore(std::size_t population, int generations, bool log, pagmo::population& members,
               Evaluator& evaluator, FrontReport& report) {
    const Value value = checkpoint_ ? checkpoint_->find(name_) : Value();
    if (value.is_null()) return;
    constexpr std::int64_t max_evaluations = std::int64_t{1} << 53;  // exact as a double
    const std::size_t n = evaluator.lower.size(), m = evaluator.objectives();
    report.generations = static_cast<int>(load_integer(value, "generations", 1, generations, name_));
    evaluator.evaluations = load_integer(value, "evaluations", 1, max_evaluations, name_);
    const auto numbers = [&](std::string_view key) {
      return unpack_numbers(load_member(value, key, name_), name_);
    };
    const Value& reason = load_member(value, "stop_reason", name_);
    const std::vector<double> x = numbers("x"), f = numbers("f"), best = numbers("least_violated"),
                              logged = numbers("log");
    const std::size_t all = evaluator.design({}, {}).x.size(), entry = 3 + m,
                      entries = log ? static_cast<std::size_t>(report.generations /
                                                               log_interval(report.generations))
                                    : 0;
    bool good = reason.is_string() && x.size() == population * n && f.size() == population * m &&
                best.size() == 1 + all + m && best[0] >= 0 && logged.size() == entries * entry &&
                std::none_of(f.begin(), f.end(), [](double v) { return std::isnan(v); });
    for (std::size_t i = 0; good && i < x.size(); ++i)
      good = x[i] >= evaluator.lower[i % n] && x[i] <= evaluator.upper[i % n];
    for (std::size_t k = 0; good && k < entries; ++k)
      good = logged[k * entry] >= 0 && logged[k * entry] <= static_cast<double>(max_evaluations) &&
             logged[k * entry + 2] >= 0 && logged[k * entry + 2] <= static_cast<double>(population);
    if (!good) throw CheckpointError(fmt::format("{}: is not a state of this method and problem", name_));
    report.stop_reason = reason.as_string();
    fill(members, population, x, f);
    evaluator.least_violation = best[0];
    evaluator.least_violated.x.assign(best.begin() + 1, best.end() - static_cast<std::ptrdiff_t>(m));
    evaluator.least_violated.costs.assign(best.end() - static_cast<std::ptrdiff_t>(m), best.end());
    for (std::size_t k = 0; k < entries; ++k) {
      const double* v = &logged[k * entry];
      report.log.push_back({.evaluations = static_cast<std::int64_t>(v[0]),
                            .violated = v[1],
                            .front = static_cast<int>(v[2]),
                            .least = {v + 3, v + entry}});
    }
    kept_once_ = true;
  }

  void generation_done(const pagmo::population& members, const Evaluator& evaluator,
                       const FrontReport& report) {
    if (checkpoint_ && Clock::now() - kept_ >= interval_) keep(members, evaluator, report);
  }
  /// The end of a minimisation that was quicker than it could be saved need not be saved.
  void ended(const pagmo::population& members, const Evaluator& evaluator, const FrontReport& report,
             bool interrupted) {
    if (checkpoint_ && (interrupted || kept_once_)) keep(members, evaluator, report);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void keep(const pagmo::population& members, const Evaluator& evaluator, const FrontReport& report) {
    std::vector<double> x, f, log, best = {evaluator.least_violation};
    for (const auto& one : members.get_x()) append(x, one);
    for (const auto& one : members.get_f()) append(f, one);
    for (const FrontLog& g : report.log) {
      append(log, std::vector<double>{static_cast<double>(g.evaluations), g.violated,
                                      static_cast<double>(g.front)});
      append(log, g.least);
    }
    append(best, evaluator.least_violated.x);
    append(best, evaluator.least_violated.costs);
    Value value;
    value["generations"] = report.generations;
    value["evaluations"] = evaluator.evaluations;
    value["x"] = pack_numbers(x);
    value["f"] = pack_numbers(f);
    value["least_violated"] = pack_numbers(best);
    value["log"] = pack_numbers(log);
    value["stop_reason"] = report.stop_reason;  // empty = not at its end
    checkpoint_->keep(name_, value);
    kept_ = Clock::now();
    interval_ = checkpoint_->interval();
    kept_once_ = true;
  }

  Checkpoint* checkpoint_;
  std::string name_;
  Clock::time_point kept_ = Clock::now();
  std::chrono::duration<double> interval_{};
  bool kept_once_ = false;
};

}  // namespace

FrontReport minimise_with_pagmo(const Problem& problem, const PagmoOptions& method,
                                const FrontOptions& options, const Seed& seed, RunContext& context) {
  const std::string_view name = name_of(method.method);
  require_in_range("minimise_with_pagmo", options);
  require_in_range(name, method);
  const bool moead = method.method == PagmoMethod::moead;
  const int generations = moead ? method.moead.generations : method.nsga2.generations;
  const auto population = static_cast<std::size_t>(moead ? method.moead.population : method.nsga2.population);
  LINKWRIGHT_REQUIRE(problem.objectives >= 2, "{}: needs two objectives or more, got {}", name,
                     problem.objectives);
  LINKWRIGHT_REQUIRE(moead || population % 4 == 0, "nsga2: population must be a multiple of 4, got {}",
                     population);
  LINKWRIGHT_REQUIRE(!moead || method.moead.neighbours < method.moead.population,
                     "moead: neighbours must be less than population {}, got {}", population,
                     method.moead.neighbours);

  Evaluator evaluator(problem, context);
  FrontReport report;
  pagmo::algorithm algorithm = make_algorithm(method, evaluator.lower.size(), problem.objectives);
  pagmo::population members(pagmo::problem(EvaluatorProblem{&evaluator}), 0, 0);
  FrontKeeper keeper(context.checkpoint(), options.checkpoint);
  keeper.restore(population, generations, options.log, members, evaluator, report);
  const bool was_at_its_end = !report.stop_reason.empty();
  Status interruption = Status::done;
  while (report.stop_reason.empty()) {
    const std::int64_t before = evaluator.evaluations;
    evaluator.violated = 0;
    try {
      if (report.generations == 0) {
        const pagmo::vector_double x = evaluator.first_population(population, seed);
        fill(members, population, x, evaluator(x));
      } else {
        // Half of the streams are kept for uses like this one, see Optimiser::Optimiser.
        algorithm.set_seed(
            RandomStream({seed.seed, seed.run, static_cast<std::uint32_t>(report.generations), 1u << 31})
                .bits());
        members = algorithm.evolve(members);
      }
    } catch (const Interrupted& why) {
      // The generation does not count; the members are those before it.
      interruption = why.status();
      evaluator.evaluations = before;
      break;
    }
    ++report.generations;
    if (options.log)
      log_generation(report.log, report.generations, [&] {
        const std::vector<ParetoPoint> front = non_dominated(feasible(members, evaluator));
        return FrontLog{.evaluations = evaluator.evaluations,
                        .violated = static_cast<double>(evaluator.violated) /
                                    static_cast<double>(evaluator.evaluations - before),
                        .front = static_cast<int>(front.size()),
                        .least = min_costs(front, problem.objectives)};
      });
    if (options.progress)
      context.report({.stage = name, .fraction = static_cast<double>(report.generations) / generations});

    if (report.generations >= generations)
      report.stop_reason = fmt::format("{} generations", report.generations);
    else if (options.evaluations > 0 &&
             evaluator.evaluations + static_cast<std::int64_t>(population) > options.evaluations)
      report.stop_reason = fmt::format("another generation could exceed {} evaluations", options.evaluations);
    else if (interruption = context.interruption(); interruption != Status::done)
      break;
    else
      keeper.generation_done(members, evaluator, report);
  }
  if (!was_at_its_end && report.generations > 0)
    keeper.ended(members, evaluator, report, interruption != Status::done);
  if (interruption != Status::done)
    report.stop_reason = interruption == Status::deadline ? "time limit reached" : "cancelled";
  report.evaluations = evaluator.evaluations;
  report.front = non_dominated(feasible(members, evaluator));
  report.status = interruption;
  if (report.front.empty()) {
    if (evaluator.least_violated.x.empty()) evaluator.least_violated = evaluator.nothing();
    report.front.push_back(evaluator.least_violated);
    report.violation = evaluator.least_violation;
    if (interruption == Status::done) report.status = Status::infeasible;
  }
  return report;
}

double hypervolume(std::span<const double> costs, std::span<const double> reference) {
  const std::size_t m = reference.size();
  const auto finite = [](double v) { return std::isfinite(v); };
  LINKWRIGHT_REQUIRE(m >= 2 && costs.size() % m == 0, "{} costs for a reference point of {} objectives",
                     costs.size(), m);
  LINKWRIGHT_REQUIRE(std::all_of(costs.begin(), costs.end(), finite) &&
                         std::all_of(reference.begin(), reference.end(), finite),
                     "a hypervolume needs finite costs");
  std::vector<pagmo::vector_double> points;
  for (std::size_t i = 0; i < costs.size(); i += m)
    if (std::equal(reference.begin(), reference.end(), costs.begin() + static_cast<std::ptrdiff_t>(i),
                   std::greater<>()))
      points.emplace_back(costs.begin() + static_cast<std::ptrdiff_t>(i),
                          costs.begin() + static_cast<std::ptrdiff_t>(i + m));
  if (points.empty()) return 0;
  return pagmo::hypervolume(points, false).compute({reference.begin(), reference.end()});
}

double hypervolume(std::span<const ParetoPoint> front, std::span<const double> reference) {
  std::vector<double> costs;
  for (const ParetoPoint& d : front) {
    LINKWRIGHT_REQUIRE(d.costs.size() == reference.size(),
                       "a design of {} objectives, a reference point of {}", d.costs.size(),
                       reference.size());
    append(costs, d.costs);
  }
  return hypervolume(costs, reference);
}

}  // namespace linkwright::optimise
