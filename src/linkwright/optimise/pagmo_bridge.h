// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/optimise/optimiser.h"
#include "linkwright/optimise/pareto.h"
#include "linkwright/optimise/problem.h"

namespace linkwright::optimise {

/// Methods of pagmo for several objectives. (Its CMA-ES, for one objective, is a Method like our own.)
enum class PagmoMethod { nsga2, moead };
constexpr std::array<EnumName<PagmoMethod>, 2> names(PagmoMethod) {
  return {{{PagmoMethod::nsga2, "nsga2", "sorting by non-domination and crowding (NSGA-II)"},
           {PagmoMethod::moead, "moead", "decomposition into weighted largest objectives (MOEA/D-DE)"}}};
}

/// NSGA-II (Deb, Pratap, Agarwal, Meyarivan 2002) with the settings of that paper. Evaluates whole
/// populations.
struct Nsga2Options {
  int population = 100;  ///< a multiple of 4, at least 8
  int generations = 250;
  double crossover = 0.9;  ///< probability
  /// Distribution index of simulated binary crossover; large = children near their parents.
  double crossover_index = 20;
  double mutation = 0;         ///< probability of a variable; 0 = one variable in the mean
  double mutation_index = 20;  ///< distribution index of polynomial mutation; large = small steps
};
template <class Visitor>
void fields(Visitor&& visit, Nsga2Options& o) {
  visit(field::entry("population", "members, a multiple of 4").between(8, 1e6), o.population);
  visit(field::entry("generations", "generations, the first included").between(1, 1e9), o.generations);
  visit(field::entry("crossover", "probability of crossover").between(0, 1), o.crossover);
  visit(
      field::entry("crossover_index", "distribution index of crossover; large = children near their parents")
          .between(1, 100),
      o.crossover_index);
  visit(field::entry("mutation", "probability that a variable mutates; 0 = one over their number")
            .between(0, 1),
        o.mutation);
  visit(field::entry("mutation_index", "distribution index of mutation; large = small steps").between(1, 100),
        o.mutation_index);
}

/// MOEA/D with moves of differential evolution (Li and Zhang 2009, with the settings of that paper) and
/// Chebyshev decomposition: every member minimises max_k w_k (f_k - least f_k) for weights w of its own,
/// which are a grid for two objectives and a sequence of low discrepancy for more. Objectives should be of
/// one magnitude. Moves follow from one another, so that candidates are evaluated one at a time.
struct MoeadOptions {
  int population = 100;
  int generations = 250;
  /// Members with the most similar weights, with whom one mates; less than `population`.
  int neighbours = 20;
};
template <class Visitor>
void fields(Visitor&& visit, MoeadOptions& o) {
  visit(field::entry("population", "members, more than neighbours").between(4, 1e6), o.population);
  visit(field::entry("generations", "generations, the first included").between(1, 1e9), o.generations);
  visit(field::entry("neighbours", "members with the most similar weights, with whom one mates")
            .between(2, 1e6),
        o.neighbours);
}

/// A method and the options of each; only those of the chosen method count.
struct PagmoOptions {
  PagmoMethod method = PagmoMethod::nsga2;
  Nsga2Options nsga2 = {};
  MoeadOptions moead = {};
};
/// `method` comes first; the keys after it are those of the method that was read.
template <class Visitor>
void fields(Visitor&& visit, PagmoOptions& o) {
  visit(field::entry("method", "method for several objectives"), o.method);
  if (o.method == PagmoMethod::moead)
    fields(visit, o.moead);
  else
    fields(visit, o.nsga2);
}

/// The options that all methods of several objectives share.
struct FrontOptions {
  /// A generation that would exceed this is not started, except the first; 0 = no limit.
  std::int64_t evaluations = 0;
  bool log = true;       ///< keep one FrontLog a generation; of many as MinimiseOptions::log
  bool progress = true;  ///< report to the run context
  /// Name under which the state is saved in the checkpoint of the run context, of its own for every
  /// minimisation of a run; empty = not saved.
  std::string checkpoint = {};
};
template <class Visitor>
void fields(Visitor&& visit, FrontOptions& o) {
  visit(field::entry("max_evaluations", "evaluations; 0 = no limit").between(0, 1e15), o.evaluations);
}

/// One generation.
struct FrontLog {
  std::int64_t evaluations = 0;  ///< so far, this generation included
  double violated = 0;           ///< share of the candidates of this generation that violate a constraint
  int front = 0;  ///< members that are feasible and dominated by none; of those of equal costs one
  std::vector<double> least;  ///< least value of each objective among them; infinite when there are none
};

struct FrontReport {
  /// done; infeasible: likewise, but no candidate met every constraint; deadline, cancelled.
  Status status = Status::done;
  std::string stop_reason;  ///< for people: "250 generations"
  /// Members of the last population that are feasible and dominated by none, by rising costs, the first
  /// objective first; of those of equal costs one. When nothing was feasible, the one candidate least
  /// violated.
  std::vector<ParetoPoint> front;
  double violation = 0;  ///< largest violation of all designs of the front
  std::int64_t evaluations = 0;
  int generations = 0;
  std::vector<FrontLog> log;
};

/// Minimises several objectives together. All candidates lie in the bounds; variables without a range stay
/// what they are. The methods know no constraints: a candidate that violates some is reported to have, in
/// every objective, the cost of `cost_by_feasibility_rules`, so that each feasible one dominates it and of
/// two infeasible ones the less violated dominates (the constrained domination of Deb et al. 2002).
///
/// Interruption is looked for after every generation; the first one always runs. The first population is
/// uniform in the box and the same for all methods of one seed. The random numbers after that are those of
/// pagmo and of the standard library it was built with, reseeded in every generation from the seed: results
/// are the same bits on one system for any number of threads. With a checkpoint the state is saved as in
/// `minimise`; throws CheckpointError when the saved state is not of such a minimisation.
///
/// Throws ContractError for a problem of one objective or options out of range.
FrontReport minimise_with_pagmo(const Problem& problem, const PagmoOptions& method,
                                const FrontOptions& options, const Seed& seed, RunContext& context);

/// Volume that is dominated by some of the points and dominates the reference point: the larger, the better
/// the front. costs[i m + k] is objective k of point i, m = reference.size() >= 2, as Problem::evaluate gives
/// them. Points that are not better than the reference in every objective count nothing. The time rises fast
/// with m.
/// Throws ContractError for spans of wrong length or values that are not finite.
double hypervolume(std::span<const double> costs, std::span<const double> reference);

/// The same for a front.
double hypervolume(std::span<const ParetoPoint> front, std::span<const double> reference);

}  // namespace linkwright::optimise
