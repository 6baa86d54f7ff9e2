// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"

namespace linkwright::optimise {

/// constant + the sum over i of factors[i] x[variables[i]]; a variable may appear in it once.
struct Affine {
  std::vector<std::size_t> variables;
  std::vector<double> factors;
  double constant = 0;
};
double value(const Affine& form, std::span<const double> x);

/// A second-order cone, |(parts[0](x), parts[1](x), ...)| <= bound(x); without parts the linear inequality
/// 0 <= bound(x).
struct Cone {
  Affine bound;
  std::vector<Affine> parts;
};

/// |(parts(x))|^2 <= first(x) second(x), first >= 0, second >= 0, as a cone:
/// |(2 parts, first - second)| <= first + second.
Cone rotated_cone(const std::vector<Affine>& parts, const Affine& first, const Affine& second);

/// Minimise the sum of cost[j] x[j] subject to all cones. Every variable must appear in a cone.
struct ConeProgramme {
  std::vector<double> cost;
  std::vector<Cone> cones;
};

struct ConeOptions {
  double gap = 1e-10;       ///< stop when cost and lower bound differ by at most this, relative (see below)
  double absolute_gap = 0;  ///< or by at most this, in the unit of the cost: for optima of 0
  double residual = 1e-10;  ///< and no equation is off by more than this, relative
  int max_iterations = 100;
};

/// The reason why the search ended.
enum class ConeEnd {
  optimal,     ///< within the tolerances
  infeasible,  ///< no x meets all cones; the multipliers prove it
  unbounded,   ///< the cost falls without end along x
  rounding,    ///< no progress for rounding; see `status`
  iterations,  ///< max_iterations
  interrupted  ///< by the run context
};
constexpr std::array<EnumName<ConeEnd>, 6> names(ConeEnd) {
  return {{{ConeEnd::optimal, "optimal"},
           {ConeEnd::infeasible, "infeasible"},
           {ConeEnd::unbounded, "unbounded"},
           {ConeEnd::rounding, "rounding"},
           {ConeEnd::iterations, "iterations"},
           {ConeEnd::interrupted, "interrupted"}}};
}

/// Multipliers of one cone: bound >= |parts|. A bound that is larger by a small d lowers the least cost by
/// `bound` d.
struct ConeMultiplier {
  double bound = 0;
  std::vector<double> parts;
};

/// The optimum, and its proof. For any multipliers in their cones whose weighted sum of the cones equals the
/// cost, minus their weighted sum of the constants is a lower bound of every feasible cost (weak duality), so
/// that `lower_bound` and `cost` enclose the global optimum within `gap`, up to the residuals.
struct ConeReport {
  /// done: optimal (rounding: with all tolerances within 1e-7); infeasible; not_converged: unbounded,
  /// iterations, rounding; deadline, cancelled.
  Status status = Status::not_converged;
  ConeEnd end = ConeEnd::iterations;
  std::vector<double> x;   ///< empty when infeasible; when unbounded a direction along which the cost falls
  double cost = infinity;  ///< at x; -infinity when unbounded
  double lower_bound = -infinity;
  double gap = infinity;            ///< relative difference of both, see `solve`
  double dual_residual = infinity;  ///< residual of the equilibrated dual equations
  double violation = infinity;      ///< largest |parts| - bound at x, >= 0
  /// One a cone. When infeasible: their weighted sum of the cones is 0 and that of the constants -1, which no
  /// x can meet. Empty when unbounded.
  std::vector<ConeMultiplier> multipliers;
  int iterations = 0;
};

/// Solves a cone programme by the homogeneous primal-dual interior-point method with scaling of Nesterov and
/// Todd and Mehrotra's correction (Andersen, Roos and Terlaky 2003; Vandenberghe 2010, "The CVXOPT linear and
/// quadratic cone program solvers"): no start is needed, and an infeasible programme is proved so. Equations
/// are sparse and symmetric (LDL'), so that variables which appear in few cones cost little. Deterministic.
///
/// `gap` in the options is relative to the larger of |cost| and |lower bound|, but at least to 1e-10 of the
/// largest sum of |cost[j] x[j]|. The run context is asked before every iteration.
///
/// Throws ContractError for no variables, numbers that are not finite, a variable out of range, one that
/// appears in no cone or twice in an expression, and options out of range.
ConeReport solve(const ConeProgramme& programme, const ConeOptions& options, RunContext& context);

}  // namespace linkwright::optimise
