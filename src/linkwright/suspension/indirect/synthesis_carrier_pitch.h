// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/suspension/indirect/corner_errors.h"
#include "linkwright/suspension/indirect/link_task.h"

namespace linkwright::suspension {

struct CarrierPitchFitOptions {
  CarrierPitchTechnique technique = CarrierPitchTechnique::each;
  int starts = 30;              ///< local searches at most
  int iterations = 200;         ///< steps of each
  int final_iterations = 4000;  ///< steps of each that is polished, the best first, until one is good enough
  double tolerance = 1e-7;      ///< m: root mean square of the structural errors at which the search ends
  double largest_carrier_pitch = 0.5;  ///< rad: bound of the unknown carrier pitches
  double distinct_links = 5e-3;        ///< m: ends with two links nearer than this are refused
  bool progress = true;                ///< report to the run context
};
template <class Visitor>
void fields(Visitor&& visit, CarrierPitchFitOptions& o) {
  visit(field::entry("technique", "what stands for the missing carrier pitch"), o.technique);
  visit(field::entry("starts", "local searches at most").between(1, 1e6), o.starts);
  visit(field::entry("iterations", "steps of each search").between(1, 1e6), o.iterations);
  visit(field::entry("final_iterations",
                     "steps of the best searches, one after the other until one is good enough")
            .between(1, 1e6),
        o.final_iterations);
  visit(field::length("tolerance", "root mean square of the structural errors at which the search ends")
            .positive(),
        o.tolerance);
  visit(field::angle("largest_carrier_pitch", "bound of the unknown carrier pitches").positive(),
        o.largest_carrier_pitch);
  visit(field::length("distinct_links", "ends with two links nearer than this are refused").not_negative(),
        o.distinct_links);
}

/// Links found together with the carrier pitch that positions leave open.
struct CarrierPitchFit {
  /// done: within the tolerance; not_converged: the best of all starts; infeasible: every start ended in two
  /// equal links; deadline, cancelled: the best so far.
  Status status = Status::infeasible;
  std::vector<CornerLink> links;
  std::vector<Coupler> couplers;
  CarrierTargets targets;  ///< targets with the carrier pitches found, continuing those given
  std::vector<ErrorTotals> link_errors, coupler_errors;
  double rms = infinity, largest = rms;  ///< m
  int starts = 0;
  int refused = 0;  ///< ends with equal links, which leave the carrier a freedom more
  std::int64_t evaluations = 0;
};

/// Finds all links and couplers of a wheel suspension at once when positions do not prescribe the carrier
/// pitch (Poznanovic 2016, section 5.3.5). Every carrier pitch that is NaN is an unknown, which enters the
/// errors of its own position only, or follows from the source's quadratic or dyad, see
/// CarrierPitchTechnique. Where positions are complete it is a least-squares fit of everything together.
///
/// Five US links then need 9 positions, and even with more the errors hardly distinguish one solution from
/// another: links whose errors are below a micrometre lie anywhere in boxes of 150 mm, with carrier pitches
/// some degrees apart. They all move the wheel as prescribed.
CarrierPitchFit fit_with_unknown_carrier_pitch(const CarrierTargets& targets, std::span<const LinkTask> links,
                                               const CarrierPitchFitOptions& options, std::uint64_t seed,
                                               RunContext& context,
                                               std::span<const CouplerTask> couplers = {});

/// One search from a place nearby, for links that share couplers and positions that are not exact.
CarrierPitchFit fit_together(const CarrierTargets& targets, std::span<const LinkTask> links,
                             std::span<const CouplerTask> couplers, std::span<const CornerLink> start,
                             std::span<const Coupler> coupler_start, const CarrierPitchFitOptions& options);

}  // namespace linkwright::suspension
