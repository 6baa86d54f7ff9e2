// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/optimise/nlopt_bridge.h"
#include "linkwright/optimise/optimiser.h"
#include "linkwright/optimise/smooth_problem.h"

namespace linkwright::optimise {

/// The treatment of several objectives.
enum class SmoothGoal {
  mean,     ///< the sum of weights times objectives, as they are 1 / number of objectives
  largest,  ///< the largest of weights times objectives, as they are 1, by its epigraph
};
constexpr std::array<EnumName<SmoothGoal>, 2> names(SmoothGoal) {
  return {{{SmoothGoal::mean, "mean", "the weighted mean of the objectives"},
           {SmoothGoal::largest, "largest", "the largest of the objectives"}}};
}

struct SmoothOptions {
  SmoothGoal goal = SmoothGoal::mean;
  int candidates = 4096;        ///< drawn to choose starts from
  int starts = 96;              ///< local searches at most
  int confirmations = 24;       ///< end when so many of them found the best cost; 0 = make all starts
  double same_cost = 1e-6;      ///< relative: ends that cost at most this much more than the best found it
  std::vector<double> weights;  ///< one an objective, at least 0; empty = as named at SmoothGoal
  std::vector<double> caps;     ///< no objective may exceed its own; infinite = free; empty = all free
  LocalOptions local = {.max_evaluations = 400, .step_tolerance = 1e-8, .decrease_tolerance = 1e-10};
  /// Name under which the ends are saved in the checkpoint of the run context; empty = not saved.
  std::string checkpoint = {};
};
template <class Visitor>
void fields(Visitor&& visit, SmoothOptions& o) {
  visit(field::entry("candidates", "candidates drawn to choose starts from").between(1, 1e7), o.candidates);
  visit(field::entry("starts", "local searches at most").between(1, 1e6), o.starts);
  visit(field::entry("confirmations", "end when so many searches found the best cost; 0 = make all starts")
            .between(0, 1e6),
        o.confirmations);
  visit(field::entry("same_cost", "relative: costs that differ by less are the same").between(0, 1),
        o.same_cost);
}

/// The end of one start.
struct SmoothEnd {
  double cost = infinity;
  double violation = 0;  ///< largest of the constraints and caps at x; 0 when each holds
  LocalEnd end = LocalEnd::success;
  std::int64_t evaluations = 0;
  std::vector<double> x;
};

/// A limit that stops the cost from being less, or a part of the cost.
enum class LimitKind { lower_bound, upper_bound, cap, constraint, objective };
constexpr std::array<EnumName<LimitKind>, 5> names(LimitKind) {
  return {{{LimitKind::lower_bound, "lower_bound"},
           {LimitKind::upper_bound, "upper_bound"},
           {LimitKind::cap, "cap"},
           {LimitKind::constraint, "constraint"},
           {LimitKind::objective, "objective", "one of those that are largest together"}}};
}
struct ActiveLimit {
  LimitKind kind = LimitKind::lower_bound;
  std::size_t index = 0;  ///< index of the variable, objective or constraint
  /// Lagrange multiplier: how much the cost falls for a unit by which the limit is loosened (a unit of the
  /// variable, of the objective, of the constraint). Of an objective: its share in the cost; they add up
  /// to 1.
  double price = 0;
  /// Decrease of the cost when a bound or cap is loosened by a hundredth of its value; 0 for others.
  double price_per_cent = 0;
};

struct SmoothReport {
  /// done, infeasible (no start met every constraint), not_converged (no start came to an end), deadline or
  /// cancelled.
  Status status = Status::done;
  std::string stop_reason;
  std::vector<double> x;            ///< the best design
  std::vector<double> objectives;   ///< at x
  std::vector<double> constraints;  ///< at x
  double cost = infinity;
  double violation = infinity;      ///< sum of the violations, as in SmoothEnd
  std::int64_t evaluations = 0;     ///< candidates, those of derivatives included
  std::vector<SmoothEnd> ends;      ///< ends of all starts made, in order
  int reached_best = 0;             ///< number of starts that reached the best cost, see same_cost
  std::vector<ActiveLimit> active;  ///< at x, largest price per cent first
  /// The remainder of the gradient of the cost at x when the active limits are taken into account, relative
  /// to that gradient, variables in parts of the widths of their bounds: 0 at a minimum.
  double stationarity = nan;
};

/// Minimises several smooth objectives with caps and constraints from many starts: the recommended method
/// where derivatives exist but are not written down. Candidates uniform in the bounds are evaluated as one
/// population; from the best ones that lie apart, sequential quadratic programming (`slsqp`) goes down, with
/// derivatives by central differences, all of a point evaluated as one population (one-sided at bounds and
/// where a neighbour does not exist). It ends when the best found has been found again, or after all starts.
///
/// Starts run in rounds of eight, in parallel on RunContext::threads() threads; the same bits for any number
/// of threads. With a checkpoint, finished rounds are saved, and a later call continues after them; it throws
/// CheckpointError when the saved state is not of such a minimisation. Throws ContractError for options out
/// of range, weights below 0 or all 0, caps that are NaN, lists of wrong length and bounds that are not
/// finite or not ordered.
SmoothReport minimise_smooth(const SmoothProblem& problem, const SmoothOptions& options, const Seed& seed,
                             RunContext& context);

/// The local search alone, from one start, with the report of a single end.
SmoothReport minimise_smooth_from(const SmoothProblem& problem, const SmoothOptions& options,
                                  std::span<const double> start, RunContext& context);

}  // namespace linkwright::optimise
