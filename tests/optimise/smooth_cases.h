// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/optimise/smooth_problem.h"

namespace linkwright::test {}
namespace linkwright::optimise::test {
using namespace linkwright::test;  // shared by the tests of all modules

/// A problem of one candidate at a time: `value(x, out)` writes objectives and constraints.
template <class Value>
SmoothProblem smooth_problem(std::vector<Variable> variables, std::size_t objectives, std::size_t constraints,
                             Value value) {
  SmoothProblem p;
  p.variables = std::move(variables);
  p.objectives = objectives;
  p.constraints = constraints;
  p.evaluate = [=, n = p.variables.size()](const PopulationView& candidates, std::span<double> values) {
    std::vector<double> x(n);
    const std::size_t width = objectives + constraints;
    for (std::size_t i = 0; i < candidates.size; ++i) {
      for (std::size_t j = 0; j < n; ++j) x[j] = candidates(j, i);
      value(std::span<const double>(x), values.subspan(i * width, width));
    }
  };
  return p;
}

/// Squares of the distances to (1, 0) and (0, 2), subject to a + b <= 1; it does not exist for a > 2.
inline SmoothProblem two_points() {
  return smooth_problem({{"a", -3, 3}, {"b", -3, 3}}, 2, 1,
                        [](std::span<const double> x, std::span<double> out) {
                          const double a = x[0], b = x[1];
                          out[0] = (a - 1) * (a - 1) + b * b;
                          out[1] = a * a + (b - 2) * (b - 2);
                          out[2] = a + b - 1;
                          if (a > 2) out[0] = nan;
                        });
}

}  // namespace linkwright::optimise::test
