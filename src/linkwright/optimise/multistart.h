// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/core/run_context.h"
#include "linkwright/math/function_ref.h"
#include "linkwright/math/least_squares.h"
#include "linkwright/optimise/optimiser.h"

namespace linkwright::optimise {

/// Writes start number `start` to x; false = no such start can be made, continue with the next. Draws from
/// `random` only, whose numbers belong to (seed, run, start), so that a start is the same wherever and
/// whenever it is made.
using StartGenerator = math::FunctionRef<bool(std::size_t start, RandomStream& random, std::span<double> x)>;

struct MultistartOptions {
  int starts = 100;
  /// No start begins after so many; 0 = no limit. They do not cut a local search short.
  std::int64_t evaluations = 0;
  double target_cost = -infinity;  ///< end when half the sum of squares is at most this
  /// Relative: ends that cost at most this much more than the best count as having reached it.
  double same_cost = 1e-6;
  math::LeastSquaresOptions local = {};
};

/// The end of one start.
struct MultistartEnd {
  std::size_t start = 0;
  math::LeastSquaresReport report;
  std::vector<double> x;
};

struct MultistartReport {
  Status status = Status::done;     ///< done, infeasible (no start could be evaluated), deadline or cancelled
  std::vector<MultistartEnd> ends;  ///< ends of all starts made, in order
  std::size_t best = 0;             ///< index of the cheapest end; the first of equals
  int reached_best = 0;             ///< ends that cost as much as the best, see same_cost
  std::int64_t evaluations = 0;
};

/// Local least squares from many starts, one after the other (seeds are what runs in parallel, see
/// for_each_seed). Arguments of the local searches as in math::minimise_least_squares. An interruption cuts
/// the search that is on short: its end is the best it had come to, not_converged.
MultistartReport multistart_least_squares(math::ResidualFunction function, std::size_t m, std::size_t n,
                                          std::span<const double> lower, std::span<const double> upper,
                                          StartGenerator generate, const MultistartOptions& options,
                                          const Seed& seed, RunContext& context);

}  // namespace linkwright::optimise
