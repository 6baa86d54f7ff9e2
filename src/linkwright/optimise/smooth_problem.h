// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/optimise/problem.h"

namespace linkwright::optimise {

/// Objectives and constraints one by one, where `Problem` knows their costs and one violation: what a method
/// needs that goes by derivatives.
struct SmoothProblem {
  std::vector<Variable> variables;
  std::size_t objectives = 1;
  std::size_t constraints = 0;

  /// Values of candidate i from values[i (objectives + constraints)] on: first the objectives, relative to
  /// references of theirs and to be minimised, then the constraints, dimensionless and met when g <= 0. An
  /// objective that is not finite says that the candidate does not exist, for example because a mechanism
  /// does not assemble; constraints may still be known then, and say how far it is from existing. Must be
  /// pure, as Problem::evaluate, and smooth: with continuous first derivatives where candidates exist. May
  /// throw Interrupted (core/interruption.h); values of candidates that it has not come to are then
  /// untouched.
  std::function<void(const PopulationView& candidates, std::span<double> values)> evaluate;

  std::size_t values() const { return objectives + constraints; }
};

/// The value that `values` hold before an evaluation that may be interrupted, by which one sees whether it
/// has written those of a candidate: no objective of a candidate is minus infinity.
inline constexpr double untouched = -infinity;
bool is_touched(std::span<const double> values);

/// The violation of one candidate: the sum of the positive parts of its constraints, and 1 more when an
/// objective or a constraint is not finite.
double violation_of(std::span<const double> values, std::size_t objectives);

/// The same problem, whose `evaluate` looks before each candidate but its first whether the run is to stop,
/// and then throws Interrupted: for candidates that take long. `context` must outlive it.
SmoothProblem interruptible(SmoothProblem problem, const RunContext& context);

/// The same problem for population methods, with as many objectives (combine.h makes one of them). Infinite
/// costs where the candidate does not exist. Where `evaluate` throws Interrupted so does that of the problem,
/// with costs and violations of the candidates before; the others are untouched.
Problem to_problem(const SmoothProblem& problem);

}  // namespace linkwright::optimise
