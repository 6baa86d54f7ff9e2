// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/minimise_largest.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/optimise/problem.h"

namespace linkwright::optimise {

LocalReport minimise_largest(std::size_t functions, ValuesFunction objectives,
                             std::span<const double> references, std::size_t m, ValuesFunction constraints,
                             std::span<double> x, std::span<const double> lower,
                             std::span<const double> upper, const LocalOptions& options,
                             RunContext& context) {
  const std::size_t n = x.size();
  LINKWRIGHT_REQUIRE(functions > 0, "needs functions to minimise the largest of");
  LINKWRIGHT_REQUIRE(references.empty() || references.size() == functions, "{} references for {} functions",
                     references.size(), functions);
  for (std::size_t k = 0; k < references.size(); ++k)
    LINKWRIGHT_REQUIRE(references[k] > 0 && std::isfinite(references[k]),
                       "reference {} must be more than 0, got {}", k, references[k]);
  LINKWRIGHT_REQUIRE(options.method == LocalMethod::slsqp, "needs slsqp, got {}", name_of(options.method));
  LINKWRIGHT_REQUIRE(n > 0, "a search needs variables");
  LINKWRIGHT_REQUIRE((lower.empty() || lower.size() == n) && (upper.empty() || upper.size() == n),
                     "{} lower and {} upper bounds for {} variables", lower.size(), upper.size(), n);
  const auto reference = [&](std::size_t k) { return references.empty() ? 1.0 : references[k]; };

  // The start with its own largest ratio as t meets the first constraints.
  std::vector<double> xt(x.begin(), x.end()), low(n + 1, -HUGE_VAL), high(n + 1, HUGE_VAL);
  std::copy(lower.begin(), lower.end(), low.begin());
  std::copy(upper.begin(), upper.end(), high.begin());
  for (std::size_t j = 0; j < n; ++j) {
    LINKWRIGHT_REQUIRE(low[j] <= high[j], "bounds of variable {}: {} to {}", j, low[j], high[j]);
    LINKWRIGHT_REQUIRE(std::isfinite(x[j]), "start of variable {}: {}", j, x[j]);
    xt[j] = std::clamp(xt[j], low[j], high[j]);
  }
  std::vector<double> ratios(functions), rows(std::max(functions, m) * n);
  const auto largest = [&] {
    double most = -HUGE_VAL;
    for (std::size_t k = 0; k < functions; ++k) most = std::max(most, ratios[k] / reference(k));
    return most;
  };
  const std::span<const double> start(xt.data(), n);
  objectives(start, ratios, {});
  if (!std::all_of(ratios.begin(), ratios.end(), [](double v) { return std::isfinite(v); }))
    return {.status = Status::not_converged, .end = LocalEnd::not_finite};
  xt.push_back(largest());

  // The best x by what it really is: t lags behind on the way.
  LocalReport best;
  bool any = false;
  const auto violation_of = [&](std::span<const double> values) {
    const double most = values.empty() ? 0 : *std::max_element(values.begin(), values.end());
    return most > options.constraint_tolerance ? most : 0;
  };
  const auto evaluate = [&](std::span<const double> at, std::span<double> values,
                            std::span<double> jacobian) {
    const std::span<const double> point = at.first(n);
    const bool derivatives = !jacobian.empty();
    objectives(point, ratios, derivatives ? std::span(rows).first(functions * n) : std::span<double>());
    for (std::size_t k = 0; k < functions; ++k) {
      values[k] = ratios[k] / reference(k) - at[n];
      if (!derivatives) continue;
      double* row = jacobian.data() + k * (n + 1);
      for (std::size_t j = 0; j < n; ++j) row[j] = rows[k * n + j] / reference(k);
      row[n] = -1;
    }
    const std::span<double> limits = values.subspan(functions);
    if (m > 0) {
      constraints(point, limits, derivatives ? std::span(rows).first(m * n) : std::span<double>());
      for (std::size_t i = 0; derivatives && i < m; ++i) {
        double* row = jacobian.data() + (functions + i) * (n + 1);
        std::copy_n(rows.data() + i * n, n, row);
        row[n] = 0;
      }
    }
    const double cost = largest(), violation = violation_of(limits);
    const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (!finite || (any && !better(cost, violation, best.cost, best.violation))) return;
    any = true;
    best.cost = cost;
    best.violation = violation;
    std::copy(point.begin(), point.end(), x.begin());
  };
  const LocalReport found = minimise_local(
      [&](std::span<const double> at, std::span<double> gradient) {
        std::fill(gradient.begin(), gradient.end(), 0.0);
        if (!gradient.empty()) gradient[n] = 1;
        return at[n];
      },
      functions + m, evaluate, xt, low, high, options, context);
  best.end = found.end;
  best.evaluations = found.evaluations;
  best.status = status_of(best.end, best.violation, found.status);
  return best;
}

LocalReport minimise_largest(std::size_t functions, ValuesFunction objectives,
                             std::span<const double> references, std::span<double> x,
                             std::span<const double> lower, std::span<const double> upper,
                             const LocalOptions& options, RunContext& context) {
  return minimise_largest(
      functions, objectives, references, 0,
      [](std::span<const double>, std::span<double>, std::span<double>) {}, x, lower, upper, options,
      context);
}

}  // namespace linkwright::optimise
