// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"
#include "linkwright/suspension/corner/carrier_poses.h"
#include "linkwright/suspension/indirect/link_task.h"

namespace linkwright::suspension {

/// The coupler found, and how well it fits.
struct CouplerFit {
  Status status = Status::infeasible;  ///< see LinkFit::status; infeasible also when a link is missing
  Coupler coupler;
  double offset = 0;                     ///< m, from the body point of the first link
  double rms = infinity, largest = rms;  ///< m: change of its length
};

/// Finds a coupler between links that are known: seen from the second link, the point on the first one moves
/// on a sphere about the coupler's other end. The centre solves a linear problem for every offset, so one
/// unknown is searched (Poznanovic 2016, section 5.3.4, decoupled). Where the centre then lies outside its
/// box, or the length changes by more than the tolerance, offset and point are searched together within their
/// limits, from the best point in the box for each of a row of offsets; the best end is taken. Throws
/// ContractError for links of other types and for a position without carrier pitch.
CouplerFit fit_coupler(const CarrierTargets& targets, std::span<const CornerLink> links,
                       const CouplerTask& task, double tolerance = 1e-8);

}  // namespace linkwright::suspension
