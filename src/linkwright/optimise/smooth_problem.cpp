#include "linkwright/optimise/smooth_problem.h"

#include <cmath>
#include <limits>

#include "linkwright/core/check.h"

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
    problem.evaluate(candidates, values);
    for (std::size_t i = 0; i < candidates.size; ++i) {
      const std::span<const double> of = values.subspan(i * width, width);
      violation[i] = violation_of(of, objectives);
      bool exists = true;
      for (std::size_t k = 0; k < objectives; ++k) exists &= std::isfinite(of[k]);
      for (std::size_t k = 0; k < objectives; ++k)
        cost[i * objectives + k] = exists ? of[k] : std::numeric_limits<double>::infinity();
    }
  };
  return out;
}

}  // namespace linkwright::optimise
