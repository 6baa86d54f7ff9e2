// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/pagmo_adapters.h"

#include <algorithm>
#include <cmath>
#include <pagmo/population.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/optimise/pagmo_bridge.h"

namespace linkwright::optimise {
namespace {

struct AdaptedProblem {
  Problem problem;

  pagmo::vector_double fitness(const pagmo::vector_double& x) const { return batch_fitness(x); }

  pagmo::vector_double batch_fitness(const pagmo::vector_double& x) const {
    const std::size_t n = problem.variables.size(), m = problem.objectives, count = x.size() / n;
    Population candidates(n, count);
    for (std::size_t i = 0; i < count; ++i) candidates.set(i, std::span(x).subspan(i * n, n));
    pagmo::vector_double cost(count * m);
    std::vector<double> violation(count);
    problem.evaluate(candidates.view(), cost, violation);
    for (std::size_t k = 0; k < cost.size(); ++k)
      cost[k] = cost_by_feasibility_rules(cost[k], violation[k / m]);
    return cost;
  }

  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    pagmo::vector_double lower, upper;
    for (const Variable& v : problem.variables) {
      lower.push_back(v.lower);
      upper.push_back(v.upper);
    }
    return {lower, upper};
  }
  pagmo::vector_double::size_type get_nobj() const { return problem.objectives; }
  std::string get_name() const { return "Linkwright problem"; }
};

/// The parts of what pagmo calls a fitness.
struct Merit {
  double cost, violation;
};
Merit split(const pagmo::problem& problem, const double* fitness) {
  double violation = 0;
  const pagmo::vector_double tolerance = problem.get_c_tol();
  for (std::size_t k = 0; k < tolerance.size(); ++k) {
    const double c = fitness[1 + k];
    const double amount = (k < problem.get_nec() ? std::abs(c) : c) - tolerance[k];
    violation += std::isnan(amount) ? HUGE_VAL : std::max(amount, 0.0);
  }
  const bool exists = !std::isnan(fitness[0]);
  return {exists ? fitness[0] : HUGE_VAL, exists ? violation : HUGE_VAL};
}

struct AdaptedAlgorithm {
  OptimiserOptions method = {};
  unsigned seed = 0;
  mutable std::uint32_t runs = 0;  ///< number of runs of `evolve` so far

  void set_seed(unsigned s) {
    seed = s;
    runs = 0;
  }
  std::string get_name() const { return "Linkwright " + std::string(name_of(method.method)); }

  pagmo::population evolve(pagmo::population members) const {
    const pagmo::problem& problem = members.get_problem();
    LINKWRIGHT_REQUIRE(problem.get_nobj() == 1 && problem.get_nix() == 0,
                       "{}: one objective and no integers, got {} objectives and {} integers",
                       name_of(method.method), problem.get_nobj(), problem.get_nix());
    const std::size_t n = problem.get_nx(), size = members.size();
    LINKWRIGHT_REQUIRE(size > 0, "{}: the population is empty", name_of(method.method));
    const auto [lower, upper] = problem.get_bounds();
    std::vector<Variable> variables;
    for (std::size_t j = 0; j < n; ++j) variables.push_back({"x" + std::to_string(j), lower[j], upper[j]});
    OptimiserOptions options = method;
    visit_method(options, [&](auto& o) { o.population = static_cast<int>(size); });
    const auto optimiser = make_optimiser(variables, options, Seed{.seed = seed, .run = runs++});

    Population first(n, size);
    std::vector<double> cost(size), violation(size);
    const std::vector<pagmo::vector_double>&known_x = members.get_x(), &known_f = members.get_f();
    for (std::size_t i = 0; i < size; ++i) first.set(i, known_x[i]);
    optimiser->begin_with(first.view());
    optimiser->ask();
    for (std::size_t i = 0; i < size; ++i) {
      const Merit merit = split(problem, known_f[i].data());
      cost[i] = merit.cost, violation[i] = merit.violation;
    }
    optimiser->tell(cost, violation);

    const std::size_t nf = problem.get_nf();
    const auto evaluate = [&](const PopulationView& candidates) {
      pagmo::vector_double all(candidates.size * n), f;
      for (std::size_t i = 0; i < candidates.size; ++i)
        for (std::size_t j = 0; j < n; ++j) all[i * n + j] = candidates(j, i);
      if (candidates.size > 0 && problem.has_batch_fitness()) {
        f = problem.batch_fitness(all);
      } else {
        for (std::size_t i = 0; i < candidates.size; ++i) {
          const pagmo::vector_double one = problem.fitness({&all[i * n], &all[i * n] + n});
          f.insert(f.end(), one.begin(), one.end());
        }
      }
      return f;
    };
    const auto last = static_cast<std::uint32_t>(generations(options));
    pagmo::vector_double best_f = known_f[optimiser->best_candidate()];
    while (optimiser->generation() < last) {
      const PopulationView candidates = optimiser->ask();
      const pagmo::vector_double f = evaluate(candidates);
      for (std::size_t i = 0; i < candidates.size; ++i) {
        const Merit merit = split(problem, &f[i * nf]);
        cost[i] = merit.cost, violation[i] = merit.violation;
      }
      optimiser->tell({cost.data(), candidates.size}, {violation.data(), candidates.size});
      if (optimiser->improved()) {
        const double* found = &f[optimiser->best_candidate() * nf];
        best_f.assign(found, found + nf);
      }
    }
    write_back(*optimiser, evaluate(optimiser->members()), best_f, members);
    return members;
  }

 private:
  static void write_back(const Optimiser& optimiser, const pagmo::vector_double& f,
                         const pagmo::vector_double& best_f, pagmo::population& members) {
    const pagmo::problem& problem = members.get_problem();
    const PopulationView last = optimiser.members();
    const std::size_t nf = problem.get_nf();
    const pagmo::vector_double best(optimiser.best().begin(), optimiser.best().end());
    pagmo::vector_double x(last.dimension);
    std::size_t worst = 0;
    bool there = false;
    for (std::size_t i = 0; i < last.size; ++i) {
      for (std::size_t j = 0; j < x.size(); ++j) x[j] = last(j, i);
      there |= x == best;
      members.set_xf(i, x, {&f[i * nf], &f[i * nf] + nf});
      const auto [cost, violation] = split(problem, &f[i * nf]);
      const auto [worst_cost, worst_violation] = split(problem, &f[worst * nf]);
      if (better(worst_cost, worst_violation, cost, violation)) worst = i;
    }
    if (!there) members.set_xf(worst, best, best_f);
  }
};

}  // namespace

pagmo::problem pagmo_problem(Problem problem) {
  LINKWRIGHT_REQUIRE(!problem.variables.empty() && problem.evaluate, "a problem needs variables and costs");
  return pagmo::problem(AdaptedProblem{std::move(problem)});
}

pagmo::algorithm pagmo_algorithm(const OptimiserOptions& method, unsigned seed) {
  return pagmo::algorithm(AdaptedAlgorithm{method, seed});
}

}  // namespace linkwright::optimise
