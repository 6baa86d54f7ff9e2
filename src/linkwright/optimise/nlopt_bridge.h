// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/math/function_ref.h"

namespace linkwright::optimise {

/// The cost f(x) and, when `gradient` is not empty, df/dx_j at gradient[j].
using CostFunction = math::FunctionRef<double(std::span<const double> x, std::span<double> gradient)>;

/// Several functions of x: values[k] and, when `jacobian` is not empty, their derivatives by x_j at
/// jacobian[k n + j], n variables (row-major: one gradient after the other).
using ValuesFunction =
    math::FunctionRef<void(std::span<const double> x, std::span<double> values, std::span<double> jacobian)>;

/// Searches of NLopt from one start.
enum class LocalMethod {
  slsqp,   ///< sequential quadratic programming (Kraft 1994); needs derivatives
  cobyla,  ///< linear models without derivatives (Powell 1994)
  bobyqa,  ///< quadratic models without derivatives (Powell 2009); bounds only, at least two free variables
};
constexpr std::array<EnumName<LocalMethod>, 3> names(LocalMethod) {
  return {{{LocalMethod::slsqp, "slsqp", "sequential quadratic programming, with derivatives"},
           {LocalMethod::cobyla, "cobyla", "linear models, without derivatives"},
           {LocalMethod::bobyqa, "bobyqa", "quadratic models, without derivatives or constraints"}}};
}

struct LocalOptions {
  LocalMethod method = LocalMethod::slsqp;
  int max_evaluations = 1000;         ///< largest number of evaluations of the cost
  double step_tolerance = 1e-10;      ///< stop when a step changes every variable by less than this, relative
  double decrease_tolerance = 1e-14;  ///< stop when a step changes the cost by less than this, relative
  double constraint_tolerance = 1e-9;  ///< a constraint holds when its value is at most this
};
template <class Visitor>
void fields(Visitor&& visit, LocalOptions& o) {
  visit(field::entry("method", "local search"), o.method);
  visit(field::entry("max_evaluations", "evaluations of the cost").between(1, 1e9), o.max_evaluations);
  visit(field::entry("step_tolerance",
                     "end when a step is smaller than this, relative to the variables; 0 = never")
            .between(0, 1),
        o.step_tolerance);
  visit(field::entry("decrease_tolerance",
                     "end when a step changes the cost by less than this share; 0 = never")
            .between(0, 1),
        o.decrease_tolerance);
  visit(field::entry("constraint_tolerance", "a constraint holds when its value is at most this")
            .not_negative(),
        o.constraint_tolerance);
}

/// The reason why a local search ended.
enum class LocalEnd {
  step,         ///< step_tolerance
  decrease,     ///< decrease_tolerance
  success,      ///< the method sees no better point
  rounding,     ///< no progress for rounding: often as good as it gets
  evaluations,  ///< max_evaluations
  not_finite,   ///< a value or derivative was not finite
  failed,       ///< the method could not continue, for example towards a feasible point
  interrupted,  ///< by the run context
};
constexpr std::array<EnumName<LocalEnd>, 8> names(LocalEnd) {
  return {{{LocalEnd::step, "step"},
           {LocalEnd::decrease, "decrease"},
           {LocalEnd::success, "success"},
           {LocalEnd::rounding, "rounding"},
           {LocalEnd::evaluations, "evaluations"},
           {LocalEnd::not_finite, "not_finite"},
           {LocalEnd::failed, "failed"},
           {LocalEnd::interrupted, "interrupted"}}};
}

struct LocalReport {
  /// deadline, cancelled; else infeasible: no point met every constraint; not_converged: evaluations used up,
  /// a value that was not finite, or no possible step; else done.
  Status status = Status::done;
  LocalEnd end = LocalEnd::success;
  double cost = infinity;  ///< at x; infinite: not finite at the start
  double violation = 0;    ///< largest constraint at x, 0 when every one holds within its tolerance
  int evaluations = 0;     ///< calls of the cost
};

/// The status that goes with an end: `interruption` (deadline or cancelled) where it was interrupted.
Status status_of(LocalEnd end, double violation, Status interruption);

/// Minimises a smooth cost over lower <= x <= upper subject to m constraints g_k(x) <= 0 by NLopt (Johnson
/// 2007). x is the start, moved into the box first, and the best point evaluated in the end: of those where
/// the constraints hold the one that costs least, else the one that violates them least. The start may
/// violate constraints. Empty bounds mean unbounded; +-infinity is allowed. Cost and constraints are called
/// with empty derivatives by the methods that need none, and never outside the box by slsqp and bobyqa.
///
/// The run context is asked before every evaluation but the first. An exception of a function ends the search
/// and comes out of here.
///
/// Throws ContractError for spans of wrong length, lower > upper, a start that is not finite, constraints
/// with bobyqa, or options out of range.
LocalReport minimise_local(CostFunction cost, std::size_t m, ValuesFunction constraints, std::span<double> x,
                           std::span<const double> lower, std::span<const double> upper,
                           const LocalOptions& options, RunContext& context);

/// Without constraints.
LocalReport minimise_local(CostFunction cost, std::span<double> x, std::span<const double> lower,
                           std::span<const double> upper, const LocalOptions& options, RunContext& context);

}  // namespace linkwright::optimise
