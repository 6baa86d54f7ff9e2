#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

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
  /// does not assemble; constraints may still be known then, and tell how far it is from existing. Must be
  /// pure, as Problem::evaluate, and smooth: with continuous first derivatives where candidates exist.
  std::function<void(const PopulationView& candidates, std::span<double> values)> evaluate;

  std::size_t values() const { return objectives + constraints; }
};

/// How far one candidate is from feasible: the sum of the positive parts of its constraints, and 1 more when
/// an objective or a constraint is not finite.
double violation_of(std::span<const double> values, std::size_t objectives);

/// The same problem for population methods, with as many objectives (combine.h makes one of them). Infinite
/// costs where the candidate does not exist.
Problem to_problem(const SmoothProblem& problem);

}  // namespace linkwright::optimise
