// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/nlopt_bridge.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <new>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/finite.h"
#include "linkwright/core/interruption.h"
#include "linkwright/optimise/optimiser.h"

namespace linkwright::optimise {
namespace {

struct Destroy {
  void operator()(nlopt_opt o) const { nlopt_destroy(o); }
};
using Nlopt = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, Destroy>;

/// The data that the callbacks of one search share. NLopt asks for the cost and for the constraints at a
/// point one after the other, in either order; a point counts once both are known.
struct Search {
  CostFunction cost_function;
  ValuesFunction constraint_function;
  RunContext& context;
  bool constrained;
  double tolerance;
  nlopt_opt nlopt = nullptr;
  LocalReport report = {};
  std::vector<double> best, cost_at, constraints_at;
  double cost = 0, violation = 0;
  bool stopped = false, any = false;
  Status interruption = Status::done;
  std::exception_ptr thrown = nullptr;

  void stop(LocalEnd end) {
    if (!stopped) report.end = end;
    stopped = true;
    nlopt_force_stop(nlopt);
  }

  void consider(std::span<const double> x) {
    if (any && !better(cost, violation, report.cost, report.violation)) return;
    any = true;
    report.cost = cost;
    report.violation = violation;
    best.assign(x.begin(), x.end());
  }

  double evaluate_cost(std::span<const double> x, std::span<double> gradient) {
    if (report.evaluations > 0 && !stopped) {
      interruption = context.interruption();
      if (interruption != Status::done) stop(LocalEnd::interrupted);
    }
    if (stopped) return 0;
    ++report.evaluations;
    const double value = cost_function(x, gradient);
    if (!std::isfinite(value) || !all_finite(gradient)) {
      stop(LocalEnd::not_finite);
      return 0;
    }
    cost = value;
    cost_at.assign(x.begin(), x.end());
    if (!constrained || std::equal(x.begin(), x.end(), constraints_at.begin(), constraints_at.end()))
      consider(x);
    return value;
  }

  void evaluate_constraints(std::span<const double> x, std::span<double> values, std::span<double> jacobian) {
    std::fill(values.begin(), values.end(), 0.0);
    std::fill(jacobian.begin(), jacobian.end(), 0.0);
    if (stopped) return;
    constraint_function(x, values, jacobian);
    if (!all_finite(values) || !all_finite(jacobian)) {
      std::fill(values.begin(), values.end(), 0.0);
      std::fill(jacobian.begin(), jacobian.end(), 0.0);
      return stop(LocalEnd::not_finite);
    }
    const double largest = *std::max_element(values.begin(), values.end());
    violation = largest > tolerance ? largest : 0;
    constraints_at.assign(x.begin(), x.end());
    if (std::equal(x.begin(), x.end(), cost_at.begin(), cost_at.end())) consider(x);
  }
};

// Exceptions must not pass through the C frames of NLopt.
void note_exception(Search& search) {
  try {
    throw;
  } catch (const Interrupted& why) {
    search.interruption = why.status();
  } catch (...) {
    search.thrown = std::current_exception();
  }
  search.stop(LocalEnd::interrupted);
}
double call_cost(unsigned n, const double* x, double* gradient, void* data) {
  Search& search = *static_cast<Search*>(data);
  try {
    return search.evaluate_cost({x, n}, {gradient, gradient ? n : 0});
  } catch (...) {
    note_exception(search);
    return 0;
  }
}
void call_constraints(unsigned m, double* values, unsigned n, const double* x, double* jacobian, void* data) {
  Search& search = *static_cast<Search*>(data);
  try {
    search.evaluate_constraints({x, n}, {values, m}, {jacobian, jacobian ? std::size_t{m} * n : 0});
  } catch (...) {
    note_exception(search);
  }
}

nlopt_algorithm algorithm(LocalMethod method) {
  switch (method) {
    case LocalMethod::cobyla:
      return NLOPT_LN_COBYLA;
    case LocalMethod::bobyqa:
      return NLOPT_LN_BOBYQA;
    case LocalMethod::slsqp:
      break;
  }
  return NLOPT_LD_SLSQP;
}

LocalEnd end_of(nlopt_result result) {
  switch (result) {
    case NLOPT_XTOL_REACHED:
      return LocalEnd::step;
    case NLOPT_FTOL_REACHED:
      return LocalEnd::decrease;
    case NLOPT_MAXEVAL_REACHED:
      return LocalEnd::evaluations;
    case NLOPT_ROUNDOFF_LIMITED:
      return LocalEnd::rounding;
    case NLOPT_SUCCESS:
      return LocalEnd::success;
    default:
      return LocalEnd::failed;
  }
}

}  // namespace

LocalReport minimise_local(CostFunction cost, std::size_t m, ValuesFunction constraints, std::span<double> x,
                           std::span<const double> lower, std::span<const double> upper,
                           const LocalOptions& options, RunContext& context) {
  require_in_range("minimise_local", options);
  const std::size_t n = x.size();
  LINKWRIGHT_REQUIRE(n > 0, "a search needs variables");
  LINKWRIGHT_REQUIRE((lower.empty() || lower.size() == n) && (upper.empty() || upper.size() == n),
                     "{} lower and {} upper bounds for {} variables", lower.size(), upper.size(), n);
  LINKWRIGHT_REQUIRE(m == 0 || options.method != LocalMethod::bobyqa,
                     "bobyqa takes no constraints, got {}; slsqp and cobyla do", m);
  std::vector<double> low(n, -HUGE_VAL), high(n, HUGE_VAL);
  std::copy(lower.begin(), lower.end(), low.begin());
  std::copy(upper.begin(), upper.end(), high.begin());
  std::size_t free = 0;
  for (std::size_t j = 0; j < n; ++j) {
    LINKWRIGHT_REQUIRE(low[j] <= high[j], "bounds of variable {}: {} to {}", j, low[j], high[j]);
    LINKWRIGHT_REQUIRE(std::isfinite(x[j]), "start of variable {}: {}", j, x[j]);
    x[j] = std::clamp(x[j], low[j], high[j]);
    free += low[j] < high[j];
  }
  LINKWRIGHT_REQUIRE(free >= 2 || options.method != LocalMethod::bobyqa,
                     "bobyqa needs two free variables, got {}", free);

  Search search{.cost_function = cost,
                .constraint_function = constraints,
                .context = context,
                .constrained = m > 0,
                .tolerance = options.constraint_tolerance};
  search.best.reserve(n);
  search.cost_at.reserve(n);
  search.constraints_at.reserve(n);
  const Nlopt nlopt(nlopt_create(algorithm(options.method), static_cast<unsigned>(n)));
  if (!nlopt) throw std::bad_alloc();
  search.nlopt = nlopt.get();
  const std::vector<double> tolerances(m, options.constraint_tolerance);
  bool taken = nlopt_set_lower_bounds(nlopt.get(), low.data()) > 0 &&
               nlopt_set_upper_bounds(nlopt.get(), high.data()) > 0 &&
               nlopt_set_min_objective(nlopt.get(), call_cost, &search) > 0 &&
               nlopt_set_maxeval(nlopt.get(), options.max_evaluations) > 0 &&
               nlopt_set_xtol_rel(nlopt.get(), options.step_tolerance) > 0 &&
               nlopt_set_ftol_rel(nlopt.get(), options.decrease_tolerance) > 0;
  if (m > 0)
    taken = taken && nlopt_add_inequality_mconstraint(nlopt.get(), static_cast<unsigned>(m), call_constraints,
                                                      &search, tolerances.data()) > 0;
  if (!taken) throw std::bad_alloc();  // the only failure left: everything was checked above

  std::vector<double> at(x.begin(), x.end());
  double value = 0;
  const nlopt_result result = nlopt_optimize(nlopt.get(), at.data(), &value);
  if (search.thrown) std::rethrow_exception(search.thrown);
  if (result == NLOPT_OUT_OF_MEMORY) throw std::bad_alloc();
  LocalReport report = search.report;
  if (!search.stopped) report.end = end_of(result);
  if (search.any) std::copy(search.best.begin(), search.best.end(), x.begin());
  report.status = status_of(report.end, report.violation, search.interruption);
  return report;
}

LocalReport minimise_local(CostFunction cost, std::span<double> x, std::span<const double> lower,
                           std::span<const double> upper, const LocalOptions& options, RunContext& context) {
  return minimise_local(
      cost, 0, [](std::span<const double>, std::span<double>, std::span<double>) {}, x, lower, upper, options,
      context);
}

}  // namespace linkwright::optimise
