// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "linkwright/core/numbers.h"

namespace linkwright::planar {

/// Minimises under conditions "value <= 0" by passes of the augmented Lagrangian (Powell, Hestenes,
/// Rockafellar), from multipliers of 0 and values of minus infinity. `descend` minimises for the multipliers
/// and the penalty as they are and returns what it comes to, not finite where it fails; `evaluate` sets the
/// values of where it has come to. The penalty is ten times as large, at most 1e8, after a pass that leaves
/// more than a quarter of the violation.
///
/// Returns the largest violation, infinity where a descent fails.
template <class Descend, class Evaluate>
double minimise_by_multipliers(int passes, std::span<double> multipliers, std::span<double> values,
                               double& penalty, Descend&& descend, Evaluate&& evaluate) {
  std::fill(multipliers.begin(), multipliers.end(), 0.0);
  std::fill(values.begin(), values.end(), -infinity);
  double violation = 0, before = infinity;
  for (int pass = 0; pass < passes; ++pass) {
    if (!std::isfinite(descend())) return infinity;
    evaluate();
    double complementarity = 0;
    violation = 0;
    for (std::size_t row = 0; row < values.size(); ++row) {
      violation = std::max(violation, values[row]);
      if (multipliers[row] > 0)
        complementarity = std::max(complementarity, std::min(multipliers[row], std::abs(values[row])));
    }
    if (pass + 1 == passes || (violation <= 1e-10 && complementarity <= 1e-9)) break;
    for (std::size_t row = 0; row < values.size(); ++row)
      multipliers[row] = std::max(0.0, multipliers[row] + penalty * values[row]);
    if (violation > 0.25 * before) penalty = std::min(10 * penalty, 1e8);
    before = violation;
  }
  return violation;
}

}  // namespace linkwright::planar
