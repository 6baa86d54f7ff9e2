// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <vector>

#include "linkwright/optimise/combine.h"
#include "linkwright/optimise/methods.h"
#include "linkwright/optimise/minimise.h"
#include "linkwright/optimise/pagmo_bridge.h"

namespace {

using namespace linkwright;
using namespace linkwright::optimise;

Problem sphere(std::size_t dimension) {
  Problem problem;
  for (std::size_t j = 0; j < dimension; ++j) problem.variables.push_back({fmt::format("x{}", j), -5, 3});
  problem.evaluate = [](const PopulationView& x, std::span<double> cost, std::span<double> violation) {
    for (std::size_t i = 0; i < x.size; ++i) cost[i] = violation[i] = 0;
    for (std::size_t j = 0; j < x.dimension; ++j) {
      const double* row = x.row(j);
      for (std::size_t i = 0; i < x.size; ++i) cost[i] += row[i] * row[i];
    }
  };
  return problem;
}

constexpr int generations = 1000;

/// Everything between two evaluations, with ask and tell: the objective is the first variable, that is next
/// to nothing.
void overhead(benchmark::State& state, OptimiserOptions options) {
  const auto n = static_cast<int>(state.range(0));
  options.differential_evolution.population = n;
  options.self_adaptive_differential_evolution.population = n;
  options.grey_wolf.population = n;
  options.particle_swarm.population = n;
  options.jade.population = n;
  options.grey_wolf.generations = 1000;
  const Problem problem = sphere(10);
  const auto optimiser = make_optimiser(problem.variables, options, {});
  const std::vector<double> violation(optimiser->population(), 0.0);
  for (auto _ : state) {
    const PopulationView candidates = optimiser->ask();
    optimiser->tell({candidates.row(0), candidates.size}, violation);
  }
  state.counters["ns_per_evaluation"] =
      benchmark::Counter(1e-9 * static_cast<double>(state.iterations() * n),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// A whole run with minimise: sphere of 10 variables, log and all. Fireflies and cuckoos make several rounds
/// a generation, most of one evaluation.
void whole_run(benchmark::State& state, OptimiserOptions options) {
  const auto n = static_cast<int>(state.range(0));
  options.differential_evolution.population = n;
  options.self_adaptive_differential_evolution.population = n;
  options.grey_wolf.population = n;
  options.particle_swarm.population = n;
  options.jade.population = n;
  options.firefly.population = options.cuckoo_search.population = options.hybrid_cuckoo_firefly.population =
      options.subpopulation_firefly.population = n;
  options.cma_es.population = n;
  MinimiseOptions minimise_options;
  minimise_options.stop.generations = generations;
  const Problem problem = sphere(10);
  RunContext context;
  context.set_threads(1);
  std::uint64_t seed = 0;
  std::int64_t evaluations = 0;
  for (auto _ : state)
    evaluations += minimise(problem, options, minimise_options, {.seed = ++seed}, context).evaluations;
  state.counters["ns_per_evaluation"] = benchmark::Counter(
      1e-9 * static_cast<double>(evaluations), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Two objectives, which pull to two corners.
Problem two_spheres() {
  Problem problem = sphere(10);
  problem.objectives = 2;
  problem.evaluate = [](const PopulationView& x, std::span<double> cost, std::span<double> violation) {
    for (std::size_t i = 0; i < x.size; ++i) {
      cost[2 * i] = cost[2 * i + 1] = violation[i] = 0;
      for (std::size_t j = 0; j < x.dimension; ++j) {
        cost[2 * i] += x(j, i) * x(j, i);
        cost[2 * i + 1] += (x(j, i) - 2) * (x(j, i) - 2);
      }
    }
  };
  return problem;
}

/// The moves of all objectives, the incumbent, and a front of 100.
void several_objectives(benchmark::State& state, OptimiserOptions options) {
  Problem problem = two_spheres();
  if (!takes_several_objectives(options.method)) problem = weighted_sum(problem);
  MinimiseOptions minimise_options;
  minimise_options.stop.generations = generations;
  minimise_options.front = static_cast<std::size_t>(state.range(0));
  RunContext context;
  context.set_threads(1);
  std::uint64_t seed = 0;
  std::int64_t evaluations = 0;
  for (auto _ : state)
    evaluations += minimise(problem, options, minimise_options, {.seed = ++seed}, context).evaluations;
  state.counters["ns_per_evaluation"] = benchmark::Counter(
      1e-9 * static_cast<double>(evaluations), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// The same by methods of pagmo, log and all.
void fronts_by_pagmo(benchmark::State& state, PagmoMethod method) {
  PagmoOptions options = {.method = method};
  options.nsga2.population = options.moead.population = static_cast<int>(state.range(0));
  const Problem problem = two_spheres();
  RunContext context;
  context.set_threads(1);
  std::uint64_t seed = 0;
  std::int64_t evaluations = 0;
  for (auto _ : state)
    evaluations += minimise_with_pagmo(problem, options, {}, {.seed = ++seed}, context).evaluations;
  state.counters["ns_per_evaluation"] = benchmark::Counter(
      1e-9 * static_cast<double>(evaluations), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void sphere_only(benchmark::State& state) {
  const Problem problem = sphere(10);
  const auto n = static_cast<std::size_t>(state.range(0));
  const Population x(10, n);
  std::vector<double> cost(n), violation(n);
  for (auto _ : state) {
    problem.evaluate(x.view(), cost, violation);
    benchmark::DoNotOptimize(cost.data());
  }
  state.counters["ns_per_evaluation"] =
      benchmark::Counter(1e-9 * static_cast<double>(state.iterations() * state.range(0)),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

const OptimiserOptions cma_es = {.method = Method::cma_es};
const OptimiserOptions de = {.method = Method::differential_evolution};
const OptimiserOptions jde = {.method = Method::self_adaptive_differential_evolution};
const OptimiserOptions wolf = {.method = Method::grey_wolf};
const OptimiserOptions jade = {.method = Method::jade};
const OptimiserOptions best_1 = {.differential_evolution = {.scheme = MutationScheme::best_1}};
const OptimiserOptions swarm = {.method = Method::particle_swarm};
const OptimiserOptions firefly = {.method = Method::firefly};
const OptimiserOptions cuckoo = {.method = Method::cuckoo_search};
const OptimiserOptions hybrid = {.method = Method::hybrid_cuckoo_firefly};
const OptimiserOptions parts = {.method = Method::subpopulation_firefly};

BENCHMARK_CAPTURE(overhead, differential_evolution, de)->Arg(30)->Arg(100)->Arg(1000);
BENCHMARK_CAPTURE(overhead, self_adaptive_differential_evolution, jde)->Arg(30)->Arg(100)->Arg(1000);
BENCHMARK_CAPTURE(overhead, grey_wolf, wolf)->Arg(30)->Arg(100)->Arg(1000);
BENCHMARK_CAPTURE(overhead, differential_evolution_best_1, best_1)->Arg(30)->Arg(100)->Arg(1000);
BENCHMARK_CAPTURE(overhead, jade, jade)->Arg(30)->Arg(100)->Arg(1000);
BENCHMARK_CAPTURE(overhead, particle_swarm, swarm)->Arg(30)->Arg(100)->Arg(1000);
BENCHMARK_CAPTURE(whole_run, differential_evolution, de)->Arg(30)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_run, self_adaptive_differential_evolution, jde)
    ->Arg(30)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_run, grey_wolf, wolf)->Arg(30)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_run, firefly, firefly)->Arg(40)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_run, cuckoo_search, cuckoo)->Arg(25)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_run, hybrid_cuckoo_firefly, hybrid)->Arg(25)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_run, subpopulation_firefly, parts)->Arg(40)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_run, cma_es, cma_es)->Arg(30)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fronts_by_pagmo, nsga2, PagmoMethod::nsga2)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fronts_by_pagmo, moead, PagmoMethod::moead)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(several_objectives, cuckoo_search, cuckoo)->Arg(0)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(several_objectives, subpopulation_firefly, parts)
    ->Arg(0)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(several_objectives, differential_evolution, de)
    ->Arg(0)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(sphere_only)->Arg(30)->Arg(100);

}  // namespace
