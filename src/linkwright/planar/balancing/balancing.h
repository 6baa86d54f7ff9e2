// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/table.h"
#include "linkwright/optimise/smooth_problem.h"
#include "linkwright/planar/balancing/four_bar.h"

// Balancing as a problem of numbers: measures of the columns of a mechanism's table, relative to a reference,
// are minimised.
namespace linkwright::planar {

struct BalancingGoal {
  std::string quantity;  ///< column of the table: "shaking_force_N"
  Measure measure = Measure::rms;
  double weight = 1;                ///< > 0
  std::optional<double> reference;  ///< counts as 1; default: the value of the initial design
  std::optional<double> at_most;    ///< value over reference may be at most this
  double target = 1;                ///< in order: met when value over reference is at most this, > 0
};

/// at_least <= measure <= at_most, in the unit of the column.
struct BalancingLimit {
  std::string quantity;
  Measure measure = Measure::max_abs;
  bool change = false;  ///< true for a limit of the difference between the design and the initial one
  std::optional<double> at_least, at_most;
  bool enabled = true;
};

/// The way in which several objectives f_k = value / reference become one answer, or a front.
enum class Combine { mean, largest, all, front, in_order };
constexpr std::array<EnumName<Combine>, 5> names(Combine) {
  return {{{Combine::mean, "mean", "least weighted mean of the ratios to the references"},
           {Combine::largest, "largest", "least value of the largest weighted ratio"},
           {Combine::all, "all", "a design counts as better only if no objective is worse (Boskovic 2018)"},
           {Combine::front, "front", "designs of which none is better in every objective"},
           {Combine::in_order, "in_order",
            "objectives in the order of the file, each until it meets its target; then the largest of all"}}};
}

/// The task of balancing: design variables, their meaning, objectives and limits.
struct BalancingTask {
  std::vector<optimise::Variable> variables;
  std::vector<double> initial;  ///< one a variable; may lie outside the bounds
  std::vector<BalancingGoal> objectives;
  std::vector<BalancingLimit> constraints;
  /// The columns that objectives and constraints name, of the design x; rows without an answer have NaN. Must
  /// be pure; called from several threads at once.
  std::function<Table(std::span<const double> x)> table;
  bool closes = false;  ///< the last row of a table is the first one again
};

/// A task with the numbers of its initial design.
struct BalancingProblem {
  BalancingTask task;
  Table initial;                   ///< columns of the initial design
  std::vector<double> references;  ///< one an objective, > 0
  /// Objectives: measure / reference. Constraints: one a limit, <= 0 when met, relative to the larger of the
  /// limit and the initial value. NaN for designs that have no answer somewhere.
  optimise::SmoothProblem problem;
};

/// Throws ContractError when a column is missing, or a reference that is not given would be zero, or the
/// initial design has no answer somewhere.
BalancingProblem balancing_problem(BalancingTask task);

/// Values of all objectives of a design, in the units of their columns.
std::vector<double> goal_values(const BalancingTask& task, const Table& table);

}  // namespace linkwright::planar
