#include "linkwright/optimise/smooth_problem.h"

#include <cmath>
#include <limits>
#include <utility>

#include "linkwright/core/check.h"

namespace linkwright::optimise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Values of the population in memory of the thread, then `answer` for every candidate.
template <class Answer>
void evaluate_each(const SmoothProblem& problem, const PopulationView& candidates, Answer&& answer) {
  thread_local std::vector<double> values;
  const std::size_t width = problem.values();
  if (values.size() < candidates.size * width) values.resize(candidates.size * width);
  const std::span<double> all(values.data(), candidates.size * width);
  problem.evaluate(candidates, all);
  for (std::size_t i = 0; i < candidates.size; ++i) {
    const std::span<const double> of = all.subspan(i * width, width);
    bool exists = true;
    for (std::size_t k = 0; k < problem.objectives; ++k) exists &= std::isfinite(of[k]);
    answer(i, of, exists, violation_of(of, problem.objectives));
  }
}

Problem shell(const SmoothProblem& problem) {
  LINKWRIGHT_REQUIRE(problem.objectives > 0, "a problem needs objectives");
  Problem out;
  out.variables = problem.variables;
  return out;
}

}  // namespace

double violation_of(std::span<const double> values, std::size_t objectives) {
  double sum = 0;
  bool finite = true;
  for (std::size_t k = 0; k < values.size(); ++k) {
    finite &= std::isfinite(values[k]);
    if (k >= objectives && std::isfinite(values[k]) && values[k] > 0) sum += values[k];
  }
  return finite ? sum : sum + 1;
}

Problem to_problem(const SmoothProblem& problem) {
  Problem out = shell(problem);
  out.objectives = problem.objectives;
  out.evaluate = [problem](const PopulationView& candidates, std::span<double> cost,
                           std::span<double> violation) {
    evaluate_each(problem, candidates,
                  [&](std::size_t i, std::span<const double> values, bool exists, double far) {
                    violation[i] = far;
                    for (std::size_t k = 0; k < problem.objectives; ++k)
                      cost[i * problem.objectives + k] = exists ? values[k] : infinity;
                  });
  };
  return out;
}

Problem to_weighted_problem(const SmoothProblem& problem, std::vector<double> weights) {
  Problem out = shell(problem);
  LINKWRIGHT_REQUIRE(weights.empty() || weights.size() == problem.objectives, "{} weights for {} objectives",
                     weights.size(), problem.objectives);
  if (weights.empty()) weights.assign(problem.objectives, 1 / static_cast<double>(problem.objectives));
  out.evaluate = [problem, weights = std::move(weights)](
                     const PopulationView& candidates, std::span<double> cost, std::span<double> violation) {
    evaluate_each(problem, candidates,
                  [&](std::size_t i, std::span<const double> values, bool exists, double far) {
                    violation[i] = far;
                    cost[i] = exists ? 0 : infinity;
                    for (std::size_t k = 0; exists && k < problem.objectives; ++k)
                      cost[i] += weights[k] * values[k];
                  });
  };
  return out;
}

}  // namespace linkwright::optimise
