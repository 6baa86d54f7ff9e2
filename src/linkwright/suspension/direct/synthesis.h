// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/sentence.h"
#include "linkwright/optimise/priorities.h"
#include "linkwright/suspension/corner/limits.h"
#include "linkwright/suspension/direct/corner_targets.h"

/// Wheel suspensions from what their wheels are to do (Poznanovic 2016, section 5.4).
namespace linkwright::suspension {

/// A wheel suspension to be found: objectives, most important first, and limits.
struct DirectTask {
  Suspension suspension;  ///< the suspension as given; its design variables are where a search may begin
  std::vector<DesignVariable> designed;
  Driver driver = Driver::wheel_centre_z;
  std::vector<TargetObjective> objectives;
  CornerLimits limits;  ///< at the positions of the targets
};

enum class DirectGoal { largest, least_squares, priorities, one };
constexpr std::array<EnumName<DirectGoal>, 4> names(DirectGoal) {
  return {{{DirectGoal::largest, "largest", "the largest deviation of all targets, in tolerances"},
           {DirectGoal::least_squares, "least_squares", "half the sum of squared deviations"},
           {DirectGoal::priorities, "priorities",
            "as many objectives as possible within tolerances, most important first, then the largest "
            "deviation of those after the first that is not"},
           {DirectGoal::one, "one", "the largest deviation of one objective, all others within tolerances"}}};
}

struct DirectOptions {
  DirectGoal goal = DirectGoal::largest;
  int one = 0;  ///< objective of the goal `one`
  /// Goal `priorities`: share by which the first objective beyond its tolerance may exceed its least
  /// deviation so that those after it come closer to theirs.
  double priority_margin = 0.01;
  int starts = 50;          ///< local searches
  int draws = 30;           ///< random designs tried for a start, until one assembles
  int refined = 3;          ///< best different ends of the starts that continue to the goal
  int evaluations = 400;    ///< largest number of evaluations of a local search
  double same_cost = 1e-6;  ///< relative: ends of least squares that count as the same
};

struct DirectStart {
  int draws = 0;       ///< until it assembled
  bool moved = false;  ///< towards the given design, since no draw assembled
  bool assembled = false;
  double cost = infinity;  ///< half the sum of squares at its end
  std::vector<double> x;
};

/// A target that is as far off as any.
struct ActiveTarget {
  std::size_t row = 0;   ///< row of DirectSynthesis::positions.rows
  double deviation = 0;  ///< in tolerances
};

struct DirectSynthesis {
  /// done; infeasible: no start assembled, or limits (for the goal `one` also tolerances) are missed;
  /// deadline, cancelled.
  Status status = Status::infeasible;
  Sentence reason;  ///< empty, or why it is infeasible
  Suspension suspension;
  std::vector<double> x;  ///< values of the design variables
  /// The same in shares of their ranges: what the design is made from, to the bit.
  std::vector<double> shares;
  TargetPositions positions;
  TargetAnswer answer;                    ///< at x, without derivatives
  std::vector<double> objectives;         ///< largest deviation of each, in tolerances
  double largest = infinity;              ///< largest deviation of all targets
  double half_sum_of_squares = infinity;  ///< half the sum of squared deviations
  optimise::PriorityKey key;              ///< objectives met, and the deviation of the next
  std::vector<ActiveTarget> active;       ///< within 1e-4 of the largest of what was minimised
  std::vector<LimitAnswer> limits;
  /// Singular values of the derivatives of the deviations by the design variables, each in units of its
  /// range, descending; with the direction (unit, in those units) of each. A small one is a direction that
  /// the targets hardly determine.
  std::vector<double> singular_values;
  std::vector<std::vector<double>> directions;
  std::vector<DirectStart> starts;
  int assembled = 0;     ///< starts that assembled
  int reached_best = 0;  ///< starts that reached the least half sum of squares found
  std::int64_t evaluations = 0;
};

/// Bounded least squares on all deviations with exact derivatives from random starts, then from the best
/// ends the goal by sequential quadratic programming in a trust region, which backs off from designs that do
/// not assemble. Starts run on RunContext::threads() threads, the same bits for any number. Throws
/// ContractError for numbers, objectives and limits that do not fit, and options out of range.
DirectSynthesis synthesise(const DirectTask& task, const DirectOptions& options, std::uint64_t seed,
                           RunContext& context);

/// The goal at a given design: everything of the report but starts.
DirectSynthesis assess(const DirectTask& task, const DirectOptions& options, const Suspension& suspension);
/// Assesses a design given by its shares, one a design variable.
DirectSynthesis assess(const DirectTask& task, const DirectOptions& options, std::span<const double> shares);

/// Differential evolution for comparison, with the settings of the source (NP 50, F 0.6, CR 0.9, at most 5000
/// generations, ended when all members are within 1e-5 m of the best): by priority for the goal `priorities`,
/// else the largest deviation. Designs that do not assemble rank last, by the positions that they reach.
struct DirectEvolution {
  DirectSynthesis found;
  int generations = 0;
};
DirectEvolution evolve(const DirectTask& task, const DirectOptions& options, std::uint64_t seed,
                       RunContext& context, int members = 50, int generations = 5000);

}  // namespace linkwright::suspension
