// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/smooth_problem.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/numbers.h"

namespace linkwright::optimise {

double violation_of(std::span<const double> values, std::size_t objectives) {
  double sum = 0;
  bool finite = true;
  for (std::size_t k = 0; k < values.size(); ++k) {
    finite &= std::isfinite(values[k]);
    if (k >= objectives && std::isfinite(values[k]) && values[k] > 0) sum += values[k];
  }
  return finite ? sum : sum + 1;
}

bool is_touched(std::span<const double> values) {
  return !std::all_of(values.begin(), values.end(), [](double v) { return v == untouched; });
}

SmoothProblem interruptible(SmoothProblem problem, const RunContext& context) {
  const std::size_t width = problem.values();
  auto evaluate = std::move(problem.evaluate);
  problem.evaluate = [evaluate = std::move(evaluate), width, &context](const PopulationView& candidates,
                                                                       std::span<double> values) {
    thread_local Population one;
    if (one.dimension() != candidates.dimension || one.size() != 1) one = Population(candidates.dimension, 1);
    for (std::size_t i = 0; i < candidates.size; ++i) {
      if (i > 0) throw_if_interrupted(context);
      for (std::size_t j = 0; j < candidates.dimension; ++j) one(j, 0) = candidates(j, i);
      evaluate(one.view(), values.subspan(i * width, width));
    }
  };
  return problem;
}

Problem to_problem(const SmoothProblem& problem) {
  LINKWRIGHT_REQUIRE(problem.objectives > 0, "a problem needs objectives");
  Problem out;
  out.variables = problem.variables;
  out.objectives = problem.objectives;
  out.evaluate = [problem](const PopulationView& candidates, std::span<double> cost,
                           std::span<double> violation) {
    thread_local std::vector<double> all;
    const std::size_t width = problem.values(), objectives = problem.objectives;
    if (all.size() < candidates.size * width) all.resize(candidates.size * width);
    const std::span<double> values(all.data(), candidates.size * width);
    const auto take = [&](std::size_t i) {
      const std::span<const double> of = values.subspan(i * width, width);
      violation[i] = violation_of(of, objectives);
      bool exists = true;
      for (std::size_t k = 0; k < objectives; ++k) exists &= std::isfinite(of[k]);
      for (std::size_t k = 0; k < objectives; ++k) cost[i * objectives + k] = exists ? of[k] : infinity;
    };
    std::fill(values.begin(), values.end(), untouched);
    try {
      problem.evaluate(candidates, values);
    } catch (const Interrupted&) {
      for (std::size_t i = 0; i < candidates.size; ++i)
        if (is_touched(values.subspan(i * width, width))) take(i);
      throw;
    }
    for (std::size_t i = 0; i < candidates.size; ++i) take(i);
  };
  return out;
}

}  // namespace linkwright::optimise
