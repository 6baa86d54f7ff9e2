// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/optimise/methods.h"
#include "linkwright/optimise/optimiser.h"
#include "linkwright/optimise/pareto.h"
#include "linkwright/optimise/problem.h"

namespace linkwright::optimise {

/// When a run ends, whichever comes first.
struct StopCriteria {
  /// a generation that could exceed this is not started, except the first; 0 = no limit.
  std::int64_t evaluations = 0;
  int generations = 0;             ///< 0 = as the options of the method say
  double target_cost = -infinity;  ///< a feasible candidate costs at most this
  int stagnation = 0;              ///< generations in a row without a new best candidate; 0 = no limit
  /// The best was improved or equalled in this generation and no member is further than this from it
  /// (Euclidean, in the units of the variables); 0 = never. The criterion of the wheel-suspension studies.
  double spread = 0;
  /// No two members are further apart than this (Euclidean, in the units of the variables); 0 = never.
  double diameter = 0;
};
template <class Visitor>
void fields(Visitor&& visit, StopCriteria& o) {
  visit(field::entry("max_evaluations", "evaluations; 0 = no limit").between(0, 1e15), o.evaluations);
  visit(field::entry("target_cost", "end when a feasible candidate costs at most this"), o.target_cost);
  visit(field::entry("stagnation", "end after so many generations without a better candidate; 0 = never")
            .between(0, 1e9),
        o.stagnation);
  visit(field::entry("spread", "end when no member is further than this from the best; 0 = never")
            .not_negative(),
        o.spread);
  visit(field::entry("diameter", "end when no two members are further apart than this; 0 = never")
            .not_negative(),
        o.diameter);
}

/// The ranking of candidates that violate constraints.
enum class Constraints {
  feasibility_rules,  ///< Deb 2000, see better()
  penalty,            ///< by cost + weight [violation > 0], as many publications do
};
constexpr std::array<EnumName<Constraints>, 2> names(Constraints) {
  return {
      {{Constraints::feasibility_rules, "feasibility_rules", "feasible first, then by violation (Deb 2000)"},
       {Constraints::penalty, "penalty",
        "cost plus a constant for every candidate that violates a constraint"}}};
}

/// A known design that a minimisation is to improve on.
struct Incumbent {
  std::vector<double> x;      ///< need not lie in the bounds
  std::vector<double> costs;  ///< its own, as in Report::costs
};

struct MinimiseOptions {
  StopCriteria stop = {};
  Constraints constraints = Constraints::feasibility_rules;
  double penalty_weight = 1e3;
  Incumbent incumbent = {};  ///< see Optimiser::start_from; empty = none
  /// Keep up to so many feasible designs that no other one dominates in the objectives, see ParetoArchive;
  /// 0 = none.
  std::size_t front = 0;
  /// Keep one GenerationLog a generation; of more than 65 536 those of every second, fourth, ... one.
  bool log = true;
  bool progress = true;  ///< report to the run context
  /// Name under which the state is saved in the checkpoint of the run context, of its own for every
  /// minimisation of a run; empty = not saved.
  std::string checkpoint = {};
};
template <class Visitor>
void fields(Visitor&& visit, MinimiseOptions& o) {
  fields(visit, o.stop);
  visit(field::entry("constraints", "how candidates that violate constraints are ranked"), o.constraints);
  visit(
      field::entry("penalty_weight", "what a candidate that violates a constraint costs more").not_negative(),
      o.penalty_weight);
}

/// One generation; NaN where there is no (feasible) candidate. The cost of a candidate is the mean of all
/// when there are several objectives.
struct GenerationLog {
  std::int64_t evaluations = 0;  ///< so far, this generation included
  double best_cost = 0;          ///< cost of the best candidate so far, see Report::cost
  double best_violation = 0;
  double median = 0;  ///< cost of the feasible candidates of this generation
  double mean = 0;
  double violated = 0;  ///< share of its candidates that violate a constraint
};

struct Report {
  /// done: a stop criterion was met; infeasible: likewise, but no candidate met every constraint; deadline,
  /// cancelled.
  Status status = Status::done;
  std::string stop_reason;  ///< for people: "target cost 1e-08 reached"
  std::vector<double> x;    ///< best candidate, also when the run was interrupted
  /// Cost of the problem, without penalty: its objective, or the mean of all when there are several.
  double cost = infinity;
  /// All objectives of the best candidate; with a problem that is combined of several (combine.h) those.
  std::vector<double> costs;
  double violation = infinity;
  std::int64_t evaluations = 0;
  int generations = 0;
  std::vector<GenerationLog> log;
  /// Feasible designs of the run of which none dominates another, in the order of their costs; as
  /// MinimiseOptions::front has it. The incumbent to begin with is not among them.
  std::vector<ParetoPoint> front;
};

/// Minimises a problem by a population method. Interruption is looked for after every generation and before
/// each part of it but the first; a problem may look itself and throw Interrupted out of `evaluate`. Of a
/// generation that was cut short the best of what was evaluated counts. Populations of more than 256
/// candidates are evaluated in parts by RunContext::threads() threads; the result does not depend on that.
/// Throws ContractError for options out of range.
///
/// Several objectives are minimised together by those methods that can, see takes_several_objectives: what
/// is best, and stays so, is described at Optimiser::best. The target cost and the log are about the mean of
/// the objectives; a penalty counts for each of them. Methods of one objective minimise them combined, see
/// combine.h and priorities.h.
///
/// With a checkpoint the state is saved whenever Checkpoint::interval() has passed since the last time, and
/// at an interruption (before the generation that it cut short); a later call continues from there and ends
/// with the same bits. Throws CheckpointError when the saved state is not of such a minimisation.
Report minimise(const Problem& problem, const OptimiserOptions& method, const MinimiseOptions& options,
                const Seed& seed, RunContext& context);

/// The same with an optimiser of one's own, for at most `generations` more generations. `name` is the stage
/// of the progress.
Report minimise(const Problem& problem, Optimiser& optimiser, int generations, std::string_view name,
                const MinimiseOptions& options, RunContext& context);

}  // namespace linkwright::optimise
