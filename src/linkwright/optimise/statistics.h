// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/math/function_ref.h"
#include "linkwright/optimise/minimise.h"
#include "linkwright/optimise/pieces.h"

namespace linkwright::optimise {

/// Seeds first, first + 1, ... as a study gives them.
struct SeedRange {
  std::uint64_t first = 1;
  int count = 1;
};
/// The outcome of one seed.
struct SeedOutcome {
  double cost = infinity;
  double violation = 0;
  std::int64_t evaluations = 0;
};

/// Figures over seeds. A seed that ended infeasible counts as one of infinite cost.
struct SeedStatistics {
  int seeds = 0;
  int feasible = 0;
  double best = nan;  ///< costs; NaN when there are no seeds
  double quantile10 = best, quantile25 = best, median = best, quantile75 = best, quantile90 = best,
         worst = best;
  double mean = best;
  double threshold = 0;  ///< a seed succeeds when it is feasible and costs at most this
  int successes = 0;
  double success_rate = nan;
  std::int64_t evaluations = 0;  ///< evaluations of all seeds together
  double median_evaluations = best;
  /// Evaluations spent, failures included, for one success; infinite without success.
  double evaluations_per_success = infinity;
};

/// Linear between order statistics (type 7 of Hyndman and Fan 1996), p in [0, 1]; of nothing NaN. Infinite
/// values count.
double quantile(std::span<const double> sorted, double p);

SeedStatistics statistics(std::span<const SeedOutcome> outcomes, double threshold);

/// Calls body(i, seed i) for every seed as for_each_piece does.
PieceLoop for_each_seed(const SeedRange& seeds, RunContext& context, std::string_view stage,
                        math::FunctionRef<double(std::size_t index, std::uint64_t seed)> body);

/// Name of a seed in the checkpoint: "seed 7". What the body saves meanwhile has names below it.
std::string seed_name(std::uint64_t seed);

/// The same with a checkpoint, if the run context has one, which holds seeds under their names.
PieceLoop for_each_seed(const SeedRange& seeds, RunContext& context, std::string_view stage,
                        math::FunctionRef<double(std::size_t index, std::uint64_t seed)> body,
                        math::FunctionRef<Value(std::size_t index)> save,
                        math::FunctionRef<double(std::size_t index, const Value& value)> restore);

/// The same method on the same problem with many seeds.
struct SeedsReport {
  Status status = Status::done;      ///< done, infeasible (all seeds), deadline or cancelled
  std::vector<std::uint64_t> seeds;  ///< seeds that ran, in order; under an interruption perhaps not all
  std::vector<Report> reports;       ///< one a seed
  std::size_t best = 0;  ///< index of the best report, by the feasibility rules; the first of equals
  SeedStatistics statistics;
};

/// Runs `minimise` for every seed in parallel. The same bits for any number of threads.
SeedsReport minimise_seeds(const Problem& problem, const OptimiserOptions& method,
                           const MinimiseOptions& options, const SeedRange& seeds, double threshold,
                           RunContext& context);

}  // namespace linkwright::optimise
