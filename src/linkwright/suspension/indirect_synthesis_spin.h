#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/suspension/link_fit.h"

namespace linkwright::suspension {

struct SpinFitOptions {
  int starts = 30;               ///< local searches at most
  int iterations = 200;          ///< steps of each
  int final_iterations = 4000;   ///< steps of the best one of them
  double tolerance = 1e-7;       ///< m: root mean square of the structural errors at which the search ends
  double largest_spin = 0.5;     ///< rad: bound of the unknown spins
  double distinct_links = 5e-3;  ///< m: ends with two links nearer than this are refused
};

/// Links found together with the spin of the carrier that positions leave open.
struct SpinFit {
  /// done: within the tolerance; not_converged: the best of all starts; infeasible: every start ended in two
  /// equal links; deadline, cancelled: the best so far.
  Status status = Status::infeasible;
  std::vector<GuideLink> links;
  CarrierTargets targets;  ///< with the spins found, continuing those given
  double rms = std::numeric_limits<double>::infinity(), largest = rms;  ///< m
  int starts = 0;
  int refused = 0;  ///< ends with equal links, which leave the carrier a freedom more
  std::int64_t evaluations = 0;
};

/// Finds all links of a wheel guide at once when positions do not prescribe the spin of the carrier: every
/// spin that is NaN is an unknown, which enters the errors of its own position only (Poznanovic 2016,
/// section 5.3.5, in the place of its polynomial or its dyad). For KS, SS, RS, SR and RR links; throws
/// ContractError for others.
///
/// Five KS links then need 9 positions, and even with more the errors hardly tell one solution from another:
/// links whose errors are below a micrometre lie anywhere in boxes of 150 mm, with spins some degrees apart.
/// They all move the wheel as prescribed.
SpinFit fit_with_unknown_spin(const CarrierTargets& targets, std::span<const LinkTask> links,
                              const SpinFitOptions& options, std::uint64_t seed, RunContext& context);

}  // namespace linkwright::suspension
